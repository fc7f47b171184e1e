//! `advise`: the methods that meet each criterion at the given rate, their cost and headroom, and the recommendation.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;
use std::sync::LazyLock;
#[cfg(target_os = "linux")]
use std::time::Duration;
use std::time::Instant;

use regatta::measure::{AnalysisWorker, MethodAdvice, Report, recommended as taken};
use regatta::scene::Scene;
use regatta::sim::integrators::GENERAL_METHODS;
use regatta::studio::{Instrument, StageCommand, Studio, accept_findings};
use serde_json::Value;

use super::{refusal, regatta, run_in, stdout_of};
#[cfg(target_os = "linux")]
use super::{start, stderr, until_worked, work_after};

const CRITERIA: [&str; 3] = ["bounded", "looks-right", "accurate"];

fn advice(arguments: &str) -> Value {
    serde_json::from_str(&stdout_of(&format!("advise {arguments} --format json"))).unwrap()
}

fn row<'a>(advice: &'a Value, id: &str) -> &'a Value {
    let rows = advice["methods"].as_array().unwrap();
    rows.iter().find(|row| row["method"] == id).unwrap()
}

/// The ids of the methods that are judged where none is named.
fn for_games() -> Vec<&'static str> {
    GENERAL_METHODS.iter().filter(|method| method.is_for_games()).map(|method| method.id).collect()
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

/// The advice on the spring, which several tests read.
pub(super) static ON_SPRING: LazyLock<Value> = LazyLock::new(|| advice("--scene spring --rates"));

