//! `identify`: reads a log, and names the engine, the visible motion and the settings to use.

use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use super::{run, run_in, stderr, stdout_of};

const LOG: &str = "tests/data/engines/box2d__spring_1hz_z005_60hz.csv";
const BODY: &str = "--tick-hz 60 --k 78.956835208714864 --c 1.25663706143591724 --mass 2";

#[test]
fn a_log_identifies_its_engine_and_the_visible_motion() {
    let text = stdout_of(&format!("identify {LOG} {BODY}"));
    assert!(
        text.starts_with(
            "made by engine-box2d ×4 or engine-box3d ×4 (the same on this body), residual "
        ),
        "{text}"
    );
    assert!(text.contains("a player sees: 0.9965 Hz, damping ratio 0.0761"), "{text}");
    assert!(text.contains("the equation says: 0.9987 Hz, damping ratio 0.0500"), "{text}");
    assert!(text.contains("\nunder velocity-verlet: "), "{text}");

    let json = stdout_of(&format!("identify {LOG} {BODY} --format json"));
    let found: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(
        (&found["word"], &found["best"], &found["substeps"], &found["held"]),
        (&"identified".into(), &"engine-box2d".into(), &4.into(), &false.into())
    );
    let number = |key: &str| found[key].as_f64().unwrap_or_else(|| panic!("{key}: {found}"));
    assert!(number("residual") < 1e-5 && number("runner_up_residual") > 1e-4);
    assert!(found["runner_up"].is_string());
    assert!((number("effective_frequency_hz") - 0.9965).abs() < 1e-3);
    assert!((number("effective_damping_ratio") - 0.0761).abs() < 1e-3);
    assert!((number("effective_stiffness_n_per_m") / 78.96 - 1.0).abs() < 0.01);
    assert!(number("energy_halves_s") > 0.0 && found["energy_doubles_s"].is_null());
}

#[test]
fn a_log_may_have_times_for_ticks_and_other_column_names() {
    let rows = fs::read_to_string(LOG).unwrap();
    let mut text = String::from("time,pos.x,vel.x,other\n");
    for row in rows.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let tick: f64 = cells[0].parse().unwrap();
        text += &format!("{:.5},{},{},junk\n", 12.0 + tick / 60.0, cells[1], cells[2]);
    }
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("log.csv"), text).unwrap();
    let named = "--t-column time --x-column pos.x --v-column vel.x";
    let output = run_in(folder.path(), &format!("identify log.csv {BODY} {named}"));
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.starts_with("made by engine-box2d ×4"), "{said}");
}

#[test]
fn a_log_that_cannot_be_read_is_refused_with_its_line_and_a_remedy() {
    let folder = tempdir().unwrap();
    for (text, told) in [
        ("", "log.csv:1: there is nothing here"),
        (
            "tick,y\n0,1\n",
            "log.csv:1: no column \"x\"; here are \"tick\", \"y\"; name the coordinate's with --x-column",
        ),
        ("tick;x\n0;1\n", "log.csv:1: a log of 1 rows says too little"),
        ("x\n1\n", "log.csv:1: no column \"tick\" and none \"t\""),
        // A row of a trace has the name in a cell.
        (
            "tick,coordinate,q\n0,x,1\n",
            "log.csv:1: no column \"x\"; here are \"tick\", \"coordinate\", \"q\"",
        ),
        ("tick,x\n0,1\n1,abc\n", "log.csv:3: column \"x\": \"abc\" is no number"),
        ("tick,x\n0,1\n1,NaN\n", "log.csv:3: column \"x\": \"NaN\" is no number"),
        ("tick,x\n0,1\n1\n", "log.csv:3: the row has 1 of the header's 2 cells"),
        ("t,x\n0,1\n0.02,1\n", "log.csv:3: the row is 1.200 ticks of 60 Hz after the first"),
        ("tick,x\n0,1\n0,2\n", "log.csv:3: tick 0 does not follow the row before"),
        ("tick,x\n0,1\n1,2\n", "log.csv:1: a log of 2 rows says too little; log at least 4"),
        ("tick,x\n0,1\n1,1\n2,1\n3,1\n", "log.csv:2: nothing moves; log a motion"),
    ] {
        fs::write(folder.path().join("log.csv"), text).unwrap();
        let output = run_in(folder.path(), "identify log.csv --tick-hz 60 --k 40");
        assert_eq!(output.status.code(), Some(2), "{text:?}");
        assert!(output.stdout.is_empty());
        let said = stderr(&output);
        assert!(said.contains(told), "{text:?}: {said}");
    }
    for (arguments, told) in [
        ("identify nothing.csv --tick-hz 60", "cannot read the log nothing.csv"),
        ("identify log.csv", "--tick-hz"),
        ("identify log.csv --tick-hz 0", "give a rate above 0"),
        ("identify log.csv --tick-hz 60 --k -1", "give a number from 0 up"),
        ("identify log.csv --tick-hz 60 --mass 0", "give a number above 0"),
        ("identify log.csv --tick-hz 60 --c 1", "--k"),
        (&format!("identify {LOG} --tick-hz 60 --v-column vel"), "no column \"vel\"; here are"),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        assert!(stderr(&output).contains(told), "{arguments}: {}", stderr(&output));
    }
}

