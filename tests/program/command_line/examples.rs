//! What README and the chapters of the manual print below a command is what the command prints.
#![cfg(unix)]

use std::collections::HashMap;
use std::process::Command;
use std::{env, fs, path::Path};

use regatta::manual::CHAPTERS;

/// The files of a reader's own that examples are about.
const OWN_FILES: [&str; 3] = ["spring.csv", "clip", "run.toml"];

/// Whether `said` has the lines that are `printed`, in this order. An ellipsis stands for any lines, or for the end of one.
fn has_lines(said: &str, printed: &[&str]) -> Result<(), String> {
    let mut lines = said.lines();
    let mut may_skip = false;
    for line in printed {
        if *line == "…" {
            may_skip = true;
            continue;
        }
        let is_line = |said: &str| match line.strip_suffix('…') {
            Some(begin) => said.starts_with(begin),
            None => said == *line,
        };
        let found = if may_skip { lines.any(is_line) } else { lines.next().is_some_and(is_line) };
        if !found {
            return Err(format!("not said: {line}"));
        }
        may_skip = false;
    }
    Ok(())
}

/// What a shell command prints, data first, in a folder where `regatta` is the program.
fn said_by(command: &str, folder: &Path) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_regatta")).parent().unwrap();
    let path = format!("{}:{}", program.display(), env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    shell.args(["-c", command]).current_dir(folder).env("PATH", path).env_remove("DISPLAY");
    let output = shell.output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(0), "{command}: {err}");
    // How far a long run is, is said by the way.
    let wrote = err.lines().filter(|line| line.starts_with("wrote "));
    out + &wrote.collect::<Vec<_>>().join("\n")
}

#[test]
fn every_example_with_an_answer_prints_that_answer() {
    let readme = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md"));
    let texts = CHAPTERS.iter().map(|chapter| (chapter.id, chapter.text.to_owned()));
    let folder = tempfile::tempdir().unwrap();
    let mut known: HashMap<String, String> = HashMap::new();
    let mut compared: Vec<(&str, usize)> = Vec::new();
    for (name, text) in texts.chain([("README", readme.unwrap())]) {
        let blocks = text.split("```console\n").skip(1).filter_map(|rest| rest.split_once("```"));
        let mut count = 0;
        for example in blocks.flat_map(|(block, _)| block.split("$ ").skip(1)) {
            let mut lines = example.lines().map(str::trim_start);
            let command = lines.next().unwrap();
            let printed: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
            let is_own = |word: &str| OWN_FILES.contains(&word);
            if printed.is_empty() || command.split(' ').any(is_own) {
                continue;
            }
            assert!(printed.iter().any(|line| *line != "…"), "{command}");
            let said =
                known.entry(command.into()).or_insert_with(|| said_by(command, folder.path()));
            let said: String = said
                .lines()
                .map(str::trim_start)
                .filter(|l| !l.is_empty())
                .map(|l| format!("{l}\n"))
                .collect();
            has_lines(&said, &printed).unwrap_or_else(|e| panic!("{name}: {command}: {e}\n{said}"));
            count += 1;
        }
        compared.extend((count > 0).then_some((name, count)));
    }
    assert_eq!(compared, [("commands", 2), ("questions", 19), ("code", 1), ("README", 1)]);
}

#[test]
fn a_line_that_is_not_said_is_found() {
    assert!(has_lines("a\nb\nc 1\n", &["a", "…", "c…"]).is_ok());
    assert!(has_lines("a\nb\nc 1\n", &["a", "c…"]).is_err());
    assert!(has_lines("a\n", &["a", "b"]).is_err());
}
