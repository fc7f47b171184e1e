//! Mistakes in scene files, with the reviewed messages: `tests/bad_scenes.md` has a case for each.
//!
//! `BLESS=1 cargo test --test library bad_scenes` writes the messages again; without it, one that is missing or
//! different fails.

use std::fs;
use std::path::{Path, PathBuf};

use regatta::scene::{MAX_BODIES, MAX_FILE_BYTES, MAX_SHOWN, Scene, SceneErrors};

use crate::kept::hold_text;

/// A bad scene and its error message.
#[derive(Clone, Debug, PartialEq)]
struct Case {
    name: String,
    /// The scene as the file of cases has it.
    written: String,
    /// The scene's own bytes.
    scene: Vec<u8>,
    /// With a line break at its end.
    message: String,
}

fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad_scenes.md")
}

/// The words before the first case, and the cases; else the one that is malformed.
fn cases(text: &str) -> Result<(String, Vec<Case>), String> {
    let mut sections = text.split("\n## ");
    let preface = sections.next().unwrap_or_default().to_owned();
    let cases: Vec<Case> = sections
        .map(|section| {
            let name = section.lines().next().unwrap_or_default();
            case(section).ok_or_else(|| format!("the case {name:?} is malformed"))
        })
        .collect::<Result<_, _>>()?;
    match cases.windows(2).find(|pair| pair[0].name >= pair[1].name) {
        Some(pair) => Err(format!("{} stands before {}", pair[0].name, pair[1].name)),
        None => Ok((preface, cases)),
    }
}

fn case(section: &str) -> Option<Case> {
    let (name, rest) = section.split_once("\n\n```toml")?;
    let (kind, rest) = rest.split_once('\n')?;
    let (written, rest) = rest.split_once("```\n\n```text\n")?;
    let message = rest.strip_suffix("```\n")?;
    let is_whole = |lines: &str| lines.is_empty() || lines.ends_with('\n');
    let is_named = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if !is_named
        || ![written, message].iter().all(|lines| is_whole(lines) && !lines.contains("```"))
    {
        return None;
    }
    let scene = match kind {
        "" => written.as_bytes().to_owned(),
        " escaped" => unescaped(written)?,
        _ => return None,
    };
    Some(Case {
        name: name.to_owned(),
        written: format!("{kind}\n{written}"),
        scene,
        message: message.to_owned(),
    })
}

/// The bytes of an escaped text. Line breaks are ignored.
fn unescaped(written: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut rest = written.bytes().filter(|byte| *byte != b'\n');
    while let Some(byte) = rest.next() {
        bytes.push(match byte {
            b'\\' => match rest.next()? {
                b'n' => b'\n',
                b'r' => b'\r',
                b'0' => 0,
                b'\\' => b'\\',
                b'x' => {
                    let digits = String::from_utf8(vec![rest.next()?, rest.next()?]).ok()?;
                    u8::from_str_radix(&digits, 16).ok()?
                }
                _ => return None,
            },
            byte => byte,
        });
    }
    Some(bytes)
}

/// The file of these cases.
fn written(preface: &str, cases: &[Case]) -> String {
    let sections = cases.iter().map(|case| {
        let Case { name, written, message, .. } = case;
        format!("\n## {name}\n\n```toml{written}```\n\n```text\n{message}```\n")
    });
    preface.to_owned() + &sections.collect::<String>()
}

fn reviewed() -> (String, Vec<Case>) {
    let text = fs::read_to_string(file()).unwrap();
    let (preface, cases) = cases(&text).unwrap_or_else(|malformed| panic!("{malformed}"));
    assert!(written(&preface, &cases) == text, "a case is read otherwise than it is written");
    assert!(cases.len() >= 100, "only {} bad scenes", cases.len());
    (preface, cases)
}

#[test]
fn every_bad_scene_gives_its_reviewed_message() {
    let (preface, reviewed) = reviewed();
    let now = reviewed.iter().map(|case| {
        let name = format!("{}.toml", case.name);
        let errors = Scene::from_bytes(&name, &case.scene).err();
        let errors = errors.unwrap_or_else(|| panic!("{name} is a good scene"));
        Case { message: format!("{errors}\n"), ..case.clone() }
    });
    let now: Vec<Case> = now.collect();
    if std::env::var_os("BLESS").is_some() {
        fs::write(file(), written(&preface, &now)).unwrap();
        return;
    }
    let remedy = "BLESS=1 cargo test --test library bad_scenes writes them; read each";
    let kept = written(&preface, &reviewed);
    hold_text("tests/bad_scenes.md", &written(&preface, &now), &kept, remedy);
}

#[test]
fn malformed_cases_are_detected() {
    let good = "# Head\n\n## a\n\n```toml\nx\n```\n\n```text\nbad\n```\n\n## b\n\n```toml escaped\n\
                \\xe9\\r\\n\n\\\\\n```\n\n```text\n```\n";
    let (preface, found) = cases(good).unwrap();
    assert_eq!((&*preface, found.len()), ("# Head\n", 2));
    assert_eq!((&*found[0].scene, &*found[0].message), (&b"x\n"[..], "bad\n"));
    assert_eq!((&*found[1].scene, &*found[1].message), (&b"\xe9\r\n\\"[..], ""));
    assert_eq!(written(&preface, &found), good);
    for (from, to) in [
        ("## b", "## a"),
        ("## b", "## B b"),
        ("## b", "## "),
        ("## b", "##b"),
        ("```toml\n", "```\n"),
        ("escaped", "twice"),
        ("\\r", "\\q"),
        ("\\xe9", "\\x"),
        ("x\n```\n", "x\n"),
        ("x\n", "x"),
        ("bad\n```\n", "bad\n"),
        ("bad\n", "bad"),
        ("```text\n", "```\n"),
        ("bad\n```\n", "bad\n```\n\nmore words\n"),
    ] {
        assert!(good.contains(from));
        let bad = good.replacen(from, to, 1);
        assert!(cases(&bad).is_err(), "{bad}");
    }
}

