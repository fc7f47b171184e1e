//! `show`: a method as a function, or a game loop, in the languages of both.

use std::io::Read as _;
use std::process::Stdio;

use regatta::loops::{engine, policy};
use regatta::manual::chapter;
use regatta::sim::integrators::METHODS;
use regatta::tools::source_code::{Language, Precision, loop_code, source_code};

use super::{refusal, regatta, run, stdout_of};

#[test]
fn every_method_is_shown_in_every_language() {
    for method in METHODS {
        for language in Language::ALL {
            let arguments = format!("show {} --as {}", method.id, language.id());
            match source_code(method, language, Precision::Double) {
                Ok(code) => assert_eq!(stdout_of(&arguments), code),
                Err(refused) => {
                    assert!(refusal(&arguments, 2).contains(&refused.reason), "{refused}")
                }
            }
        }
    }
}

#[test]
fn every_loop_is_shown_in_every_language() {
    for id in ["fixed", "hysteresis", "bevy"] {
        let card = policy(id).or_else(|| engine(id)).unwrap();
        for language in Language::ALL {
            let code = loop_code(id, card.lines().unwrap(), language).unwrap();
            assert_eq!(stdout_of(&format!("show {id} --as {}", language.id())), code);
        }
        assert_eq!(stdout_of(&format!("show {id} --as step")), card.lines().unwrap());
    }
    assert_eq!(stdout_of("show fixed"), stdout_of("show fixed --as rust"));
    assert_eq!(stdout_of("show bevy"), stdout_of("show bevy --as step"));
    assert_eq!(stdout_of("show bevy --as cpp"), stdout_of("show bevy --as c"));
    assert!(refusal("show fixed --float", 2).contains("--float is for methods"));
    assert_eq!(stdout_of("show rk4 --as cpp"), stdout_of("show rk4 --as c"));
}

#[test]
fn without_a_language_a_method_is_shown_in_rust() {
    assert_eq!(stdout_of("show rk4"), stdout_of("show rk4 --as rust"));
}

#[test]
fn an_alias_shows_its_method_with_a_note() {
    let aliases = METHODS.iter().flat_map(|m| m.also.iter().map(move |alias| (m, *alias)));
    let aliases: Vec<_> = aliases.collect();
    assert!(aliases.iter().any(|(_, alias)| *alias == "xpbd"), "{aliases:?}");
    for (method, alias) in aliases {
        let shown = run(&format!("show {alias} --as c"));
        assert_eq!(
            String::from_utf8(shown.stdout).unwrap(),
            stdout_of(&format!("show {} --as c", method.id))
        );
        let note = format!("note: {alias} is another name of {}, which is shown\n", method.id);
        assert_eq!(
            (shown.status.code(), String::from_utf8(shown.stderr).unwrap()),
            (Some(0), note)
        );
        // A scene has one name for a method.
        let raced = refusal(&format!("trace --scene spring --method {alias}"), 2);
        assert!(raced.contains(&format!("did you mean {}?", method.id)), "{raced}");
    }
}

#[test]
fn a_misspelt_name_gets_the_nearest_suggestion() {
    for (arguments, said) in [
        ("show", "<METHOD|POLICY|FILE>"),
        (
            "show rk5",
            "did you mean rk4? `regatta list methods`, `regatta list policies` and `regatta list impacts` name all",
        ),
        ("show runge-kutta", "did you mean rk4?"),
        ("show x", "no such method, policy or rule. `regatta list methods`"),
        ("show fixed-liner", "did you mean fixed-linear?"),
        ("show rk4 --as cobol", "There are rust, c, csharp, gdscript, javascript, lua, cpp"),
        ("show rk4 --as csharpp", "did you mean csharp?"),
    ] {
        let said_so = refusal(arguments, 2);
        assert!(said_so.contains(said), "{arguments}: {said_so}");
    }
}

#[test]
fn a_pipe_that_closes_early_ends_show_quietly() {
    let mut command = regatta();
    command.args(["show", "dormand-prince-54"]).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    drop(child.stdout.take());
    let mut said = String::new();
    child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
    assert_eq!((child.wait().unwrap().code(), &*said), (Some(0), ""));
}

#[test]
fn the_manual_shows_the_printed_code() {
    let (_, example) = chapter("code")
        .unwrap()
        .text
        .split_once("$ regatta show position-verlet --as csharp\n")
        .unwrap();
    let (shown, _) = example.split_once("```").unwrap();
    assert_eq!(stdout_of("show position-verlet --as csharp"), shown);
}

#[test]
fn completions_name_the_command_and_its_languages() {
    for shell in ["bash", "fish", "zsh"] {
        let script = stdout_of(&format!("completions {shell}"));
        assert!(script.contains("gdscript"), "{shell}");
    }
    let help = run("--help");
    assert!(String::from_utf8(help.stdout).unwrap().contains("\n  show "));
}
