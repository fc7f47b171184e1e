use super::*;
use crate::lab::source_code::Language;
use crate::lab::{
    Action, Command, Mode, RunCommand, SCENES, StageCommand, Step, View, ViewCommand,
};

fn text(name: &str) -> &'static str {
    SCENES.iter().find(|scene| scene.name == name).unwrap().text
}

fn scene(text: &str) -> Scene {
    Scene::parse("boat/ship.toml", text).unwrap()
}

const PATH: &str = "boat/ship.toml";

/// A lab that runs the file's scene.
fn lab(text: &str) -> Studio {
    let mut lab = Studio::new(Scene::built_in("harbour").unwrap());
    lab.open_file(Path::new(PATH), scene(text));
    lab
}

#[test]
fn a_file_stays_on_the_list_and_does_not_pass_for_a_built_in_scene() {
    let mut lab = lab(text("ship"));
    assert!(lab.title().starts_with("Regatta - ship.toml - "), "{}", lab.title());
    assert_eq!(lab.scene_list().open(), Some(SCENES.len()));
    lab.apply(StageCommand::SceneBeside(Step::Next));
    assert!(lab.title().starts_with("Regatta - harbour - "), "{}", lab.title());
    lab.apply(StageCommand::SceneBeside(Step::Previous));
    assert!(lab.title().starts_with("Regatta - ship.toml - "), "{}", lab.title());
    lab.apply(StageCommand::SceneBeside(Step::Previous));
    assert_eq!(lab.scene_list().open(), Some(SCENES.len() - 1));
    for _ in 0..=SCENES.len() {
        lab.apply(StageCommand::SceneBeside(Step::Next));
    }
    assert_eq!(lab.scene_list().open(), Some(SCENES.len() - 1), "round");
}

#[test]
fn a_changed_file_with_the_same_lanes_and_bodies_is_run_again_to_the_tick() {
    let before = text("spring");
    let after = before.replacen("mass_kg = ", "mass_kg = 1", 1);
    assert_ne!(before, after);
    let mut old = lab(before);
    old.apply(StageCommand::ToggleRace);
    old.apply(StageCommand::Pick(2));
    old.apply(ViewCommand::ZoomPan {
        body: 0,
        zoom_pan: crate::lab::ZoomPan::default().zoomed(2.0, [0.0; 2]),
    });
    (0..50).for_each(|_| old.tick());
    old.apply(RunCommand::Act(Action::Kick(1.0)));
    let kicked = old.race().state_hash();
    old.reload_file(Path::new(PATH), scene(&after));
    assert_eq!(
        old.viewer().notice.as_deref(),
        Some(
            "ship.toml: reloaded and rerun to tick 50 (your kicks and edits left out; Ctrl Z: old run)"
        )
    );
    assert_eq!((old.mode(), old.active()), (Mode::Race, 2));
    assert_eq!(old.view().zoom_pan(0).zoom(), 2.0);

    let mut new = lab(&after);
    new.apply(StageCommand::ToggleRace);
    (0..50).for_each(|_| new.tick());
    assert_eq!(old.race().state_hash(), new.race().state_hash());
    old.apply(RunCommand::Undo);
    assert_eq!(old.race().state_hash(), kicked);
}

#[test]
fn a_file_that_changes_in_comments_only_leaves_the_run_and_its_journal_alone() {
    let mut lab = lab(text("spring"));
    (0..50).for_each(|_| lab.tick());
    lab.apply(RunCommand::Act(Action::Kick(1.0)));
    let (hash, rows) = (lab.race().state_hash(), lab.race().journal().rows().len());
    lab.reload_file(Path::new(PATH), scene(&format!("# A remark.\n{}", text("spring"))));
    let notice = "ship.toml saved; nothing that matters changed";
    assert_eq!(lab.viewer().notice.as_deref(), Some(notice));
    assert_eq!(lab.race().state_hash(), hash);
    assert_eq!((lab.race().tick(), lab.race().journal().rows().len()), (50, rows));
}

#[test]
fn a_changed_file_with_other_bodies_or_lanes_begins_again() {
    let before = text("spring");
    for after in
        [text("harbour").to_owned(), before.replacen("\"rk4\", ", "", 1), text("ship").to_owned()]
    {
        assert_ne!(before, after);
        let mut lab = lab(before);
        (0..50).for_each(|_| lab.tick());
        lab.reload_file(Path::new(PATH), scene(&after));
        assert_eq!(lab.race().tick(), 0);
        assert!(lab.viewer().notice.as_deref().unwrap().contains("from the start"));
    }
}

#[test]
fn a_rate_that_nobody_chose_follows_the_file_and_one_that_was_chosen_stays() {
    let before = text("spring");
    let after = before.replacen("tick_hz = 60", "tick_hz = 50", 1);
    assert_ne!(before, after);
    for (chosen, rate) in [(None, 50), (Some(120), 120)] {
        let mut lab = lab(before);
        if let Some(hz) = chosen {
            lab.apply(StageCommand::TickHz(hz));
        }
        lab.reload_file(Path::new(PATH), scene(&after));
        assert_eq!(lab.race().tick_hz(), rate);
    }
}