#[cfg(feature = "desktop")]
#[test]
fn every_bad_scene_is_reported_with_its_lines() {
    use annotate_snippets::Renderer;
    use clap::Parser;
    use regatta::commands::{self, Cli};

    let folder = tempfile::tempdir().unwrap();
    for case in reviewed().1 {
        let path = folder.path().join(format!("{}.toml", case.name));
        fs::write(&path, &case.scene).unwrap();
        let cli =
            Cli::parse_from(["regatta".as_ref(), "trace".as_ref(), "--scene".as_ref(), &*path]);
        let error = commands::run(cli).expect_err("a good scene");
        assert_eq!(error.exit_code(), 2);
        let report = error.report(&Renderer::plain());
        for line in case.message.lines() {
            let line = folder.path().join(line).display().to_string();
            assert!(report.lines().any(|reported| reported == line), "{report}");
        }
    }
}

#[test]
fn a_tolerance_is_accepted_for_any_lane_that_may_be_adaptive() {
    let head = "title = 'x'\ntick_hz = 60\nseconds = 10\nmethods = ['rk4', 'midpoint']\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";
    let command = |words: &str| format!("[[command]]\n{words}\n");
    let tolerance = command("at_s = 9\nlane = 2\ntolerance = 1e-6");
    let adaptive = "method = 'dormand-prince-54'";
    for before in [
        // Only where the lane is flown solo.
        command(&format!("at_s = 3\n{adaptive}")),
        command(&format!("at_s = 3\nlane = 2\n{adaptive}")),
        command("at_s = 3\nsolo = 2") + &command(&format!("at_s = 4\n{adaptive}")),
    ] {
        // The times decide, not the order in the file.
        for text in [before.clone() + &tolerance, tolerance.clone() + &before] {
            Scene::parse("good.toml", &(head.to_owned() + &text)).unwrap();
        }
    }
    let late = tolerance + &command(&format!("at_s = 10\nlane = 2\n{adaptive}"));
    let refused = Scene::parse("bad.toml", &(head.to_owned() + &late)).unwrap_err();
    assert!(refused.to_string().contains("at 9 s its method is \"midpoint\""), "{refused}");
}

#[test]
fn a_file_of_a_million_bodies_is_refused_for_its_size() {
    let errors = refused(&"[[ship]]\n".repeat(1_000_000));
    let message = "bad.toml:1:1: the file holds more than 1048576 bytes; give a scene file, with a shorter script";
    assert_eq!(errors.to_string(), message);
}

#[test]
fn the_most_bodies_a_file_can_hold_are_refused_for_their_number() {
    let head = "title = 'many'\ntick_hz = 60\nseconds = 1\n";
    let body = "[[ship]]\n";
    let count = (MAX_FILE_BYTES - head.len()) / body.len();
    let errors = refused(&(head.to_owned() + &body.repeat(count)));
    // Three keys are missing in each ship that is looked at.
    assert_eq!(errors.errors.len() + errors.more, 3 * MAX_BODIES + 1);

    let good = "[[ship]]\nthrust_n = 1\ndrag_n_s_per_m = 1\nmass_kg = 1\n";
    let count = (MAX_FILE_BYTES - head.len()) / good.len();
    let errors = refused(&(head.to_owned() + &good.repeat(count)));
    let message =
        format!("bad.toml:260:1: the scene has {count} bodies; keep at most {MAX_BODIES}");
    assert_eq!(errors.to_string(), message);
}

#[test]
fn a_file_full_of_mistakes_is_refused_briefly() {
    for mistake in ["=\n", "a=\n", "a=1\n", "\0", "\0\n", "[", "\"", "a=1 1\n", "[[x]]\n", "é\r"] {
        let errors = refused(&mistake.repeat(MAX_FILE_BYTES / mistake.len()));
        assert!(errors.to_string().lines().count() <= MAX_SHOWN + 1);
        check_places(&errors);
    }
}

#[test]
fn the_deepest_possible_nesting_does_not_overflow_the_stack() {
    for opening in ["[", "{a=", "a.", "[[", "[{a="] {
        for start in ["", "a=", "methods=", "[a."] {
            let text = start.to_owned() + &opening.repeat((MAX_FILE_BYTES - 8) / opening.len());
            check_places(&refused(&text));
        }
    }
}

fn refused(text: &str) -> SceneErrors {
    Scene::parse("bad.toml", text).expect_err("a good scene")
}

/// Errors come in order, and each begins at a place that an editor can go to.
pub(crate) fn check_places(errors: &SceneErrors) {
    assert!(!errors.errors.is_empty());
    let lines: Vec<&str> = errors.text.split('\n').collect();
    let mut last = (1, 1);
    for error in &errors.errors {
        let place = errors.position(error.span.start);
        assert!(place >= last, "{errors}");
        let (line, column) = place;
        assert!((1..=lines.len()).contains(&line), "{errors}");
        assert!((1..=lines[line - 1].chars().count() + 1).contains(&column), "{errors}");
        assert!(error.span.start <= error.span.end && error.span.end <= errors.text.len());
        assert!(!error.to_string().contains(char::is_control), "{errors:?}");
        last = place;
    }
}