#[test]
fn every_method_has_a_verdict_and_substeps_for_each_criterion() {
    let advice = &*ON_SPRING;
    let rows = advice["methods"].as_array().unwrap();
    let ids: Vec<&str> = rows.iter().map(|row| row["method"].as_str().unwrap()).collect();
    assert_eq!(ids, for_games());
    assert_eq!((&advice["scene"], &advice["tick_hz"]), (&"spring".into(), &60.into()));
    assert_eq!((&advice["horizon_s"], &advice["bodies"]), (&20.0.into(), &["spring"][..].into()));

    let explicit = row(advice, "explicit-euler");
    assert_eq!(explicit["verdict"]["word"], "grows");
    assert_eq!(explicit["verdict"]["body"], "spring");
    assert_eq!(explicit["verdict"]["text"], "grows · swing ×2 in 2.1 s");
    let doubles = explicit["verdict"]["doubles_in_s"].as_f64().unwrap();
    let z = std::f64::consts::TAU / 60.0;
    let expected = 2.0 * std::f64::consts::LN_2 / (1.0 + z * z).ln() / 60.0;
    assert!((doubles / expected - 1.0).abs() < 1e-6, "{doubles}, not {expected}");
    assert!(explicit["verdict"]["halves_in_s"].is_null());
    let criteria = explicit["criteria"].as_object().unwrap();
    assert!(criteria.values().all(|found| *found == serde_json::json!({ "met": false })));
    assert!(explicit["rates"]["bounded"].is_null() && explicit["rates"]["accurate"].is_null());

    let semi_implicit = row(advice, "semi-implicit-euler");
    let bounded = &semi_implicit["criteria"]["bounded"];
    assert_eq!((&bounded["substeps"], &bounded["evaluations_per_s"]), (&1.into(), &60.0.into()));
    // h ω < 2 from 3.15 Hz on, or up to (2 / 0.1047)² = 364.8 times the stiffness; factors up to ten are tried.
    assert_eq!((&bounded["slowest_hz"], &bounded["stiffness_factor"]), (&4.into(), &10.0.into()));
    assert_eq!(bounded["met"], true);
    assert_eq!(bounded["limited_by"], "stiffness");
    assert!(bounded["ns_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!(semi_implicit["rates"]["bounded"], 4);

    let runge_kutta = row(advice, "rk4");
    assert_eq!(runge_kutta["verdict"]["word"], "accurate");
    let halving = runge_kutta["verdict"]["halves_in_s"].as_f64().unwrap() / 86_400.0;
    assert!((14.5..14.7).contains(&halving), "{halving} days");
    assert_eq!(runge_kutta["rates"]["accurate"], 21);
    // z²/24 · 20 · 2π < 0.01 is about 150 Hz.
    let accurate = row(advice, "velocity-verlet")["rates"]["accurate"].as_u64().unwrap();
    assert!((140..150).contains(&accurate), "{accurate}");
    assert_eq!(row(advice, "velocity-verlet")["criteria"]["accurate"]["substeps"], 3);
}

/// Compares the command's recommendation with those of the library and of the window.
fn is_said_by_library_and_window(recommended: &Value, name: &str) {
    let scene = Scene::built_in(name).unwrap();
    let report = Report::of_scene(&scene);
    assert_eq!(&serde_json::to_value(&report.recommended).unwrap(), recommended, "{report}");
    let mut studio = Studio::new(scene);
    studio.apply(StageCommand::Instrument(Instrument::Advice));
    let findings = AnalysisWorker::new(studio.analysis_request()).finish();
    accept_findings(&mut studio, findings);
    let advised = &studio.viewer.advice().expect("it is found").advised;
    for (i, criterion) in CRITERIA.iter().enumerate() {
        let MethodAdvice { spec, met, .. } = &advised[taken(advised, i).expect("one meets it")];
        assert_eq!(recommended[criterion]["method"], spec.method.id);
        assert_eq!(recommended[criterion]["substeps"], met[i].met().unwrap().substeps);
    }
}

#[test]
fn a_recommended_method_meets_its_criterion_and_is_no_printed_listing() {
    for scene in ["ship", "harbour"] {
        let advice = advice(&format!("--scene {scene}"));
        assert_eq!(keys(&advice["recommended"]), CRITERIA);
        if scene == "ship" {
            is_said_by_library_and_window(&advice["recommended"], scene);
        }
        for (criterion, take) in advice["recommended"].as_object().unwrap() {
            let id = take["method"].as_str().unwrap();
            assert!(!id.ends_with("-as-printed"), "{scene}: {id}");
            let met = &row(&advice, id)["criteria"][criterion];
            for key in keys(take).iter().filter(|key| **key != "method") {
                assert_eq!(met[key], take[key], "{scene}: {criterion}: {key}");
            }
            assert_eq!(take["tick_hz"], advice["tick_hz"]);
            assert!(take["substeps"].is_u64() && take["evaluations_per_s"].is_f64(), "{take}");
        }
    }
}

#[test]
fn the_verdict_follows_the_tick_rate_and_the_rates_do_not() {
    let [coarse, fine] = [49, 60].map(|tick_hz| {
        advice(&format!("--scene stiff --method semi-implicit-euler --rates --tick-hz {tick_hz}"))
    });
    let only = |advice: &Value| {
        assert_eq!(advice["methods"].as_array().unwrap().len(), 1);
        row(advice, "semi-implicit-euler").clone()
    };
    let (coarse, fine) = (only(&coarse), only(&fine));
    let words = [&coarse, &fine].map(|row| row["verdict"]["word"].clone());
    assert_eq!(words, ["blows-up", "bounded"]);
    assert!(coarse["verdict"]["error"].is_null());
    assert_eq!(coarse["rates"], fine["rates"]);
    // The limit itself is at 50 Hz.
    let stable = fine["rates"]["bounded"].as_u64().unwrap();
    assert!((50..=51).contains(&stable), "{stable}");
    assert_eq!(coarse["criteria"]["bounded"]["substeps"], 2);
}

#[test]
fn the_text_has_one_recommendation_and_a_table_of_verdicts() {
    let text = stdout_of(
        "advise --all --scene stiff --method semi-implicit-euler --method explicit-euler",
    );
    let lines: Vec<&str> = text.lines().collect();
    let table = &lines[2..];
    assert!(table[0].starts_with("METHOD") && table[0].ends_with("VERDICT"), "{text}");
    let places = |line: &str, word: &str| line.find(word).map(|at| line[..at].chars().count());
    assert_eq!(places(table[0], "VERDICT"), places(table[1], "bounded · swings "), "{text}");
    assert_eq!(places(table[0], "VERDICT"), places(table[2], "blows up · at "), "{text}");
    let taken = "at 60 Hz: looks-right: semi-implicit-euler ×4 \
                 (240 evaluations/s; holds down to 52 Hz, or 1.3 × stiffness)";
    assert_eq!((lines[0], lines[1]), (taken, ""), "{text}");
    assert_eq!(text.matches("at 60 Hz: ").count(), 1, "{text}");
    assert!(lines.contains(&"  not with up to 64 substeps: explicit-euler"), "{text}");
    assert!(lines.iter().all(|line| line.trim_end() == *line), "{text}");
}

#[test]
fn without_all_the_answer_and_the_eight_best_rows_are_printed() {
    let text = stdout_of("advise --scene stiff");
    let lines: Vec<&str> = text.lines().collect();
    let whole = stdout_of("advise --scene stiff --all");
    assert_eq!(whole.lines().next(), Some(lines[0]), "{text}");
    let head: Vec<&str> = lines[2].split_whitespace().collect();
    assert_eq!(head, ["METHOD", "BOUNDED", "LOOKS-RIGHT", "ACCURATE", "VERDICT"]);
    let rows = &lines[3..11];
    let of_table = |line: &str| line.split("  ").next().unwrap().to_owned();
    let method = lines[0].split(' ').nth(4).unwrap();
    assert!(rows[..3].iter().any(|row| of_table(row) == method), "{text}");
    // Each row shows the substeps and the cost of its method.
    let advice = advice("--scene stiff");
    for row in rows {
        let met = &self::row(&advice, &of_table(row))["criteria"]["bounded"];
        let cell = format!("×{} {}", met["substeps"], met["cost_per_s"].as_f64().unwrap().round());
        assert!(row.contains(&cell), "{row}: {cell}");
    }
    let [empty, told] = lines[11..] else { panic!("{text}") };
    assert!(empty.is_empty() && told.starts_with("The best 8 of 25 methods. "), "{text}");
    let one = stdout_of("advise --scene stiff --method explicit-euler --rates");
    assert!(one.contains("explicit-euler  no       no           no        blows up"), "{one}");
    assert!(one.contains("\nslowest tick rates") && !one.contains("best"), "{one}");
}

#[test]
fn a_spring_is_advised_on_from_three_numbers_with_the_code_to_paste() {
    let one = "--method semi-implicit-euler --tick-hz 30";
    let by_stiffness = stdout_of(&format!("advise --k 900 --c 4 --mass 12 {one}"));
    let lines: Vec<&str> = by_stiffness.lines().collect();
    assert!(lines[0].starts_with("at 30 Hz: looks-right: semi-implicit-euler ×"), "{by_stiffness}");
    assert!(lines[2].starts_with("Call this "), "{by_stiffness}");
    assert!(by_stiffness.contains("fn semi_implicit_euler"), "{by_stiffness}");
    let frequency = 75f64.sqrt() / std::f64::consts::TAU;
    let ratio = 4.0 / (2.0 * 10_800f64.sqrt());
    let by_frequency = stdout_of(&format!(
        "advise --frequency {frequency} --damping-ratio {ratio} --mass 12 {one}"
    ));
    assert_eq!(by_frequency.lines().next(), by_stiffness.lines().next());
    let c_sharp = stdout_of(&format!("advise --k 900 --as csharp {one}"));
    assert!(c_sharp.contains("double "), "{c_sharp}");
    let trace = stdout_of("trace --k 900 --mass 12 --method rk4 --seconds 0.1");
    assert!(trace.contains(",my spring,x,"), "{trace}");
    let sweep = stdout_of("sweep --k 900 --mass 12 --method rk4 --tick-hz 60");
    assert!(
        sweep.lines().nth(1).is_some_and(|row| row.starts_with("my-spring,my spring,rk4,60,")),
        "{sweep}"
    );
}

#[test]
fn a_spring_replaces_a_scene_and_its_numbers_are_checked() {
    for (options, said) in [
        ("--k 900 --scene spring", "cannot be used with"),
        ("--k 900 --frequency 2", "cannot be used with"),
        ("--c 4", "--k"),
        ("--mass 12", "--k"),
        ("--k 0", "a number above 0"),
        ("--k 900 --c -1", "a number from 0 up"),
        ("--k 1e300", "stiffness_n_per_m"),
    ] {
        let run = regatta().arg("advise").args(options.split(' ')).output().unwrap();
        let error = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(2), "{options}: {error}");
        assert!(error.contains(said), "{options}: {error}");
    }
}

/// The factor by which a body may be stiffer or, squared, the ticks slower: the lesser of both.
fn reserve(met: &Value) -> f64 {
    let factor = met["stiffness_factor"].as_f64().unwrap_or(10.0);
    let [hz, slowest_hz] = ["tick_hz", "slowest_hz"].map(|key| met[key].as_f64().unwrap());
    factor.min((hz / slowest_hz).powi(2))
}

#[test]
fn a_method_with_more_reserve_at_little_more_cost_is_recommended() {
    for (spring, worse) in [
        ("--k 900 --c 62.3538 --mass 12", "adams-bashforth-2"),
        ("--frequency 0.5 --damping-ratio 0.5", "explicit-euler"),
        ("--frequency 2 --damping-ratio 0.1", ""),
    ] {
        let advice = advice(spring);
        for criterion in CRITERIA {
            let taken = &advice["recommended"][criterion];
            assert!(criterion != "looks-right" || taken["method"] != worse, "{spring}: {taken}");
            let cost = |met: &Value| met["cost_per_s"].as_f64().unwrap();
            for row in advice["methods"].as_array().unwrap() {
                let met = &row["criteria"][criterion];
                if met["met"] != true || row["method"] == taken["method"] {
                    continue;
                }
                let (more, little) = (reserve(met) - reserve(taken), reserve(taken) < 1.5);
                let what = format!("{spring}: {criterion}: {taken}, not {row}");
                // Reserves are compared to a tenth.
                assert!(cost(met) != cost(taken) || more < 0.11, "{what}");
                assert!(!little || cost(met) > 2.0 * cost(taken) || more < 0.11, "{what}");
                assert!(cost(met) >= cost(taken) || reserve(met) < 1.5, "{what}");
            }
        }
    }
}

#[test]
fn the_answer_names_the_cheaper_method_with_too_little_reserve() {
    let two = "advise --k 900 --c 62.3538 --mass 12 --method adams-bashforth-2 --method midpoint";
    let text = stdout_of(two);
    let line = text.lines().find(|line| line.contains("looks-right")).unwrap();
    assert!(line.starts_with("at 60 Hz: looks-right: midpoint ×1 (120 evaluations/s; "), "{text}");
    let reason = "; adams-bashforth-2 ×1 costs less, but its reserve is only 1.3 ×)";
    assert!(line.ends_with(reason), "{text}");
    assert!(text.contains("fn midpoint"), "the code is of the same method: {text}");
    let advice: Value = serde_json::from_str(&stdout_of(&format!("{two} --format json"))).unwrap();
    let wanted = serde_json::json!(
        { "method": "adams-bashforth-2", "substeps": 1, "cost_per_s": 60.0, "reserve": 1.3 }
    );
    assert_eq!(advice["recommended"]["looks-right"]["instead_of"], wanted);
    let one = stdout_of("advise --k 900 --c 62.3538 --mass 12 --method adams-bashforth-2");
    assert!(one.contains("looks-right: adams-bashforth-2 ×1"), "nothing else is better: {one}");
}

#[test]
fn the_deciding_body_of_several_is_named() {
    let advice = advice("--scene harbour --method explicit-euler --method semi-implicit-euler");
    assert_eq!(row(&advice, "explicit-euler")["verdict"]["body"], "spring");
    let text = row(&advice, "explicit-euler")["verdict"]["text"].as_str().unwrap();
    assert!(text.ends_with("(spring)"), "{text}");
    let limited = &row(&advice, "semi-implicit-euler")["criteria"]["looks-right"]["limited_by"];
    assert_eq!(limited, "stiffness (spring)");
}

#[test]
fn an_unstable_scene_is_reported_as_having_no_suitable_method() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 60\nseconds = 1\n\
                 [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1e12\n";
    fs::write(folder.path().join("hard.toml"), scene).unwrap();
    let output = run_in(folder.path(), "advise --scene hard.toml --method rk4");
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("at 60 Hz: bounded: none of these with up to 64 substeps"), "{text}");
    let output = run_in(folder.path(), "advise --scene hard.toml --method rk4 --format json");
    let advice: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(row(&advice, "rk4")["criteria"]["bounded"], serde_json::json!({ "met": false }));
    let why = advice["recommended"]["bounded"]["none"].as_str().unwrap();
    assert!(why.starts_with("none of these with up to 64 substeps"), "{why}");
}

