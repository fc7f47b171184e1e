//! Solo and race: the lanes, their methods, and the settings that a restart keeps.

use regatta::run::race::{Lane, Mode};
use regatta::scene::{Action, LaneSpec, Scene};
use regatta::sim::Solver;
use regatta::sim::integrators::{GENERAL_METHODS, method};
use regatta::studio::{Command, RunCommand, StageCommand, Step, Studio};

fn scene(name: &str) -> Scene {
    Scene::built_in(name).expect("a built-in scene")
}

fn bits(lane: &Lane) -> Vec<u64> {
    let values =
        lane.bodies().iter().flat_map(|body| body.stepper.q().iter().chain(body.stepper.v()));
    values.map(|value| value.to_bits()).collect()
}

#[test]
fn entering_and_leaving_a_race_keeps_the_selected_method() {
    let mut studio = Studio::new(scene("spring"));
    for method in GENERAL_METHODS {
        studio.apply(StageCommand::Method(method));
        studio.apply(StageCommand::ToggleRace);
        assert_eq!(studio.mode(), Mode::Race);
        let guest = studio.scene().lanes.iter().all(|spec| spec.method != method);
        assert_eq!(studio.race().entrants().len(), studio.scene().lanes.len() + usize::from(guest));
        for _ in 0..50 {
            studio.tick();
        }
        let active = studio.active();
        let mut entrants = studio.race().entrants().iter();
        let selected = &entrants.find(|entrant| studio.entry(entrant) == active).unwrap().lane;
        assert_eq!(selected.solver(), Solver::Method(method));
        let before = bits(selected);
        studio.apply(StageCommand::ToggleRace);
        assert_eq!(studio.race().entrants().len(), 1);
        let lane = &studio.race().entrants()[0].lane;
        assert_eq!((lane.solver(), bits(lane)), (Solver::Method(method), before));
    }
}

#[test]
fn a_race_has_the_scenes_lanes_and_the_last_method_only() {
    let text = "title = \"pair\"\ntick_hz = 60\nseconds = 5\nmethods = [\"rk4\", \"improved-euler\"]\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";
    let racing = |studio: &Studio| {
        studio.race().entrants().iter().map(|e| studio.entry(e)).collect::<Vec<_>>()
    };
    let mut studio = Studio::new(Scene::parse("pair.toml", text).unwrap());
    assert_eq!(studio.entries().len(), GENERAL_METHODS.len(), "every method can be flown");
    studio.apply(StageCommand::ToggleRace);
    assert_eq!(racing(&studio), [0, 1]);
    for _ in 0..30 {
        studio.tick();
    }
    studio.apply(StageCommand::Pick(3));
    assert_eq!((studio.race().tick(), racing(&studio), studio.active()), (30, vec![0, 1], 0));
    studio.apply(StageCommand::MethodBeside(Step::Previous));
    assert_eq!(studio.active(), 1);
    studio.apply(StageCommand::MethodBeside(Step::Next));
    assert_eq!(studio.active(), 0);

    studio.apply(StageCommand::ToggleRace);
    studio.apply(StageCommand::Pick(3));
    let lane = &studio.race().entrants()[0].lane;
    assert_eq!(lane.solver(), Solver::Method(studio.entries()[3].method));
    studio.apply(StageCommand::ToggleRace);
    assert_eq!((racing(&studio), studio.active()), (vec![0, 1, 3], 3));
}

#[test]
fn throttle_and_rudder_move_in_tenths_within_limits_until_a_restart() {
    let mut studio = Studio::new(scene("helm"));
    assert!(
        studio.race().takes_input("rudder")
            && studio.race().takes_input("throttle")
            && !studio.race().takes_input("anchor")
    );
    assert_eq!((studio.race().rudder(), studio.race().throttle()), (0.0, 1.0));
    for (command, times, rudder) in [
        (Command::Run(RunCommand::RudderLeft), 3, 0.3),
        (Command::Run(RunCommand::RudderRight), 3, 0.0),
        (Command::Run(RunCommand::RudderRight), 14, -1.0),
        (Command::Run(RunCommand::RudderLeft), 10, 0.0),
        (Command::Run(RunCommand::Act(Action::Rudder(7.0))), 1, 1.0),
    ] {
        for _ in 0..times {
            studio.apply(command.clone());
        }
        assert_eq!(studio.race().rudder(), rudder);
    }
    for _ in 0..10 {
        studio.tick();
    }
    let heading = |studio: &Studio| studio.race().entrants()[0].lane.bodies()[0].stepper.q()[2];
    assert!(heading(&studio) > 0.1, "left is counter-clockwise");
    studio.apply(StageCommand::Restart);
    assert_eq!((studio.race().rudder(), heading(&studio)), (0.0, 0.0));
    assert!(!Studio::new(scene("ship")).race().takes_input("rudder"));
}

#[test]
fn a_lane_adopts_advised_substeps_in_flight_and_keeps_them() {
    let spec = |substeps| LaneSpec { substeps, ..LaneSpec::plain(method("rk4").unwrap()) };
    let mut studio = Studio::new(Scene::built_in("stiff").unwrap());
    (0..10).for_each(|_| studio.tick());
    let before = studio.race().entrants()[0].lane.bodies()[0].stepper.q().to_vec();
    studio.apply(RunCommand::SetLane(spec(8)));
    let lane = &studio.race().entrants()[0].lane;
    assert_eq!((lane.solver(), lane.substeps()), (spec(8).solver(), 8));
    assert_eq!(lane.bodies()[0].stepper.q(), before);
    assert_eq!(studio.entries()[studio.active()], spec(8));
    studio.apply(StageCommand::Restart);
    assert_eq!(studio.race().entrants()[0].lane.substeps(), 8);
    // In a race the method's own lane takes them, and the others continue.
    studio.apply(StageCommand::ToggleRace);
    (0..10).for_each(|_| studio.tick());
    studio.apply(RunCommand::SetLane(spec(4)));
    let substeps = studio.race().entrants().iter().map(|entrant| entrant.lane.substeps());
    assert_eq!(substeps.collect::<Vec<_>>(), [1, 1, 1, 4, 1]);
    // One that is not in the race is taken in.
    studio.apply(RunCommand::SetLane(LaneSpec {
        substeps: 3,
        ..LaneSpec::plain(method("pefrl").unwrap())
    }));
    assert_eq!(studio.viewer.notice.as_deref(), Some("the race restarted with PEFRL in it"));
    assert_eq!((studio.race().tick(), studio.race().entrants().len()), (0, 6));
    assert_eq!(studio.entries()[studio.active()].substeps, 3);
}
