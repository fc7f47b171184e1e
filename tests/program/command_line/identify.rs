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
            "moves as engine-box2d ×4 or engine-box3d ×4 do, or code with the same step, residual "
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
    assert!(said.starts_with("moves as engine-box2d ×4"), "{said}");
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
        (
            "t (h),x\n0,1\n",
            "column \"t (h)\": h is no unit of time that is known; give it with --unit",
        ),
        (
            "t,body,x\n0,a,1\n0,b,2\n1,a,3\n1,b,4\n",
            "two rows at each time; --where body=a takes one",
        ),
        ("{\"t\": 0, \"x\": 1}\n[2]\n", "line 2: [2] is no row like the first"),
        ("{\"traceEvents\": []}", "this is a trace of Chromium"),
        // A row of a trace has the name in a cell.
        (
            "tick,coordinate,w\n0,x,1\n",
            "log.csv:1: no column \"x\"; here are \"tick\", \"coordinate\", \"w\"",
        ),
        ("tick,x\n0,1\n1,abc\n", "log.csv:3: column \"x\": \"abc\" is no number"),
        ("tick,x\n0,1\n1,NaN\n", "log.csv:3: column \"x\": \"NaN\" is no number"),
        ("tick,x\n0,1\n1\n", "log.csv:3: the row has 1 of the header's 2 cells"),
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
        ("identify log.csv", "the rows are ticks of a rate; give it with --tick-hz"),
        ("identify log.csv --tick-hz 60 --where y=2", "no column \"y\"; here are"),
        ("identify log.csv --tick-hz 60 --rows 7..9", "none of the 4 rows is taken"),
        ("identify log.csv --unit h", "give ns, us, ms, s or ticks"),
        ("identify log.csv --rows 0..3", "give the first and the last row, from 1"),
        ("identify log.csv --tick-hz 0", "give a rate above 0"),
        ("identify log.csv --tick-hz 60 --k -1", "give a number from 0 up"),
        ("identify log.csv --tick-hz 60 --mass 0", "give a number above 0"),
        ("identify log.csv --tick-hz 60 --c 1", "--k"),
        (&format!("identify {LOG} --tick-hz 60 --v-column vel"), "no column \"vel\"; here are"),
    ] {
        let output = match arguments.contains(LOG) {
            true => run(arguments),
            false => run_in(folder.path(), arguments),
        };
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        assert!(stderr(&output).contains(told), "{arguments}: {}", stderr(&output));
    }
}

#[test]
fn each_body_of_a_log_is_answered_by_its_rows_alone() {
    let folder = tempdir().unwrap();
    // Semi-implicit Euler at 60 Hz on two springs of 40 N/m and 2 kg.
    let body = |name: &str, x: f64, v: f64| -> Vec<String> {
        let mut state = [x, v];
        let row = |tick: u32| {
            let [x, v] = state;
            let v_after = v + (-20.0 * x - 0.25 * v) / 60.0;
            state = [x + v_after / 60.0, v_after];
            format!("{:?},{name},{x:?},{v:?}", f64::from(tick) / 60.0)
        };
        (0..200).map(row).collect()
    };
    let [a, b] = [body("a", 1.0, 0.0), body("b", -0.5, 1.0)];
    let by_time: Vec<String> = a.iter().zip(&b).map(|(a, b)| format!("{a}\n{b}")).collect();
    for (rows, found) in [
        (by_time, "two rows at each time; --where body=a takes one"),
        ([a, b].concat(), "rows of several bodies; --where body=a takes one"),
    ] {
        let text = format!("t,body,x,v\n{}\n", rows.join("\n"));
        fs::write(folder.path().join("log.csv"), text).unwrap();
        let output =
            run_in(folder.path(), "identify log.csv --k 40 --c 0.5 --mass 2 --format json");
        assert_eq!(output.status.code(), Some(0));
        assert!(stderr(&output).contains(found), "{}", stderr(&output));
        let first: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(first["of"], "body=a");
        for answer in [&first, &first["others"]["body=b"]] {
            assert_eq!(answer["word"], "identified");
            let mut named = answer["also"].as_array().unwrap().iter();
            assert!(named.any(|it| it["method"] == "semi-implicit-euler"), "{answer}");
        }
        let output = run_in(folder.path(), "identify log.csv --k 40 --c 0.5 --mass 2");
        let said = String::from_utf8(output.stdout).unwrap();
        let heads = said.lines().filter(|line| line.starts_with("body="));
        assert_eq!(heads.collect::<Vec<_>>(), ["body=a", "body=b"]);
    }
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
pub(super) fn identified(log: &str, options: &str) -> (String, Value) {
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
        // Where the spring is not given, other methods fit as well, and all are listed.
        assert!(has_it && text.contains("semi-implicit-euler ×1"), "{options}: {text}");
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
    assert!(stderr(&output).starts_with("read rows 1 to 240 of 240 in "), "{}", stderr(&output));
    // Even rows at another rate are not uneven.
    let even: String = (0..50).map(|n| format!("{:.6},{n}\n", f64::from(n) / 50.0)).collect();
    fs::write(folder.path().join("even.csv"), format!("t,x\n{even}")).unwrap();
    let output = run_in(folder.path(), "identify even.csv --tick-hz 60");
    assert!(stderr(&output).contains("50.00 rows a second: give the rate"), "{}", stderr(&output));
}

/// Rows of semi-implicit Euler at 60 Hz with k 40 N/m, c 0.5 N s/m and 2 kg, as lines of `row`.
fn rows_of(count: u32, row: impl Fn(u32, f64, f64) -> String) -> String {
    let (mut x, mut v, mut text) = (1.0_f64, 0.0_f64, String::new());
    for tick in 0..count {
        text += &row(tick, x, v);
        v += (-40.0 * x - 0.5 * v) / 2.0 / 60.0;
        x += v / 60.0;
    }
    text
}

/// The first line that `identify` says of a log, and all that it says on standard error.
fn read_as(log: &str, options: &str) -> (String, String) {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join("log.csv"), log).unwrap();
    let output = run_in(folder.path(), &format!("identify log.csv {options}"));
    let said = String::from_utf8(output.stdout.clone()).unwrap();
    (said, stderr(&output))
}

