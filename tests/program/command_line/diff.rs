//! `diff`: two runs of every kind, its words, its JSON and its exit codes.

use super::{refusal, regatta, run, run_in, stderr};
use serde_json::Value;
use std::fs;
use std::io::Write;
use std::process::Stdio;

/// Writes the log of a run into a folder.
fn log(folder: &std::path::Path, name: &str, options: &str) -> String {
    let output = run(&format!("trace --scene spring --seconds 2 {options}"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    fs::write(folder.join(name), &text).unwrap();
    text
}

#[test]
fn the_first_difference_is_reported_with_place_and_growth() {
    let folder = tempfile::tempdir().unwrap();
    let text = log(folder.path(), "a.csv", "--method rk4");
    log(folder.path(), "b.csv", "--method rk4 --tick-hz 60");
    let same = run_in(folder.path(), "diff a.csv b.csv");
    assert_eq!(same.status.code(), Some(0), "{}", stderr(&same));
    let told = String::from_utf8(same.stdout).unwrap();
    assert!(told.contains("the same\n") && told.contains("242 rows compared"), "{told}");

    let line = text.lines().position(|line| line.starts_with("49,") && line.contains("rk4"));
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let cells: Vec<&str> = text.lines().nth(line.unwrap()).unwrap().split(',').collect();
    let q: f64 = cells[6].parse().unwrap();
    let changed = format!("{:?}", q.next_up());
    lines[line.unwrap()] = lines[line.unwrap()].replace(cells[6], &changed);
    fs::write(folder.path().join("c.csv"), lines.join("\n")).unwrap();
    let other = run_in(folder.path(), "diff a.csv c.csv --format json");
    assert_eq!(other.status.code(), Some(1), "{}", stderr(&other));
    let json = String::from_utf8(other.stdout).unwrap();
    let digits = [format!("\"a\": {},", cells[6]), format!("\"b\": {changed},")];
    assert!(digits.iter().all(|digits| json.contains(digits)), "{json}");
    let found: Value = serde_json::from_str(&json).unwrap();
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    let mut all = keys(&found);
    all.sort();
    let known = [
        "columns",
        "comparable",
        "equal",
        "first",
        "missing",
        "moved",
        "per_second",
        "reaches",
        "read",
        "rows",
        "same",
        "worst",
    ];
    assert_eq!(all, known);
    let first = &found["first"];
    for (key, known) in [
        ("tick", Value::from(49)),
        ("lane", Value::from(1)),
        ("body", "spring".into()),
        ("coordinate", "x".into()),
        ("column", "q".into()),
        ("ulps", 1.into()),
    ] {
        assert_eq!(first[key], known, "{key}");
    }
    assert_eq!(keys(first).len(), 10);
    assert_eq!((&found["same"], &found["comparable"]), (&false.into(), &true.into()));
    assert_eq!((&found["rows"], &found["moved"]), (&242.into(), &2.0.into()));
    assert_eq!(found["reaches"].as_array().unwrap().len(), 5);
    assert!(found["per_second"].is_null() && found["missing"]["a"] == 0);
    assert_eq!(found["worst"]["column"], "q");
    let equal = run_in(folder.path(), "diff a.csv c.csv --ulps 1");
    assert_eq!(equal.status.code(), Some(0), "{}", stderr(&equal));
}

#[test]
fn log_recording_and_capture_of_one_run_are_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let traced = run("trace --scene spring");
    fs::write(folder.path().join("log.csv"), traced.stdout).unwrap();
    let text = run("trace --scene spring --seconds 2").stdout;
    fs::write(folder.path().join("short.csv"), text).unwrap();
    let scene = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/spring.toml");
    fs::copy(scene, folder.path().join("mine.toml")).unwrap();
    for same in ["diff spring log.csv", "diff log.csv mine.toml", "diff mine.toml spring"] {
        let output = run_in(folder.path(), same);
        assert_eq!(output.status.code(), Some(0), "{same}: {}", stderr(&output));
    }
    let lacks = run_in(folder.path(), "diff spring short.csv --format json");
    assert_eq!(lacks.status.code(), Some(1), "{}", stderr(&lacks));
    let found: Value = serde_json::from_slice(&lacks.stdout).unwrap();
    assert!(found["first"].is_null() && found["missing"]["a"] == 0, "{found}");
    assert!(found["missing"]["b"].as_u64().unwrap() > 1000, "{found}");

    let size = "--frames 20 --size 160x100";
    let made = run_in(folder.path(), &format!("capture --scene spring --race {size} --out clip"));
    assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    let same = run_in(folder.path(), "diff clip clip");
    assert_eq!(same.status.code(), Some(0), "{}", stderr(&same));
    // A capture has the ticks that it drew.
    let part = run_in(folder.path(), "diff spring clip --format json");
    let found: Value = serde_json::from_slice(&part.stdout).unwrap();
    assert!(found["first"].is_null() && found["missing"]["a"] == 0, "{found}");
    assert!(found["rows"].as_u64().unwrap() > 100, "{found}");
}

#[test]
fn only_one_input_may_be_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    let text = log(folder.path(), "a.csv", "--method rk4");
    let mut child = regatta()
        .current_dir(folder.path())
        .args(["diff", "-", "a.csv"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(refusal("diff - -", 2).contains("give a file for one"));
}

#[test]
fn incomparable_tables_are_refused_with_the_place() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("still.csv", &format!("tick,x\n{}", "0,1\n1,1\n2,1\n"));
    write("moves.csv", "tick,x\n0,1\n1,2\n2,1\n");
    write("torn.csv", "tick,x\n0,1\n1\n");
    write("empty.csv", "");
    write("lanes.csv", "tick,lane,x\n0,1,1\n");
    write("title.csv", "frame,time,x\n0,0,5\n1,0.1,5\n2,0.2,5\n");
    write("twice.csv", "x,x\n1,1\n2,2\n");
    write("below.csv", "tick,x\n-1,1\n0,2\n");
    let rows = |of: fn(u32) -> (u32, u32)| -> String {
        (0..140_000).map(of).map(|(tick, lane)| format!("{tick},{lane},{tick}\n")).collect()
    };
    write("by_tick.csv", &format!("tick,lane,q\n{}", rows(|i| (i / 2, i % 2))));
    write("by_lane.csv", &format!("tick,lane,q\n{}", rows(|i| (i % 70_000, i / 70_000))));
    for (arguments, told) in [
        ("diff title.csv title.csv", "nothing to compare: nothing moves in the 3 rows"),
        ("diff twice.csv twice.csv", "a has two columns \"x\"; rename one"),
        ("diff below.csv below.csv", "column \"tick\" has \"-1\"; write a whole number"),
        ("diff by_tick.csv by_lane.csv", "stand more than 65536 rows apart"),
        ("diff still.csv still.csv", "nothing to compare: nothing moves in the 3 rows"),
        ("diff moves.csv torn.csv", "torn.csv:3:"),
        ("diff moves.csv empty.csv", "empty.csv is empty"),
        ("diff moves.csv lanes.csv", "b has a column \"lane\" and a has none"),
        ("diff moves.csv none.csv", "cannot read none.csv"),
        ("diff moves.csv moves.csv --relative -1", "--relative"),
    ] {
        let output = run_in(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        assert!(stderr(&output).contains(told), "{arguments}: {}", stderr(&output));
    }
    let json = run_in(folder.path(), "diff still.csv still.csv --format json");
    assert_eq!(json.status.code(), Some(2));
    let found: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!((&found["comparable"], &found["same"]), (&false.into(), &false.into()));
    assert!(found["first"].is_null() && found["worst"].is_null());
}

#[test]
fn semicolons_notes_and_numbers_beyond_a_double_are_compared() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("semicolons.csv", "# a note\ntick;h;x\n0;18446744073709551615;1\n1;7;2.5\n");
    write("tabs.csv", "tick\th\tx\n0\t18446744073709551615\t1.0\n1\t7\t2.5\n");
    write("hash.csv", "tick,h,x\n0,18446744073709551614,1\n1,7,2.5\n");
    write("huge.csv", "tick,h,x\n0,18446744073709551615,1\n1,1e400,2.5\n");
    write("larger.csv", "tick,h,x\n0,18446744073709551615,1\n1,2e400,2.5\n");
    let code = |arguments: &str| run_in(folder.path(), arguments).status.code();
    assert_eq!(code("diff semicolons.csv tabs.csv"), Some(0));
    assert_eq!(code("diff tabs.csv hash.csv"), Some(1));
    assert_eq!(code("diff huge.csv larger.csv"), Some(1));
    assert_eq!(code("diff huge.csv huge.csv"), Some(0));
}

#[test]
fn notes_are_only_skipped_above_the_header() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let rows = |q: u32| format!("body,tick,q\n#1,0,1\n#1,1,{q}\nb,0,0\nb,1,1\n");
    write("a.csv", &rows(2));
    write("b.csv", &format!("\u{feff}# a note\n\n# and another\n{}", rows(99)));
    write("c.csv", &rows(2).replace("b,0", "# a note below\nb,0"));
    let found = run_in(folder.path(), "diff a.csv b.csv");
    let text = String::from_utf8(found.stdout).unwrap();
    assert_eq!(found.status.code(), Some(1), "{text}");
    assert!(text.contains("first at tick 1, #1: q is 2 in a and 99 in b"), "{text}");
    assert!(text.contains("4 rows compared"), "{text}");
    let refused = run_in(folder.path(), "diff a.csv c.csv");
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("c.csv:4:"), "{}", stderr(&refused));
    assert!(stderr(&refused).contains("notes a place above the header"), "{}", stderr(&refused));
}

