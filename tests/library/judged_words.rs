//! The verdicts of eight scenes in words. `.ci/web-test.mjs` holds browsers to the same file.
//!
//! `BLESS=1 cargo test --test library judged_words` writes it again.

use std::path::Path;
use std::thread;

use regatta::measure::Judge;
use regatta::scene::{LaneSpec, Scene};

use crate::kept::hold_text;

/// At least one scene of each kind that a verdict has words for.
const SCENES: [&str; 8] =
    ["spring", "ship", "stiff", "jump", "lerp", "follow", "alike", "pendulum"];

/// A line for each method: the scene, the method, and its verdict.
fn words(scene: &str) -> String {
    let scene = Scene::built_in(scene).unwrap();
    let judge = Judge::new(&scene);
    let line = |method| {
        let verdict = judge.verdict(LaneSpec { method, ..scene.lanes[0] }, scene.tick_hz);
        format!("{} {}: {verdict}\n", scene.name, method.id)
    };
    scene.fitting_methods().map(line).collect()
}

#[test]
fn the_verdicts_of_eight_scenes_have_the_stored_words() {
    let found: String = thread::scope(|threads| {
        let scenes = SCENES.map(|scene| threads.spawn(move || words(scene)));
        scenes.map(|words| words.join().unwrap()).concat()
    });
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/judged_words.txt");
    if std::env::var_os("BLESS").is_some_and(|value| value == "1") {
        std::fs::write(&path, &found).unwrap();
    }
    let kept = std::fs::read_to_string(path).unwrap();
    let remedy = "BLESS=1 cargo test --test library judged_words writes them";
    hold_text("tests/judged_words.txt", &found, &kept, remedy);
}
