//! `loop`: a row for each policy and trace, frames, a picture, advice and snippets.

use std::fs;

use regatta::loops::{POLICIES, TRACES};
use regatta::manual::chapter;
use serde_json::Value;

use super::{dimensions, refusal, run, run_in, stderr};

const HEADER: &str = "policy,trace,tick_hz,frames,animation_error_rms_ms,animation_error_max_ms,\
                      repeated_percent,double_percent,old_refreshes_percent,latency_mean_ms,\
                      latency_max_ms,dropped_ms,owed_max_ms,position_error_rms,ticks,evaluations,\
                      speed_percent,owed_ms,fast_forward_frames,backward_frames";

/// The rows of `loop` with these options.
pub(super) fn rows(options: &str) -> Vec<Value> {
    let output = run(&format!("loop {options} --format json"));
    assert_eq!(output.status.code(), Some(0), "{options}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

pub(super) fn number(row: &Value, column: &str) -> f64 {
    row[column].as_f64().unwrap_or_else(|| panic!("{column} of {row}"))
}

/// Asserts that a value is within 2 % of one derived by hand, or within a millionth of 0.
pub(super) fn near(row: &Value, column: &str, expected: f64) {
    let value = number(row, column);
    let is_near = value.is_finite() && (value - expected).abs() <= 0.02 * expected.abs() + 1e-6;
    assert!(is_near, "{column} of {row}: {expected} was expected");
}

#[test]
fn rows_are_ordered_by_trace_and_policy_in_csv_and_json() {
    let output = run("loop --all --seconds 0.5");
    let csv = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines[0], HEADER);
    let pairs = TRACES.iter().flat_map(|trace| POLICIES.iter().map(move |p| (&*p.id, trace.id)));
    let expected: Vec<String> =
        pairs.map(|(policy, trace)| format!("{policy},{trace},60,")).collect();
    assert_eq!(lines.len() - 1, expected.len());
    for (line, expected) in lines[1..].iter().zip(&expected) {
        assert!(line.starts_with(expected.as_str()), "{line}");
        assert_eq!(line.split(',').count(), HEADER.split(',').count(), "{line}");
    }
    let told = String::from_utf8(output.stderr).unwrap();
    for trace in TRACES {
        let lines = told.lines().filter(|line| line.starts_with(&format!("{} (", trace.id)));
        assert_eq!(lines.count(), 1, "{}: {told}", trace.id);
    }
    let row = &rows("--seconds 0.5 --trace edge --policy fixed --policy fixed")[0];
    let keys: Vec<&str> = row.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(keys.join(","), HEADER);
}

#[test]
fn without_a_policy_the_usual_ones_are_compared_with_the_same_advice() {
    let compared = rows("--trace edge --seconds 0.5");
    let ids: Vec<&str> = compared.iter().map(|row| row["policy"].as_str().unwrap()).collect();
    assert_eq!(ids, ["variable", "fixed", "fixed-linear", "render-tick", "whole-refresh"]);
    let advised = |options: &str, says: &str| -> Vec<(String, String)> {
        let told = stderr(&run(&format!("loop {options} --seconds 20")));
        let takes = told.lines().filter_map(|line| line.split_once(says));
        takes.map(|(of, take)| (of.into(), take.split(':').next().unwrap().into())).collect()
    };
    let (all, usual) = (advised("--all", "): take "), advised("", "): of these take "));
    assert_eq!(all.len(), TRACES.len(), "{all:?}");
    let found = all.iter().filter(|(_, taken)| taken != "none");
    assert!(found.clone().count() > TRACES.len() / 2, "{all:?}");
    for of_all in found {
        let is_compared = ids.contains(&&*of_all.1);
        assert_eq!(usual.contains(of_all), is_compared, "{of_all:?} {usual:?}");
    }
    // Where all have none, the usual have none either.
    assert!(usual.iter().all(|(of, _)| !all.contains(&(of.clone(), "none".into()))), "{usual:?}");
}

#[test]
fn the_table_derived_by_hand_is_reproduced() {
    let fixed = |trace: &str| {
        let mut rows =
            rows(&format!("--trace {trace} --policy fixed --policy fixed-linear --seconds 300"));
        (rows.remove(0), rows.remove(0))
    };
    for (trace, repeated, error) in [
        ("steady-59.94", 0.0, 0.527),
        ("steady-75", 20.0, 6.67),
        ("steady-144", 58.33, 8.22),
        ("steady-240", 75.0, 7.22),
    ] {
        let (raw, linear) = fixed(trace);
        near(&raw, "repeated_percent", repeated);
        near(&raw, "animation_error_rms_ms", error);
        near(&linear, "animation_error_rms_ms", 0.0);
        near(&linear, "repeated_percent", 0.0);
        near(&linear, "latency_mean_ms", 1000.0 / 60.0);
    }
    // One double step in 16.7 s.
    near(&fixed("steady-59.94").0, "double_percent", 100.0 / (16.667 * 59.94));
    let (raw, linear) = fixed("edge");
    near(&raw, "repeated_percent", 25.0);
    near(&raw, "double_percent", 25.0);
    near(&raw, "animation_error_rms_ms", 11.79);
    near(&linear, "animation_error_rms_ms", 0.408);
    let whole = &rows("--trace edge --policy whole-refresh --seconds 300")[0];
    near(whole, "animation_error_rms_ms", 0.0);
    let extrapolated = &rows("--trace steady-144 --policy fixed-extrapolated")[0];
    near(extrapolated, "latency_mean_ms", 0.0);
    assert!(number(extrapolated, "position_error_rms") > 1e-4, "it is wrong on curves");
}

#[test]
fn the_manuals_table_matches_its_command() {
    let manual = chapter("loops").unwrap().text;
    let (_, command) = manual.split_once("```sh\nregatta loop ").unwrap();
    let (command, _) = command.split_once("```").unwrap();
    let measured = rows(&command.replace('\\', ""));
    let value = |policy: &str, trace: &str, column: &str| {
        let row = measured.iter().find(|row| row["policy"] == policy && row["trace"] == trace);
        number(row.unwrap_or_else(|| panic!("{policy} on {trace}")), column)
    };
    let (_, table) = manual.split_once("\n| display |").unwrap();
    let lines = table.lines().skip(2).take_while(|line| line.starts_with('|'));
    let error = "animation_error_rms_ms";
    let mut compared = 0;
    for line in lines {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let steady = format!("steady-{}", cells[0].trim_end_matches(" Hz"));
        let trace = if cells[0].contains("begin within") { "edge" } else { &steady };
        for (cell, (policy, column)) in cells[1..].iter().zip([
            ("fixed", "repeated_percent"),
            ("fixed", "double_percent"),
            ("fixed", error),
            ("fixed-linear", error),
        ]) {
            let printed = cell.split(' ').next().unwrap();
            let decimals = printed.split_once('.').map_or(0, |(_, after)| after.len());
            let half = 0.5 * 0.1_f64.powi(decimals as i32);
            // Less than a microsecond is the rounding of traces.
            let half = if printed == "0" { 1e-3 } else { half };
            let found = value(policy, trace, column);
            assert!(
                (found - printed.parse::<f64>().unwrap()).abs() <= half,
                "{trace}: {cell}, {found}"
            );
            compared += 1;
        }
    }
    assert_eq!(compared, 5 * 4);
}

#[test]
fn a_render_tick_has_no_latency_and_the_accuracy_of_its_method() {
    let ahead = |options: &str| {
        let both = "--policy fixed-extrapolated --policy render-tick --seconds 8";
        let rows = rows(&format!("--trace steady-144 {both} {options}"));
        for row in &rows {
            near(row, "latency_mean_ms", 0.0);
            near(row, "animation_error_rms_ms", 0.0);
        }
        [0, 1].map(|i| number(&rows[i], "position_error_rms"))
    };
    let [extrapolated, stepped] = ahead("--scene spring --method rk4");
    assert!(1e-3 < extrapolated && extrapolated < 2e-3, "{extrapolated}");
    assert!(1e-5 < stepped && stepped < 3e-5, "{stepped}, and RK4 itself is off by that");
    let [extrapolated, stepped] = ahead("--scene damped --method rk4");
    assert!(1e-3 < extrapolated && extrapolated < 2e-3, "{extrapolated} with drag");
    assert!(1e-5 < stepped && stepped < 3e-5, "{stepped} with drag");
    let [extrapolated, stepped] = ahead("--scene spring --method rk4 --tick-hz 4");
    assert!(0.4 < stepped && stepped < extrapolated && extrapolated < 0.6, "{stepped}");
    // A step of explicit Euler moves a position by its velocity, exactly like extrapolation.
    let [extrapolated, stepped] = ahead("--scene spring --method explicit-euler");
    assert!(stepped.is_finite() && (stepped - extrapolated).abs() < 1e-12, "{stepped}");
    // The copies' evaluations are paid for: 480 ticks and a copy in each frame that is not at a tick.
    let rows =
        rows("--scene spring --method rk4 --trace steady-144 --policy render-tick --seconds 8");
    near(&rows[0], "ticks", 480.0);
    near(&rows[0], "evaluations", 4.0 * (480.0 + 1120.0));
}

#[test]
fn every_frame_has_a_line_with_its_shown_state() {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(
        folder.path(),
        "loop --trace steady-144 --policy fixed --seconds 1 --out rows.csv --frame-rows frames.csv",
    );
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = fs::read_to_string(folder.path().join("frames.csv")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "trace,policy,frame,began_ms,displayed_ms,shown_ms,ticks,dropped_ms,q,step_ms,owed_ms,alpha"
    );
    assert_eq!(lines.len(), 1 + 145);
    assert_eq!(lines[1], "steady-144,fixed,0,0.0,0.0,0.0,0,0.0,1.0,0.0,0.0,0.0");
    let shown = |line: &str| line.split(',').nth(5).unwrap().parse::<f64>().unwrap();
    let repeated = lines[1..].windows(2).filter(|pair| shown(pair[0]) == shown(pair[1])).count();
    // Seven in twelve of 144.
    assert_eq!(repeated, 84);
    let again = run_in(folder.path(), "loop --trace steady-144 --frame-rows frames.csv");
    assert_eq!(again.status.code(), Some(2));
    assert!(stderr(&again).contains("--force"), "{}", stderr(&again));
}

#[test]
fn a_recorded_log_is_a_trace_for_each_of_its_programs() {
    let log = "tests/data/frame-traces/presentmon_test_case_5.csv";
    let rows = rows(&format!("--trace {log} --policy fixed-linear --policy variable"));
    assert_eq!(rows.len(), 2 * 7);
    let bench = rows.iter().find(|row| row["trace"].as_str().unwrap().contains("PresentBench"));
    let bench = bench.expect("the present benchmark has a stream");
    assert_eq!(number(bench, "frames"), 258.0);
    near(bench, "animation_error_rms_ms", 5.606);
}

#[test]
fn a_utf_16_log_is_read_and_summarised_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let text = "\u{feff}MsBetweenPresents,MsBetweenDisplayChange\r\n16.7,16.7\r\n16.7,16.7\r\n";
    let bytes: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    fs::write(folder.path().join("log.csv"), bytes).unwrap();
    let output = run_in(folder.path(), "loop --trace log.csv");
    assert_eq!(output.status.code(), Some(0));
    let said = stderr(&output);
    assert!(
        said.starts_with("read 2 frames in 0.0167 s: 59.9 a second, longest 16.7 ms"),
        "{said}"
    );
}

