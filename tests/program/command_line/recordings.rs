//! `regatta verify FILE.toml`: a recording against its own checks; and `regatta play --record` without a display.

use std::fs;

use regatta::run::Session;
use regatta::scene::Scene;
use tempfile::TempDir;

use super::{run_in, stderr};

/// A folder with `run.toml`, the recording of two seconds of the harbour's race.
fn recorded() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let harbour = Scene::built_in("harbour").unwrap();
    let mut session = Session::racing(harbour.into());
    session.run(130);
    let text = session.recording(130).to_toml();
    fs::write(folder.path().join("run.toml"), format!("# by hand\n{text}")).unwrap();
    folder
}

/// The result of `regatta verify run.toml` with more arguments: code, data and messages.
fn verify(folder: &TempDir, arguments: &str) -> (Option<i32>, String, String) {
    let output = run_in(folder.path(), &format!("verify run.toml {arguments}"));
    let (data, messages) = (String::from_utf8(output.stdout.clone()).unwrap(), stderr(&output));
    (output.status.code(), data, messages)
}

fn edit(folder: &TempDir, change: impl FnOnce(String) -> String) {
    let path = folder.path().join("run.toml");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(path, change(text)).unwrap();
}

#[test]
fn a_recording_is_the_same_to_the_bit_lane_by_lane() {
    let folder = recorded();
    let (code, data, messages) = verify(&folder, "");
    assert_eq!((code, &*messages), (Some(0), ""));
    let lines: Vec<&str> = data.lines().collect();
    assert_eq!(lines.len(), 5);
    assert_eq!(lines[3], "lane 4, rk4: same to the bit: 3 checks to tick 130");
}

#[test]
fn a_failure_names_the_first_failed_and_the_last_good_check() {
    let folder = recorded();
    edit(&folder, |text| {
        let (before, after) = text.split_once("tick = 120\nlane = 4\nhash = \"").unwrap();
        format!("{before}tick = 120\nlane = 4\nhash = \"{}{}", "0".repeat(16), &after[16..])
    });
    let (code, data, messages) = verify(&folder, "");
    assert_eq!(code, Some(1));
    let line = data.lines().nth(3).unwrap();
    let expected = "lane 4, rk4: differs first at tick 120 (2 s): 0000000000000000 in the file, ";
    assert!(line.starts_with(expected), "{line}");
    assert!(line.ends_with("; the last check that holds is at tick 60"));
    assert!(
        messages.contains("1 lane of run.toml differs; if that is meant, --bless"),
        "{messages}"
    );
    assert_eq!(data.lines().filter(|line| line.contains("same to the bit")).count(), 4);
}

#[test]
fn a_changed_parameter_fails_every_lane_and_bless_changes_only_hashes() {
    let folder = recorded();
    edit(&folder, |text| text.replacen("mass_kg = 1.0", "mass_kg = 1.25", 1));
    let (code, data, _) = verify(&folder, "");
    assert_eq!(
        (code, data.lines().filter(|line| line.contains("differs first at tick 60")).count()),
        (Some(1), 5)
    );
    let before = fs::read_to_string(folder.path().join("run.toml")).unwrap();
    let (code, _, messages) = verify(&folder, "--bless");
    assert_eq!((code, &*messages), (Some(0), "blessed: run.toml\n"));
    assert_eq!(verify(&folder, "").0, Some(0));
    let after = fs::read_to_string(folder.path().join("run.toml")).unwrap();
    let others = |text: &str| -> Vec<String> {
        text.lines().filter(|line| !line.starts_with("hash")).map(str::to_owned).collect()
    };
    assert_eq!(others(&after), others(&before));
    assert_ne!(after, before);
}

#[test]
fn a_scene_without_checks_is_not_judged_until_blessed() {
    let folder = tempfile::tempdir().unwrap();
    let text = "# mine\ntitle = 'x'\ntick_hz = 30\nseconds = 2.5\nmethods = ['rk4', 'midpoint']\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";
    fs::write(folder.path().join("run.toml"), text).unwrap();
    let (code, data, messages) = verify(&folder, "");
    assert_eq!((code, &*data), (Some(2), ""));
    assert!(messages.contains("run.toml has no [[check]] to be judged by; --bless writes one"));
    assert_eq!(verify(&folder, "--bless").0, Some(0));
    let blessed = fs::read_to_string(folder.path().join("run.toml")).unwrap();
    assert!(blessed.starts_with(text), "{blessed}");
    assert_eq!(blessed.matches("[[check]]").count(), 2 * 3);
    let (code, data, _) = verify(&folder, "");
    assert_eq!(code, Some(0));
    assert_eq!(data.lines().next(), Some("lane 1, rk4: same to the bit: 3 checks to tick 75"));
}

