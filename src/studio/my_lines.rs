//! A person's own lines, typed or pasted in the window: a rule opens as a scene at three frame rates, a method races in
//! the open scene, and a loop runs beside those of the loop lab.

use std::path::Path;

use super::Studio;
use super::looping::{open_own_loop, read_own_loop};
use super::opening::{open_as, race_own_method};
use super::viewer::{Dialog, ReadLines, Viewer};
use crate::run::race::Mode;
use crate::scene::{LaneSpec, SceneErrors, is_rule};
use crate::sim::law::LoopText;
use crate::tools::Rule;
use crate::tools::rule::rule_scene;

/// Name that a rule's scene has on the list of scenes.
const MY_LINES: &str = "my lines";
/// Name of the lines in messages, as that of a file.
const NAME: &str = "mine.step";
const LOOP_NAME: &str = "mine.loop";
/// Frames per second for which a rule is written.
const FPS: u32 = 60;

/// Reads the lines of the dialog after a change.
pub(super) fn read_lines(viewer: &mut Viewer, text: String) {
    let mut read = ReadLines::default();
    if is_loop(&text) {
        let fault = LoopText::read(&text).err();
        read.report =
            fault.map_or(vec![], |fault| SceneErrors::of_step(LOOP_NAME, &text, fault).into());
    } else if is_rule(text.as_bytes()) {
        match Rule::read(&text, FPS.into()) {
            Ok(rule) => read.code = rule.code(&text, viewer.language()).ok().map(|code| code.text),
            Err(fault) => read.report = SceneErrors::of_step(NAME, &text, fault).into(),
        }
    }
    viewer.preferences.my_lines = text;
    viewer.dialog = Some(Dialog::Lines(read));
}

/// Whether the lines make ticks.
fn is_loop(text: &str) -> bool {
    text.split(['\n', ';', '{', '}']).any(|part| part.trim_start().starts_with("tick "))
}

/// Runs the lines, or reports their faults in the dialog.
pub(super) fn run_lines(studio: &mut Studio) {
    let text = studio.viewer.preferences.my_lines.clone();
    let done = match is_rule(text.as_bytes()) {
        _ if is_loop(&text) => read_own_loop(Path::new(LOOP_NAME), text.into()).map(|(card, _)| {
            studio.viewer.dialog = None;
            open_own_loop(studio, card);
        }),
        true => rule_scene(NAME, &text, FPS.into())
            .map(|scene| {
                studio.loops = None;
                open_as(studio, MY_LINES, scene, Mode::Race);
            })
            .map_err(Vec::from),
        false => LaneSpec::from_step(NAME, text.as_bytes())
            .map(|lane| race_own_method(studio, lane))
            .map_err(Vec::from),
    };
    if let Err(report) = done {
        studio.viewer.dialog = Some(Dialog::Lines(ReadLines { report, code: None }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ViewCommand;
    use crate::scene::Scene;
    use crate::viewer::EXAMPLE;

    fn typed(text: &str) -> Studio {
        let mut studio = Studio::new(Scene::built_in("spring").unwrap());
        studio.apply(ViewCommand::AskForLines);
        studio.apply(ViewCommand::TypeLines(text.into()));
        studio
    }

    fn read(studio: &Studio) -> ReadLines {
        match studio.viewer.dialog() {
            Some(Dialog::Lines(read)) => read.clone(),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_pasted_rule_has_its_closed_form_and_runs_at_three_frame_rates() {
        let mut studio = typed(EXAMPLE);
        assert!(read(&studio).code.is_some_and(|code| code.contains("closed form")));
        studio.apply(ViewCommand::RunLines);
        assert_eq!((studio.mode(), studio.race().entrants().len()), (Mode::Race, 3));
        assert!(studio.running() && studio.viewer.dialog().is_none());
        assert_eq!(studio.deck.scene_name(), "my lines");
    }

    #[test]
    fn a_pasted_loop_runs_in_the_lab_and_is_edited_while_it_runs() {
        let mut studio =
            typed("memory owed = 0\nowed += dt\nwhile owed >= H { tick 1; owed -= H }");
        studio.apply(ViewCommand::RunLines);
        let engine = |studio: &Studio| studio.loop_lab().unwrap().engine().unwrap().clone();
        assert!(engine(&studio).has_fixed_tick && studio.viewer.dialog().is_none());
        studio.apply(ViewCommand::AskForLines);
        studio.apply(ViewCommand::TypeLines("tick 1 of dtt".into()));
        assert!(read(&studio).report[0].message.starts_with("mine.loop:1:11: unknown name `dtt`"));
        studio.apply(ViewCommand::TypeLines("tick 1 of dt".into()));
        studio.apply(ViewCommand::RunLines);
        assert!(!engine(&studio).has_fixed_tick && studio.viewer.dialog().is_none());
        assert_eq!(studio.viewer.notice.as_deref(), Some("mine: reloaded"));
    }

    #[test]
    fn a_pasted_method_races_in_the_open_scene_and_a_fault_stays_in_the_dialog() {
        let mut studio = typed("v += h * a(x, v)\nx += h * v\n");
        studio.apply(ViewCommand::RunLines);
        assert_eq!(studio.deck.scene_name(), "spring");
        assert_eq!(studio.selected().spec.method.id, "mine");
        let mut studio = typed("v += h * a(x, v)\nx += h * w\n");
        studio.apply(ViewCommand::RunLines);
        let report = read(&studio).report;
        assert!(report[0].message.starts_with("mine.step:2:10: unknown name `w`"), "{report:?}");
    }
}
