//! The manifest of the frames: its content, and its description.

use std::collections::BTreeSet;
use std::fs;
use std::process::Output;

use regatta::commands::manifest::{Manifest, SCHEMA};
use regatta::run::METRICS;
use regatta::scene::Scene;
use regatta::sim::integrators::METHODS;
use regatta::studio::{StageCommand, Studio};
use serde_json::Value;

use super::{run_in, stderr};

/// A small capture's manifest as text.
fn manifest(arguments: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let capture = format!("capture --size 32x18 --scale 0.5 --out clip {arguments}");
    let output = run_in(folder.path(), &capture);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    fs::read_to_string(folder.path().join("clip/manifest.json")).unwrap()
}

fn keys(value: &Value, into: &mut BTreeSet<String>) {
    match value {
        Value::Object(entries) => entries.iter().for_each(|(key, value)| {
            into.insert(key.clone());
            keys(value, into);
        }),
        Value::Array(entries) => entries.iter().for_each(|value| keys(value, into)),
        _ => {}
    }
}

#[test]
fn every_key_is_described_and_the_manifest_reads_back() {
    let text = manifest("--race --frames 3");
    let source = include_str!("../../../src/commands/manifest.rs");
    let description: String = source.lines().take_while(|line| line.starts_with("//!")).collect();
    let mut found = BTreeSet::new();
    keys(&serde_json::from_str(&text).unwrap(), &mut found);
    let metrics: Vec<&str> = METRICS.iter().map(|metric| metric.id).collect();
    for key in found.iter().filter(|key| !metrics.contains(&key.as_str())) {
        assert!(description.contains(&format!("`{key}`")), "{key} is not described");
    }
    assert!(metrics.iter().all(|&id| found.contains(id)));
    let manifest: Manifest = serde_json::from_str(&text).unwrap();
    assert_eq!(manifest.schema, SCHEMA);
    assert!(manifest.to_text() == text, "what is read is written again to the byte");
}

/// Captures this scene, with the output of `verify`.
fn captured(scene: &str, arguments: &str) -> (Manifest, Output) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("my.toml"), scene).unwrap();
    let capture =
        format!("capture --scene my.toml --size 32x18 --scale 0.5 --out clip {arguments}");
    let output = run_in(folder.path(), &capture);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = fs::read_to_string(folder.path().join("clip/manifest.json")).unwrap();
    let judged = run_in(folder.path(), "verify clip");
    (serde_json::from_str(&text).unwrap(), judged)
}

const SPRING: &str = "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\n";

#[test]
fn settings_and_lanes_name_the_methods_that_flew() {
    for (listed, option, selected, flown) in [
        ("['explicit-euler']", "", Some("explicit-euler"), vec!["explicit-euler"]),
        ("['explicit-euler']", "--race", None, vec!["explicit-euler"]),
        ("['midpoint', 'pefrl']", "", Some("midpoint"), vec!["midpoint"]),
        ("['midpoint', 'rk4']\nmethod = 'rk4'", "", Some("rk4"), vec!["rk4"]),
        ("['midpoint', 'pefrl']", "--race", None, vec!["midpoint", "pefrl"]),
        ("['midpoint']", "--method bdf2", Some("bdf2"), vec!["bdf2"]),
    ] {
        let scene = format!("title = 'x'\ntick_hz = 10\nseconds = 1\nmethods = {listed}\n{SPRING}");
        let arguments = format!("--frames 2 {option}");
        let (manifest, judged) = captured(&scene, &arguments);
        assert_eq!(manifest.drawing.selected.as_deref(), selected, "{listed} {option}");
        let lanes: Vec<_> =
            manifest.lanes.iter().map(|lane| lane["method"].as_str().unwrap()).collect();
        assert_eq!(lanes, flown, "{listed} {option}");
        assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
    }
}

#[test]
fn a_race_of_many_methods_names_none_of_them_as_selected() {
    let methods = METHODS.iter().take(10).map(|method| format!("'{}'", method.id));
    let listed = methods.collect::<Vec<_>>().join(", ");
    let scene = format!("title = 'x'\ntick_hz = 10\nseconds = 1\nmethods = [{listed}]\n{SPRING}");
    let (manifest, judged) = captured(&scene, "--race --frames 2");
    assert_eq!(manifest.drawing.selected, None);
    assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
}

#[test]
fn frames_show_their_moment_across_the_rates_that_a_script_sets() {
    let scene = format!(
        "title = 'x'\ntick_hz = 1\nseconds = 9\n{SPRING}[[command]]\nat_s = 5\ntick_hz = 100\n"
    );
    let arguments = "--fps 2 --frames 14";
    let (manifest, judged) = captured(&scene, arguments);
    let ticks: Vec<u64> = manifest.frames.iter().map(|frame| frame.tick).collect();
    assert_eq!(ticks, [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 55, 105, 155]);
    assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
}