const SPRING: &str = "--k 40 --c 0.5 --mass 2";

#[test]
fn a_log_is_read_in_any_form_that_its_rows_tell() {
    let t = |tick: u32| f64::from(tick) / 60.0;
    let ns = |tick: u32| 1_767_225_600_000_000_000_u64 + u64::from(tick) * 1_000_000_000 / 60;
    let of_day = |tick: u32| {
        let (s, ms) = (tick / 60, tick % 60 * 1000 / 60);
        format!("2026-02-19T16:25:{s:02}.{ms:03}")
    };
    let object = |tick, x: f64, v: f64| {
        format!("{{\"time\": {:?}, \"pos\": {{\"x\": {x:?}}}, \"v\": {v:?}}}\n", t(tick))
    };
    let entries = rows_of(90, object).trim_end().replace('\n', ",");
    for (log, options, read) in [
        (rows_of(90, |_, x, v| format!("{x:?},{v:?}\n")), "--tick-hz 60", "columns 1, 2"),
        (rows_of(90, |_, x, v| format!("{x:?} {v:?}\n")), "--tick-hz 60", "columns 1, 2"),
        (
            rows_of(90, |n, x, v| format!("{:?} {x:?}  {v:?}\n", t(n))),
            "",
            "columns 1 (in seconds, by size), 2, 3",
        ),
        (
            format!("# t x v\n{}", rows_of(90, |n, x, v| format!("{:?} {x:?} {v:?}\n", t(n)))),
            "",
            "columns t (in seconds, by size), x, v",
        ),
        (
            format!(
                "time (us),x,v,z\n{}",
                rows_of(90, |n, x, v| format!("{:.0},{x:?},{v:?},0\n", 1e6 * t(n)))
            ),
            "",
            "columns time (us) (in µs, by its heading), x, v; left out: z",
        ),
        (
            format!("%time,position\n{}", rows_of(90, |n, x, _| format!("{},{x:?}\n", ns(n)))),
            "",
            "%time (in ns, by size)",
        ),
        (
            format!("timestamp,x\n{}", rows_of(90, |n, x, _| format!("{},{x:?}\n", of_day(n)))),
            "",
            "(in ns, by its form)",
        ),
        (
            format!("a,b,c\n{}", rows_of(90, |n, x, v| format!("{x:?},{v:?},{:?}\n", 1e3 * t(n)))),
            "--t-column 3 --x-column a --v-column 2",
            "columns c (in ms, by size), a, b",
        ),
        (
            format!("dt_ms,x,v\n{}", rows_of(90, |_, x, v| format!("16.6666667,{x:?},{v:?}\n"))),
            "--frame-column dt_ms",
            "dt_ms (in ms, by its heading)",
        ),
        (rows_of(90, object), "", "columns time (in seconds, by size), pos.x, v"),
        (
            format!("{{\"mass\": 2, \"entries\": [{entries}]}}"),
            "",
            "columns time (in seconds, by size), pos.x, v",
        ),
        (format!("[{entries}]"), "--clock-column time", "rows 1 to 90 of 90"),
    ] {
        let (said, told) = read_as(&log, &format!("{SPRING} {options}"));
        let first = log.lines().next().unwrap_or_default();
        assert!(told.contains(read) && told.contains(" 60.0"), "{first}: {told}");
        assert!(said.contains("0.71"), "{first}: {said}");
        // Milliseconds of a day make uneven rows, which step alike.
        assert!(said.starts_with("moves as"), "{first}: {said}");
    }
}

