//! The tables of the manual and of the README agree with the tables of the program.

use regatta::manual::CHAPTERS;
use regatta::scene::{SCENES, SceneGroup};
use regatta::sim::integrators::{Engine, Family, GENERAL_METHODS, METHODS, Method, OtherEngine};
use regatta::tools::port::{Setup, setups};

use crate::kept::hold_text;
use crate::tidy::root;

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
        (Family::Gyro, _) => "of a free rotation".into(),
        (Family::Interface, _) => "by a clock of its own".into(),
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

/// The row of another name of an engine in the manual.
fn other_engine_row(setup: &Setup) -> Option<String> {
    let OtherEngine { id, version, logged } = setup.mode.engine?;
    let logged = logged.unwrap_or("no log");
    Some(format!("| `{id}` | `{}` | {version} | {logged} |", setup.method.id))
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
    let remedy = "BLESS=1 cargo test --test library tables writes them";
    hold_text(&format!("src/manual/{chapter}.md"), &rows.join("\n"), &found.join("\n"), remedy);
}

/// The rows of the caveats: methods with the same one share a row.
fn caveat_rows() -> Vec<String> {
    let mut rows: Vec<(&str, Vec<String>)> = Vec::new();
    for method in METHODS.iter().filter(|method| !method.caveat.is_empty()) {
        let id = format!("`{}`", method.id);
        match rows.iter_mut().find(|(caveat, _)| *caveat == method.caveat) {
            Some((_, ids)) => ids.push(id),
            None => rows.push((method.caveat, vec![id])),
        }
    }
    rows.iter().map(|(caveat, ids)| format!("| {} | {caveat} |", ids.join(", "))).collect()
}

#[test]
fn the_manual_agrees_with_every_card_of_methods_and_engines() {
    hold_rows("methods", "| method | beware |", &caveat_rows());
    let (engines, methods): (Vec<&Method>, Vec<&Method>) =
        METHODS.iter().partition(|method| method.is_engine());
    let rows: Vec<String> = methods.into_iter().map(method_row).collect();
    hold_rows("methods", "| method | order |", &rows);
    let rows: Vec<String> = engines.into_iter().filter_map(engine_row).collect();
    hold_rows("engines", "| engine | version |", &rows);
    let rows: Vec<String> = setups(None, 60.0, None).iter().filter_map(other_engine_row).collect();
    hold_rows("engines", "| other name | card |", &rows);
}

#[test]
fn the_manual_lists_scenes_and_method_times_in_table_order() {
    let (head, measured) = ("| method | ship, ns |", manual_table("| method | ship, ns |"));
    let timed = |method: &Method| {
        let begin = format!("| `{}` | ", method.id);
        let row = measured.iter().find(|row| row.starts_with(&begin)).cloned();
        // A quiet machine measures it with the others.
        row.unwrap_or_else(|| format!("{begin}not measured |  |  |  |  |  |"))
    };
    hold_rows("speed", head, &GENERAL_METHODS.iter().map(timed).collect::<Vec<_>>());
    for group in SceneGroup::ALL {
        let scenes = SCENES.iter().filter(|scene| scene.group == group);
        let names: Vec<&str> = scenes.map(|scene| scene.name).collect();
        let rows = manual_rows(&format!("| {} | what it shows |", group.title()));
        let remedy = "each scene has a row there, by hand, in the order of SCENES";
        hold_text("src/manual/scenes.md", &names.join("\n"), &rows.join("\n"), remedy);
    }
    assert!(
        SCENES.is_sorted_by_key(|scene| SceneGroup::ALL.iter().position(|g| *g == scene.group)),
        "list SCENES in the order of SceneGroup::ALL"
    );
}

#[test]
fn the_readme_lists_every_chapter_and_every_chapter_begins_with_its_title() {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("the README");
    let (_, after) =
        readme.split_once("| chapter | what it is about |\n|---|---|\n").expect("the table");
    let listed: Vec<&str> = after.lines().take_while(|line| line.starts_with('|')).collect();
    let rows = CHAPTERS.iter().map(|chapter| format!("| `{}` | {} |", chapter.id, chapter.about));
    let remedy = "each chapter of CHAPTERS has this row there, by hand";
    hold_text("README.md", &rows.collect::<Vec<_>>().join("\n"), &listed.join("\n"), remedy);
    for chapter in CHAPTERS {
        assert!(chapter.text.starts_with("# "), "{}", chapter.id);
    }
}