#[test]
fn a_margin_that_takes_too_much_work_is_unknown() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 60\nseconds = 60\n[[net]]\ncolumns = 10\nrows = 8\nspacing_m = 0.1\n\
                 shear = true\npin = 'corners'\nmass_kg = 0.02\nstiffness_n_per_m = 1000\n";
    fs::write(folder.path().join("net.toml"), scene).unwrap();
    let said = |format: &str| {
        let arguments = format!("advise --all --scene net.toml --method rk4 --format {format}");
        String::from_utf8(run_in(folder.path(), &arguments).stdout).unwrap()
    };
    // The run at the rate asked for is affordable. The many runs of a stiffer net may each take a tenth of its work.
    let advice: Value = serde_json::from_str(&said("json")).unwrap();
    let bounded = &row(&advice, "rk4")["criteria"]["bounded"];
    assert!(bounded["stiffness_factor"].is_null() && bounded["limited_by"].is_null(), "{bounded}");
    let slowest_hz = bounded["slowest_hz"].as_u64().expect("slower runs are cheaper");
    assert!((50..=60).contains(&slowest_hz), "{slowest_hz} Hz");
    let text = said("text");
    let is_unknown = |line: &str| line.contains(" Hz ") && line.ends_with(" not known");
    assert!(text.lines().any(is_unknown), "{text}");
    assert!(text.contains(" Hz; with stiffer bodies not known)\n"), "{text}");
}

