//! Hashes and verdicts. With them a test checks that a browser computes the same bits and judges alike.

use regatta::measure::Judge;
use regatta::run::Session;
use regatta::scene::{LaneSpec, Scene, SceneBody};
use wasm_bindgen::prelude::wasm_bindgen;

/// Returns the lines of a built-in scene in `tests/early_hashes.txt`, as computed here: the scene's name, a method, and
/// the hash of its lane. The second text is the same at tick 0. Returns nothing if there is no such scene.
#[wasm_bindgen]
pub fn early_hashes(scene: &str) -> Vec<String> {
    let Some(mut scene) = Scene::built_in(scene) else { return Vec::new() };
    let spec = |method| LaneSpec { method, ..scene.lanes[0] };
    scene.lanes = scene.fitting_methods().map(spec).collect();
    // The number of ticks is a twentieth of that in `tests/determinism.rs`.
    let coordinates = |body: &SceneBody| body.kind.coordinates(&body.values).len() as u64;
    let ticks = 400_000 / scene.bodies.iter().map(coordinates).sum::<u64>().max(4) / 20;
    let lines = |ticks| {
        let mut session = Session::racing(scene.clone().into());
        session.run(ticks);
        let hashes = session.race().lane_hashes();
        let line = |(lane, hash): (&LaneSpec, u64)| {
            format!("{} {} {hash:016x}\n", scene.name, lane.method.id)
        };
        scene.lanes.iter().zip(hashes).map(line).collect::<String>()
    };
    [ticks, 0].map(lines).into()
}

/// Returns the lines of a built-in scene in `tests/judged_words.txt`, as judged here: the scene's name, a method, and
/// its verdict. Returns an empty text if there is no such scene.
#[wasm_bindgen]
pub fn judged_words(scene: &str) -> String {
    let Some(scene) = Scene::built_in(scene) else { return String::new() };
    let judge = Judge::new(&scene);
    let line = |method| {
        let verdict = judge.verdict(LaneSpec { method, ..scene.lanes[0] }, scene.tick_hz);
        format!("{} {}: {verdict}\n", scene.name, method.id)
    };
    scene.fitting_methods().map(line).collect()
}
