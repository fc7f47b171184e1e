//! `trace`: its numbers, its columns, its ends.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::Stdio;

use regatta::scene::Scene;
use serde_json::Value;

use super::{regatta, run_in, stderr, stdout_of};

const HEADER: &str = "tick,t,lane,method,body,coordinate,q,v";

/// A row's cells.
fn rows(csv: &str) -> Vec<Vec<&str>> {
    csv.lines().skip(1).map(|line| line.split(',').collect()).collect()
}

/// The velocity at each time, of the only body under `method`.
fn velocities(csv: &str, method: &str) -> BTreeMap<String, f64> {
    let rows = rows(csv).into_iter().filter(|row| row[3] == method);
    rows.map(|row| (row[1].to_owned(), row[7].parse().unwrap())).collect()
}

#[test]
fn the_chapters_table_7_1_is_reproduced_digit_by_digit() {
    const TIMES: [&str; 5] = ["6.5", "7.0", "7.5", "8.0", "8.5"];
    const TABLE: [(&str, [&str; 5]); 4] = [
        ("exact", ["9.559084465", "10.068293924", "10.552668945", "11.013420718", "11.451701361"]),
        (
            "explicit-euler",
            ["9.733158334", "10.246500418", "10.734175397", "11.197466627", "11.637593296"],
        ),
        (
            "improved-euler",
            ["9.556148145", "10.065285923", "10.549603234", "11.010310076", "11.448557460"],
        ),
        ("rk4", ["9.559084096", "10.068293547", "10.552668560", "11.013420327", "11.451700966"]),
    ];
    for (method, cells) in TABLE {
        let flown = if method == "exact" { "rk4" } else { method };
        let csv = stdout_of(&format!("trace --scene ship --method {flown} --seconds 8.5"));
        let velocities = velocities(&csv, method);
        for (t, cell) in TIMES.into_iter().zip(cells) {
            assert_eq!(format!("{:.9}", velocities[t]), cell, "{method} at {t} s");
        }
    }
}

#[test]
fn a_trace_is_tidy_and_begins_at_tick_0_with_the_truth_as_lane_0() {
    let csv = stdout_of("trace --scene ship --seconds 2");
    assert_eq!(csv.lines().next(), Some(HEADER));
    let scene = Scene::built_in("ship").unwrap();
    let lanes = 1 + scene.lanes.len();
    assert_eq!(csv.lines().count(), 1 + 5 * lanes);
    assert!(csv.lines().all(|line| line.split(',').count() == 8));
    for (n, row) in rows(&csv).into_iter().enumerate() {
        let (tick, lane) = (n / lanes, n % lanes);
        let t = format!("{:?}", tick as f64 / 2.0);
        let method = if lane == 0 { "exact" } else { scene.lanes[lane - 1].method.id };
        let start = [&tick.to_string(), &t, &lane.to_string(), method, "ship", "s"];
        assert_eq!(row[..6], start);
    }
}

#[test]
fn a_body_without_closed_form_has_a_reference_of_reported_accuracy() {
    let output = run_in(&std::env::temp_dir(), "trace --scene helm --method rk4 --seconds 0.2");
    let csv = String::from_utf8(output.stdout.clone()).unwrap();
    let heads: Vec<_> = rows(&csv).iter().map(|row| row[..6].join(",")).collect();
    let expected = ["x", "y", "psi"].map(|q| format!("0,0.0,0,reference,helm,{q}"));
    assert_eq!(heads[..3], expected);
    assert_eq!(heads.len(), 2 * 2 * 3);
    let said =
        "lane 0, helm: has no closed form; its reference aims at 1e-10, relative, and reached ";
    let came: f64 = stderr(&output)
        .strip_prefix(said)
        .and_then(|rest| rest.strip_suffix(" on this run\n"))
        .and_then(|number| number.parse().ok())
        .unwrap_or_else(|| panic!("{}", stderr(&output)));
    assert!(came > 0.0 && came < 1e-10, "{came}");
}

