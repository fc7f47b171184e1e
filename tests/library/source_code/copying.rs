//! The studio's requests to its driver for copying.

use regatta::scene::Scene;
use regatta::studio::{Command, DriverRequest, Studio, ViewCommand};
use regatta::tools::source_code::Language;

#[test]
fn copying_takes_the_hovered_lanes_method_or_else_the_instrument() {
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
fn the_chosen_language_is_remembered() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    assert_eq!(studio.viewer.language(), Language::Rust);
    let command = Command::View(ViewCommand::CopyMethod { entry: 2, language: Language::GdScript });
    assert_eq!(studio.apply(command), Some(DriverRequest::CopyMethod(2)));
    assert_eq!(studio.viewer.language(), Language::GdScript);
    let command = Command::View(ViewCommand::CopyMethod { entry: 999, language: Language::C });
    assert_eq!(studio.apply(command), None);
}
