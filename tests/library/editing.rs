//! Edits during a run: they are in the journal, and a restart keeps them.

use regatta::lab::{
    Action, LaneId, LaneSpec, Mode, RunCommand, Scene, Session, StageCommand, Studio, ViewCommand,
};
use regatta::sim::integrators::{GENERAL_METHODS, method};

fn stiffness(value: f64) -> Action {
    Action::Set { body: 0, parameter: 1, value }
}

#[test]
fn dragging_a_parameter_at_one_tick_adds_few_rows_and_repeats_to_the_bit() {
    for ways in [&[50.0, 60.0, 70.0, 80.0][..], &[50.0, 60.0, 50.0, 60.0, 50.0], &[50.0, 0.0]] {
        for method in GENERAL_METHODS {
            let mut scene = Scene::built_in("spring").unwrap();
            scene.lanes = vec![LaneSpec::plain(method)];
            let scene = std::sync::Arc::new(scene);
            let mut session = Session::racing(scene.clone());
            session.run(20);
            let before = scene.bodies[0].values[1];
            for &value in ways {
                session.act(stiffness(if value == 0.0 { before } else { value }));
            }
            assert!(session.journal().rows().len() <= 3, "{:?}", session.journal());
            session.run(20);
            let mut again = Session::racing(scene);
            again.follow(session.journal().clone());
            again.run(40);
            let [hash, again] = [&session, &again].map(|session| session.race().state_hash());
            assert_eq!(hash, again, "{} by {ways:?}", method.id);
        }
    }
}

#[test]
fn a_selected_lane_stays_selected_when_its_method_changes() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    lab.apply(StageCommand::ToggleRace);
    lab.apply(StageCommand::Pick(0));
    lab.tick();
    let spec = LaneSpec::plain(method("pefrl").unwrap());
    lab.apply(RunCommand::Act(Action::Lane { lane: LaneId(1), spec }));
    assert_eq!((lab.selected().id, lab.entries()[lab.active()]), (LaneId(1), spec));
    assert!(lab.title().contains("race: PEFRL"), "{}", lab.title());
    lab.apply(RunCommand::Seek(0));
    lab.apply(RunCommand::Seek(1));
    lab.apply(StageCommand::ToggleRace);
    assert_eq!((lab.mode(), lab.selected().id), (Mode::Solo, LaneId(1)));
    lab.apply(StageCommand::Restart);
    lab.tick();
}

#[test]
fn a_race_restarts_with_the_methods_that_a_person_gave_its_lanes() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    lab.apply(StageCommand::ToggleRace);
    let methods = |lab: &Studio| -> Vec<&str> {
        let lanes = lab.race().entrants().iter();
        lanes.map(|lane| lane.spec.method.id).collect()
    };
    let opened = methods(&lab);
    for (lane, id) in [(LaneId(2), "bdf2"), (LaneId(1), "pefrl")] {
        let spec = LaneSpec { substeps: 3, ..LaneSpec::plain(method(id).unwrap()) };
        lab.apply(RunCommand::Act(Action::Lane { lane, spec }));
    }
    let given = methods(&lab);
    assert_eq!((given[0], given[1], &given[2..]), ("pefrl", "bdf2", &opened[2..]));
    lab.apply(StageCommand::Restart);
    assert_eq!(methods(&lab), given);
    assert_eq!((lab.selected().id, lab.selected().lane.substeps()), (LaneId(1), 3));
    for (lane, spec) in (1..).map(LaneId).zip(lab.scene_as_opened().lanes.clone()) {
        lab.apply(RunCommand::Act(Action::Lane { lane, spec }));
    }
    lab.apply(StageCommand::Restart);
    assert_eq!(methods(&lab), opened);
}

#[test]
fn a_new_scene_length_applies_to_plots_and_verdicts_and_stays_after_a_restart() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    let seconds = lab.scene().seconds;
    for nonsense in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e12] {
        lab.apply(RunCommand::Seconds(nonsense));
        assert_eq!(lab.scene().seconds, seconds);
    }
    lab.apply(RunCommand::Seconds(2.0 * seconds));
    lab.apply(StageCommand::Restart);
    assert_eq!(lab.scene().seconds, 2.0 * seconds);
    assert_eq!(lab.scene_as_opened().seconds, seconds);
}

#[test]
fn escape_closes_the_inspector_before_it_quits() {
    let mut lab = Studio::new(Scene::built_in("spring").unwrap());
    lab.apply(RunCommand::ToggleInspector);
    assert!(lab.display().inspector);
    assert_eq!(lab.apply(ViewCommand::Escape), None);
    assert!(!lab.display().inspector);
    assert!(lab.apply(ViewCommand::Escape).is_some());
}