#[test]
fn an_unexplained_log_is_unknown_with_null_fields() {
    let folder = tempdir().unwrap();
    // A spring that is not given is read off ticks that follow each other.
    let row = |tick: u32| format!("{tick},{}", (0.1 * f64::from(tick)).cos());
    let rows: Vec<String> = (0..60).map(|i| row(3 * i)).collect();
    fs::write(folder.path().join("log.csv"), format!("tick,x\n{}\n", rows.join("\n"))).unwrap();
    let output = run_in(folder.path(), "identify log.csv --tick-hz 60");
    assert_eq!(output.status.code(), Some(0));
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.starts_with("unknown: no method comes near"), "{said}");
    let output = run_in(folder.path(), "identify log.csv --tick-hz 60 --format json");
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&found["word"], &found["best"]), (&"unknown".into(), &Value::Null));
    assert!(found["residual"].is_null() && found["runner_up"].is_null());
    // The motion itself is a cosine of 6 rad/s.
    let seen = found["effective_frequency_hz"].as_f64().unwrap();
    assert!((seen - 3.0 / std::f64::consts::PI).abs() < 1e-9, "{found}");
}

#[test]
fn an_unknown_overdamped_spring_is_fitted() {
    let folder = tempdir().unwrap();
    let mut text = "t,x,v\n".to_owned();
    let rates = [-5.0 + 21.0_f64.sqrt(), -5.0 - 21.0_f64.sqrt()];
    for tick in 0..120 {
        let t = f64::from(tick) / 60.0;
        let [slow, fast] = rates.map(|rate| (rate * t).exp());
        let share = rates[1] / (rates[1] - rates[0]);
        let x = share * slow + (1.0 - share) * fast;
        let v = share * rates[0] * slow + (1.0 - share) * rates[1] * fast;
        text += &format!("{t},{x},{v}\n");
    }
    fs::write(folder.path().join("log.csv"), text).unwrap();
    let output = run_in(folder.path(), "identify log.csv --tick-hz 60 --format json");
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_ne!(found["word"], "unknown", "{found}");
    let ratio = found["effective_damping_ratio"].as_f64().unwrap_or_else(|| panic!("{found}"));
    assert!((ratio - 2.5).abs() < 0.01, "{ratio}");
    assert!(found["effective_frequency_hz"].is_null());
}

#[test]
fn a_log_is_read_the_same_with_tabs_semicolons_and_decimal_commas() {
    let folder = tempdir().unwrap();
    let (mut x, mut v, h) = (1.0_f64, 0.0_f64, 1.0 / 60.0);
    let mut text = "# of a game\ntick,x,v\n".to_owned();
    for tick in 0..90 {
        text += &format!("{tick},{x:?},{v:?}\n");
        v += h * -(40.0 * x + 0.5 * v) / 2.0;
        x += h * v;
    }
    let told = |text: &str| {
        fs::write(folder.path().join("log.csv"), text).unwrap();
        let output = run_in(folder.path(), "identify log.csv --tick-hz 60 --k 40 --c 0.5 --mass 2");
        String::from_utf8(output.stdout).unwrap()
    };
    let said = told(&text);
    assert!(said.contains("semi-implicit"), "{said}");
    assert_eq!(told(&text.replace(',', "\t")), said);
    assert_eq!(told(&text.replace("tick,", "Frame,")), said);
    for (name, per_tick) in [("Time", 1.0 / 60.0), ("time_ms", 1e3 / 60.0), ("t", 1e3 / 60.0)] {
        let timed = text.lines().map(|line| match line.split_once(',') {
            Some((tick, rest)) => match tick.parse::<f64>() {
                Ok(tick) => format!("{:?},{rest}\n", tick * per_tick),
                Err(_) => format!("{name},{rest}\n"),
            },
            None => format!("{line}\n"),
        });
        assert_eq!(told(&timed.collect::<String>()), said, "{name}");
    }
    assert_eq!(told(&text.replace(',', ";").replace('.', ",")), said);
}