#[cfg(unix)]
#[test]
fn an_endless_row_is_refused_before_it_fills_the_memory() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("a.csv", "tick,x\n0,1\n1,2\n");
    write("open.csv", &format!("tick,x\n0,\"1\n{}", "1,2\n".repeat(1 << 20)));
    write("note.csv", &format!("#{}\ntick,x\n0,1\n1,2\n", "-".repeat(1 << 21)));
    // A long row is one, up to the bound.
    let wide = |last: &str| {
        let names: String = (0..60_000).map(|i| format!(",x{i}")).collect();
        let cells = |x: &str| format!(",{x}").repeat(60_000);
        format!("tick{names}\n0{}\n1{}\n", cells("1"), cells(last))
    };
    write("wide.csv", &wide("2"));
    write("wider.csv", &wide("3"));
    let sparse = fs::File::create(folder.path().join("zeros.csv")).unwrap();
    sparse.set_len(1 << 30).unwrap();
    for (arguments, told) in [
        ("diff /dev/zero a.csv", "it is no regular file but a pipe or a device"),
        ("diff a.csv /dev/null", "or give - for standard input"),
        ("diff a.csv open.csv", "open.csv:2: a row of more than 1048576 bytes"),
        ("diff note.csv a.csv", "a row of more than 1048576 bytes"),
        ("diff zeros.csv a.csv", "a row of more than 1048576 bytes"),
    ] {
        let output = run_in(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {}", stderr(&output));
        assert!(stderr(&output).contains(told), "{arguments}: {}", stderr(&output));
    }
    let same = run_in(folder.path(), "diff wide.csv wide.csv");
    assert_eq!(same.status.code(), Some(0), "{}", stderr(&same));
    assert_eq!(run_in(folder.path(), "diff wide.csv wider.csv").status.code(), Some(1));
}

