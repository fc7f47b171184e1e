//! What the lab asks of its driver when something is to be copied.

use regatta::lab::source_code::Language;
use regatta::lab::{Command, DriverRequest, Scene, Studio, ViewCommand};

#[test]
fn the_method_is_copied_while_a_lane_is_pointed_at_and_else_the_instrument() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    let instrument = Some(DriverRequest::CopyInstrument);
    assert_eq!(lab.apply(ViewCommand::Copy), instrument);
    lab.apply(ViewCommand::PointAt(Some(3)));
    assert_eq!(lab.apply(ViewCommand::Copy), Some(DriverRequest::CopyMethod(3)));
    assert_eq!(lab.apply(ViewCommand::CopyInstrument), instrument);
    lab.apply(ViewCommand::PointAt(None));
    assert_eq!(lab.apply(ViewCommand::Copy), instrument);
    // A place of a longer list.
    lab.apply(ViewCommand::PointAt(Some(999)));
    assert_eq!(lab.apply(ViewCommand::Copy), instrument);
}

#[test]
fn a_language_that_was_chosen_is_kept() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    assert_eq!(lab.viewer().language(), Language::Rust);
    let command = Command::View(ViewCommand::CopyMethod { entry: 2, language: Language::GdScript });
    assert_eq!(lab.apply(command), Some(DriverRequest::CopyMethod(2)));
    assert_eq!(lab.viewer().language(), Language::GdScript);
    let command = Command::View(ViewCommand::CopyMethod { entry: 999, language: Language::C });
    assert_eq!(lab.apply(command), None);
}
