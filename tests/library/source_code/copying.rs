//! What the studio asks of its driver when something is to be copied.

use regatta::scene::Scene;
use regatta::studio::{Command, DriverRequest, Studio, ViewCommand};
use regatta::tools::source_code::Language;

#[test]
fn the_method_is_copied_while_a_lane_is_pointed_at_and_else_the_instrument() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    let instrument = Some(DriverRequest::CopyInstrument);
    assert_eq!(studio.apply(ViewCommand::Copy), instrument);
    studio.apply(ViewCommand::PointAt(Some(3)));
    assert_eq!(studio.apply(ViewCommand::Copy), Some(DriverRequest::CopyMethod(3)));
    assert_eq!(studio.apply(DriverRequest::CopyInstrument), instrument);
    studio.apply(ViewCommand::PointAt(None));
    assert_eq!(studio.apply(ViewCommand::Copy), instrument);
    // A place of a longer list.
    studio.apply(ViewCommand::PointAt(Some(999)));
    assert_eq!(studio.apply(ViewCommand::Copy), instrument);
}

#[test]
fn a_language_that_was_chosen_is_kept() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    assert_eq!(studio.viewer.language(), Language::Rust);
    let command = Command::View(ViewCommand::CopyMethod { entry: 2, language: Language::GdScript });
    assert_eq!(studio.apply(command), Some(DriverRequest::CopyMethod(2)));
    assert_eq!(studio.viewer.language(), Language::GdScript);
    let command = Command::View(ViewCommand::CopyMethod { entry: 999, language: Language::C });
    assert_eq!(studio.apply(command), None);
}
