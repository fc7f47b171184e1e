//! A person's own lines, typed or pasted in the window: a rule opens as a scene at three frame rates, a method races in
//! the open scene.

use super::Studio;
use super::opening::{open_as, race_own_method};
use super::viewer::{Dialog, ReadLines, Viewer};
use crate::run::race::Mode;
use crate::scene::{LaneSpec, SceneErrors, is_rule};
use crate::tools::Rule;
use crate::tools::rule::rule_scene;

/// Name that a rule's scene has on the list of scenes.
const MY_LINES: &str = "my lines";
/// Name of the lines in messages, as that of a file.
const NAME: &str = "mine.step";
/// Frames per second for which a rule is written.
const FPS: u32 = 60;

/// Reads the lines of the dialog after a change.
pub(super) fn read_lines(viewer: &mut Viewer, text: String) {
    let mut read = ReadLines::default();
    if is_rule(text.as_bytes()) {
        match Rule::read(&text, FPS.into()) {
            Ok(rule) => read.code = rule.code(&text, viewer.language()).ok().map(|code| code.text),
            Err(fault) => read.report = SceneErrors::of_step(NAME, &text, fault).into(),
        }
    }
    viewer.preferences.my_lines = text;
    viewer.dialog = Some(Dialog::Lines(read));
}

/// Runs the lines, or reports their faults in the dialog.
pub(super) fn run_lines(studio: &mut Studio) {
    let text = studio.viewer.preferences.my_lines.clone();
    let done = match is_rule(text.as_bytes()) {
        true => rule_scene(NAME, &text, FPS.into()).map(|scene| {
            studio.loops = None;
            open_as(&mut studio.deck, &mut studio.viewer, MY_LINES, scene, Mode::Race);
        }),
        false => {
            LaneSpec::from_step(NAME, text.as_bytes()).map(|lane| race_own_method(studio, lane))
        }
    };
    if let Err(errors) = done {
        let report = errors.into();
        studio.viewer.dialog = Some(Dialog::Lines(ReadLines { report, code: None }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::studio::ViewCommand;
    use crate::studio::viewer::EXAMPLE;

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
