//! `regatta help` has the commands and the manual.

use regatta::commands::Cli;
use regatta::manual::CHAPTERS;
use regatta::scene::SCENES;

use super::{run, stderr, stdout_of};

#[test]
fn every_chapter_of_the_manual_is_printed_unchanged() {
    for chapter in CHAPTERS.iter().filter(|chapter| chapter.id != "keys") {
        assert_eq!(stdout_of(&format!("help {}", chapter.id)), chapter.text);
    }
    // Lines break where the terminal ends.
    let list = stdout_of("help help").split_whitespace().collect::<Vec<_>>().join(" ");
    for chapter in CHAPTERS {
        assert!(list.contains(&format!(" {} {}", chapter.id, chapter.about)), "{list}");
    }
}

#[test]
fn the_chapter_of_keys_lists_them_before_the_mouse() {
    let (chapter, list) = (stdout_of("help keys"), stdout_of("list keys"));
    let mouse = chapter.strip_prefix(&format!("# Keys\n\n{list}\n")).expect("the list of keys");
    assert!(mouse.contains("Mouse: drag a body") && !mouse.contains('|'), "{mouse}");
}

#[test]
fn help_names_the_chapters() {
    let help = stdout_of("help").split_whitespace().collect::<Vec<_>>().join(" ");
    let chapters: Vec<&str> = CHAPTERS.iter().map(|chapter| chapter.id).collect();
    let named =
        format!("`regatta help CHAPTER` prints a chapter of the manual: {}.", chapters.join(", "));
    assert!(help.contains(&named), "{help}");
}

#[test]
fn a_list_or_chapter_is_printed_by_its_name_alone() {
    for list in ["keys", "scenes", "methods", "keys --format json"] {
        assert_eq!(stdout_of(list), stdout_of(&format!("list {list}")));
    }
    // A scene of that name comes first, and so does a list.
    let scenes = SCENES.iter().map(|scene| scene.name);
    let others: Vec<&str> = scenes.chain(["keys", "scenes", "methods"]).collect();
    for chapter in CHAPTERS.iter().filter(|chapter| !others.contains(&chapter.id)) {
        assert_eq!(stdout_of(chapter.id), chapter.text);
    }
}

#[test]
fn a_scene_may_be_given_without_its_option_in_every_command() {
    let read = |line: &str| {
        let words = format!("regatta {line}");
        let read = Cli::read(words.split_whitespace().map(Into::into));
        read.map(|cli| format!("{cli:?}")).map_err(|error| error.to_string())
    };
    for scene in SCENES.iter().map(|scene| scene.name).chain(["run.toml", "../mine/run.toml"]) {
        for (command, rest) in [
            #[cfg(feature = "window")]
            ("", ""),
            #[cfg(feature = "window")]
            ("play", ""),
            #[cfg(feature = "window")]
            ("", "--race --tick-hz 30"),
            ("trace", "--seconds 2"),
            ("advise", ""),
            ("sweep", ""),
            ("cloud", ""),
            ("loop", ""),
            ("capture", "--out x"),
        ] {
            let wanted = read(&format!("{command} --scene {scene} {rest}"));
            assert!(wanted.is_ok(), "{wanted:?}");
            assert_eq!(read(&format!("{command} {scene} {rest}")), wanted);
            assert_eq!(read(&format!("{command} {rest} {scene}")), wanted);
        }
    }
    // A command with other arguments treats a scene's name as one of them.
    for line in ["show spring", "diff spring ship", "identify run.toml"] {
        assert!(read(line).map_or(true, |cli| !cli.contains("scene: Some")), "{line}");
    }
}

#[test]
fn help_with_a_command_equals_its_help_option() {
    assert_eq!(stdout_of("help"), stdout_of("--help"));
    for command in ["capture", "advise", "help"] {
        assert_eq!(stdout_of(&format!("help {command}")), stdout_of(&format!("{command} --help")));
    }
}

#[test]
fn help_on_an_unknown_name_suggests_the_nearest() {
    let output = run("help scene");
    assert_eq!(output.status.code(), Some(2));
    let said = stderr(&output);
    let meant = "error: no command and no chapter is called `scene`; did you mean `scenes`?\n";
    assert!(said.starts_with(meant), "{said}");
}