#[test]
fn a_path_that_is_refused_stays_in_its_field_with_the_reason_until_it_is_edited() {
    let mut lab = lab(text("spring"));
    let refused = |lab: &Studio| match lab.viewer().dialog() {
        Some(Dialog::Path { refused }) => refused.clone(),
        other => panic!("{other:?}"),
    };
    lab.apply(ViewCommand::AskForPath);
    lab.apply(ViewCommand::TypePath("boat/none.toml".into()));
    assert_eq!(
        lab.apply(ViewCommand::OpenTypedPath),
        Some(crate::lab::DriverRequest::OpenTypedPath)
    );
    lab.refuse_typed_path(Path::new("boat/none.toml"), vec!["no such file".into()]);
    assert_eq!(lab.viewer().typed_path(), "boat/none.toml");
    assert_eq!(refused(&lab), Some(vec!["no such file".into()]));
    lab.apply(ViewCommand::TypePath("boat/none.toml".into()));
    assert!(refused(&lab).is_some());
    lab.apply(ViewCommand::TypePath("boat/non.toml".into()));
    assert_eq!(refused(&lab), None);
    lab.open_file(Path::new(PATH), scene(text("ship")));
    assert_eq!(lab.viewer().dialog(), None);
}

#[test]
fn a_file_that_goes_and_comes_back_is_told_by_its_name() {
    let mut lab = lab(text("spring"));
    lab.file_is_gone(Path::new(PATH));
    assert!(lab.viewer().notice.as_deref().unwrap().starts_with("ship.toml is gone: "));
    lab.file_is_back(Path::new(PATH));
    assert_eq!(lab.viewer().notice.as_deref(), Some("ship.toml is back, unchanged"));
}

#[test]
fn a_broken_file_shows_its_mistakes_and_the_run_goes_on() {
    let mut lab = lab(text("spring"));
    (0..50).for_each(|_| lab.tick());
    let hash = lab.race().state_hash();
    lab.reload_failed(Path::new(PATH), vec!["boat/ship.toml:1:1: no".into()]);
    let shown = |lab: &Studio| matches!(lab.viewer().dialog(), Some(Dialog::Mistakes { .. }));
    assert!(shown(&lab) && lab.race().state_hash() == hash);
    assert_eq!(lab.apply(ViewCommand::Escape), None);
    assert!(!shown(&lab));
    // Whoever comes back to it is told again.
    lab.apply(StageCommand::SceneBeside(Step::Next));
    assert!(!shown(&lab));
    lab.apply(StageCommand::SceneBeside(Step::Previous));
    assert!(shown(&lab));
    lab.reload_file(Path::new(PATH), scene(text("spring")));
    assert!(!shown(&lab));
    // Of a file that is not open, nothing is shown yet.
    lab.apply(StageCommand::SceneBeside(Step::Next));
    lab.reload_failed(Path::new(PATH), vec!["boat/ship.toml:1:1: no".into()]);
    assert!(!shown(&lab));
}

#[test]
fn the_memory_for_rewinding_is_that_of_every_scene_that_is_opened() {
    let mut lab = Studio::new(Scene::built_in("harbour").unwrap());
    lab.set_rewind_bytes(1 << 20);
    lab.apply(StageCommand::SceneBeside(Step::Next));
    assert_eq!(lab.timeline().limit(), 1 << 20);
    lab.open_file(Path::new(PATH), scene(text("stiff")));
    assert_eq!(lab.timeline().limit(), 1 << 20);
    for _ in 0..20_000 {
        lab.tick();
        assert!(lab.timeline().bytes() <= 1 << 20, "{}", lab.timeline().bytes());
    }
}

#[test]
fn what_a_person_prefers_survives_a_scene_and_where_they_look_does_not() {
    let mut lab = Studio::new(Scene::built_in("harbour").unwrap());
    let chosen = lab.viewer().preferences.clone();
    for command in [
        Command::Stage(StageCommand::Body(1)),
        Command::Run(RunCommand::MapParameter(0)),
        Command::View(ViewCommand::CopyMethod { entry: 0, language: Language::GdScript }),
        Command::View(ViewCommand::ToggleTheme),
        Command::View(ViewCommand::ToggleGhost),
        Command::View(ViewCommand::Scale(Step::Next)),
        Command::View(ViewCommand::TypePath("boat.toml".into())),
    ] {
        lab.apply(command);
    }
    let (preferences, view) = (format!("{:?}", lab.viewer().preferences), lab.view().clone());
    assert!(preferences != format!("{chosen:?}") && view != View::default());
    lab.apply(StageCommand::SceneBeside(Step::Next));
    assert_eq!(format!("{:?}", lab.viewer().preferences), preferences);
    assert_eq!(lab.viewer().language(), Language::GdScript);
    assert_eq!(*lab.view(), View::default());
}
