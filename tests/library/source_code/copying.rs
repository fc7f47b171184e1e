//! What the lab asks of its driver when something is to be copied.

use regatta::lab::{Command, DriverRequest, Lab, Language, Scene};

#[test]
fn the_method_is_copied_while_a_lane_is_pointed_at_and_else_the_instrument() {
    let mut lab = Lab::new(Scene::built_in("spring").unwrap());
    let instrument = Some(DriverRequest::CopyInstrument);
    assert_eq!(lab.apply(Command::Copy), instrument);
    lab.apply(Command::PointAt(Some(3)));
    assert_eq!(lab.apply(Command::Copy), Some(DriverRequest::CopyMethod(3)));
    assert_eq!(lab.apply(Command::CopyInstrument), instrument);
    lab.apply(Command::PointAt(None));
    assert_eq!(lab.apply(Command::Copy), instrument);
    // A place of a longer list.
    lab.apply(Command::PointAt(Some(999)));
    assert_eq!(lab.apply(Command::Copy), instrument);
}

#[test]
fn a_language_that_was_chosen_is_kept() {
    let mut lab = Lab::new(Scene::built_in("spring").unwrap());
    assert_eq!(lab.viewer().language(), Language::Rust);
    let command = Command::CopyMethod { entry: 2, language: Language::GdScript };
    assert_eq!(lab.apply(command), Some(DriverRequest::CopyMethod(2)));
    assert_eq!(lab.viewer().language(), Language::GdScript);
    let command = Command::CopyMethod { entry: 999, language: Language::C };
    assert_eq!(lab.apply(command), None);
}