#[test]
fn advice_names_a_policy_within_the_latency_with_its_constants() {
    let told = |options: &str| stderr(&run(&format!("loop {options}")));
    let of_edge = told("--trace edge --seconds 5");
    assert!(of_edge.contains("take whole-refresh: animation error 0 ms"), "{of_edge}");
    let at_once = told("--trace edge --seconds 5 --latency-ms 1");
    assert!(!at_once.contains("take whole-refresh"), "{at_once}");
    // A game in lockstep with the display has no error on it, and another speed on any other.
    let lockstep = told("--trace edge --policy lockstep --seconds 5");
    let speed = "take none of these: in every loop with a fixed tick the speed depends on the frame rate; try --all";
    assert!(lockstep.contains(speed), "{lockstep}");
    let variable = told("--trace steady-144 --policy variable --policy fixed --seconds 5");
    assert!(variable.contains("(amplitudes): variable by"), "{variable}");
    assert!(!variable.contains("take variable") && !variable.contains("fixed by"), "{variable}");
    // Whole periods of the spring later it is where it was, but not on the way there.
    let periods = told("--trace steady-60 --policy lockstep --seconds 20");
    assert!(periods.contains("lockstep by 2"), "{periods}");
    // A step of five seconds is as smooth as any, and throws the spring out of the world.
    let thrown = told("--trace alt-tab-5s --policy variable");
    assert!(!thrown.contains("take variable"), "{thrown}");
}

