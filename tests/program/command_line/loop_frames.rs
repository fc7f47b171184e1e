//! `loop`: what each frame of a list counts as, its limits, and loops of lines.

use std::fs;

use super::loops::{near, number, rows};
use super::{run, run_in, stderr};

#[test]
fn a_refresh_of_one_tick_is_one_step_of_semi_fixed() {
    for (trace, ticks) in [("steady-60", 3600.0), ("steady-120", 7200.0), ("spiral", 2885.0)] {
        let row = &rows(&format!("--trace {trace} --policy semi-fixed --seconds 60"))[0];
        near(row, "ticks", ticks);
        near(row, "evaluations", 4.0 * number(row, "ticks"));
    }
}

#[test]
fn raw_ticks_as_frequent_as_refreshes_are_never_advised() {
    let advised = |options: &str| {
        let told = stderr(&run(&format!("loop {options} --policy fixed --policy fixed-linear")));
        told.lines().next().unwrap_or_default().to_owned()
    };
    for options in ["--trace steady-60", "--display-hz 59.5", "--trace steady-120 --tick-hz 120"] {
        assert!(advised(options).contains("take fixed-linear"), "{options}: {}", advised(options));
    }
    let half = advised("--trace steady-120 --tick-hz 240");
    assert!(half.contains("take fixed:"), "{half}");
    let alone = stderr(&run("loop --trace steady-60 --policy fixed"));
    assert!(alone.contains("a clock that rounds decides between no tick and two"), "{alone}");
}

/// Measures the policies on a list of frame times in ms, and returns the rows of the frames.
fn frames_of(times: &[f64], options: &str) -> Vec<csv::StringRecord> {
    let folder = tempfile::tempdir().unwrap();
    let list: String = times.iter().map(|time| format!("{time}\n")).collect();
    fs::write(folder.path().join("list.txt"), list).unwrap();
    let output = run_in(
        folder.path(),
        &format!("loop --trace list.txt {options} --out rows.csv --frame-rows frames.csv"),
    );
    assert_eq!(output.status.code(), Some(0), "{options}: {}", stderr(&output));
    let mut frames = csv::Reader::from_path(folder.path().join("frames.csv")).unwrap();
    frames.records().map(Result::unwrap).collect()
}

/// The numbers of a column of frames, by its index.
fn column(frames: &[csv::StringRecord], index: usize) -> Vec<f64> {
    frames.iter().map(|row| row[index].parse().unwrap()).collect()
}

/// Columns of the frames.
const TICKS: usize = 6;
const STEP_MS: usize = 9;
const OWED_MS: usize = 10;

#[test]
fn each_line_of_a_list_is_a_frame() {
    let times = [16.0, 17.0, 17.0, 16.0, 250.0];
    let frames = frames_of(&times, "--policy variable");
    assert_eq!(column(&frames, STEP_MS), times);
    assert_eq!(column(&frames, 3), [16.0, 33.0, 50.0, 66.0, 316.0]);
    assert_eq!(column(&frames, OWED_MS), [0.0; 5]);
    let rounded: Vec<f64> = (0..301).map(|n| if n % 3 == 1 { 16.0 } else { 17.0 }).collect();
    let folder = tempfile::tempdir().unwrap();
    let list: String = rounded.iter().map(|time| format!("{time}\n")).collect();
    fs::write(folder.path().join("list.txt"), list).unwrap();
    let told = stderr(&run_in(folder.path(), "loop --trace list.txt --policy fixed-linear"));
    assert!(told.contains("(60 Hz display") && told.contains("whole milliseconds"), "{told}");
}

#[test]
fn long_frames_and_excess_ticks_count_as_asked() {
    let tick = 1000.0 / 60.0 + 1e-6;
    let times = [tick, tick, 1000.0, tick, tick, tick];
    for (options, ticks) in [
        ("--max-ticks 20", [1.0, 1.0, 20.0, 1.0, 1.0, 1.0]),
        ("--max-ticks 20 --excess keep", [1.0, 1.0, 20.0, 20.0, 20.0, 3.0]),
        ("--long-frame clamp:100", [1.0, 1.0, 6.0, 1.0, 1.0, 1.0]),
        ("--long-frame replace:200=50.1", [1.0, 1.0, 3.0, 1.0, 1.0, 1.0]),
        ("--long-frame last:66.7", [1.0; 6]),
    ] {
        let frames = frames_of(&times, &format!("--policy fixed {options}"));
        assert_eq!(column(&frames, TICKS), ticks, "{options}");
    }
    for bad in ["--excess save", "--long-frame clamp", "--long-frame last:-1"] {
        assert_eq!(run(&format!("loop {bad}")).status.code(), Some(2), "{bad}");
    }
}