#[test]
fn an_unknown_result_is_null_and_not_a_refusal() {
    let folder = tempfile::tempdir().unwrap();
    // The swing loses so slowly that it is not at rest after 2000 times the scene.
    let scene = "title = 'x'\ntick_hz = 200\nseconds = 3\n[[pendulum]]\nlength_m = 0.0327\ntheta0_rad = 0.3\n";
    fs::write(folder.path().join("slow.toml"), scene).unwrap();
    let one = "advise --all --scene slow.toml --method bogacki-shampine-32 --format";
    let output = run_in(folder.path(), &format!("{one} json"));
    let advice: Value = serde_json::from_slice(&output.stdout).unwrap();
    let criteria = &row(&advice, "bogacki-shampine-32")["criteria"];
    assert_eq!(criteria["bounded"], Value::Null);
    assert_eq!([&criteria["looks-right"]["met"], &criteria["accurate"]["met"]], [true, true]);
    let why = advice["recommended"]["bounded"]["none"].as_str().unwrap();
    assert!(why.starts_with("not known: no exact motion"), "{why}");
    let text = String::from_utf8(run_in(folder.path(), &format!("{one} text")).stdout).unwrap();
    assert!(text.starts_with("at 200 Hz: looks-right: bogacki-shampine-32 ×1"), "{text}");
    assert_eq!(advice["take"], "looks-right");
    assert!(
        text.contains("  not known: no truth, or too much work: bogacki-shampine-32\n"),
        "{text}"
    );
}