#[test]
fn a_juddering_or_variable_loop_is_never_advised() {
    let told = |options: &str| stderr(&run(&format!("loop {options}")));
    let of_all = told("--all --scene stiff --tick-hz 30");
    let lost = "take none: in every loop with a fixed tick the motion is lost; give more --tick-hz or another --method";
    assert!(of_all.matches(lost).count() >= 10, "{of_all}");
    assert!(!of_all.contains("try --all") && !of_all.contains("take variable"), "{of_all}");
    let coarse = told("--all --scene ship --trace edge");
    assert!(
        coarse.contains(
            "edge (60 Hz display, 2 Hz ticks): take none: no loop with a fixed tick is smooth within 20 ms; \
             whole-refresh is smooth and 500 ms late; in time fixed-extrapolated is the smoothest: \
             uneven by 0.41 ms; --latency-ms 501 takes whole-refresh"
        ),
        "{coarse}"
    );
    let late = told("--all --scene ship --trace edge --latency-ms 501");
    assert!(late.contains("take whole-refresh: animation error 0 ms"), "{late}");
    let variable = told("--trace steady-60 --policy variable");
    let varies =
        "take none of these: without a fixed tick the physics varies with the rate; try --all";
    assert!(variable.contains(varies), "{variable}");
    // Advice is a loop with a fixed tick or none, in every scene and at odd rates.
    for (scene, tick_hz) in [("spring", 7), ("stiff", 120), ("pendulum", 30), ("orbit", 10)] {
        let told = told(&format!("--all --scene {scene} --tick-hz {tick_hz} --seconds 10"));
        for line in told.lines().filter_map(|line| line.split_once("): take ")) {
            let taken = line.1.split(':').next().unwrap();
            let card = POLICIES.iter().find(|card| card.id == taken);
            assert!(taken == "none" || card.is_some_and(|card| card.has_fixed_tick), "{line:?}");
        }
    }
}

