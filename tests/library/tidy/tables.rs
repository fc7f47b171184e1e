//! Every file is in its table, and every table's ids are fit to be typed.

use std::collections::BTreeSet;

use regatta::loops::POLICIES;
use regatta::run::METRICS;
use regatta::scene::{SCENES, Scene};
use regatta::sim::bodies::{BODIES, kind};
use regatta::sim::integrators::METHODS;

use super::paths::code;
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

/// The text between `open` and the next `close` in a file.
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
fn every_step_for_blocks_is_inlined_into_its_instruction_set() {
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

#[test]
fn contributing_lists_the_files_of_each_new_thing() {
    let text = std::fs::read_to_string(root().join("CONTRIBUTING.md")).expect("a text");
    let (_, after) = text.split_once("| thing | example | files |\n|---|---|---|\n").unwrap();
    let files = sources("src", &["rs"]);
    for row in after.lines().take_while(|line| line.starts_with('|')) {
        let mut ticked = row.split('`').skip(1).step_by(2);
        let (name, told) = (ticked.next().unwrap(), ticked.collect::<BTreeSet<_>>());
        let missing = told.iter().filter(|path| !root().join(path).exists());
        none(missing.map(|path| format!("{path} of {name} is not there")).collect());
        let own = format!("/{name}.rs");
        let is_named = |source: &&Source| {
            let code = code(&source.text);
            code.contains(&format!("mod {name};")) || code.contains(&format!(" {name}::"))
        };
        let naming: BTreeSet<&str> =
            files.iter().filter(is_named).map(|source| &*source.path).collect();
        let is_module = told.iter().any(|path| path.ends_with(&own));
        let rest = |path: &&&str| path.ends_with(".rs") && !path.ends_with(&own);
        let wanted: BTreeSet<&str> = told.iter().filter(rest).copied().collect();
        assert!(!is_module || naming == wanted, "{name}: {naming:?}");
    }
}

#[test]
fn missing_files_and_lines_are_detected() {
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
    let loops = POLICIES.iter().map(|card| &*card.id);
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

/// The packages that a list lacks, of those that tests want.
fn lacking(tests: &str, list: &str) -> Vec<String> {
    // Every Debian with a linker has the first ones, or none. `.ci/run` and rustup bring the last ones.
    let given =
        ["coreutils", "gcc", "mount, by root", "mcp 2.3.0 of Python (pip)", "clippy of rustup"];
    let wanted = tests.split("Need::new(\"").skip(1).filter_map(|rest| rest.split('"').next());
    let named: BTreeSet<&str> =
        list.split_whitespace().filter_map(|it| it.split(':').next()).collect();
    let lacking = wanted.filter(|package| !given.contains(package) && !named.contains(package));
    lacking.map(|package| format!("{package} is wanted by a test and not in the list")).collect()
}

#[test]
fn every_package_that_a_test_wants_is_in_the_readme_and_installed_by_ci() {
    for program in ["tools", "window"] {
        let path = root().join(format!("tests/{program}/main.rs"));
        let tests = std::fs::read_to_string(path).expect("the table of the tests");
        assert!(tests.matches("Need::new(").count() > 4, "{program}");
        none(lacking(&tests, &between("README.md", "`apt-get install ", '`')));
        none(lacking(&tests, &between(".ci/run", "packages=(", ')')));
    }
    let test = "Need::new(\"gcc\", f) Need::new(\"weston\", f)";
    assert_eq!([lacking(test, "xvfb weston:Weston").len(), lacking(test, "xvfb").len()], [0, 1]);
}