#[test]
fn margins_of_large_bodies_are_searched_only_near_the_least_cost() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 60\nseconds = 2\n[[chain]]\nmasses = 9\nmass_kg = 1\nstiffness_n_per_m = 800\n";
    fs::write(folder.path().join("chain.toml"), scene).unwrap();
    let three = "--method semi-implicit-euler --method rk4 --method dormand-prince-54";
    let said = |format: &str| {
        let arguments = format!("advise --all --scene chain.toml {three} --format {format}");
        String::from_utf8(run_in(folder.path(), &arguments).stdout).unwrap()
    };
    let advice: Value = serde_json::from_str(&said("json")).unwrap();
    let cheapest = CRITERIA.map(|criterion| {
        let rows = advice["methods"].as_array().unwrap().iter();
        let costs = rows.filter_map(|row| row["criteria"][criterion]["evaluations_per_s"].as_f64());
        costs.fold(f64::INFINITY, f64::min)
    });
    let mut counts = [0, 0];
    for row in advice["methods"].as_array().unwrap() {
        for (criterion, cheapest) in CRITERIA.iter().zip(cheapest) {
            let met = &row["criteria"][criterion];
            let Some(evaluations) = met["evaluations_per_s"].as_f64() else { continue };
            let is_recommended = advice["recommended"][criterion]["method"] == row["method"];
            let is_searched = is_recommended || evaluations <= 4.0 * cheapest;
            assert_eq!(met["margins_searched"], is_searched, "{row}");
            assert_eq!(met["slowest_hz"].is_null(), !is_searched, "{row}");
            assert_eq!(met["stiffness_factor"].is_null(), !is_searched, "{row}");
            counts[usize::from(is_searched)] += 1;
        }
    }
    assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
    let text = said("text");
    let neither = |line: &str| line.matches("  not searched").count() == 2;
    assert!(text.lines().any(neither), "{text}");
}