#[test]
fn a_log_without_passing_time_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (name, head) in [("list.txt", ""), ("log.csv", "MsBetweenPresents\n")] {
        fs::write(folder.path().join(name), format!("{head}{}", "0\n".repeat(100))).unwrap();
        let output = run_in(folder.path(), &format!("loop --trace {name}"));
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0));
        let line = 1 + u32::from(!head.is_empty());
        let refused = format!(
            "error: {name}:{line}: no time passes from here to the last of these 100 frames; capture them again\n"
        );
        assert_eq!(stderr(&output), refused);
    }
}

#[test]
fn interpolation_is_advised_among_equally_smooth_loops() {
    let why = "extrapolation or a render tick would be as smooth and no tick late, but overshoots";
    for trace in ["steady-75", "steady-144", "steady-240"] {
        let told = stderr(&run(&format!("loop --trace {trace} --seconds 5 --all")));
        assert!(told.contains("take fixed-linear: animation error 0 ms"), "{told}");
        assert!(told.contains(why), "{told}");
    }
    let told = stderr(&run("loop --trace steady-144 --seconds 5 --latency-ms 1 --all"));
    assert!(told.contains("take fixed-extrapolated") && !told.contains(why), "{told}");
    let told = stderr(&run("loop --trace steady-120 --tick-hz 240 --seconds 5"));
    assert!(told.contains("take fixed:") && !told.contains(why), "{told}");
}

#[test]
fn a_game_at_another_speed_has_no_latency() {
    let rows = rows("--trace steady-144 --policy lockstep --policy fixed --seconds 5");
    assert!(rows[0]["latency_mean_ms"].is_null() && rows[0]["latency_max_ms"].is_null());
    let latency = number(&rows[1], "latency_mean_ms");
    assert!((0.0..17.0).contains(&latency), "{latency}");
}

#[test]
fn a_list_of_frame_times_is_a_trace_without_display_times() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("mine.csv"), "16.7\n".repeat(300)).unwrap();
    let output =
        run_in(folder.path(), "loop --trace mine.csv --policy fixed --policy fixed-linear");
    let told = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{told}");
    assert!(told.contains("mine.csv (59.88"), "{told}");
    assert!(told.contains("each frame counts as shown when it begins"), "{told}");
    assert!(!told.contains("common origin"), "{told}");
}