#[test]
fn control_characters_become_visible_in_text_and_escaped_in_json() {
    let folder = tempfile::tempdir().unwrap();
    let body = "\u{1b}[31m\u{7}\u{9b}2J\u{202e}";
    for (name, last) in [("a.csv", "2"), ("b.csv", "\"3\nthe same\"")] {
        let text = format!("tick,body,q\n0,{body},1\n1,{body},{last}\n");
        fs::write(folder.path().join(name), text).unwrap();
    }
    let found = run_in(folder.path(), "diff a.csv b.csv");
    let text = String::from_utf8(found.stdout).unwrap();
    assert!(
        text.contains("first at tick 1, ␛[31m␇�2J�: q is 2 in a and 3␊the same in b"),
        "{text}"
    );
    assert!(!text.contains(|sign: char| sign.is_control() && sign != '\n'), "{text}");
    let found = run_in(folder.path(), "diff a.csv b.csv --format json");
    let text = String::from_utf8(found.stdout).unwrap();
    assert!(!text.contains(|sign: char| sign.is_control() && sign != '\n'), "{text}");
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["first"]["body"], body);
}

#[test]
fn columns_can_be_chosen_and_each_reports_its_first_difference() {
    let folder = tempfile::tempdir().unwrap();
    let a = "frame,object,x,wall_ms\n1,10,0.5,2362\n1,11,2,2363\n2,11,3,2380\n2,10,0.25,2381\n";
    let b = "frame,object,x,wall_ms\n1,10,0.5,9362\n1,11,2,9363\n2,10,0.125,9380\n2,11,3,9381\n";
    fs::write(folder.path().join("a.csv"), a).unwrap();
    fs::write(folder.path().join("b.csv"), b).unwrap();
    let diff = |options: &str| {
        let output = run_in(folder.path(), &format!("diff a.csv b.csv {options}"));
        let told = stderr(&output);
        (output.status.code(), String::from_utf8(output.stdout).unwrap(), told)
    };
    let (code, text, _) = diff("--key frame,object --ignore wall_ms");
    assert_eq!(code, Some(1));
    assert!(text.contains("first at frame 2, object 10: x is 0.25 in a and 0.125 in b"), "{text}");
    let (_, text, _) = diff("--key frame,object");
    let by_column = "by column: x from frame 2 in 1 row, wall_ms from frame 1 in 4 rows";
    assert!(text.contains(by_column), "{text}");
    let (_, json, _) = diff("--key frame,object --columns x --format json");
    let found: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(found["first"]["key"]["object"], "10");
    assert_eq!(found["columns"][0]["first_tick"], 2);
    let (code, text, told) = diff("");
    assert_eq!(code, Some(1));
    assert!(text.contains("rows are matched by their number; --key"), "{text}{told}");
    let (code, _, told) = diff("--key nothing");
    assert_eq!(code, Some(2));
    assert!(
        told.contains("a has no column \"nothing\"; it has frame, object, x, wall_ms"),
        "{told}"
    );
    // The same numbers are the same by their key.
    fs::write(folder.path().join("b.csv"), a).unwrap();
    assert_eq!(diff("--key frame,object --ignore wall_ms").0, Some(0));
}

