//! The answers in the manual's chapter `questions` are what the commands print.

use regatta::manual::chapter;

use super::run;

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

#[test]
fn every_number_in_the_chapter_comes_out_of_its_command() {
    let text = chapter("questions").unwrap().text;
    let blocks = text.split("```console\n").skip(1).filter_map(|rest| rest.split_once("```"));
    let mut commands = 0;
    for (block, _) in blocks {
        for command in block.split("$ regatta ").skip(1) {
            let mut lines = command.lines();
            let arguments = lines.next().unwrap();
            let printed: Vec<&str> = lines.collect();
            assert!(printed.iter().any(|line| *line != "…"), "{arguments}");
            let output = run(arguments);
            assert_eq!(output.status.code(), Some(0), "{arguments}");
            let said = String::from_utf8(output.stdout).unwrap();
            has_lines(&said, &printed).unwrap_or_else(|e| panic!("{arguments}: {e}\n{said}"));
            commands += 1;
        }
    }
    assert_eq!((text.matches("\n## ").count(), commands), (7, 10));
}

#[test]
fn a_line_that_is_not_said_is_found() {
    assert!(has_lines("a\nb\nc 1\n", &["a", "…", "c…"]).is_ok());
    assert!(has_lines("a\nb\nc 1\n", &["a", "c…"]).is_err());
    assert!(has_lines("a\n", &["a", "b"]).is_err());
}