#[test]
fn latency_on_a_log_is_relative_to_its_minimum() {
    let folder = tempfile::tempdir().unwrap();
    let log = |name: &str, first_display_ms: f64| {
        let rows: String = (0..300).map(|_| "16.7,16.7\n").collect();
        let text =
            format!("MsBetweenPresents,MsBetweenDisplayChange\n16.7,{first_display_ms}\n{rows}");
        fs::write(folder.path().join(name), text).unwrap();
        let output = run_in(folder.path(), &format!("loop --trace {name}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stderr(&output).replace(name, "log")
    };
    let told = log("a.csv", 16.7);
    assert!(told.contains("the log's two clocks have no common origin"), "{told}");
    assert!(told.contains("log ("), "{told}");
    let built_in = stderr(&run("loop --trace steady-60 --policy fixed --seconds 5"));
    assert!(!built_in.contains("common origin"), "{built_in}");
}

#[test]
fn standard_output_is_not_reported_as_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let frames = "loop --trace edge --policy fixed --seconds 2 --out rows.csv --frame-rows";
    let to_stdout = run_in(folder.path(), &format!("{frames} -"));
    assert_eq!(stderr(&to_stdout).matches("wrote").collect::<Vec<_>>(), ["wrote"]);
    let to_file = run_in(folder.path(), &format!("{frames} frames.csv --force"));
    assert!(stderr(&to_file).contains("wrote the frames: frames.csv"), "{}", stderr(&to_file));
}

#[test]
fn a_trace_is_not_overwritten_by_its_measurements() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("log.csv");
    let text = "MsBetweenPresents,MsBetweenDisplayChange\n16.7,16.7\n16.7,16.7\n";
    fs::write(&log, text).unwrap();
    let output = run_in(folder.path(), "loop --trace log.csv --out ./log.csv --force");
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("is read as a trace"), "{}", stderr(&output));
    assert_eq!(fs::read_to_string(&log).unwrap(), text);
}

#[test]
fn a_picture_is_drawn_of_the_first_trace() {
    let folder = tempfile::tempdir().unwrap();
    let command = "loop --trace steady-144 --plot loops.png";
    let output = run_in(folder.path(), command);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(dimensions(&folder.path().join("loops.png")), (1840, 900));
}

#[test]
fn mistakes_are_reported_with_a_remedy() {
    for (options, says) in [
        ("--policy fixd", "did you mean fixed?"),
        ("--trace stedy-144", "did you mean steady-144?"),
        ("--trace steady-144 --display-hz 60", "leave --display-hz out"),
        ("--display-hz 0", "from 1 to 1000 Hz"),
        ("--display-hz nan", "from 1 to 1000 Hz"),
        ("--latency-ms -1", "give 0 to 10000 ms"),
        ("--seconds 0", "more than 0 seconds"),
        ("--tick-hz 0", "give a rate from 0.01 to 10000 Hz"),
        ("--scene nowhere", "nowhere"),
        ("--trace Cargo.toml", "Cargo.toml"),
        ("--out x.csv --frame-rows x.csv", "the same place"),
        ("--all --policy fixed", "cannot be used with"),
    ] {
        let refused = refusal(&format!("loop {options}"), 2);
        assert!(refused.contains(says), "{options}: {refused}");
    }
    for command in ["capture", "play"] {
        let refused = refusal(&format!("{command} --loop my/capture.csv"), 2);
        assert!(refused.contains("drop the file on the window"), "{refused}");
    }
}

#[test]
fn the_limits_on_ticks_and_frame_time_can_be_set_and_drop_the_rest() {
    let row =
        |options: &str| rows(&format!("--fps 20 --tick-hz 60 --seconds 10 {options}")).remove(0);
    // Two of the three ticks of a frame: two thirds of the speed.
    let two = row("--policy fixed --max-ticks 2");
    near(&two, "dropped_ms", 200.0 * 1000.0 / 60.0);
    near(&two, "ticks", 400.0);
    assert!(number(&two, "owed_max_ms") < 17.0, "{two}");
    for policy in ["semi-fixed", "slow-down", "whole-refresh", "hysteresis"] {
        let limited = row(&format!("--policy {policy} --max-ticks 2"));
        assert!((number(&limited, "ticks") - 400.0).abs() <= 3.0, "{policy}: {limited}");
    }
    // 40 ms of each 50 are simulated, under every loop that has a most or none.
    for policy in ["fixed", "variable", "whole-refresh"] {
        let short = row(&format!("--policy {policy} --max-frame-ms 40"));
        near(&short, "dropped_ms", 2000.0);
    }
    // More than the loop's own quarter of a second.
    let hitch = |options: &str| {
        let trace = "--trace alt-tab-5s --policy fixed --seconds 12";
        number(&rows(&format!("{trace} {options}"))[0], "dropped_ms")
    };
    let [own, more] = [hitch(""), hitch("--max-frame-ms 1000")];
    assert!(own - more > 700.0, "{own} and {more}");
    let told = refusal("loop --policy variable --max-ticks 2", 2);
    assert!(told.contains("--max-ticks does nothing under variable"), "{told}");
}

