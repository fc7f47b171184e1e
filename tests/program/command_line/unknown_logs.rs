//! `identify` on logs that no method explains.

use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use super::identify::identified;
use super::run_in;

#[test]
fn an_unexplained_log_is_unknown_with_null_fields() {
    let folder = tempdir().unwrap();
    // A method makes even ticks.
    let row = |n: u32| {
        let t = 0.05 * f64::from(n) + 0.013 * f64::from(n % 3);
        format!("{t},{}", (6.0 * t).cos())
    };
    let rows: Vec<String> = (0..60).map(row).collect();
    fs::write(folder.path().join("log.csv"), format!("t,x\n{}\n", rows.join("\n"))).unwrap();
    let output = run_in(folder.path(), "identify log.csv --tick-hz 60");
    assert_eq!(output.status.code(), Some(0));
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.starts_with("unknown: the rows are at uneven times"), "{said}");
    // The motion of the log stands alone, without that of a spring that does not fit.
    assert!(said.contains("a player sees: 0.9549 Hz") && !said.contains("by the spring"), "{said}");
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

#[test]
fn where_no_method_comes_near_none_is_named() {
    let (mut x, mut v, mut log) = (1.0_f64, 0.0, "t,x,v\n".to_owned());
    for tick in 0..600 {
        log += &format!("{:?},{x:?},{v:?}\n", f64::from(tick) / 60.0);
        v += (-40.0 * x - 30.0 * x * x * x - 0.2 * v) / 60.0;
        x += v / 60.0;
    }
    let (text, _) = identified(&log, "--tick-hz 60");
    assert!(text.starts_with("unknown: no method comes near\n"), "{text}");
    assert!(!text.contains("engine-"), "{text}");
}
