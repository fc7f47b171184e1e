//! Faults that were mended, each in a recording of the scene where it was. The `about` of a recording says what was wrong.

use std::fs;
use std::path::Path;

use regatta::measure::Judge;
use regatta::scene::Scene;

use crate::recordings::wrong_lanes;

/// Each recording, with the present verdict on each of its lanes.
const FAULTS: &[(&str, &[&str])] = &[
    (
        "chain-keeps-its-swing",
        &["looks right · off by 31 % at 15.1 s", "looks right · main mode 0.032 % fast"],
    ),
    (
        "kick-after-a-lead",
        &[
            "looks right · 34 ms early after 20 s",
            "looks right · 15 ms early after 20 s",
            "looks right · 17 ms late after 20 s",
        ],
    ),
    ("orbit-falls-inward", &["dies away · reach ½ in 320 s"]),
    (
        "orbit-flung-out",
        &[
            "grows · reach ×2 in 1.3 s",
            "grows · reach ×2 in 1.2 s",
            "grows · reach ×2 in 1.2 s",
            "grows · reach ×2 in 1.2 s",
        ],
    ),
    ("phone-flips-too-seldom", &["inaccurate · flips 4 times instead of 6"]),
];

#[test]
fn a_mended_fault_stays_mended_in_the_recording_of_its_scene() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/faults");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), FAULTS.len());
    for (name, verdicts) in FAULTS {
        let text = fs::read_to_string(folder.join(name).with_extension("toml")).unwrap();
        let scene = Scene::parse(name, &text).unwrap_or_else(|errors| panic!("{errors}"));
        assert!(!scene.checks.is_empty() && !scene.about.is_empty(), "{name}");
        assert_eq!(wrong_lanes(&scene), [], "{name}");
        let judge = Judge::over(&scene, scene.seconds);
        let found = scene.lanes.iter().map(|lane| judge.verdict(*lane, scene.tick_hz).to_string());
        assert_eq!(found.collect::<Vec<_>>(), *verdicts, "{name}: {}", scene.about);
    }
}