#[test]
fn a_law_with_a_solution_has_an_exact_truth_until_its_first_input() {
    let folder = tempfile::tempdir().unwrap();
    let law = "title = 'x'\ntick_hz = 10\nseconds = 0.3\n[[law]]\nname = 'swing'\n[law.coordinates.x]\n\
               start = 1\nacceleration = '-x'\nexact = 'cos(t)'\n";
    let kick = "[[command]]\nat_s = 0.1\nkick = 1.0\n";
    let aim = "lane 0, swing: is exact only up to its first input, edit or placing; its reference aims at 1e-10, relative, and reached ";
    for (text, methods, said) in [
        (law.to_owned(), ["exact"; 4], ""),
        (format!("{law}{kick}"), ["exact", "exact", "reference", "reference"], aim),
    ] {
        fs::write(folder.path().join("law.toml"), text).unwrap();
        let output = run_in(folder.path(), "trace --scene law.toml --method rk4");
        let csv = String::from_utf8(output.stdout.clone()).unwrap();
        let truth: Vec<&str> =
            rows(&csv).into_iter().filter(|row| row[2] == "0").map(|row| row[3]).collect();
        let told = stderr(&output);
        assert_eq!((truth, told.is_empty()), (methods.to_vec(), said.is_empty()));
        assert!(told.starts_with(said), "{told}");
    }
}

#[test]
fn impacts_are_numbered_through_a_kick() {
    let folder = tempfile::tempdir().unwrap();
    let ball = "title = 'x'\ntick_hz = 60\nseconds = 3\n[[ball]]\nheight_m = 1\n[[command]]\nat_s = 1.0\nkick = 1\n";
    fs::write(folder.path().join("ball.toml"), ball).unwrap();
    let output = run_in(folder.path(), "trace --scene ball.toml --method rk4 --impacts");
    let csv = String::from_utf8(output.stdout.clone()).unwrap();
    let of = |lane: &str| -> Vec<(u64, f64)> {
        let rows = rows(&csv).into_iter().filter(|row| row[1] == lane);
        rows.map(|row| (row[0].parse().unwrap(), row[4].parse().unwrap())).collect()
    };
    let [truth, lane] = ["0", "1"].map(of);
    // The kick, at 0.548 s of a flight, lifts the ball as by a second start.
    let first_s = (2.0_f64 / 9.81).sqrt();
    let up = 0.8 * 9.81 * first_s;
    let flown_s = 1.0 - first_s;
    let (y, v) = (up * flown_s - 9.81 / 2.0 * flown_s * flown_s, up - 9.81 * flown_s + 4.905);
    let second_s = 1.0 + (v + (v * v + 2.0 * 9.81 * y).sqrt()) / 9.81;
    assert_eq!(truth.len(), 3, "{csv}");
    for (n, at_s) in [(0, first_s), (1, second_s)] {
        assert_eq!((truth[n].0, lane[n].0), (n as u64 + 1, n as u64 + 1), "{csv}");
        assert!((truth[n].1 - at_s).abs() < 1e-12, "{truth:?}, not {at_s} s");
    }
    assert!(truth.iter().zip(&lane).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-12), "{csv}");
    assert!(!stderr(&output).contains("meets no wall"));
}

#[test]
fn an_event_that_never_fires_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let law = "title = 'x'\ntick_hz = 60\nseconds = 2\n[[law]]\n[law.coordinates.y]\nstart = 1\n\
               acceleration = '-9.81'\n[law.events.floor]\nwhen = 'y + 90'\nthen = { vy = '-vy' }\n";
    fs::write(folder.path().join("law.toml"), law).unwrap();
    let output = run_in(folder.path(), "trace --scene law.toml --method rk4 --impacts");
    assert!(stderr(&output).contains("`floor` never fires in 2 s"), "{}", stderr(&output));
}

#[test]
fn impacts_after_a_kick_out_of_rest_have_the_numbers_of_the_truth() {
    let folder = tempfile::tempdir().unwrap();
    let ball = "title = 'x'\ntick_hz = 60\nseconds = 8\n[[ball]]\nheight_m = 1\nrestitution = 0.5\n\
                [[command]]\nat_s = 4.0\nkick = 1\n";
    fs::write(folder.path().join("ball.toml"), ball).unwrap();
    let asked = "trace --scene ball.toml --method rk4 --method semi-implicit-euler --impacts";
    let csv = String::from_utf8(run_in(folder.path(), asked).stdout).unwrap();
    let first_after = |lane: &str| -> (u64, f64) {
        let rows = rows(&csv).into_iter().filter(|row| row[1] == lane);
        rows.map(|row| (row[0].parse().unwrap(), row[4].parse().unwrap()))
            .find(|(_, at_s)| *at_s > 4.0)
            .unwrap()
    };
    let [truth, rk4, euler] = ["0", "1", "2"].map(first_after);
    assert_eq!((rk4.0, euler.0), (truth.0, truth.0), "{csv}");
    // The kick lifts the ball at once.
    assert!((truth.1 - 5.0).abs() < 1e-9 && (rk4.1 - 5.0).abs() < 1e-9, "{csv}");
}

