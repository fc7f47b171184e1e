//! Frames by the processor. With them a test checks that a browser computes the same bytes.

use regatta::scene::Scene;
use regatta::studio::{StageCommand, Studio, analyse_bounded};
use regatta::view::OffscreenRenderer;
use wasm_bindgen::prelude::wasm_bindgen;

/// Returns the pixels of `tests/golden/SCENE-race.png`, as drawn here: 400×225, red, green, blue and alpha, top row
/// first. Returns nothing if there is no such scene.
#[wasm_bindgen]
pub fn golden_race(scene: &str) -> Vec<u8> {
    let mut rgba = Vec::new();
    let Some(scene) = Scene::built_in(scene) else { return rgba };
    let mut studio = Studio::new(scene);
    studio.apply(StageCommand::ToggleRace);
    studio.deck.forget_changes();
    // As in `tests/program/golden.rs`.
    for _ in 0..130 {
        studio.advance(16_666_667);
    }
    analyse_bounded(&mut studio, |worker| Some(worker.finish()));
    if let Ok(mut renderer) = OffscreenRenderer::new([400, 225], 0.5) {
        renderer.draw(&studio, &mut rgba).expect("the processor returns every frame");
    }
    rgba
}