/// A log in a folder of its own, with the text and the JSON of `identify`.
fn identified(log: &str, options: &str) -> (String, Value) {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("log.csv"), log).unwrap();
    let of = |format: &str| {
        let output =
            run_in(folder.path(), &format!("identify log.csv {options} --format {format}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        String::from_utf8(output.stdout).unwrap()
    };
    (of("text"), serde_json::from_str(&of("json")).unwrap())
}

/// Rows of semi-implicit Euler at 60 Hz about a place of rest, with their velocities.
fn swinging_about(rest: f64, [k, c]: [f64; 2]) -> String {
    let (mut x, mut v, mut log) = (1.0, 0.0, "t,x,v\n".to_owned());
    for tick in 0..300 {
        log += &format!("{:.9},{:?},{v:?}\n", f64::from(tick) / 60.0, x + rest);
        v += (-k * x - c * v) / 60.0;
        x += v / 60.0;
    }
    log
}

#[test]
fn a_spring_with_another_rest_is_identified_with_or_without_the_rest() {
    let log = swinging_about(3.2, [20.0, 0.25]);
    for options in [
        "--tick-hz 60 --k 40 --c 0.5 --mass 2",
        "--tick-hz 60",
        "--tick-hz 60 --k 40 --c 0.5 --mass 2 --rest 3.2",
    ] {
        let (text, found) = identified(&log, options);
        let candidates = found["also"].as_array().unwrap().iter().map(|it| &it["method"]);
        let has_it =
            [&found["best"]].into_iter().chain(candidates).any(|id| id == "semi-implicit-euler");
        // A spring that is not given fits other methods as well.
        assert!(has_it || !options.contains("--k"), "{options}: {text}");
        assert!((found["rest_m"].as_f64().unwrap() - 3.2).abs() < 1e-6, "{options}: {found}");
        assert!((found["effective_frequency_hz"].as_f64().unwrap() - 0.7124).abs() < 1e-4);
        assert_eq!(text.contains("it rests at 3.2000 m"), !options.contains("--rest"), "{text}");
    }
    // A rest that is wrong is not mended.
    let (_, found) = identified(&log, "--tick-hz 60 --k 40 --c 0.5 --mass 2 --rest 3");
    assert_eq!(found["word"], "unknown", "{found}");
}

#[test]
fn a_fall_from_rest_identifies_its_method_and_the_error() {
    let h = 1.0 / 60.0;
    let falling = |is_semi_implicit: bool| {
        let (mut x, mut v, mut log) = (0.0, 0.0, "tick,x\n".to_owned());
        for tick in 0..=60 {
            log += &format!("{tick},{x:?}\n");
            let before = v;
            v -= 9.81 * h;
            x += h * if is_semi_implicit { v } else { before };
        }
        log
    };
    let options = "--tick-hz 60 --drag 0 --thrust -9.81";
    for (is_semi_implicit, id, off) in
        [(true, "semi-implicit-euler", -1.0), (false, "explicit-euler", 1.0)]
    {
        for v0 in ["", " --v0 0"] {
            let (text, found) = identified(&falling(is_semi_implicit), &format!("{options}{v0}"));
            assert_eq!(found["word"], "identified", "{text}");
            assert_eq!(text.contains("if it starts at rest"), v0.is_empty(), "{text}");
            assert!(text.contains(id), "{text}");
            // g h t / 2 after a second.
            let far = found["from_exact_m"].as_f64().unwrap();
            assert!((far - off * 9.81 * h / 2.0).abs() < 1e-9, "{far}");
        }
    }
}

#[test]
fn a_log_at_uneven_times_is_fitted_and_can_be_ported() {
    let (mut t, mut log) = (0.0_f64, "time,x\n".to_owned());
    for row in 0..240 {
        let x = (-0.125 * t).exp() * (4.470_388_10 * t).cos();
        log += &format!("{t:.6},{x:.9}\n");
        t += 0.012 + 0.001 * f64::from(row * 7 % 11);
    }
    let (text, found) = identified(&log, "--tick-hz 60");
    assert!(text.starts_with("unknown: the rows are at uneven times"), "{text}");
    let swing = |key: &str| found["swing"][key].as_f64().unwrap();
    assert!((swing("frequency_hz") / 0.711_49 - 1.0).abs() < 1e-3, "{found}");
    assert!((swing("damping_ratio") - 0.027_951).abs() < 1e-4, "{found}");
    assert!(swing("residual") < 1e-4 && swing("undamped_hz_error") < 1e-4, "{found}");
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("log.csv"), &log).unwrap();
    let output = run_in(folder.path(), "port --from log.csv --tick-hz 60 --to engine-box2d");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stderr(&output).starts_with("read 240 rows in "), "{}", stderr(&output));
    // Even rows at another rate are not uneven.
    let even: String = (0..50).map(|n| format!("{:.6},{n}\n", f64::from(n) / 50.0)).collect();
    fs::write(folder.path().join("even.csv"), format!("t,x\n{even}")).unwrap();
    let output = run_in(folder.path(), "identify even.csv --tick-hz 60");
    assert!(stderr(&output).contains("50.00 rows a second: give the rate"), "{}", stderr(&output));
}

#[test]
fn a_motion_of_no_known_method_has_a_best_fit_with_errors() {
    // A spring that stiffens is none of ours, and nearly a swing.
    let (mut x, mut v, mut log) = (1.0_f64, 0.0, "tick,x\n".to_owned());
    for tick in 0..400 {
        log += &format!("{tick},{x:?}\n");
        for _ in 0..100 {
            v -= (20.0 * x + 2.0 * x * x * x) / 6000.0;
            x += v / 6000.0;
        }
    }
    let (text, found) = identified(&log, "--tick-hz 60 --k 20");
    assert_eq!(found["word"], "unknown", "{text}");
    assert!(text.contains("the best fit of a damped swing: 0.73"), "{text}");
    let hz = found["swing"]["undamped_hz"].as_f64().unwrap();
    assert!((0.72..0.75).contains(&hz) && found["swing"]["residual"].as_f64().unwrap() < 0.05);
}
