//! `regatta help` has the commands and the manual.

use regatta::manual::CHAPTERS;

use super::{run, run_in, stderr, stdout_of};

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

#[test]
fn the_names_that_options_had_are_taken_for_one_release_and_not_shown() {
    let engine = "--to engine-box2d";
    assert_eq!(
        stdout_of(&format!("port --want 2Hz --zeta 0.2 {engine}")),
        stdout_of(&format!("port --frequency 2 --damping-ratio 0.2 {engine}"))
    );
    let folder = tempfile::tempdir().unwrap();
    for (old, new) in [("cloud --size 0.1", "--reach"), ("loop --frames a.csv", "--frame-rows")] {
        let (command, option) = old.split_once(' ').unwrap();
        let options = "--scene spring --seconds 0.2";
        let run = run_in(folder.path(), &format!("{command} {options} {option}"));
        assert_eq!(run.status.code(), Some(0), "{}", stderr(&run));
        let help = stdout_of(&format!("help {command}"));
        let old = option.split(' ').next().unwrap();
        assert!(help.contains(new) && !help.contains(&format!("{old} <")), "{help}");
    }
}