#[test]
fn rows_are_taken_by_number_time_and_cell_and_said() {
    let row = |n, x: f64, v: f64| {
        let t = f64::from(n) / 60.0;
        format!("{t:?},a,{x:?},{v:?},7\n{t:?},b,{:?},0,7\n", f64::from(n))
    };
    let log = format!("time,body,x,v,other\n{}", rows_of(300, row));
    let (said, told) = read_as(&log, &format!("{SPRING} --where body=a"));
    assert!(said.starts_with("moves as"), "{said}");
    assert!(
        told.contains("rows 1 to 599 of 600") && told.contains("left out: body, other"),
        "{told}"
    );
    for (options, rows) in [
        ("--rows 101..300", "rows 101 to 299 of 600"),
        ("--start 1s --end 2.0", "rows 121 to 239 of 600"),
    ] {
        let (said, told) =
            read_as(&log, &format!("{SPRING} --where body=a {options} --format json"));
        let found: Value = serde_json::from_str(&said).unwrap_or_else(|_| panic!("{told}"));
        assert!(told.contains(rows), "{options}: {told}");
        assert_eq!(found["word"], "identified", "{options}: {found}");
        assert_eq!(found["read"]["of"], 600, "{found}");
        assert_eq!(found["read"]["left_out"], serde_json::json!(["body", "other"]), "{found}");
        assert_eq!(found["read"]["unit"], "seconds", "{found}");
    }
    // A long log says what it leaves out.
    let long =
        format!("t,x\n{}", rows_of(3500, |n, x, _| format!("{:?},{x:?}\n", f64::from(n) / 60.0)));
    let (_, told) = read_as(&long, SPRING);
    assert!(
        told.contains("rows 1 to 3001 of 3500") && told.contains("--start and --end"),
        "{told}"
    );
}

#[test]
fn rows_that_step_alike_are_ticks_whatever_their_times() {
    let late = |n: u32| f64::from(if n > 60 { n + 2 } else { n }) / 60.0;
    let log = format!("t,x,v\n{}", rows_of(200, |n, x, v| format!("{:.6},{x:?},{v:?}\n", late(n))));
    let (said, told) = read_as(&log, SPRING);
    assert!(said.starts_with("moves as"), "{said} {told}");
    assert!(said.contains("step alike whatever their times (row 62 is 33.3 ms late)"), "{said}");
    assert!(said.contains("a player sees: 0.7124 Hz"), "{said}");
    let twice = |n: u32| f64::from(n.max(1) - 1) / 60.0;
    let log = format!("t,x,v\n{}", rows_of(200, |n, x, v| format!("{:?},{x:?},{v:?}\n", twice(n))));
    let (said, told) = read_as(&log, &format!("{SPRING} --tick-hz 60"));
    assert!(said.starts_with("moves as"), "{said} {told}");
    assert!(said.contains("(rows 1 and 2 are both at 0 s)"), "{said}");
    // A row that the logger lost is lost: the rows do not step alike.
    let lost = rows_of(200, |n, x, v| match n {
        60 => String::new(),
        n => format!("{:?},{x:?},{v:?}\n", f64::from(n) / 60.0),
    });
    let (said, _) = read_as(&format!("t,x,v\n{lost}"), SPRING);
    assert!(said.starts_with("moves as") && !said.contains("step alike"), "{said}");
}

