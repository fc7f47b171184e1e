//! How much work the advice on each built-in scene is, counted, so that it does not depend on the machine.

use regatta::lab::{Adviser, LaneSpec, SCENES, Scene};

/// The work of the advice on all methods of a scene, in millions of evaluations of one coordinate. That of most nets is
/// that of hundreds of runs over twenty times the scene, which is what *bounded* claims.
const MILLIONS: [(&str, f64); 25] = [
    ("ship", 4.2),
    ("spring", 136.0),
    ("stiff", 97.0),
    ("chain", 932.0),
    ("pendulum", 366.0),
    ("liouville", 41.0),
    ("kicked-rotor", 99.0),
    ("orbit", 317.0),
    ("helm", 160.0),
    ("surge", 9.2),
    ("harbour", 266.0),
    ("duffing", 163.0),
    ("bouncing-bungee", 220.0),
    ("quarter-car", 356.0),
    ("lift", 160.0),
    ("jump", 11.4),
    ("rope", 8248.0),
    ("cloth", 1398.0),
    ("bridge", 3467.0),
    ("follow", 5.5),
    ("lerp", 10.0),
    ("held-force", 96.0),
    ("alike", 12.5),
    ("engines", 135.0),
    ("stiff-in-engines", 71.0),
];

/// An unoptimised build would take half an hour for all.
const MAX_MILLIONS: f64 = if cfg!(debug_assertions) { 12.0 } else { f64::INFINITY };

#[test]
fn the_work_of_advice_on_each_built_in_scene_is_what_it_was() {
    for scene in SCENES {
        let known = MILLIONS.iter().find(|(name, _)| *name == scene.name);
        let (name, wanted) = *known.unwrap_or_else(|| panic!("{} has no bound", scene.name));
        if wanted > MAX_MILLIONS {
            continue;
        }
        let scene = Scene::built_in(name).unwrap();
        let adviser = Adviser::new(&scene, 1.0, scene.tick_hz);
        let specs = scene.non_engine_methods().map(LaneSpec::plain);
        let mut advised: Vec<_> = specs.map(|spec| adviser.judged(spec)).collect();
        for (row, criterion) in adviser.worth_margins(&advised) {
            advised[row].search_margins(&adviser, criterion);
        }
        let found = adviser.work_done() as f64 / 1e6;
        assert!((0.8..1.2).contains(&(found / wanted)), "{name}: {found} million, not {wanted}");
    }
}