#[test]
fn a_captured_recording_keeps_its_own_checks_before_the_states() {
    let check = "[[check]]\ntick = 5\nlane = 1\nhash = '0123456789abcdef'\n";
    let scene =
        format!("title = 'x'\ntick_hz = 9\nseconds = 1\nmethods = ['rk4']\n{SPRING}{check}");
    let (manifest, judged) = captured(&scene, "--frames 2 --fps 3");
    assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
    let checks = Scene::parse("x", &manifest.recording).unwrap().checks;
    assert_eq!(manifest.drawing.own_checks, 1);
    assert_eq!(checks.iter().map(|check| check.tick).collect::<Vec<_>>(), [5, 0, 1, 2, 3]);
}

#[test]
fn a_run_of_any_values_can_be_judged() {
    let scene = "title = 'x'\ntick_hz = 60\nseconds = 1\n\
                 [[spring]]\nmass_kg = 1e-300\nstiffness_n_per_m = 1e-300\n\
                 [[command]]\nat_s = 0.05\nkick = 1e12\n";
    let (_, judged) = captured(scene, "--race --frames 9");
    assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
}

#[test]
fn an_unbounded_kick_leaves_a_manifest_that_can_be_judged() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 60\nseconds = 1\nmethods = ['rk4']\n\
                 [[spring]]\nname = 'light'\nmass_kg = 1e-300\nstiffness_n_per_m = 1\n\
                 [[spring]]\nname = 'heavy'\nmass_kg = 1\nstiffness_n_per_m = 1\nkick_n_s = 0\n\
                 [[command]]\nat_s = 0\nkick = 1e14\n";
    fs::write(folder.path().join("light.toml"), scene).unwrap();
    let capture = "capture --scene light.toml --size 32x18 --scale 0.5 --frames 3 --out clip";
    let output = run_in(folder.path(), capture);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = fs::read_to_string(folder.path().join("clip/manifest.json")).unwrap();
    let manifest: Manifest = serde_json::from_str(&text).unwrap();
    let lane = &manifest.lanes[0];
    assert_eq!(lane["halted"], 0);
    assert_eq!(
        (&lane["bodies"][0]["halted"], &lane["bodies"][1]["halted"]),
        (&Value::from(0), &Value::Null)
    );
    assert!(lane["bodies"][0]["position_error"].is_null());
    assert!(lane["bodies"][1]["position_error"].is_number());
    let verify = run_in(folder.path(), "verify clip --physics-only");
    assert_eq!(verify.status.code(), Some(0), "{}", stderr(&verify));
}

#[test]
fn frames_and_states_match_the_run() {
    let arguments = "--scene harbour --race --tick-hz 49 --frames 9 --fps 7 --mark-every 10";
    let text = manifest(arguments);
    let manifest: Manifest = serde_json::from_str(&text).unwrap();
    assert!(manifest.complete);
    // 49 Hz at 7 frames a second: 7 ticks to a frame.
    let ticks: Vec<u64> = manifest.frames.iter().map(|frame| frame.tick).collect();
    assert_eq!(ticks, (0..9).map(|frame| 7 * frame).collect::<Vec<_>>());
    for frame in &manifest.frames {
        let [numerator, denominator] = frame.alpha;
        assert!(numerator < denominator / 1_000_000, "a frame falls on a tick but for rounding");
    }
    let checks = Scene::parse("clip.toml", &manifest.recording).unwrap().checks;
    let mut ticks: Vec<u64> = checks.iter().map(|check| check.tick).collect();
    ticks.dedup();
    assert_eq!(ticks, [0, 10, 20, 30, 40, 50, 56]);

    let mut scene = Scene::built_in("harbour").unwrap();
    scene.tick_hz = 49.into();
    let mut studio = Studio::new(scene);
    studio.apply(StageCommand::ToggleRace);
    for check in &checks {
        while studio.race().tick() < check.tick {
            studio.tick();
        }
        assert_eq!(studio.race().lane_hash(check.lane), Some(check.hash));
    }
    let exact = studio.race().truth();
    for (lane, entrant) in manifest.lanes.iter().zip(studio.race().entrants()) {
        for (n, body) in lane["bodies"].as_array().unwrap().iter().enumerate() {
            assert_eq!(body["name"], studio.scene().bodies[n].name);
            for metric in METRICS {
                let value = (metric.measure)(&entrant.lane.bodies()[n], &exact.bodies()[n]);
                assert_eq!(body[metric.id], Value::from(value), "{}", metric.id);
            }
        }
    }
}