#[test]
fn frames_and_the_display_may_have_two_rates() {
    // A picture that the next one replaces before the refresh is never displayed.
    let fast = &rows("--fps 200 --display-hz 100 --policy variable --seconds 10")[0];
    assert_eq!(fast["trace"], "fps-200-on-100");
    assert!(number(fast, "frames") > 1999.0, "{fast}");
    near(fast, "animation_error_rms_ms", 0.0);
    // At 48 frames on 60 Hz one refresh in five shows the same picture again.
    let slow = &rows("--fps 48 --display-hz 60 --policy variable --seconds 10")[0];
    assert!(number(slow, "animation_error_rms_ms") > 1.0, "{slow}");
    // A display of a variable rate shows each when it begins.
    let variable = &rows("--fps 100 --policy variable --seconds 2")[0];
    assert_eq!(variable["trace"], "steady-100");
    assert!(refusal("loop --fps 100 --trace edge", 2).contains("--trace"));
}

#[test]
fn capframex_json_and_table_have_the_same_frames() {
    let folder = tempfile::tempdir().unwrap();
    let runs = |count: usize| {
        let run = r#"{"CaptureData": {"MsBetweenPresents": [9.7, 12.2, 9.9, 10.1],
            "MsBetweenDisplayChange": [10.0, 10.0, 10.0, 10.0], "Dropped": [false, false, true, false],
            "MsInPresentAPI": []}}"#;
        let runs = vec![run; count].join(",");
        format!(r#"{{"Info": {{"ProcessName": "game.exe"}}, "Runs": [{runs}]}}"#)
    };
    let table = "MsBetweenPresents,MsBetweenDisplayChange,Dropped\n\
                 9.7,10,0\n12.2,10,0\n9.9,10,1\n10.1,10,0\n";
    let written = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    written("a.json", &runs(1));
    written("a.csv", table);
    written("two.json", &runs(2));
    let rows = |name: &str| {
        let output = run_in(folder.path(), &format!("loop --trace {name} --policy fixed"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        String::from_utf8(output.stdout).unwrap()
    };
    assert_eq!(rows("a.json").replace("a.json", "a.csv"), rows("a.csv"));
    let two = rows("two.json");
    assert!(two.contains("two.json:game.exe-1,") && two.contains("two.json:game.exe-2,"), "{two}");
    for (text, told) in [
        ("{", "this is no JSON"),
        ("{\"Runs\": []}", "there is no run in it"),
        ("{\"Runs\": [{\"CaptureData\": {\"MsBetweenPresents\": [\"x\"]}}]}", "frame 1: column"),
    ] {
        written("bad.json", text);
        let output = run_in(folder.path(), "loop --trace bad.json");
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(stderr(&output).contains(told), "{text}: {}", stderr(&output));
    }
}

#[test]
fn a_log_with_diverging_clocks_uses_frame_starts_with_a_notice() {
    let folder = tempfile::tempdir().unwrap();
    let log = |change: f64| {
        let row = format!("7,{change}\n");
        format!("MsBetweenPresents,MsBetweenDisplayChange\n{}", row.repeat(300))
    };
    for (change, is_parted) in [(9.0, true), (5.0, true), (7.02, false)] {
        fs::write(folder.path().join("log.csv"), log(change)).unwrap();
        let output = run_in(folder.path(), "loop --trace log.csv --policy variable --format json");
        let told = stderr(&output).contains("part by more than 1 %");
        assert_eq!(told, is_parted, "{change}: {}", stderr(&output));
        let rows: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
        if is_parted {
            near(&rows[0], "latency_mean_ms", 0.0);
        }
    }
}

#[test]
fn lines_that_name_an_absurd_time_make_rows_and_no_panic() {
    let folder = tempfile::tempdir().unwrap();
    for lines in [
        "tick 1\nshow 1/0\n",
        "tick 1\nshow 1e308*10\n",
        "memory owed = 0\nowed = 1e300\ntick 1\n",
        "memory owed = 0\nowed = -1e300\ntick 1\nshow owed/H\n",
        "memory dropped = 0\ndropped = 1e300\ntick 1\n",
    ] {
        fs::write(folder.path().join("odd.loop"), lines).unwrap();
        let asked = "loop --policy odd.loop --trace steady-144 --seconds 1 --format json";
        let output = run_in(folder.path(), asked);
        assert_eq!(output.status.code(), Some(0), "{lines}: {}", stderr(&output));
        let rows: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
        assert!(rows[0]["ticks"].as_u64().unwrap() > 100, "{lines}: {rows:?}");
    }
}