#[test]
fn bless_keeps_the_line_endings_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let text = "# mine\ntitle = 'x'\ntick_hz = 30\nseconds = 2\nmethods = ['rk4']\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";
    for (ending, lone_feeds) in [("\r\n", false), ("\n", true)] {
        let text = text.replace('\n', ending);
        fs::write(folder.path().join("run.toml"), &text).unwrap();
        // The second time the hashes are there, and are replaced.
        for _ in 0..2 {
            assert_eq!(verify(&folder, "--bless").0, Some(0));
            let blessed = fs::read_to_string(folder.path().join("run.toml")).unwrap();
            assert!(blessed.starts_with(&text) && blessed.contains("[[check]]"), "{blessed:?}");
            assert_eq!(blessed.replace("\r\n", "").contains('\n'), lone_feeds, "{blessed:?}");
        }
        assert_eq!(verify(&folder, "").0, Some(0));
    }
}

#[test]
fn a_lane_is_named_by_its_number_and_by_every_method_that_it_had() {
    let folder = tempfile::tempdir().unwrap();
    let switch = |tick: u32, method: &str| {
        let at_s = f64::from(tick) / 30.0;
        format!("[[command]]\nat_s = {at_s}\nlane = 1\nmethod = '{method}'\n")
    };
    let text = "title = 'x'\ntick_hz = 30\nseconds = 1\nmethods = ['rk4', 'midpoint']\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";
    let [two, four] = ["rk4 then pefrl", "rk4 then 2 others then newmark"];
    let switched = text.to_owned() + &switch(5, "pefrl");
    let again = switched.clone() + &switch(6, "bdf2") + &switch(7, "newmark");
    for (text, methods) in [(switched, two), (again, four)] {
        fs::write(folder.path().join("run.toml"), text).unwrap();
        assert_eq!(verify(&folder, "--bless").0, Some(0));
        let (_, data, _) = verify(&folder, "--report junit r.xml");
        let expected = format!(
            "lane 1, {methods}: same to the bit: 1 check to tick 30\n\
             lane 2, midpoint: same to the bit: 1 check to tick 30\n"
        );
        assert_eq!(data, expected);
        let xml = fs::read_to_string(folder.path().join("r.xml")).unwrap();
        assert!(xml.contains(&format!("name=\"lane 1, {methods}\"")), "{xml}");
    }
}

#[test]
fn an_unreachable_check_is_not_blessed_and_the_file_stays() {
    let folder = tempfile::tempdir().unwrap();
    let check = |tick: u64, lane: usize| {
        format!("[[check]]\ntick = {tick}\nlane = {lane}\nhash = '0123456789abcdef'\n")
    };
    let scene = "title = 'x'\ntick_hz = 30\nseconds = 1\nmethods = ['rk4', 'midpoint']\n\
                 [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";
    let solo = "[[command]]\ntick = 5\nsolo = 1\n";
    // Nor does the judgement, which fails, advise it.
    let reads = |option: &str, text: &str| match (option, text.contains("solo")) {
        ("", true) => 1,
        _ => 2,
    };
    for (text, options, said) in [
        (
            format!("{scene}{solo}{}{}", check(30, 1), check(30, 2)),
            &["", "--bless"][..],
            ": lane 2 of run.toml has left the race at tick 30, where a [[check]] names it; \
             take that check out, or the `solo` that removes the lane",
        ),
        (
            format!("{scene}{}", check(100_000_001, 1)),
            &["", "--bless"][..],
            "run.toml has a [[check]] at tick 100000001, and verify runs 100000000 ticks at most",
        ),
    ] {
        fs::write(folder.path().join("run.toml"), &text).unwrap();
        for option in options {
            let (code, _, messages) = verify(&folder, option);
            assert_eq!(code, Some(reads(option, &text)), "{messages}");
            assert!(messages.replace("; lane", ": lane").contains(said), "{messages}");
            assert!(!messages.contains("--bless"), "{messages}");
            assert_eq!(fs::read_to_string(folder.path().join("run.toml")).unwrap(), text);
        }
    }
}

#[test]
fn checks_beyond_the_end_of_the_scene_are_announced_and_judged() {
    let folder = recorded();
    edit(&folder, |text| text.replacen("seconds = 2.1666666666666665", "seconds = 1.5", 1));
    for option in ["", "--bless"] {
        let (code, _, messages) = verify(&folder, option);
        assert_eq!(code, Some(0), "{messages}");
        let announced = "10 checks lie beyond the end of run.toml at tick 90 (1.5 s); \
                         the race runs on to tick 130\n";
        assert!(messages.starts_with(announced), "{messages}");
    }
}

