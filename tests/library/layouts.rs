//! Solo and race: which lanes there are, what they are under, and what a restart keeps of it.

use regatta::lab::{
    Action, Command, Lane, LaneSpec, Mode, RunCommand, Scene, StageCommand, Step, Studio,
};
use regatta::sim::Solver;
use regatta::sim::integrators::{GENERAL_METHODS, method};

fn scene(name: &str) -> Scene {
    Scene::built_in(name).expect("a built-in scene")
}

fn bits(lane: &Lane) -> Vec<u64> {
    let values =
        lane.bodies().iter().flat_map(|body| body.stepper.q().iter().chain(body.stepper.v()));
    values.map(|value| value.to_bits()).collect()
}

#[test]
fn solo_to_race_and_back_flies_the_method_that_was_selected() {
    let mut lab = Studio::new(scene("spring"));
    for method in GENERAL_METHODS {
        lab.apply(StageCommand::Method(method));
        lab.apply(StageCommand::ToggleRace);
        assert_eq!(lab.mode(), Mode::Race);
        let guest = lab.scene().lanes.iter().all(|spec| spec.method != method);
        assert_eq!(lab.race().entrants().len(), lab.scene().lanes.len() + usize::from(guest));
        for _ in 0..50 {
            lab.tick();
        }
        let active = lab.active();
        let mut entrants = lab.race().entrants().iter();
        let selected = &entrants.find(|entrant| lab.entry(entrant) == active).unwrap().lane;
        assert_eq!(selected.solver(), Solver::Method(method));
        let before = bits(selected);
        lab.apply(StageCommand::ToggleRace);
        assert_eq!(lab.race().entrants().len(), 1);
        let lane = &lab.race().entrants()[0].lane;
        assert_eq!((lane.solver(), bits(lane)), (Solver::Method(method), before));
    }
}

#[test]
fn a_race_is_of_the_scenes_lanes_and_of_the_method_last_flown_and_takes_no_others() {
    let text = "title = \"pair\"\ntick_hz = 60\nseconds = 5\nmethods = [\"rk4\", \"improved-euler\"]\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\n";
    let racing =
        |lab: &Studio| lab.race().entrants().iter().map(|e| lab.entry(e)).collect::<Vec<_>>();
    let mut lab = Studio::new(Scene::parse("pair.toml", text).unwrap());
    assert_eq!(lab.entries().len(), GENERAL_METHODS.len(), "every method can be flown");
    lab.apply(StageCommand::ToggleRace);
    assert_eq!(racing(&lab), [0, 1]);
    for _ in 0..30 {
        lab.tick();
    }
    lab.apply(StageCommand::Pick(3));
    assert_eq!((lab.race().tick(), racing(&lab), lab.active()), (30, vec![0, 1], 0));
    lab.apply(StageCommand::MethodBeside(Step::Previous));
    assert_eq!(lab.active(), 1);
    lab.apply(StageCommand::MethodBeside(Step::Next));
    assert_eq!(lab.active(), 0);

    lab.apply(StageCommand::ToggleRace);
    lab.apply(StageCommand::Pick(3));
    let lane = &lab.race().entrants()[0].lane;
    assert_eq!(lane.solver(), Solver::Method(lab.entries()[3].method));
    lab.apply(StageCommand::ToggleRace);
    assert_eq!((racing(&lab), lab.active()), (vec![0, 1, 3], 3));
}

#[test]
fn throttle_and_rudder_go_in_tenths_stop_at_their_ends_and_are_back_amidships_after_a_restart() {
    let mut lab = Studio::new(scene("helm"));
    assert!(
        lab.race().takes("rudder") && lab.race().takes("throttle") && !lab.race().takes("anchor")
    );
    assert_eq!((lab.race().rudder(), lab.race().throttle()), (0.0, 1.0));
    for (command, times, rudder) in [
        (Command::Run(RunCommand::RudderLeft), 3, 0.3),
        (Command::Run(RunCommand::RudderRight), 3, 0.0),
        (Command::Run(RunCommand::RudderRight), 14, -1.0),
        (Command::Run(RunCommand::RudderLeft), 10, 0.0),
        (Command::Run(RunCommand::Act(Action::Rudder(7.0))), 1, 1.0),
    ] {
        for _ in 0..times {
            lab.apply(command.clone());
        }
        assert_eq!(lab.race().rudder(), rudder);
    }
    for _ in 0..10 {
        lab.tick();
    }
    let heading = |lab: &Studio| lab.race().entrants()[0].lane.bodies()[0].stepper.q()[2];
    assert!(heading(&lab) > 0.1, "left is counter-clockwise");
    lab.apply(StageCommand::Restart);
    assert_eq!((lab.race().rudder(), heading(&lab)), (0.0, 0.0));
    assert!(!Studio::new(scene("ship")).race().takes("rudder"));
}

#[test]
fn a_lane_takes_the_substeps_that_are_advised_in_flight_and_keeps_them() {
    let spec = |substeps| LaneSpec { substeps, ..LaneSpec::plain(method("rk4").unwrap()) };
    let mut lab = Studio::new(Scene::built_in("stiff").unwrap());
    (0..10).for_each(|_| lab.tick());
    let before = lab.race().entrants()[0].lane.bodies()[0].stepper.q().to_vec();
    lab.apply(RunCommand::SetLane(spec(8)));
    let lane = &lab.race().entrants()[0].lane;
    assert_eq!((lane.solver(), lane.substeps()), (spec(8).solver(), 8));
    assert_eq!(lane.bodies()[0].stepper.q(), before);
    assert_eq!(lab.entries()[lab.active()], spec(8));
    lab.apply(StageCommand::Restart);
    assert_eq!(lab.race().entrants()[0].lane.substeps(), 8);
    // In a race the method's own lane takes them, and the others go on.
    lab.apply(StageCommand::ToggleRace);
    (0..10).for_each(|_| lab.tick());
    lab.apply(RunCommand::SetLane(spec(4)));
    let substeps = lab.race().entrants().iter().map(|entrant| entrant.lane.substeps());
    assert_eq!(substeps.collect::<Vec<_>>(), [1, 1, 1, 4, 1]);
    // One that is not in the race is taken in.
    lab.apply(RunCommand::SetLane(LaneSpec {
        substeps: 3,
        ..LaneSpec::plain(method("pefrl").unwrap())
    }));
    assert_eq!(lab.viewer().notice.as_deref(), Some("the race restarted with PEFRL in it"));
    assert_eq!((lab.race().tick(), lab.race().entrants().len()), (0, 6));
    assert_eq!(lab.entries()[lab.active()].substeps, 3);
}