#[test]
fn refreshes_without_a_new_picture_are_counted() {
    let row = &rows("--fps 50 --display-hz 120 --policy variable --seconds 20")[0];
    near(row, "old_refreshes_percent", 58.333);
    near(row, "repeated_percent", 0.0);
    let row = &rows("--fps 59.8261 --display-hz 60 --tick-hz 59.8261 --policy lockstep")[0];
    assert!((0.2..0.5).contains(&number(row, "old_refreshes_percent")), "{row}");
    let row = &rows("--trace alt-tab-5s --policy fixed --seconds 20")[0];
    near(row, "speed_percent", 100.0 * (20_000.0 - number(row, "dropped_ms")) / 20_000.0);
    near(row, "backward_frames", 0.0);
}

#[test]
fn an_engine_answers_in_three_lines() {
    let folder = tempfile::tempdir().unwrap();
    let list = "16.666666666666668\n".repeat(600);
    fs::write(folder.path().join("my.csv"), list).unwrap();
    let output = run_in(folder.path(), "loop --engine phaser-limit60 --trace my.csv");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let told = stderr(&output);
    let lines: Vec<&str> = told.lines().skip(1).collect();
    assert_eq!(lines.len(), 3, "{told}");
    assert!(
        lines[0].contains("4.2.1 on my.csv: runs too fast, at 1") && lines[2].starts_with("set: ")
    );
    assert!(lines[1].contains("a hitch of 100 ms: ") && lines[1].contains("; a hitch of 10 s: "));
    assert!(String::from_utf8_lossy(&output.stdout).contains("\nphaser-limit60,my.csv,60,600,"));
}

#[test]
fn a_loop_of_lines_takes_times_below_0_and_settings() {
    let times = [16.0, -20.0, 0.0, 400.0];
    let frames = frames_of(&times, "--policy three-timer");
    assert_eq!(column(&frames, STEP_MS), times);
    assert_eq!(column(&frames, TICKS), [1.0; 4]);
    let frames = frames_of(&times, "--policy babylon-lockstep --set max_ticks=15");
    assert_eq!(column(&frames, TICKS), [1.0, 0.0, 0.0, 15.0]);
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    at("list.txt", "16\n-20\n16\n");
    at(
        "mine.loop",
        "const most = 3\nmemory owed = 0\nowed += dt\ntick min(floor(owed / H), most)\nowed = 0\n",
    );
    at("bad.loop", "tick 1 of dtt\n");
    let told = |options: &str| {
        let output = run_in(folder.path(), &format!("loop {options}"));
        (output.status.code(), stderr(&output))
    };
    assert_eq!(told("--trace list.txt --policy mine.loop --set most=9").0, Some(0));
    for (options, said) in [
        ("--trace list.txt --policy mine.loop --policy fixed", "-20 is negative"),
        ("--policy bad.loop", "bad.loop:1:11: unknown name `dtt`"),
        ("--policy none.loop", "no file is called \"none.loop\""),
        (
            "--policy bevy --set most=3",
            "no line declares \"most\"; set one of hz=64, max_frame_ms=250",
        ),
        ("--policy fixed --set hz=3", "no line declares \"hz\""),
        ("--policy unity --max-ticks 3", "--set hz=50, --set max_frame_ms=1000 / 3"),
        ("--engine fixed", "no such engine"),
    ] {
        let (code, told) = told(options);
        assert!(code == Some(2) && told.contains(said), "{options}: {told}");
    }
    let shown = run_in(folder.path(), "show mine.loop --as step");
    assert_eq!(shown.stdout, fs::read(folder.path().join("mine.loop")).unwrap());
}

