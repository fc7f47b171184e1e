//! What a scene file may say, and what the built-in ones claim.

use regatta::scene::Scene;

mod built_in;
mod reading;

fn built_in(name: &str) -> Scene {
    Scene::built_in(name).unwrap_or_else(|| panic!("no scene {name}"))
}
