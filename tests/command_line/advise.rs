//! `advise`: a row a method, the slowest rates, and one line to take away.

use std::fs;

use regatta::sim::integrators::METHODS;
use serde_json::Value;

use crate::{refusal, run_in, stdout_of};

fn advice(arguments: &str) -> Value {
    serde_json::from_str(&stdout_of(&format!("advise {arguments} --format json"))).unwrap()
}

fn row<'a>(advice: &'a Value, id: &str) -> &'a Value {
    let rows = advice["methods"].as_array().unwrap();
    rows.iter().find(|row| row["method"] == id).unwrap()
}

#[test]
fn every_method_has_a_row_with_its_rates() {
    let advice = advice("--scene spring");
    let ids: Vec<&str> = advice["methods"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["method"].as_str().unwrap())
        .collect();
    assert_eq!(ids, METHODS.iter().map(|method| method.id).collect::<Vec<_>>());
    assert_eq!(advice["horizon_s"], 20.0);
    assert_eq!(advice["tolerance"], 0.01);

    let explicit = row(&advice, "explicit-euler");
    assert_eq!(explicit["verdict"], "grows, ×2 in 2.12 s");
    assert_eq!(explicit["word"], "grows");
    assert!(explicit["stable_from_hz"].is_null() && explicit["accurate_from_hz"].is_null());
    assert!(explicit["ns_per_s"].is_null());
    // h ω < 2 at 1 Hz is 3.15 ticks a second; z²/24 · 20 · 2π < 0.01 is about 150.
    assert_eq!(row(&advice, "velocity-verlet")["stable_from_hz"], 4);
    let accurate = row(&advice, "velocity-verlet")["accurate_from_hz"].as_u64().unwrap();
    assert!((140..150).contains(&accurate), "{accurate}");
    // h ω < 2.828.
    let runge_kutta = row(&advice, "rk4");
    assert_eq!(runge_kutta["stable_from_hz"], 3);
    assert_eq!(runge_kutta["good_hz"], 21);
    assert_eq!(runge_kutta["evaluations_per_s"], 84.0);
    assert!(runge_kutta["ns_per_s"].as_f64().unwrap() > 0.0);
    let halving = runge_kutta["halving_s"].as_f64().unwrap() / 86_400.0;
    assert!((14.5..14.7).contains(&halving), "{halving} days");
}

#[test]
fn what_is_taken_is_the_cheapest_of_those_that_are_good_and_not_as_printed() {
    for scene in ["ship", "harbour"] {
        let advice = advice(&format!("--scene {scene}"));
        let taken = advice["take"].as_str().unwrap();
        let cost = |row: &Value| row["ns_per_s"].as_f64();
        let as_printed = |row: &Value| row["method"].as_str().unwrap().ends_with("-as-printed");
        let rows = advice["methods"].as_array().unwrap();
        let least = rows.iter().filter(|row| !as_printed(row)).filter_map(cost);
        assert_eq!(cost(row(&advice, taken)), least.reduce(f64::min), "{scene}: {taken}");
        let line = advice["advice"].as_str().unwrap();
        let name = METHODS.iter().find(|method| method.id == taken).unwrap().name;
        let hz = &row(&advice, taken)["good_hz"];
        assert!(line.contains(&format!("take {name} at {hz} Hz: the cheapest")), "{line}");
        assert!(line.contains("within 1 % of the amplitude over "), "{line}");
        assert_eq!(line.lines().count(), 1);
    }
}

#[test]
fn the_verdict_follows_the_tick_rate_and_the_rates_do_not() {
    let [coarse, fine] = [49, 60].map(|tick_hz| {
        advice(&format!("--scene stiff --method semi-implicit-euler --tick-hz {tick_hz}"))
    });
    let only = |advice: &Value| {
        assert_eq!(advice["methods"].as_array().unwrap().len(), 1);
        row(advice, "semi-implicit-euler").clone()
    };
    let (coarse, fine) = (only(&coarse), only(&fine));
    assert_eq!((&coarse["word"], &fine["word"]), (&"lost".into(), &"drifting".into()));
    assert_eq!(coarse["stable_from_hz"], fine["stable_from_hz"]);
    // The limit itself is at 50 Hz.
    let stable = fine["stable_from_hz"].as_u64().unwrap();
    assert!((50..=51).contains(&stable), "{stable}");
}

#[test]
fn text_is_an_aligned_table_and_a_line() {
    let text = stdout_of("advise --scene ship --method rk4 --method explicit-euler");
    let lines: Vec<&str> = text.lines().collect();
    let [head, rk4, euler, "", advice] = lines[..] else { panic!("{text}") };
    let places = |line: &str, word: &str| line.find(word).map(|at| line[..at].chars().count());
    assert_eq!(places(head, "VERDICT"), places(rk4, "accurate,"));
    assert_eq!(places(head, "VERDICT"), places(euler, "drifting,"));
    assert!(advice.starts_with("for this body take "), "{advice}");
    assert!(lines.iter().all(|line| line.trim_end() == *line), "{text}");
}

#[test]
fn a_scene_that_nothing_holds_is_told_so() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 60\nseconds = 1\n\
                 [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1e12\n";
    fs::write(folder.path().join("hard.toml"), scene).unwrap();
    let output = run_in(folder.path(), "advise --scene hard.toml --method rk4");
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("for this body take none of these methods"), "{text}");
}

#[test]
fn mistakes_are_refused_as_elsewhere() {
    assert!(refusal("advise --scene shp", 2).contains("did you mean ship?"));
    assert!(refusal("advise --format xml", 2).contains("text, json"));
}