#[test]
fn a_column_of_moments_is_a_row_beside_the_loop_that_it_resembles() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let measured = |options: &str| {
        let output =
            run_in(folder.path(), &format!("loop {options} --policy variable --format json"));
        assert_eq!(output.status.code(), Some(0), "{options}: {}", stderr(&output));
        let rows: Vec<serde_json::Value> = serde_json::from_slice(&output.stdout).unwrap();
        (rows, stderr(&output))
    };
    // Every tenth picture shows a moment that is 5 ms late.
    let late = |n: u32| if n % 10 == 9 { 0.005 } else { 0.0 };
    let rows = (0..300).map(|n| format!("{n},0.01,{}\n", 0.01 * f64::from(n + 1) - late(n)));
    at("visual.csv", &format!("frame,deltaTime,visualTime\n{}", rows.collect::<String>()));
    let (rows, told) = measured("--trace visual.csv --shown visualTime");
    assert_eq!((rows.len(), &rows[0]["policy"]), (2, &serde_json::json!("log")));
    near(&rows[0], "animation_error_rms_ms", 5.0 * (0.2_f64 * 299.0 / 300.0).sqrt());
    near(&rows[0], "animation_error_max_ms", 5.0);
    near(&rows[0], "speed_percent", 100.0 * 2995.0 / 3000.0);
    assert!(told.contains("shown is a clock in s"), "{told}");
    // A position that moves by 2 in each of 64 ticks a second, drawn raw at 144 Hz.
    let rows = (0..1440).map(|n| format!("{},{}\n", f64::from(n) / 0.144, 2 * (n * 64 / 144)));
    at("x.csv", &format!("t_ms,x\n{}", rows.collect::<String>()));
    for speed in ["", "--speed 128"] {
        let (rows, told) = measured(&format!("--trace x.csv --shown x {speed}"));
        assert!(told.contains("x.csv log: as fixed at 64 ticks a second, "), "{told}");
        assert!((number(&rows[0], "repeated_percent") - 55.6).abs() < 0.2, "{}", rows[0]);
    }
    at("back.csv", "t_ms,x\n0,0\n16,16\n10,10\n33,33\n50,50\n");
    let (rows, _) = measured("--trace back.csv --clock-column t_ms --shown x");
    near(&rows[0], "backward_frames", 1.0);
    let refused = run_in(folder.path(), "loop --trace back.csv --clock-column t_ms");
    assert!(stderr(&refused).contains("put rows in order"), "{}", stderr(&refused));
    let refused = run_in(folder.path(), "loop --trace x.csv --shown y");
    assert!(stderr(&refused).contains("no column \"y\""), "{}", stderr(&refused));
}

#[test]
fn a_camera_sees_the_body_as_each_loop_draws_it() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("camera.step");
    let seen = |rule: &str| {
        fs::write(&file, rule).unwrap();
        let options = "loop --trace edge --trace steady-144 --policy fixed --policy fixed-linear --policy whole-refresh";
        let output = run_in(
            folder.path(),
            &format!("{options} --follow camera.step --format json --frame-rows f.csv --force"),
        );
        assert_eq!(output.status.code(), Some(0), "{rule}: {}", stderr(&output));
        assert!(stderr(&output).contains("the body judders by (ms, RMS): fixed "));
        let rows: Vec<serde_json::Value> = serde_json::from_slice(&output.stdout).unwrap();
        rows
    };
    // One that stays still sees what the display shows, and a rigid one sees the ground judder in place of the body.
    for (rule, body, camera) in [("x += 0 * (target - x)", 1.0, 0.0), ("x = target", 0.0, 1.0)] {
        for row in seen(rule) {
            let error = number(&row, "animation_error_rms_ms");
            near(&row, "seen_error_rms_ms", body * error);
            near(&row, "seen_error_max_ms", body * number(&row, "animation_error_max_ms"));
            near(&row, "camera_error_rms_ms", camera * error);
        }
    }
    let rows = seen("x += (target - x) * 8 * dt");
    let error = |row: usize| number(&rows[row], "seen_error_rms_ms");
    assert!((10.0..11.0).contains(&error(0)) && (7.5..8.5).contains(&error(3)), "{rows:?}");
    assert!(error(4) < 1e-6 && error(5) < 1e-5, "{rows:?}");
    // Where the clock is noisy, the dt of the camera is, even below a loop that heals the noise of the body.
    assert!((0.3..0.6).contains(&error(2)), "{rows:?}");
    assert!((110.0..130.0).contains(&number(&rows[4], "camera_lag_ms")), "{rows:?}");
    let mut frames = csv::Reader::from_path(folder.path().join("f.csv")).unwrap();
    assert_eq!(frames.headers().unwrap().iter().next_back(), Some("camera"));
    let mut last: Option<[f64; 2]> = None;
    for row in frames.records().map(Result::unwrap).take(400) {
        let [began_ms, shown_ms, camera] = [3, 5, 12].map(|at| row[at].parse::<f64>().unwrap());
        let expected = last.map_or(shown_ms / 1e3, |[began, camera]| {
            camera + (shown_ms / 1e3 - camera) * 8.0 * (began_ms - began) / 1e3
        });
        assert!((camera - expected).abs() < 1e-9, "{row:?}: {expected}");
        last = Some([began_ms, camera]);
    }
    for (bad, told) in [
        ("x += (target - y) * dt", "camera.step:1:16: unknown name `y`"),
        ("x += dt", "no line reads `target`"),
        ("v += target", "the lines leave `x` where it is"),
        ("x += h * a(x, v)", "calls no acceleration"),
    ] {
        fs::write(&file, bad).unwrap();
        let refused = run_in(folder.path(), "loop --follow camera.step");
        assert_eq!(refused.status.code(), Some(2), "{bad}");
        assert!(stderr(&refused).contains(told), "{bad}: {}", stderr(&refused));
    }
    let refused = run("loop --speed 3");
    assert!(refused.status.code() == Some(2) && stderr(&refused).contains("give --shown or"));
}
