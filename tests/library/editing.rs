//! Edits during a run: they are in the journal, and a restart keeps them.

use regatta::run::Session;
use regatta::run::race::Mode;
use regatta::scene::{Action, LaneId, LaneSpec, Scene};
use regatta::sim::integrators::{GENERAL_METHODS, method};
use regatta::studio::{RunCommand, StageCommand, Studio};

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
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(StageCommand::ToggleRace);
    studio.apply(StageCommand::Pick(0));
    studio.tick();
    let spec = LaneSpec::plain(method("pefrl").unwrap());
    studio.apply(RunCommand::Act(Action::Lane { lane: LaneId(1), spec }));
    assert_eq!((studio.selected().id, studio.selected().spec), (LaneId(1), spec));
    assert!(studio.title().contains("race: Explicit Euler → PEFRL"), "{}", studio.title());
    studio.apply(RunCommand::Seek(0));
    studio.apply(RunCommand::Seek(1));
    studio.apply(StageCommand::ToggleRace);
    assert_eq!((studio.mode(), studio.selected().id), (Mode::Solo, LaneId(1)));
    studio.apply(StageCommand::Restart);
    studio.tick();
}

#[test]
fn a_race_restarts_with_the_methods_that_a_person_gave_its_lanes() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    studio.apply(StageCommand::ToggleRace);
    let methods = |studio: &Studio| -> Vec<&str> {
        let lanes = studio.race().entrants().iter();
        lanes.map(|lane| lane.spec.method.id).collect()
    };
    let opened = methods(&studio);
    for (lane, id) in [(LaneId(2), "bdf2"), (LaneId(1), "pefrl")] {
        let spec = LaneSpec { substeps: 3, ..LaneSpec::plain(method(id).unwrap()) };
        studio.apply(RunCommand::Act(Action::Lane { lane, spec }));
    }
    let given = methods(&studio);
    assert_eq!((given[0], given[1], &given[2..]), ("pefrl", "bdf2", &opened[2..]));
    studio.apply(StageCommand::Restart);
    assert_eq!(methods(&studio), given);
    assert_eq!((studio.selected().id, studio.selected().lane.substeps()), (LaneId(1), 3));
    for (lane, spec) in (1..).map(LaneId).zip(studio.deck.scene_as_opened().lanes.clone()) {
        studio.apply(RunCommand::Act(Action::Lane { lane, spec }));
    }
    studio.apply(StageCommand::Restart);
    assert_eq!(methods(&studio), opened);
}

#[test]
fn a_new_scene_length_survives_a_restart_and_nonsense_is_ignored() {
    let mut studio = Studio::new(Scene::built_in("spring").unwrap());
    let seconds = studio.scene().seconds;
    for nonsense in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e12] {
        studio.apply(RunCommand::Seconds(nonsense));
        assert_eq!(studio.scene().seconds, seconds);
    }
    studio.apply(RunCommand::Seconds(2.0 * seconds));
    studio.apply(StageCommand::Restart);
    assert_eq!(studio.scene().seconds, 2.0 * seconds);
    assert_eq!(studio.deck.scene_as_opened().seconds, seconds);
}
