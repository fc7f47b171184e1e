//! The output below each command in the README and the manual is the command's output, and a test covers each block.
#![cfg(unix)]

use std::collections::HashMap;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

use regatta::run::Session;
use regatta::scene::Scene;

use super::{run_in, stdout_of};
use crate::printed::texts;

/// How many blocks of each language a text has, and how they are held:
/// - `console`: each command runs below, and its output is compared.
/// - `text`: the options of the synopsis are compared with the help of their commands, below; output of a program with that of
///   the program, in `tests/library/ci_recipe.rs`.
/// - `rust`: compiled and run in `tests/library/ci_recipe.rs`.
/// - `sh` and `yaml`: options are compared with the help of their commands, below; the table above the command of `loops` with
///   its rows, in `loops.rs`; the pipe to ffmpeg is run in `formats.rs`.
/// - `toml`: scenes are read, below; dependencies are resolved in `tests/library/ci_recipe.rs`.
const BLOCKS: [(&str, &str, usize); 20] = [
    ("scenes", "toml", 7),
    ("commands", "console", 6),
    ("commands", "sh", 2),
    ("commands", "text", 1),
    ("loops", "sh", 1),
    ("logs", "console", 1),
    ("questions", "console", 18),
    ("code", "console", 2),
    ("step", "console", 5),
    ("library", "rust", 2),
    ("library", "text", 1),
    ("library", "toml", 1),
    ("ci", "rust", 1),
    ("ci", "yaml", 1),
    ("stable", "rust", 1),
    ("stable", "text", 1),
    ("README", "console", 1),
    ("README", "sh", 1),
    ("README", "toml", 1),
    ("SKILL", "console", 10),
];

/// A log of Box2D: a spring of 1 Hz and a damping ratio of 0.05.
const LOG: &str = include_str!("../../data/engines/box2d__spring_1hz_z005_60hz.csv");

/// Makes the files of a reader's own that examples are about.
fn make_own_files(folder: &Path) {
    fs::write(folder.join("spring.csv"), LOG).unwrap();
    let rk4 = include_str!("../../../assets/methods/rk4.step");
    let slipped = rk4.replace("let k2_x = v +", "let k2_x = v -");
    fs::write(folder.join("my-rk4.step"), slipped).unwrap();
    let mut session = Session::solo(Scene::built_in("harbour").unwrap().into(), 0);
    session.run(640);
    fs::write(folder.join("run.toml"), session.recording(640).to_toml()).unwrap();
    // Smaller than by the manual's command, to be quick.
    let capture = "capture --scene spring --race --seconds 10 --size 64x36 --out clip";
    assert_eq!(run_in(folder, capture).status.code(), Some(0));
}

/// The output of a shell command, data first, in a folder with `regatta` as the program.
fn said_by(command: &str, folder: &Path) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_regatta")).parent().unwrap();
    let path = format!("{}:{}", program.display(), env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    shell.args(["-c", command]).current_dir(folder).env("PATH", path).env_remove("DISPLAY");
    let output = shell.output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(0), "{command}: {err}");
    // The progress of a long run is not part of its output.
    let wrote = err.lines().filter(|line| line.starts_with("wrote "));
    out + &wrote.collect::<Vec<_>>().join("\n")
}

#[test]
fn every_example_with_an_answer_prints_that_answer() {
    let folder = tempfile::tempdir().unwrap();
    make_own_files(folder.path());
    let mut known: HashMap<String, String> = HashMap::new();
    let mut compared: Vec<(&str, usize)> = Vec::new();
    for text in texts() {
        let mut count = 0;
        for block in text.blocks().iter().filter(|block| block.language == "console") {
            for example in block.body.split("$ ").skip(1) {
                let (command, printed) = example.split_once('\n').unwrap();
                // Up to the indentation of the next command.
                let printed = &printed[..printed.rfind('\n').map_or(0, |end| end + 1)];
                if printed.trim().is_empty() {
                    continue;
                }
                assert!(printed.lines().any(|line| line.trim() != "…"), "{command}");
                let said =
                    known.entry(command.into()).or_insert_with(|| said_by(command, folder.path()));
                text.hold(printed, said);
                count += 1;
            }
        }
        compared.extend((count > 0).then_some((text.name, count)));
    }
    let expected = [
        ("commands", 4),
        ("logs", 1),
        ("questions", 25),
        ("code", 2),
        ("step", 3),
        ("README", 1),
        ("SKILL", 10),
    ];
    assert_eq!(compared, expected);
}

#[test]
fn every_block_of_the_manual_is_of_a_tested_kind() {
    let mut found: Vec<(&str, String, usize)> = Vec::new();
    for text in texts() {
        let mut languages: Vec<&str> = text.blocks().iter().map(|block| block.language).collect();
        languages.sort_unstable();
        for group in languages.chunk_by(|one, other| one == other) {
            found.push((text.name, group[0].into(), group.len()));
        }
    }
    let found: Vec<_> = found.iter().map(|(name, of, count)| (*name, &**of, *count)).collect();
    assert_eq!(found, BLOCKS);
}

/// The options that are named in a text.
fn options(text: &str) -> impl Iterator<Item = &str> {
    let is_of_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    let words = text.split(move |c| !is_of_name(c));
    words.filter(|word| word.starts_with("--") && word.len() > 2)
}

#[test]
fn every_option_in_the_manual_exists_for_its_command() {
    let mut helps: HashMap<String, String> = HashMap::new();
    let mut checked = 0;
    for text in texts() {
        let mut commands: Vec<&str> = Vec::new();
        let blocks = text.blocks();
        for block in blocks.iter().filter(|block| ["text", "sh", "yaml"].contains(&block.language))
        {
            commands.extend(block.body.split("regatta ").skip(1));
        }
        let in_prose = text.text.split("`regatta ").skip(1);
        commands.extend(in_prose.map(|rest| rest.split('`').next().unwrap_or_default()));
        for command in commands {
            let name = command.split_whitespace().next().unwrap_or_default();
            let name = name.trim_matches(['[', ']']);
            let name = if name.starts_with("--") { "play" } else { name };
            for option in options(command) {
                let help =
                    helps.entry(name.into()).or_insert_with(|| stdout_of(&format!("help {name}")));
                let is_known = options(help).any(|known| known == option);
                assert!(is_known, "{}: regatta {command}: {name} has no {option}", text.name);
                checked += 1;
            }
        }
    }
    assert!(checked > 150, "{checked} options");
}

#[test]
fn every_scene_of_the_manual_is_read() {
    let texts = texts();
    let scenes = texts.iter().find(|text| text.name == "scenes").expect("a chapter");
    for block in scenes.blocks() {
        let head = if block.body.contains("title = ") {
            ""
        } else {
            "title = 'x'\ntick_hz = 60\nseconds = 1\n"
        };
        let read = Scene::parse("manual.toml", &format!("{head}{}", block.body));
        assert!(read.is_ok(), "{}: {:?}", block.body, read.err());
    }
}