#[cfg(target_os = "linux")]
#[test]
fn an_interrupt_ends_the_search_for_the_truth() {
    let folder = tempfile::tempdir().unwrap();
    // Seconds of normal modes.
    let chain = "[[chain]]\nmasses = 256\nmass_kg = 1\nstiffness_n_per_m = 800\n".repeat(24);
    let scene = format!("title = 'x'\ntick_hz = 60\nseconds = 60\n{chain}");
    fs::write(folder.path().join("long.toml"), scene).unwrap();
    let mut child = start(folder.path(), "advise --scene long.toml");
    until_worked(&mut child, Duration::from_millis(500));
    let (output, work) = work_after("-INT", child);
    assert_eq!(output.status.code(), Some(130));
    assert!(work < Duration::from_secs(1), "{work:?}");
    let error = stderr(&output);
    assert_eq!(error, "error: interrupted after 0 of 25 methods\n");
}

#[test]
fn mistakes_are_refused_like_those_of_other_commands() {
    assert!(refusal("advise --scene shp", 2).contains("did you mean ship?"));
    assert!(refusal("advise --format xml", 2).contains("text, json"));
}

#[test]
fn a_camera_is_judged_by_half_life_and_by_its_limit_of_two() {
    let of = |id: &str, tick_hz: u32| {
        let advice = advice(&format!("--scene lerp --method {id} --tick-hz {tick_hz}"));
        row(&advice, id)["verdict"].clone()
    };
    for (id, wanted) in [
        ("lerp-per-frame", [219.3, 109.6, 45.7]),
        ("lerp-dt", [57.0, 63.4, 66.9]),
        ("exponential-decay", [69.3; 3]),
    ] {
        for (tick_hz, wanted) in [30, 60, 144].into_iter().zip(wanted) {
            let verdict = of(id, tick_hz);
            let [found, truth] = ["half_life_s", "true_half_life_s"]
                .map(|key| 1e3 * verdict[key].as_f64().expect("a half-life"));
            assert!((found - wanted).abs() < 0.06, "{id} at {tick_hz} Hz: {found} ms");
            assert!((truth - 69.315).abs() < 0.01, "{truth} ms");
            assert_eq!(verdict["overshoot_percent"], 0.0);
        }
    }
    let text = of("lerp-per-frame", 30)["text"].to_string();
    assert!(text.contains("half-life 219 ms"), "{text}");
    // k dt = 2.5 is above 2.
    let exploding = of("lerp-dt", 4);
    assert_eq!(exploding["word"], "grows");
    assert!(exploding["doubles_in_s"].is_f64(), "{exploding}");
    // k dt = 5/3 overshoots by 2/3.
    let overshoot = of("lerp-dt", 6)["overshoot_percent"].as_f64().unwrap();
    assert!((overshoot - 66.67).abs() < 0.01, "{overshoot} %");
    assert!(row(&advice("--scene spring --method rk4"), "rk4")["verdict"]["half_life_s"].is_null());
}