#[test]
fn headings_are_skipped_and_decimal_commas_are_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("points.csv", "tick,x,y\n0,1.5,2\n1,1.6,3\n");
    write("commas.csv", "My run 3\r\n\r\ntick;x;y\r\n0;1,5;2\r\n1;1,6;3\r\n");
    write("near.csv", "tick\tx\ty\n0\t1,5\t2\n1\t1,60000001\t3\n");
    let run = |arguments: &str| run_in(folder.path(), &format!("diff {arguments}")).status.code();
    assert_eq!(run("points.csv commas.csv"), Some(0));
    assert_eq!(run("commas.csv near.csv"), Some(1));
    assert_eq!(run("commas.csv near.csv --relative 1e-3"), Some(0));
}

#[test]
fn text_hashes_json_and_dumps_are_compared_at_their_tick() {
    let folder = tempfile::tempdir().unwrap();
    let told = |a: &str, b: &str, options: &str| {
        fs::write(folder.path().join("a"), a).unwrap();
        fs::write(folder.path().join("b"), b).unwrap();
        let output = run_in(folder.path(), &format!("diff a b {options}"));
        let said = String::from_utf8(output.stdout.clone()).unwrap();
        (output.status.code(), said + &stderr(&output))
    };
    let object =
        |n: u32, x: f64| format!("{{\"tick\": {n}, \"at\": {{\"x\": {x:?}}}, \"v\": 1.5}}\n");
    let objects = |odd: u32| -> String {
        (0..60).map(|n| object(n, f64::from(n * n) + if n == odd { 1.0 } else { 0.0 })).collect()
    };
    let array = |text: String| format!("[{}]", text.trim_end().replace('\n', ","));
    let dump = |odd: u32| -> String {
        (0..9)
            .map(|n| {
                format!("Frame: {}\nunit 7\n  hp: {}\n\n", 1000 + n, 90 - n - u32::from(n == odd))
            })
            .collect()
    };
    for (a, b, first) in [
        (
            "tick,frame_hash\n1,aa1c\n2,bb2d\n".into(),
            "tick,frame_hash\n1,aa1c\n2,bb9d\n".into(),
            "first at tick 2: frame_hash is bb2d in a and bb9d in b",
        ),
        (
            "tick,Frame checksum\n1,17\n2,21\n".into(),
            "tick,Frame checksum\n1,17\n2,22\n".into(),
            "first at tick 2: Frame checksum is 21",
        ),
        (objects(99), objects(41), "first at tick 41: at.x is 1681.0 in a and 1682.0 in b"),
        (objects(99), objects(0), "first at tick 0: at.x is 0.0 in a and 1.0 in b"),
        (array(objects(99)), array(objects(5)), "first at tick 5: at.x is 25.0 in a"),
        (dump(99), dump(5), "first at frame 1005, line 2: text is   hp: 85 in a"),
    ] {
        let (code, said) = told(&a, &b, "");
        let squeezed = said.replace("  ", "");
        assert_eq!(code, Some(1), "{said}");
        assert!(squeezed.contains(&first.replace("  ", "")), "{said}");
        let (code, said) = told(&a, &a, "");
        assert_eq!(code, Some(0), "{said}");
        assert!(said.contains("the same"), "{said}");
    }
    let (code, said) = told(&objects(99), &objects(41), "--rows 1..30 --format json");
    assert_eq!(code, Some(0), "{said}");
    let found: Value = serde_json::from_str(
        said.split_once("}\n").map_or(&said, |_| &said[..said.rfind('}').unwrap() + 1]),
    )
    .unwrap();
    assert_eq!(
        (&found["read"]["a"]["rows"], &found["read"]["b"]["of"]),
        (&serde_json::json!([1, 30]), &60.into())
    );
    let (code, said) = told("t,x\n0,1\n1,2\n2,9\n", "t,x\n0,1\n1,2\n2,8\n", "--end 2");
    assert!(code == Some(0) && said.contains("rows 1 to 2 of 3"), "{said}");
    let (code, said) = told("{\"a\": 1}\n{\"b\": 2}\n", "{\"a\": 1}\n", "");
    assert!(code == Some(2) && said.contains("is not in the first object"), "{said}");
}
