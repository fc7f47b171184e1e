//! `regatta help` has the commands and the manual.

use regatta::manual::CHAPTERS;

use super::{run, stderr, stdout_of};

#[test]
fn every_chapter_of_the_manual_is_printed_as_it_stands() {
    for chapter in CHAPTERS {
        assert_eq!(stdout_of(&format!("help {}", chapter.id)), chapter.text);
    }
    // Lines break where the terminal ends.
    let list = stdout_of("help help").split_whitespace().collect::<Vec<_>>().join(" ");
    for chapter in CHAPTERS {
        assert!(list.contains(&format!(" {} {}", chapter.id, chapter.about)), "{list}");
    }
}

#[test]
fn help_of_a_command_is_what_the_command_says_of_itself() {
    assert_eq!(stdout_of("help"), stdout_of("--help"));
    for command in ["capture", "advise", "help"] {
        assert_eq!(stdout_of(&format!("help {command}")), stdout_of(&format!("{command} --help")));
    }
}

#[test]
fn help_of_what_there_is_not_names_what_there_is() {
    let output = run("help scene");
    assert_eq!(output.status.code(), Some(2));
    let said = stderr(&output);
    let meant = "error: no command and no chapter is called `scene`; did you mean `scenes`?\n";
    assert!(said.starts_with(meant), "{said}");
}