#[test]
fn a_chain_has_a_row_for_each_of_its_masses() {
    let csv = stdout_of("trace --scene chain --method rk4 --seconds 0");
    let names: Vec<_> = rows(&csv).iter().map(|row| row[5].to_owned()).collect();
    let expected: Vec<_> = (0..2).flat_map(|_| (1..=16).map(|n| format!("x{n}"))).collect();
    assert_eq!(names, expected);
}

#[test]
fn numbers_are_the_shortest_that_read_back_the_same() {
    fn digits(number: &str) -> String {
        let mantissa = number.split('e').next().unwrap();
        let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
        digits.trim_matches('0').to_owned()
    }
    let csv = stdout_of("trace --scene spring --method rk4 --seconds 1");
    for row in rows(&csv) {
        for cell in [row[1], row[6], row[7]] {
            let value: f64 = cell.parse().unwrap();
            assert_eq!(digits(cell), digits(&format!("{value:e}")));
        }
    }
}

#[test]
fn json_and_csv_have_the_same_rows() {
    for options in ["--scene harbour --seconds 0.1 --metrics", "--scene ship --every 7 --seconds 9"]
    {
        let csv = stdout_of(&format!("trace {options}"));
        let json = stdout_of(&format!("trace {options} --format json"));
        let parsed: Vec<Value> = serde_json::from_str(&json).unwrap();
        assert_eq!(parsed.len(), rows(&csv).len());
        for (line, row) in json.lines().skip(1).zip(rows(&csv)) {
            let [tick, t, lane, method, body, coordinate, q, v] = row[..] else {
                panic!("{row:?}")
            };
            let v = if v.is_empty() { "null" } else { v };
            let expected = format!(
                r#"{{"tick":{tick},"t":{t},"lane":{lane},"method":"{method}","body":"{body}","coordinate":"{coordinate}","q":{q},"v":{v}}}"#
            );
            assert_eq!(line.trim_end_matches(','), expected);
        }
    }
}

#[test]
fn seconds_round_to_the_nearest_tick() {
    for (seconds, last) in [("0", 0), ("0.2", 0), ("0.3", 1), ("0.25", 1), ("8.5", 17), ("8.7", 17)]
    {
        let csv = stdout_of(&format!("trace --scene ship --method rk4 --seconds {seconds}"));
        assert_eq!(rows(&csv).last().unwrap()[0], last.to_string(), "{seconds} s");
    }
    let csv = stdout_of("trace --scene ship --method rk4 --seconds 8.35 --tick-hz 60");
    assert_eq!(rows(&csv).last().unwrap()[0], "501");
}

#[test]
fn seconds_are_counted_across_the_rates_that_a_script_sets() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 1\nseconds = 1\n\
                 [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\n\
                 [[command]]\nat_s = 5\ntick_hz = 100\n";
    fs::write(folder.path().join("my.toml"), scene).unwrap();
    for (seconds, last) in
        [("4.4", ["4", "4.0"]), ("5.4", ["45", "5.4"]), ("5.996", ["105", "6.0"])]
    {
        let output = run_in(folder.path(), &format!("trace --scene my.toml --seconds {seconds}"));
        let csv = String::from_utf8(output.stdout).unwrap();
        assert_eq!(rows(&csv).last().unwrap()[..2], last, "{seconds} s");
    }
}

#[test]
fn a_method_not_listed_by_the_scene_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (lanes, flown) in [
        ("methods = ['explicit-euler']\n", vec!["exact", "explicit-euler"]),
        ("methods = ['midpoint', 'pefrl']\n", vec!["exact", "midpoint", "pefrl"]),
    ] {
        let scene = format!(
            "title = 'x'\ntick_hz = 10\nseconds = 1\n{lanes}\
             [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\n"
        );
        fs::write(folder.path().join("my.toml"), scene).unwrap();
        let output = run_in(folder.path(), "trace --scene my.toml --seconds 0");
        let csv = String::from_utf8(output.stdout).unwrap();
        let methods: Vec<_> = rows(&csv).iter().map(|row| row[3].to_owned()).collect();
        assert_eq!(methods, flown);
    }
}

