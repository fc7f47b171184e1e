//! The syntax of scene files, and the claims of the built-in scenes.

use regatta::scene::Scene;

mod built_in;
mod reading;

fn built_in(name: &str) -> Scene {
    Scene::built_in(name).unwrap_or_else(|| panic!("no scene {name}"))
}

/// A copy of a scene with this change.
pub(crate) fn edited(scene: &Scene, change: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = scene.clone();
    change(&mut scene);
    scene
}
