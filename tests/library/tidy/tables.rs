//! Every file is in its table, and every table's ids are fit to be typed.

use std::collections::BTreeSet;

use regatta::lab::pacing::POLICIES;
use regatta::lab::scene::SceneGroup;
use regatta::lab::{METRICS, SCENES, Scene};
use regatta::manual::CHAPTERS;
use regatta::sim::bodies::{BODIES, kind};
use regatta::sim::integrators::{Engine, Family, GENERAL_METHODS, METHODS, Method};

use super::{Source, none, root, sources};

/// The files that hold `mark` but are not listed in `table` as `name::`, and those listed without one.
fn unlisted(files: &[Source], mark: &str, table: &str) -> Vec<String> {
    let stem = |source: &Source| {
        let file = source.path.rsplit('/').next().unwrap_or_default();
        file.trim_end_matches(".rs").to_string()
    };
    let holding = files.iter().filter(|source| source.text.contains(mark)).map(stem);
    let holding: BTreeSet<String> = holding.collect();
    let entries = table.split(|c: char| c == ',' || c == '[' || c.is_whitespace());
    let entries = entries.filter_map(|entry| entry.split_once("::"));
    let listed: BTreeSet<String> = entries.map(|(name, _)| name.to_string()).collect();
    let complain = |name: &String| format!("{name} has a file or a line in the table, not both");
    holding.symmetric_difference(&listed).map(complain).collect()
}

/// What stands between `open` and the next `close` in a file.
fn between(path: &str, open: &str, close: char) -> String {
    let text = std::fs::read_to_string(root().join(path)).expect("the table's file");
    let (_, after) = text.split_once(open).expect("the table");
    after.split(close).next().unwrap_or_default().to_string()
}

#[test]
fn every_method_with_a_card_is_in_methods() {
    let folder = "src/sim/integrators";
    let files = sources(folder, &["rs"]);
    let table = between(&format!("{folder}/mod.rs"), "\nmethods! {", '}');
    none(unlisted(&files, "const CARD: Method", &table));
    assert_eq!(table.matches("::").count(), METHODS.len());
    let cards = files.iter().filter(|file| file.text.contains("const CARD: Method"));
    assert_eq!(cards.count(), METHODS.len());
}

#[test]
fn the_step_of_every_method_for_blocks_is_compiled_for_the_instruction_set_of_the_block() {
    let folder = "src/sim/integrators";
    let table = between(&format!("{folder}/mod.rs"), "\nmethods! {", '}');
    let in_blocks = table.lines().filter(|line| line.contains(" in blocks"));
    let names: Vec<_> = in_blocks.filter_map(|line| line.trim().split("::").next()).collect();
    let files = sources(folder, &["rs"]);
    let of = |name: &&str| files.iter().find(|file| file.path.ends_with(&format!("/{name}.rs")));
    let found: Vec<_> = names.iter().filter_map(of).collect();
    assert!(found.len() == names.len() && names.len() > 10, "{names:?}");
    // In any other way it is compiled once for all, and a third as fast.
    let is_inlined = |text: &str| text.contains("#[inline(always)]\n    fn step(");
    let others = found.into_iter().filter(|file| !is_inlined(&file.text));
    none(others.map(|file| format!("{}: step is not inlined always", file.path)).collect());
}

#[test]
fn every_body_with_a_card_is_in_bodies() {
    let folder = "src/sim/bodies";
    let table = between(&format!("{folder}/mod.rs"), "let kinds = [", ']');
    none(unlisted(&sources(folder, &["rs"]), "fn kind() -> Kind", &table));
    assert_eq!(table.matches("::").count(), BODIES.len());
}

#[test]
fn every_scene_file_is_built_in() {
    let files = sources("assets/scenes", &["toml"]);
    let files: BTreeSet<(&str, &str)> = files
        .iter()
        .map(|file| {
            let name = file.path.rsplit('/').next().unwrap_or_default();
            (name.trim_end_matches(".toml"), &*file.text)
        })
        .collect();
    let written = SCENES.iter().filter(|scene| !scene.text.is_empty());
    let listed: BTreeSet<(&str, &str)> = written.map(|scene| (scene.name, scene.text)).collect();
    assert_eq!(files, listed);
    for scene in SCENES {
        assert!(Scene::built_in(scene.name).is_some(), "{}", scene.name);
    }
    assert!(Scene::built_in("atlantis").is_none());
}