#[test]
fn the_every_option_keeps_only_multiples() {
    let csv = stdout_of("trace --scene ship --method rk4 --seconds 10 --every 6");
    let ticks: Vec<_> = rows(&csv).iter().map(|row| row[0].to_owned()).collect();
    assert_eq!(ticks, ["0", "0", "6", "6", "12", "12", "18", "18"]);
}

#[test]
fn metrics_are_rows_without_v_for_every_lane_but_the_truth() {
    let csv = stdout_of("trace --scene ship --method rk4 --seconds 0.5 --metrics");
    let metrics: Vec<_> = rows(&csv).into_iter().filter(|row| row[7].is_empty()).collect();
    let of_tick = |tick: &str| -> Vec<&str> {
        metrics.iter().filter(|row| row[0] == tick).map(|row| row[5]).collect()
    };
    // At rest a relative speed error has no meaning; a ship with drag conserves no energy.
    assert_eq!(of_tick("0"), ["position_error", "velocity_error", "evaluations"]);
    assert_eq!(
        of_tick("1"),
        ["position_error", "velocity_error", "relative_speed_error", "evaluations"]
    );
    assert!(metrics.iter().all(|row| row[2] == "1" && row[3] == "rk4"));
}

#[test]
fn several_methods_race_in_the_order_named_each_once() {
    let csv = stdout_of(
        "trace --scene ship --method rk4 --method explicit-euler --method rk4 --seconds 0",
    );
    let lanes: Vec<_> = rows(&csv).iter().map(|row| format!("{} {}", row[2], row[3])).collect();
    assert_eq!(lanes, ["0 exact", "1 rk4", "2 explicit-euler"]);
}

#[test]
fn a_lane_that_halts_is_reported_on_standard_error() {
    let output = run_in(
        &std::env::temp_dir(),
        "trace --scene stiff --method semi-implicit-euler --tick-hz 49 --seconds 20",
    );
    assert_eq!(output.status.code(), Some(0));
    let said = stderr(&output);
    assert!(said.starts_with("lane 1, semi-implicit-euler, halted at tick "), "{said}");
    assert!(said.contains("stiff spring blew up: "), "{said}");
    assert!(said.ends_with("; its rows end there\n"), "{said}");
    let csv = String::from_utf8(output.stdout).unwrap();
    let last = |lane: &str| {
        let row = rows(&csv).into_iter().rfind(|row| row[2] == lane).unwrap();
        row[0].parse::<u64>().unwrap()
    };
    assert_eq!(last("0"), 20 * 49);
    assert!(last("1") < last("0"));
    assert!(said.contains(&format!("halted at tick {} ", last("1"))), "{said}");
}

#[test]
fn rows_of_a_halted_body_end_while_others_continue() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 10\nseconds = 60\nmethods = ['explicit-euler']\n\
                 [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 400\n\
                 [[ship]]\nthrust_n = 20000\ndrag_n_s_per_m = 1000\nmass_kg = 10000\n";
    fs::write(folder.path().join("two.toml"), scene).unwrap();
    let output = run_in(folder.path(), "trace --scene two.toml --metrics");
    let said = stderr(&output);
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.starts_with("lane 1, explicit-euler, halted at tick "), "{said}");
    let csv = String::from_utf8(output.stdout).unwrap();
    let ticks = |lane: &str, body: &str, coordinate: &str| {
        let rows = rows(&csv)
            .into_iter()
            .filter(|row| [row[2], row[4], row[5]] == [lane, body, coordinate]);
        rows.map(|row| row[0].parse::<u64>().unwrap()).collect::<Vec<_>>()
    };
    let all: Vec<u64> = (0..=600).collect();
    for (lane, body, coordinate) in [
        ("0", "spring", "x"),
        ("0", "ship", "s"),
        ("1", "ship", "s"),
        ("1", "ship", "position_error"),
    ] {
        assert_eq!(ticks(lane, body, coordinate), all, "lane {lane}, {body}, {coordinate}");
    }
    let spring = ticks("1", "spring", "x");
    let last = *spring.last().unwrap();
    assert_eq!(spring, (0..=last).collect::<Vec<_>>());
    assert_eq!(ticks("1", "spring", "position_error"), spring);
    assert!(last < 600 && said.contains(&format!("halted at tick {last} ")), "{said}");
}