#[test]
fn reports_of_a_recording_are_machine_readable() {
    let folder = recorded();
    edit(&folder, |text| text.replacen("hash = \"", "hash = \"0000000000000000\" # \"", 1));
    let (code, ..) = verify(&folder, "--report json r.json --report junit r.xml");
    assert_eq!(code, Some(1));
    let json = fs::read_to_string(folder.path().join("r.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!((&json["file"], &json["same"]), (&"run.toml".into(), &false.into()));
    let [first, second] = [0, 1].map(|lane| &json["lanes"][lane]);
    assert_eq!(first["lane"], 1);
    assert_eq!(first["methods"], serde_json::json!(["explicit-euler"]));
    assert_eq!(first["first_difference"]["tick"], 60);
    assert_eq!(first["first_difference"]["was"], "0000000000000000");
    assert_eq!((&second["same"], &second["first_difference"]), (&true.into(), &().into()));
    let xml = fs::read_to_string(folder.path().join("r.xml")).unwrap();
    assert!(xml.contains("tests=\"5\" failures=\"1\""), "{xml}");
    assert!(xml.contains("name=\"lane 2, semi-implicit-euler\"/>"), "{xml}");
}

#[test]
fn frame_options_and_missing_files_are_refused_for_a_recording() {
    let folder = recorded();
    for option in ["--diff d", "--max-channel 3", "--max-pixels 1"] {
        let (code, _, messages) = verify(&folder, option);
        assert_eq!(code, Some(2), "{option}");
        assert!(messages.contains("is for the frames of a capture"), "{messages}");
    }
    let output = run_in(folder.path(), "verify gone.toml");
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("\"gone.toml\""), "{}", stderr(&output));
    edit(&folder, |text| text.replacen("hash = \"", "hash = \"x", 1));
    let (code, _, messages) = verify(&folder, "");
    assert_eq!(code, Some(2));
    assert!(messages.contains("not a hash"), "{messages}");
}

#[test]
fn play_records_the_run_but_keeps_an_existing_file() {
    let folder = tempfile::tempdir().unwrap();
    let play = "play --scene spring --method rk4 --seconds 1 --record run.toml";
    let output = run_in(folder.path(), play);
    if stderr(&output).contains("graphics") {
        return eprintln!(
            "play_records_the_run_but_keeps_an_existing_file: skipped, no graphics to draw with"
        );
    }
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(stderr(&output).contains("recorded 60 ticks in run.toml"), "{}", stderr(&output));
    let (code, data, _) = verify(&folder, "");
    assert_eq!((code, &*data), (Some(0), "lane 4, rk4: same to the bit: 1 check to tick 60\n"));

    let again = run_in(folder.path(), play);
    assert_eq!(again.status.code(), Some(2));
    let message = "run.toml already exists; give another --record, or --force to replace it";
    assert!(stderr(&again).contains(message), "{}", stderr(&again));
    fs::remove_dir_all(folder.path().join("regatta-frames")).unwrap();
    let forced = run_in(folder.path(), &format!("{play} --force"));
    assert_eq!(forced.status.code(), Some(0), "{}", stderr(&forced));
}

#[test]
fn a_recording_never_replaces_the_played_scene() {
    let folder = recorded();
    let before = fs::read_to_string(folder.path().join("run.toml")).unwrap();
    for path in ["run.toml", "./run.toml"] {
        let output = run_in(
            folder.path(),
            &format!("play --scene run.toml --seconds 1 --record {path} --force"),
        );
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        let message = format!("{path} is the scene that is run; give another --record");
        assert!(stderr(&output).contains(&message), "{}", stderr(&output));
    }
    assert_eq!(fs::read_to_string(folder.path().join("run.toml")).unwrap(), before);
}

#[test]
fn a_report_never_replaces_the_judged_recording() {
    let folder = recorded();
    let before = fs::read_to_string(folder.path().join("run.toml")).unwrap();
    fs::create_dir(folder.path().join("x")).unwrap();
    for path in ["run.toml", "./run.toml", "./x/../run.toml"] {
        let (code, _, messages) = verify(&folder, &format!("--report json {path}"));
        assert_eq!(code, Some(2), "{messages}");
        assert!(messages.contains("is the recording that is judged; give another --report"));
    }
    assert_eq!(fs::read_to_string(folder.path().join("run.toml")).unwrap(), before);
}

#[test]
fn a_report_replaces_only_a_report_or_an_empty_file() {
    let folder = recorded();
    let report = folder.path().join("report");
    for mine in [
        "mine",
        "{\n  \"file\": \"a.rs\",\n  \"name\": 1\n}\n",
        "{\"file\": \"run.toml\", \"same\": true}",
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"jest\"></testsuite>\n",
    ] {
        for format in ["json", "junit"] {
            fs::write(&report, mine).unwrap();
            let (code, data, messages) = verify(&folder, &format!("--report {format} report"));
            assert_eq!((code, &*data), (Some(2), ""), "{mine}: {messages}");
            let remedy = "report was not made by regatta and is not replaced; move it away, or give \
                          another --report\n";
            assert!(messages.ends_with(remedy), "{messages}");
            assert_eq!(fs::read_to_string(&report).unwrap(), mine);
        }
    }
    fs::write(&report, "").unwrap();
    let mut before = String::new();
    for format in ["json", "junit", "junit", "json", "json"] {
        let (code, _, messages) = verify(&folder, &format!("--report {format} report"));
        assert_eq!(code, Some(0), "{format} over {before}: {messages}");
        before = fs::read_to_string(&report).unwrap();
        assert_eq!(before.starts_with('{'), format == "json", "{before}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}