/// The rows of the manual's table that `head` begins.
fn manual_table(head: &str) -> Vec<String> {
    let after = CHAPTERS.iter().find_map(|chapter| chapter.text.split_once(head));
    let (_, after) = after.expect("the table");
    let rows = after.lines().skip(2).take_while(|line| line.starts_with('|'));
    rows.map(str::to_string).collect()
}

/// The ids at the heads of the rows of the manual's table that `head` begins.
fn manual_rows(head: &str) -> Vec<String> {
    let id = |row: &String| row.split('`').nth(1).expect("an id").to_string();
    manual_table(head).iter().map(id).collect()
}

/// A number without zeros at the end.
fn short(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// Up to which step the manual calls a method stable.
fn limit(method: &Method) -> String {
    match (method.family, method.stability_limit) {
        (Family::Adaptive, _) => "chooses its own step".into(),
        (Family::Engine, _) if method.engine.is_some_and(|engine| engine.modes.is_empty()) => {
            "has no spring".into()
        }
        (Family::Follower, None) => "follows at any step".into(),
        (Family::Follower, Some(limit)) => format!("follows up to k h = {}", short(limit, 2)),
        (_, None) => "at any step".into(),
        (_, Some(0.0)) if method.order == 1 => "0: it grows at any step".into(),
        (_, Some(0.0)) => "0: it grows, slowly at a fine step".into(),
        (_, Some(limit)) => short(limit, 2),
    }
}

/// The row of a method in the manual.
fn method_row(method: &Method) -> String {
    let Method { id, order, order_with_drag, .. } = method;
    let evaluations = match (method.evaluations, method.family) {
        (Some(evaluations), _) => evaluations.to_string(),
        (None, Family::Implicit) => "solves".into(),
        (None, Family::Linearised) => "takes derivatives".into(),
        (None, _) => "as many as it needs".into(),
    };
    format!("| `{id}` | {order} | {order_with_drag} | {evaluations} | {} |", limit(method))
}

/// The row of an engine in the manual.
fn engine_row(method: &Method) -> Option<String> {
    let Method { id, order, order_with_drag, default_substeps, engine, .. } = method;
    let Engine { tick_hz, damping_ratio, free_spin, version, logged, .. } = (*engine)?;
    let version = match (version, logged) {
        ("", _) => "a custom force".into(),
        (version, Some(_)) => version.to_string(),
        (version, None) => format!("{version}, read and not run"),
    };
    // Two digits that count.
    let digits = |x: f64| (1.0 - x.abs().log10().floor()).clamp(0.0, 9.0) as usize;
    let ratio = damping_ratio.map_or(String::new(), |ratio| match ratio {
        0.0 => "0".into(),
        _ => format!("{ratio:.*}", digits(ratio)).replace('-', "−"),
    });
    let maps = free_spin.map(|spin| [Some(spin.default), spin.opt_in]);
    let maps = maps.into_iter().flatten().flatten().map(|map| format!("`{}`", map.id()));
    let maps = maps.collect::<Vec<_>>().join(", or ");
    Some(format!(
        "| `{id}` | {version} | {tick_hz} × {default_substeps} | {order} | {order_with_drag} | {} | {ratio} | {maps} |",
        limit(method)
    ))
}

/// Holds the rows of the manual's table that `head` begins in a chapter against these; with `BLESS=1` they become these.
fn hold_rows(chapter: &str, head: &str, rows: &[String]) {
    let found = manual_table(head);
    if std::env::var_os("BLESS").is_some_and(|value| value == "1") {
        let path = root().join(format!("src/manual/{chapter}.md"));
        let text = std::fs::read_to_string(&path).expect("a chapter");
        let text = text.replace(&found.join("\n"), &rows.join("\n"));
        std::fs::write(path, text).expect("a chapter that is written");
        return;
    }
    assert_eq!(found, rows, "BLESS=1 cargo test --test library tables writes them again");
}

#[test]
fn the_manual_says_of_every_method_and_engine_what_its_card_does() {
    let (engines, methods): (Vec<&Method>, Vec<&Method>) =
        METHODS.iter().partition(|method| method.is_engine());
    let rows: Vec<String> = methods.into_iter().map(method_row).collect();
    hold_rows("methods", "| method | order |", &rows);
    let rows: Vec<String> = engines.into_iter().filter_map(engine_row).collect();
    hold_rows("engines", "| engine | version |", &rows);
}

#[test]
fn the_manual_lists_every_scene_and_times_every_general_method_in_the_order_of_the_table() {
    let timed = manual_rows("| method | ship, ns |");
    assert_eq!(timed, GENERAL_METHODS.iter().map(|method| method.id).collect::<Vec<_>>());
    for group in SceneGroup::ALL {
        let scenes = SCENES.iter().filter(|scene| scene.group == group);
        let names: Vec<&str> = scenes.map(|scene| scene.name).collect();
        assert_eq!(manual_rows(&format!("| {} | what it shows |", group.title())), names);
    }
    assert!(
        SCENES.is_sorted_by_key(|scene| SceneGroup::ALL.iter().position(|g| *g == scene.group))
    );
}

#[test]
fn the_readme_lists_every_chapter_and_every_chapter_begins_with_its_title() {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("the README");
    let (_, after) =
        readme.split_once("| chapter | what it is about |\n|---|---|\n").expect("the table");
    let listed: Vec<&str> = after.lines().take_while(|line| line.starts_with('|')).collect();
    let rows = CHAPTERS.iter().map(|chapter| format!("| `{}` | {} |", chapter.id, chapter.about));
    assert_eq!(listed, rows.collect::<Vec<_>>());
    for chapter in CHAPTERS {
        assert!(chapter.text.starts_with("# "), "{}", chapter.id);
    }
}

#[test]
fn missing_files_and_lines_are_seen() {
    let file = |path: &str, text: &str| Source { path: path.into(), text: text.into() };
    let files =
        [file("a/rk4.rs", "const CARD"), file("a/mod.rs", ""), file("a/rk5.rs", "const CARD")];
    assert_eq!(unlisted(&files, "const CARD", "\n rk4::Rk4,\n rk5::Rk5,\n").len(), 0);
    assert_eq!(unlisted(&files, "const CARD", "rk4::Rk4").len(), 1);
    assert_eq!(unlisted(&files, "const CARD", "rk4::Rk4, rk5::Rk5, rk6::Rk6").len(), 1);
}

fn fit(ids: &[&str], dash: char) {
    let unique: BTreeSet<_> = ids.iter().collect();
    assert_eq!(unique.len(), ids.len(), "{ids:?}");
    let letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit();
    for id in ids {
        let word = |word: &str| !word.is_empty() && word.chars().all(letter);
        assert!(id.split(dash).all(word), "{id}");
    }
}

#[test]
fn ids_are_unique_and_fit_to_be_typed() {
    // `regatta show` takes either.
    let loops = POLICIES.iter().map(|card| card.id);
    fit(&METHODS.iter().map(|method| method.id).chain(loops).collect::<Vec<_>>(), '-');
    fit(&BODIES.iter().map(|kind| kind.id).collect::<Vec<_>>(), '-');
    fit(&SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>(), '-');
    fit(&METRICS.iter().map(|metric| metric.id).collect::<Vec<_>>(), '_');
    for body in BODIES.iter() {
        assert!(std::sync::Arc::ptr_eq(kind(body.id).expect("found by its id"), body));
        fit(&body.parameters.iter().map(|parameter| &*parameter.key).collect::<Vec<_>>(), '_');
        let defaults = body.parameters.iter().filter_map(|p| Some((p, p.default?)));
        for (parameter, default) in defaults {
            assert!(parameter.range.contains(default), "{} {}", body.id, parameter.key);
        }
    }
}
