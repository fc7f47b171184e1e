//! `link`: a run as an address, which every command accepts as a scene.

use std::fs;

use super::{refusal, run_in, stderr, stdout_of};

#[test]
fn a_link_with_or_without_address_replays_its_run_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string("assets/scenes/harbour.toml").unwrap();
    let run = format!("{text}\n[[command]]\nat_s = 2.0\nkick = 1.0\n");
    fs::write(folder.path().join("run.toml"), run).unwrap();
    let made = run_in(folder.path(), "link run.toml");
    let link = String::from_utf8(made.stdout).unwrap().trim().to_owned();
    assert!(link.starts_with("#v1.") && link.len() < 1000, "{link}");
    assert!(link[4..].bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_'));
    let of_file = run_in(folder.path(), "trace --scene run.toml --seconds 3").stdout;
    for written in [link.clone(), format!("https://example.org/{link}&panels=off&play")] {
        assert_eq!(stdout_of(&format!("trace {written} --seconds 3")).into_bytes(), of_file);
        assert_eq!(
            stdout_of(&format!("trace --scene {written} --seconds 3")).into_bytes(),
            of_file
        );
        assert!(stdout_of(&format!("verify {written}")).contains("same"), "{written}");
    }
    assert_eq!(stdout_of(&format!("trace --scene={link} --seconds 3")).into_bytes(), of_file);
    assert_eq!(stdout_of(&format!("link {link}")).trim(), link);
    let same = run_in(folder.path(), &format!("diff {link} run.toml"));
    assert_eq!(same.status.code(), Some(0), "{}", stderr(&same));
    let other = run_in(folder.path(), &format!("diff harbour {link}"));
    assert_eq!(other.status.code(), Some(1), "{}", stderr(&other));
}

#[test]
fn a_file_named_like_a_link_is_read_as_a_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::copy("assets/scenes/spring.toml", folder.path().join("a#v2.toml")).unwrap();
    let done = run_in(folder.path(), "trace --scene a#v2.toml --seconds 0.1");
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    let done = run_in(folder.path(), "sweep --scene spring --seconds 0.1 --out b#v1.csv");
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
    assert!(folder.path().join("b#v1.csv").exists());
    let link = stdout_of("link #scene=spring");
    let link = link.trim();
    assert!(refusal(&format!("list {link}"), 2).contains("invalid value"));
    assert!(refusal(&format!("verify {link} --bless"), 2).contains("a link is not blessed"));
    let report = folder.path().join("report.json");
    stdout_of(&format!("verify {link} --report json {}", report.display()));
    assert!(fs::read_to_string(report).unwrap().contains("\"file\": \"the link\""));
}

#[test]
fn a_short_link_sets_the_options_in_its_name() {
    assert_eq!(stdout_of("link spring"), "#scene=spring\n");
    let asked = "trace --scene spring --method rk4 --tick-hz 30 --seconds 1";
    let link = "#scene=spring&method=rk4&tick-hz=30&tick=7";
    let coded = "https://example.org/#scene%3Dspring%26method%3Drk4%26tick-hz%3D30).";
    for written in [link, coded, &format!("<https://example.org/{link}>")] {
        let lane = |text: &str| {
            let rows = text.lines().filter(|row| row.contains(",rk4,"));
            rows.map(|row| row.split_once(",rk4,").unwrap().1.to_owned()).collect::<Vec<_>>()
        };
        let found = lane(&stdout_of(&format!("trace {written} --seconds 1")));
        assert_eq!(found, lane(&stdout_of(asked)), "{written}");
        assert!(found.len() >= 30, "{written}: {} rows", found.len());
    }
    let whole = stdout_of("link #scene=spring&method=rk4");
    assert!(whole.starts_with("#v1."), "{whole}");
    assert!(stdout_of(&format!("verify {}", whole.trim())).contains("same"));
}

#[test]
fn an_invalid_link_is_refused_in_a_sentence() {
    let link = stdout_of("link #scene=spring").trim().to_owned();
    for (written, told) in [
        (link.replace("#v1.", "#v7."), "the link is of format 7, and this release reads up to 1"),
        (link[..link.len() - 9].to_owned(), "the link is broken; copy it whole"),
        ("#v1.!".to_owned(), "the link is broken; copy it whole"),
        ("#scene=sprin".to_owned(), "scene \"sprin\", and there is none; did you mean \"spring\"?"),
        ("#scene=spring&metod=rk4".to_owned(), "setting \"metod\", and there is none"),
        ("#scene=spring&method=rk5".to_owned(), "did you mean \"rk4\"?"),
        ("#scene=spring&method=lerp-per-frame".to_owned(), "does not step the body"),
    ] {
        for command in ["trace", "verify", "advise --scene", "link"] {
            let said = refusal(&format!("{command} {written}"), 2);
            assert!(said.contains(told), "{command}: {said}");
        }
    }
}

#[test]
fn a_run_too_long_for_verify_is_refused_before_it_starts() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, seconds: u32, check: &str| {
        let head = format!("title = \"t\"\ntick_hz = 10000\nseconds = {seconds}\n");
        let text = format!("{head}[[spring]]\nmass_kg = 1.0\nstiffness_n_per_m = 40.0\n{check}");
        fs::write(folder.path().join(name), text).unwrap();
    };
    write("long.toml", 10_001, "");
    write("late.toml", 1, "[[check]]\ntick = 100000001\nlane = 1\nhash = \"0000000000000000\"\n");
    for (arguments, told) in [
        ("link long.toml", "long.toml runs for 100010000 ticks"),
        ("diff long.toml spring", "long.toml runs for 100010000 ticks"),
        (
            "diff spring long.toml",
            "verify runs 100000000 at most; lower its seconds, or its tick_hz",
        ),
        ("verify --bless long.toml", "long.toml runs for 100010000 ticks"),
        ("link late.toml", "late.toml has a [[check]] at tick 100000001"),
        ("diff late.toml spring", "verify runs 100000000 ticks at most; take it out"),
    ] {
        let output = run_in(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {}", stderr(&output));
        assert!(stderr(&output).contains(told), "{arguments}: {}", stderr(&output));
    }
    write("short.toml", 1, "");
    let done = run_in(folder.path(), "link short.toml");
    assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
}