#[test]
fn a_halted_truth_is_reported_and_nothing_is_compared_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 10\nseconds = 2\nmethods = ['rk4']\n\
                 [[spring]]\nname = 'light'\nmass_kg = 1e-300\nstiffness_n_per_m = 1e-300\n\
                 [[command]]\nat_s = 0.5\nkick = 1e14\n";
    fs::write(folder.path().join("light.toml"), scene).unwrap();
    let output = run_in(folder.path(), "trace --scene light.toml --metrics");
    let said = stderr(&output);
    assert!(
        said.starts_with(
            "lane 0, exact, halted at tick 5 (t = 0.500 s): light blew up: v became infinite"
        ),
        "{said}"
    );
    assert!(said.contains("; its rows end there, and so do its comparisons\n"), "{said}");
    let csv = String::from_utf8(output.stdout).unwrap();
    assert_eq!(rows(&csv).last().unwrap()[0], "5", "{csv}");
}

#[test]
fn a_script_switches_a_lone_lane_but_no_lane_of_a_race() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "title = 'x'\ntick_hz = 10\nseconds = 1\n\
                 [[spring]]\nname = 'a, \"b\"'\nmass_kg = 1\nstiffness_n_per_m = 40\n\
                 [[command]]\nat_s = 0.5\nmethod = 'rk4'\n";
    fs::write(folder.path().join("my.toml"), scene).unwrap();
    let methods = |options: &str| {
        let output = run_in(folder.path(), &format!("trace --scene my.toml {options}"));
        let csv = String::from_utf8(output.stdout).unwrap();
        assert!(csv.lines().nth(1).unwrap().contains(",exact,\"a, \"\"b\"\"\",x,"), "{csv}");
        let lane = csv.lines().filter(|line| line.split(',').nth(2) == Some("1"));
        lane.map(|line| line.split(',').nth(3).unwrap().to_owned()).collect::<Vec<_>>()
    };
    let alone = methods("--method explicit-euler");
    assert_eq!(alone.iter().filter(|method| *method == "explicit-euler").count(), 6);
    assert_eq!(alone.iter().filter(|method| *method == "rk4").count(), 5);
    let racing = methods("--method explicit-euler --method rk4");
    assert_eq!(racing, vec!["explicit-euler"; 11]);
}

#[test]
fn a_pipe_that_closes_early_ends_the_trace_quietly() {
    let mut child = regatta()
        .args(["trace", "--scene", "spring", "--seconds", "100000"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
    assert_eq!(first.trim_end(), HEADER);
    let mut said = String::new();
    child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    assert_eq!((said.as_str(), child.wait().unwrap().code()), ("", Some(0)));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let full = || fs::File::options().write(true).open("/dev/full").unwrap();
    for arguments in ["trace --scene ship", "list methods", "completions bash", "help", "--version"]
    {
        let output = regatta().args(arguments.split(' ')).stdout(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments}");
        let said = stderr(&output);
        assert!(said.starts_with("error: cannot write to standard output: No space"), "{said}");
    }
}

#[test]
fn a_fixture_ends_where_the_truth_is_no_longer_known() {
    let output = run_in(Path::new("."), "fixture --scene paddle --as json");
    let fixture: Value = serde_json::from_slice(&output.stdout).unwrap();
    let least = fixture["least_tolerance"].as_f64().unwrap();
    let last = fixture["bodies"][0]["states"].as_array().unwrap().last().unwrap()[0].as_u64();
    assert!(
        (1e-9..1e-3).contains(&least) && (240..600).contains(&last.unwrap()),
        "{least} {last:?}"
    );
    assert!(stderr(&output).contains(&format!("end at tick {}", last.unwrap() + 1)));
    let output = run_in(Path::new("."), "trace --scene paddle --method rk4 --every 1000");
    assert!(stderr(&output).contains(" s on it is no truth"), "{}", stderr(&output));
}

#[test]
fn impacts_of_two_rules_are_compared_by_their_numbers() {
    let folder = tempfile::tempdir().unwrap();
    for rule in ["clamp", "mirror"] {
        let asked =
            format!("trace --scene ball --seconds 2 --method rk4 --impact {rule} --impacts");
        fs::write(folder.path().join(rule), run_in(folder.path(), &asked).stdout).unwrap();
    }
    let found = String::from_utf8(run_in(folder.path(), "diff clamp mirror").stdout).unwrap();
    assert!(found.contains("first at n 1, lane 1, ball: impact is clamp in a"), "{found}");
    assert!(found.contains("reaches 1e-12 at row 2") && !found.contains("tick"), "{found}");
}