#[test]
fn a_chase_and_a_walk_are_no_springs_and_a_chase_is_ported_to_followers() {
    let folder = tempdir().unwrap();
    let (mut x, mut log) = (0.0, "t,x\n".to_owned());
    for tick in 0..120 {
        log += &format!("{:?},{x:?}\n", f64::from(tick) / 60.0);
        x += (1.0 - x) * 0.1;
    }
    let (text, found) = identified(&log, "");
    assert!(
        text.starts_with("a chase, or a coast under linear drag: halves in 0.1096 s"),
        "{text}"
    );
    assert!(text.contains("as a lerp by 0.1000 at 60.00 frames per second"), "{text}");
    assert!(!text.contains("damping ratio"), "{text}");
    let half_life_s = found["chase_half_life_s"].as_f64().unwrap();
    assert!((0.1096..0.1097).contains(&half_life_s) && found["effective_frequency_hz"].is_null());
    fs::write(folder.path().join("chase.csv"), &log).unwrap();
    let output = run_in(folder.path(), "port --from chase.csv");
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("lerp-per-frame") && said.contains("60 fps  0.10000"), "{said}");
    // Steps of a generator of random numbers, added up.
    let (mut seed, mut x, mut log) = (79_u64, 0.0, "t,x\n".to_owned());
    for row in 0..300 {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let part = (seed >> 11) as f64 / (1_u64 << 53) as f64;
        x += part - 0.5;
        log += &format!("{:?},{x:?}\n", 0.02 * f64::from(row) + 0.009 * part);
    }
    let (text, found) = identified(&log, "--tick-hz 50");
    assert!(text.contains("no motion that is known: a damped swing "), "{text}");
    assert!(found["unexplained"].is_string() && found["swing"].is_null(), "{text}");
    assert!(found["effective_frequency_hz"].is_null() && found["motion"].is_null(), "{text}");
}

#[test]
fn the_ports_of_a_log_say_what_was_read_and_take_its_rate() {
    let folder = tempdir().unwrap();
    let log = rows_of(90, |n, x, _| format!("{:?},{x:?}\n", f64::from(n) / 50.0));
    fs::write(folder.path().join("log.csv"), format!("t,x\n{log}")).unwrap();
    let output = run_in(folder.path(), "port --from log.csv --to engine-jolt --format json");
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["tick_hz"], 50.0);
    assert_eq!(found["read"]["rows"], serde_json::json!([1, 90]));
    assert_eq!(found["read"]["unit"], "seconds");
}

#[test]
fn each_coordinate_of_a_log_is_answered() {
    let folder = tempdir().unwrap();
    let row = |tick: u32| {
        let t = f64::from(tick) / 60.0;
        let y = 2.0 - 2.0 * (-t / 0.5 * 2.0_f64.ln()).exp();
        format!("{t},{},{y},7", (-0.3 * t).exp() * (std::f64::consts::TAU * t).cos())
    };
    let rows: Vec<String> = (0..180).map(row).collect();
    let log = |header: &str| {
        let text = format!("{header}\n{}\n", rows.join("\n"));
        fs::write(folder.path().join("log.csv"), text).unwrap();
    };
    log("t,pos_x,pos_y,pos_z");
    let output = run_in(folder.path(), "identify log.csv");
    let (text, said) = (String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output));
    let (of_x, of_y) = text.split_once("\ny\n").unwrap_or_else(|| panic!("{text}"));
    assert!(of_x.contains("1.000 Hz") && of_y.contains("a chase"), "{text}");
    assert!(of_y.contains("halves in 0.5000 s and ends at 2.000 m"), "{text}");
    assert!(said.contains("z: ") && said.contains("nothing moves"), "{said}");
    let output = run_in(folder.path(), "identify log.csv --format json");
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let half_life = &found["others"]["y"]["chase_half_life_s"];
    assert!(half_life.as_f64().is_some_and(|s| (s - 0.5).abs() < 1e-4), "{half_life}");
    // The velocity of x is not that of y.
    log("t,x,y,vx");
    let output = run_in(folder.path(), "identify log.csv");
    assert!(!String::from_utf8(output.stdout).unwrap().contains("\ny\n"));
    let output = run_in(folder.path(), "identify log.csv --x-column y --v-column vx");
    assert!(!String::from_utf8(output.stdout).unwrap().contains("\nx\n"));
}

#[test]
fn a_log_of_a_spin_in_space_identifies_its_step_with_the_moments() {
    const LOG: &str = "identify tests/data/engines/rapier3d__tumble_a_60hz_n4.csv --tick-hz 60";
    let text = stdout_of(&format!("{LOG} --moments 1,2,3"));
    assert!(text.starts_with("moves as gyro-rescaled ×4: as engine-rapier ×4 does"), "{text}");
    let json = stdout_of(&format!("{LOG} --moments 2,4,6 --format json"));
    let found: Value = serde_json::from_str(&json).unwrap();
    assert_eq!([&found["word"], &found["best"]], ["identified", "gyro-rescaled"], "{json}");
    assert!(found["also"].as_array().is_some_and(|also| !also.is_empty()));
    assert!(stderr(&run(LOG)).contains("--moments I1,I2,I3"));
}