#[test]
fn lerp_per_frame_is_not_recommended() {
    let advice = advice("--scene lerp");
    for criterion in ["accurate", "looks-right"] {
        let method = &advice["recommended"][criterion]["method"];
        assert!(method.is_string() && method != "lerp-per-frame", "{criterion}: {method}");
    }
}

#[test]
fn engines_and_printed_listings_are_judged_only_on_request() {
    let ids = |arguments: &str| -> Vec<String> {
        let advice = advice(arguments);
        let rows = advice["methods"].as_array().unwrap();
        rows.iter().map(|row| row["method"].as_str().unwrap().to_owned()).collect()
    };
    let unasked = ids("--scene held-force");
    assert_eq!(unasked, for_games());
    let printed = ids("--scene ship --family as-printed");
    assert!(printed.iter().any(|id| id == "rk4-as-printed"), "{printed:?}");
    let engines = ids("--scene spring --family engine");
    assert!(engines.contains(&"held-force".to_owned()) && engines.len() > 10, "{engines:?}");
    assert!(engines.iter().all(|id| id == "held-force" || id.starts_with("engine-")));
    let refused = refusal("advise --scene follow --family engine", 2);
    assert!(refused.contains("engine-box2d does not step the body"), "{refused}");
    assert!(refusal("advise --family enigne", 2).contains("did you mean engine?"));
}

#[test]
fn a_pipe_gets_a_progress_line_every_ten_seconds() {
    let mut child = regatta()
        .args(["advise", "--scene", "cloth"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let begin = Instant::now();
    let mut line = String::new();
    BufReader::new(child.stderr.take().unwrap()).read_line(&mut line).unwrap();
    let seconds = begin.elapsed().as_secs_f64();
    child.kill().unwrap();
    child.wait().unwrap();
    let tells = [" of 25 methods judged\n", " margins searched\n"];
    assert!(tells.iter().any(|told| line.ends_with(told)), "{line:?}");
    assert!(seconds > 10.0, "{seconds} s");
}

#[test]
fn advise_names_the_rule_of_a_ball_beside_the_scenes_own() {
    let said = stdout_of("advise --scene perpetual --method velocity-verlet --as csharp");
    let line = "velocity-verlet with locate: accurate at 1 substep; your clamp at 60 Hz: grows · bounces 36 % too high after 10";
    assert!(said.lines().any(|it| it == line), "{said}");
    // The exact bounces of this ball.
    assert!(said.contains("double e = 1.0;") && said.contains("Math.Sqrt"), "{said}");
    let spring = stdout_of("advise --scene spring --method velocity-verlet");
    assert!(!spring.contains("with locate"), "{spring}");
    let object = advice("--scene perpetual --method velocity-verlet");
    assert_eq!(object["impact"]["impact"], "locate");
    assert_eq!(object["impact"]["yours"]["impact"], "clamp");
    let folder = tempfile::tempdir().unwrap();
    let lines = "v += a(x, v) * h\nx += v * h\nif x < 0 {\n    x = 0\n    v = -0.8 * v\n}\n";
    fs::write(folder.path().join("mine.step"), lines).unwrap();
    let said = run_in(folder.path(), "advise --scene ball --method mine.step").stdout;
    let said = String::from_utf8(said).unwrap();
    assert!(said.contains("; your mine at 60 Hz: dies away · bounces"), "{said}");
    // Code without a line for the floor says so, and no remedy is about a stiffness.
    let dragged =
        "title = 'x'\ntick_hz = 60\nseconds = 5\n[[ball]]\nheight_m = 1\ndrag_per_s = 0.2\n";
    fs::write(folder.path().join("dragged.toml"), dragged).unwrap();
    let asked = "advise --scene dragged.toml --method velocity-verlet --impact clamp --as c";
    let said = String::from_utf8(run_in(folder.path(), asked).stdout).unwrap();
    assert!(said.contains("no line for a floor") && !said.contains("soften"), "{said}");
}
