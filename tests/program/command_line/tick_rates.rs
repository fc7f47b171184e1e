//! Tick rates that are not whole: decimals, ratios and periods, in every command that takes a rate.

use std::fs;

use serde_json::Value;

use super::{refusal, run, run_in, stderr, stdout_of};

const SPRING: &str = "title = 'x'\nseconds = 3\nmethods = ['rk4', 'midpoint']\n\
                      [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";

#[test]
fn advice_at_a_fractional_rate_names_the_rate() {
    let advice = stdout_of("advise --k 900 --c 4 --mass 12 --tick-hz 66.67 --format json");
    let advice: Value = serde_json::from_str(&advice).unwrap();
    assert_eq!(advice["tick_hz"], 66.67);
    let words = stdout_of("advise --k 900 --c 4 --mass 12 --step 0.015");
    assert!(words.contains("at 66.667 Hz: looks-right: "), "{words}");
}

#[test]
fn a_loop_at_the_rate_of_ntsc_has_rows_of_59_94_hz() {
    let rows = run("loop --trace steady-144 --tick-hz 59.94").stdout;
    let rows = String::from_utf8(rows).unwrap();
    let rates: Vec<_> = rows.lines().skip(1).map(|row| row.split(',').nth(2).unwrap()).collect();
    assert!(!rates.is_empty() && rates.iter().all(|rate| *rate == "59.94"), "{rows}");
}

#[test]
fn a_trace_counts_its_ticks_in_the_given_ratio() {
    let trace = stdout_of("trace --scene spring --tick-hz 333.3333 --seconds 1 --every 100");
    let times: Vec<_> = trace.lines().skip(1).filter(|row| row.contains(",exact,")).collect();
    let time = |row: &str| row.split(',').nth(1).unwrap().parse::<f64>().unwrap();
    let times: Vec<f64> = times.into_iter().map(time).collect();
    let tick = |n: f64| n * 10_000.0 / 3_333_333.0;
    assert_eq!(times, [0.0, 100.0, 200.0, 300.0].map(tick));
    let of = |rate: &str| stdout_of(&format!("trace --scene spring {rate} --seconds 3"));
    let source = of("--step 0.015");
    for same in ["--step 15ms", "--step 3/200", "--tick-hz 200/3", "--tick-hz 1/0.015"] {
        assert_eq!(of(same), source, "{same}");
    }
    assert_eq!(of("--step 1/66.667"), of("--tick-hz 66.667"));
    assert_ne!(of("--tick-hz 66.667"), source);
    assert_eq!(of("--tick-hz 60.0"), of("--tick-hz 60"));
}

#[test]
fn a_sweep_has_a_row_for_each_rate_and_octaves_of_a_fractional_one() {
    let rates = |arguments: &str| -> Vec<String> {
        let rows = stdout_of(&format!("sweep --method rk4 --seconds 1 {arguments}"));
        rows.lines().skip(1).map(|row| row.split(',').nth(3).unwrap().to_owned()).collect()
    };
    assert_eq!(rates("--scene spring --tick-hz 66.667,59.94,60.0"), ["59.94", "60", "66.667"]);
    assert_eq!(rates("--scene spring --step 0.02,0.025"), ["40", "50"]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.toml");
    fs::write(&path, format!("tick_hz = 59.94\n{SPRING}")).unwrap();
    let octaves = ["14.985", "29.97", "59.94", "119.88", "239.76", "479.52"];
    assert_eq!(rates(&format!("--scene {}", path.display())), octaves);
}

#[test]
fn an_impossible_rate_is_refused_with_the_range() {
    for bad in ["nan", "inf", "0", "-60", "1e400", "66.6666666667", "0.001", "20000", "1/0"] {
        let message = refusal(&format!("trace --scene spring --tick-hz {bad}"), 2);
        let range = "give a rate from 0.01 to 10000 Hz, with at most 9 digits after the point";
        assert!(message.contains(range), "{message}");
    }
    for bad in ["nan", "0", "-1", "0.0166666667", "101", "1/66,667"] {
        let message = refusal(&format!("sweep --scene spring --step {bad}"), 2);
        assert!(message.contains("give a step from 0.0001 to 100 s"), "{message}");
    }
    for command in ["trace --scene spring", "loop", "advise --k 9", "port --frequency 1Hz"] {
        let message = refusal(&format!("{command} --tick-hz 60 --step 0.015"), 2);
        assert!(message.contains("cannot be used with"), "{command}: {message}");
    }
}

#[test]
fn ports_and_identified_logs_take_a_period() {
    let port = |rate: &str| stdout_of(&format!("port --frequency 1Hz --format json {rate}"));
    assert_eq!(port("--step 0.02"), port("--tick-hz 50"));
    let folder = tempfile::tempdir().unwrap();
    let trace = stdout_of("trace --scene spring --method rk4 --step 0.015 --seconds 3");
    let log = trace.lines().filter(|row| row.starts_with("tick") || row.contains(",rk4,"));
    let log: String = log.map(|row| row.replace(",q,v", ",x,v") + "\n").collect();
    fs::write(folder.path().join("log.csv"), log).unwrap();
    let k = 4.0 * std::f64::consts::PI * std::f64::consts::PI;
    let found = run_in(folder.path(), &format!("identify log.csv --step 0.015 --k {k}"));
    let words = String::from_utf8_lossy(&found.stdout).into_owned();
    assert!(words.contains("rk4"), "{words}{}", stderr(&found));
}

#[test]
fn a_recording_at_a_fractional_rate_is_verified_to_the_bit() {
    for (rate, line) in [
        ("tick_hz = 66.667", "tick_hz = 66.667\n"),
        ("step_s = 0.015", "step_s = 0.015\n"),
        ("tick_hz = \"60000/1001\"", "tick_hz = \"60000/1001\"\n"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let scene = format!("{rate}\n{SPRING}[[command]]\nat_s = 1.5\nstep_s = 0.03\n");
        fs::write(folder.path().join("run.toml"), scene).unwrap();
        let blessed = run_in(folder.path(), "verify run.toml --bless");
        assert_eq!(blessed.status.code(), Some(0), "{rate}: {}", stderr(&blessed));
        let verified = run_in(folder.path(), "verify run.toml");
        let words = String::from_utf8_lossy(&verified.stdout).into_owned();
        assert_eq!(verified.status.code(), Some(0), "{rate}: {words}{}", stderr(&verified));
        assert!(words.contains("lane 1, rk4: same to the bit"), "{words}");
        let link = run_in(folder.path(), "link run.toml").stdout;
        let link = String::from_utf8(link).unwrap();
        assert!(stdout_of(&format!("verify {}", link.trim())).contains("same"), "{rate}");
        let fixture = run_in(folder.path(), "fixture --scene run.toml --as json --seconds 1");
        let fixture: Value = serde_json::from_slice(&fixture.stdout).unwrap();
        assert!(fixture["scene"].as_str().unwrap().contains(line), "{fixture}");
    }
}

#[test]
fn a_link_names_a_fractional_rate() {
    let lane = |arguments: &str| stdout_of(&format!("trace {arguments} --seconds 1"));
    let asked = lane("--scene spring --tick-hz 66.667");
    assert_eq!(lane("#scene=spring&method=rk4&tick-hz=66.667"), asked);
    let asked = lane("--scene spring --step 0.015");
    assert_eq!(lane("#scene=spring&method=rk4&tick-hz=1/0.015"), asked);
}
