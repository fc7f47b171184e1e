//! `rule`: reads lines of a game, and prints the visible motion at every frame rate, and code.

use std::fs;
use std::io::Write as _;
use std::process::{Output, Stdio};

use serde_json::Value;

use super::{regatta, stderr, stdout_of};

fn rule(arguments: &[&str]) -> Output {
    regatta().arg("rule").args(arguments).output().unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let output = rule(&[arguments, &["--format", "json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn at(found: &Value, fps: f64) -> Value {
    let rows = found["seen"].as_array().unwrap();
    rows.iter().find(|row| row["fps"] == fps).unwrap_or_else(|| panic!("{found}")).clone()
}

fn is_near(found: &Value, expected: f64) -> bool {
    found.as_f64().is_some_and(|found| (found / expected - 1.0).abs() < 1e-3)
}

#[test]
fn a_spring_without_dt_is_twice_as_fast_at_twice_the_rate() {
    let text = "v = (v + (target - x) * 0.2) * 0.85; x += v";
    let found = json(&[text]);
    let keys: Vec<&String> = found.as_object().unwrap().keys().collect();
    let mut expected = [
        "rule",
        "fps",
        "linear",
        "seen",
        "pieces",
        "bounce",
        "within",
        "jitter",
        "jump_speed",
        "hint",
        "rings_below_fps",
        "explodes_below_fps",
        "spring",
        "code",
    ];
    expected.sort_unstable();
    let mut keys: Vec<&str> = keys.into_iter().map(String::as_str).collect();
    keys.sort_unstable();
    assert_eq!(keys, expected);
    assert_eq!((&found["rule"], &found["fps"]), (&text.into(), &60.0.into()));
    assert_eq!((&found["linear"], &found["rings_below_fps"]), (&true.into(), &Value::Null));
    let rates: Vec<f64> =
        found["seen"].as_array().unwrap().iter().map(|row| row["fps"].as_f64().unwrap()).collect();
    assert_eq!(rates, [30.0, 50.0, 60.0, 120.0, 144.0, 165.0, 240.0]);
    assert!(is_near(&at(&found, 60.0)["hz"], 4.057) && is_near(&at(&found, 120.0)["hz"], 8.1136));
    assert!(is_near(&at(&found, 144.0)["damping_ratio"], 0.1879));
    assert!(is_near(&found["spring"]["hz"], 4.130), "{found}");
    assert!(is_near(&found["spring"]["damping_ratio"], 0.1879), "{found}");
    let code = found["code"].as_object().unwrap();
    for (language, part) in [
        ("rust", "f64::cos"),
        ("c", "cos("),
        ("cpp", "cos("),
        ("csharp", "Math.Cos"),
        ("gdscript", "cos("),
        ("javascript", "Math.cos("),
        ("lua", "math.cos("),
        ("step", " cos("),
    ] {
        assert!(code[language].as_str().unwrap().contains(part), "{language}: {found}");
    }
    assert_eq!(code.len(), 8);
}

#[test]
fn the_lines_that_a_rule_prints_are_the_same_rule_when_given_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("given.step");
    for text in [
        "v += (100*(target - x) - 10*v)*dt; x += v*dt",
        "x += (target - x) * 0.1",
        "v *= 0.9; x += v",
        "v = (v + (target - x) * 0.2) * 0.7; x += v",
        "if (target > x) x += (target - x) * 0.3; else x += (target - x) * 0.1",
        "v -= 9.81*dt; x += v*dt; if x < 0 { x = 0; v = -0.8*v }",
        "x = SmoothDamp(x, target, v, 0.3)",
    ] {
        let printed = json(&[text])["code"]["step"].as_str().unwrap().to_owned();
        fs::write(&path, &printed).unwrap();
        let [first, given] = [text, path.to_str().unwrap()].map(|it| json(&[it]));
        let [first, given] = [first, given].map(|found| numbers(&at(&found, 60.0)));
        assert_eq!(first.len(), given.len(), "{text}: {printed}");
        for (key, value) in first {
            let near = given.iter().find(|(it, _)| *it == key).map(|(_, it)| *it).unwrap();
            assert!((near - value).abs() <= 1e-6 * value.abs(), "{text}, {key}: {value} {near}");
        }
    }
}

/// The numbers of a row, each with its key.
fn numbers(row: &Value) -> Vec<(String, f64)> {
    let number = |(key, value): (&String, &Value)| Some((key.clone(), value.as_f64()?));
    row.as_object().unwrap().iter().filter_map(number).collect()
}

#[test]
fn a_chase_rings_and_grows_below_the_reported_rates() {
    let found = json(&["x += (target - x) * 20 * dt", "--fps", "30"]);
    assert!(
        is_near(&found["rings_below_fps"], 20.0) && is_near(&found["explodes_below_fps"], 10.0)
    );
    assert_eq!(found["spring"], Value::Null);
    let seen = at(&found, 30.0);
    assert_eq!((&seen["hz"], &seen["damping_ratio"]), (&Value::Null, &Value::Null));
    assert_eq!((&seen["grows"], found["seen"].as_array().unwrap().len()), (&false.into(), 7));
    assert_eq!(
        json(&["x += (target - x) * 0.1", "--fps", "90"])["seen"].as_array().unwrap().len(),
        8
    );
    let text = rule(&["x += (target - x) * 20 * dt", "--fps", "30"]);
    let text = String::from_utf8(text.stdout).unwrap();
    for said in
        ["halves in 0.02103 s", "rings below 20.00", "grows below 10.00", "f64::exp((-32.95"]
    {
        assert!(text.contains(said), "{said}: {text}");
    }
}

#[test]
fn what_is_left_out_and_what_the_lines_start_with_is_in_the_answer() {
    for (lines, part) in [
        (
            "vx *= 0.9; vy *= 0.8; x += vx; y += vy",
            "left out, as nothing above depends on it: vy, y\n",
        ),
        ("float v = 8f; v -= 0.4f; x += v;", "a jump starts with v = 8.000\n"),
        ("if (x !== target) { x += (target - x) * 0.1 }", "while x !== target: halves in 0.1096 s"),
        ("v += 0.5; v = min(v, 10); x += v", "speeds are in the units of v\n"),
    ] {
        let text = String::from_utf8(rule(&[lines]).stdout).unwrap();
        assert!(text.contains(part), "{lines}: {text}");
    }
    let text = rule(&["let d = target - x; x += d * 0.1"]);
    assert!(!String::from_utf8(text.stdout).unwrap().contains("left out"));
}

#[test]
fn lines_come_from_an_argument_a_file_or_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("friction.step");
    fs::write(&path, "// Slides.\r\nv *= 0.9f;\r\n").unwrap();
    let from_file = json(&[path.to_str().unwrap()]);
    assert!(is_near(&at(&from_file, 60.0)["settles_s"], 0.7285), "{from_file}");
    let mut child = regatta()
        .args(["rule", "-", "--format", "json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(b"v *= 0.9").unwrap();
    let found: Value = serde_json::from_slice(&child.wait_with_output().unwrap().stdout).unwrap();
    assert_eq!((&found["seen"], &found["spring"]), (&from_file["seen"], &Value::Null));
}

#[test]
fn an_invalid_rule_is_refused_with_its_place_and_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let file = write("camera.step", b"v *= 0.9\nx += speed * dt\n");
    let (binary, long) = (write("a", b"\xff\xfe"), write("b", &[b' '; 20_000]));
    for (text, said) in [
        ("x += k * dt", "rule:1:6: unknown name `k`; write x, v, h or target, or give it"),
        (&*file, "camera.step:2:6: unknown name `speed`"),
        ("x += (1", "rule:1:7: the text ends where `)` is missing"),
        ("pos[0] += 1", "rule:1:1: `pos[0] += 1` is one part of a value; a step moves one number"),
        ("x + 1", "\"x + 1\" is no rule and no file; write an assignment"),
        ("", "is no rule and no file"),
        ("v += a(x) * dt", "rule:1:6: a rule is the whole motion, and calls no acceleration"),
        (&*binary, "is not text; save it as UTF-8"),
        (&*long, "holds more than 16384 bytes"),
    ] {
        let output = rule(&[text]);
        assert_eq!(output.status.code(), Some(2), "{text}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{text}: {}", stderr(&output));
        assert!(output.stdout.is_empty());
    }
    let output = rule(&["x += (1"]);
    assert!(stderr(&output).contains("^"), "{}", stderr(&output));
}

#[test]
fn a_rule_with_a_floor_is_answered_by_what_its_bounces_do() {
    let lines = "rule v-=9.81*dt;x+=v*dt;if(x<0){x=0;v=-0.8*v}";
    let said = stdout_of(lines);
    assert!(said.contains("s = −1 by the step, kappa = 0.5 by the line at the floor"), "{said}");
    assert!(said.contains("AFTER 10") && !said.contains("HALVES"), "{said}");
    let answer: Value =
        serde_json::from_str(&stdout_of(&format!("{lines} --format json"))).unwrap();
    let bounce = &answer["bounce"];
    for (key, wanted) in [("gravity", 9.81), ("restitution", 0.8), ("s", -1.0), ("kappa", 0.5)] {
        let found = bounce[key].as_f64().unwrap();
        assert!((found - wanted).abs() < 1e-3, "{key}: {found}");
    }
    // The mean of 200 other starts after five impacts at 60 Hz is 0.646.
    let seen = bounce["seen"].as_array().unwrap();
    let at_60 = seen.iter().find(|seen| seen["fps"] == 60.0).unwrap();
    assert!((at_60["after_5"].as_f64().unwrap() / 0.646 - 1.0).abs() < 0.02, "{at_60}");
    let swing = stdout_of("rule v*=0.9;x+=v*dt --format json");
    let swing: Value = serde_json::from_str(&swing).unwrap();
    assert!(swing["bounce"].is_null());
}

#[test]
fn a_drive_that_depends_on_the_frame_rate_says_so() {
    for (lines, wanted) in [
        (
            "v -= 6; x += v*dt",
            "the acceleration depends on the frame rate: −180.0 at 30, −1440 at 240",
        ),
        (
            "v += 2000*dt; v *= 0.92; x += v*dt",
            "the top speed depends on the frame rate: 766.7 at 30, 95.83 at 240",
        ),
        ("v -= 9.81*dt; x += v*dt", ""),
    ] {
        let said = String::from_utf8(rule(&[lines]).stdout).unwrap();
        let line = said.lines().find(|line| line.contains("depends on the frame rate"));
        assert_eq!(line.unwrap_or_default(), wanted, "{lines}");
    }
}

#[test]
fn a_limited_drive_in_pieces_is_shown_from_rest_and_piece_by_piece() {
    let lines = "v += 900*dt; v = clamp(v, -200, 200); x += v*dt";
    let said = String::from_utf8(rule(&[lines]).stdout).unwrap();
    let table = said.split("from rest, through all pieces:\n").nth(1).unwrap();
    let rows: Vec<Vec<&str>> =
        table.lines().take(8).map(|line| line.split_whitespace().collect()).collect();
    assert_eq!(rows[0][..3], ["FPS", "TOP", "SPEED"]);
    for row in &rows[1..] {
        assert_eq!(row[1..3], ["200.0", "900.0"], "{said}");
    }
    assert!(said.contains("it moves at a constant 200.0 a second, at every frame rate"), "{said}");
    assert!(!said.contains("HALVES"), "{said}");
    let found = json(&[lines]);
    for row in found["seen"].as_array().unwrap() {
        assert!(is_near(&row["top_speed"], 200.0) && is_near(&row["accelerates"], 900.0), "{row}");
    }
}

#[test]
fn a_piece_is_described_by_what_its_frames_do() {
    for (lines, wanted, unwanted) in [
        (
            "x += v*dt; if x > 10 { x = 10; v = -v*0.5 }",
            "when x > 10: once, it sets x to 10 and v to −0.5 times v\n",
            "1 % AFTER",
        ),
        ("if x < 0 { x = 0; v = 10 }", "when x < 0: once, it sets x to 0 and v to 10\n", "stops"),
        (
            "x += round((target - x)/8)",
            "its steps are rounded, and have no rate; from 100 above the target it stops 3 above after",
            "TOP SPEED",
        ),
        (
            "if x == target { v = 0 } else { x += (target - x)*0.1 }",
            "\nat x == target: it sets v to 0\n",
            "rest at 0",
        ),
        (
            "v = move_toward(v, 0, 500*dt); x += v*dt",
            "it brakes by 500.0 a second\n  FPS  TOP SPEED  ACCELERATES /s\n  30   -          −500.0\n",
            "JUMPS",
        ),
        (
            "x = Mathf.SmoothDamp(x, target, ref v, 0.3f, 2f, Time.deltaTime)",
            ": it comes to rest at the target: a spring of 1.060 Hz, damping ratio 1.000\n",
            "it moves on",
        ),
    ] {
        let said = String::from_utf8(rule(&[lines]).stdout).unwrap();
        assert!(said.contains(wanted) && !said.contains(unwanted), "{lines}: {said}");
    }
    let wall = &json(&["x += v*dt; if x > 10 { x = 10; v = -v*0.5 }"])["pieces"][1];
    assert_eq!(wall["course"], "once, it sets x to 10 and v to −0.5 times v");
    assert_eq!(wall["seen"][0]["settles_s"], Value::Null);
}

#[test]
fn a_speed_by_milliseconds_is_per_second_or_has_its_unit() {
    let lines = "v += 0.002*dt; v *= 0.92";
    let said = |lines: &str| String::from_utf8(rule(&[lines, "--dt", "ms"]).stdout).unwrap();
    assert!(said(lines).contains("\nspeeds are in the units of v\n"), "{}", said(lines));
    let moving = said(&format!("{lines}; x += v*dt"));
    assert!(!said("x += 0.3*dt").contains("units of v"));
    let row = "\n  60   383.3      1840\n";
    assert!(moving.contains(row) && !moving.contains("units of v"), "{moving}");
}
