//! Holds a scene's physics to the bits it had: what a game's own tests do in continuous integration.
//!
//! After an intended change, write the new hashes here.

use regatta::prelude::*;

const SCENE: &str = r#"
title = "A stiff spring"
tick_hz = 60
seconds = 10
methods = ["semi-implicit-euler", "rk4"]

[[spring]]
mass_kg = 1.0
stiffness_n_per_m = 10000.0
x0_m = 1.0
"#;

const HASHES: [(&str, u64); 2] =
    [("semi-implicit-euler", 0xb9da_5f20_e317_d036), ("rk4", 0xe182_79d1_2b95_ea9e)];

fn main() {
    let scene = Scene::parse("stiff.toml", SCENE).expect("the scene above");
    let mut race = Race::of_scene(&scene);
    race.run(600);
    let found: Vec<(&str, u64)> = race.hashes_by_method().collect();
    for (method, hash) in &found {
        println!("{method} {hash:016x}");
    }
    assert_eq!(found, HASHES, "the physics has changed");
}
