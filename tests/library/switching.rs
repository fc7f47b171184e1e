//! Switching in flight: the state is carried to the bit, and the truth continues from the state after an input.

use regatta::run::Observations;
use regatta::run::race::{Lane, LaneBody, Observer, Race, Resumed, ResumedFrom};
use regatta::scene::{Action, LaneId, LaneSpec, Scene, SceneBody};
use regatta::sim::bodies::{Body, Ship, Spring};
use regatta::sim::integrators::{GENERAL_METHODS, Method, method};
use regatta::sim::{Solver, State};
use regatta::studio::{Command, RunCommand, StageCommand, Step, Studio};

fn scene(name: &str) -> Scene {
    Scene::built_in(name).expect("a built-in scene")
}

fn solo(scene: &Scene, id: &str) -> Race {
    Race::new(scene, [LaneSpec::plain(method(id).unwrap())])
}

fn act(race: &mut Race, action: Action) {
    race.perform(&action, &mut ());
}

/// Switches the first lane.
fn switch(race: &mut Race, spec: LaneSpec) -> Vec<Resumed> {
    let lane = race.entrants()[0].id;
    race.perform(&Action::Lane { lane, spec }, &mut ()).map_or_else(Vec::new, |done| done.resumed)
}

fn bits(lane: &Lane) -> Vec<u64> {
    let values =
        lane.bodies().iter().flat_map(|body| body.stepper.q().iter().chain(body.stepper.v()));
    values.map(|value| value.to_bits()).collect()
}

fn run(race: &mut Race, ticks: u32) {
    for _ in 0..ticks {
        race.step(&mut ());
    }
}

#[test]
fn a_switch_carries_the_state_to_the_bit() {
    for from in GENERAL_METHODS {
        for to in GENERAL_METHODS {
            let mut race = solo(&scene("harbour"), from.id);
            run(&mut race, 100);
            let (before, hash) = (bits(&race.entrants()[0].lane), race.state_hash());
            switch(&mut race, LaneSpec::plain(to));
            let lane = &race.entrants()[0].lane;
            assert_eq!(bits(lane), before, "{} to {}", from.id, to.id);
            assert_eq!(lane.solver(), Solver::Method(to));
            assert_eq!(race.state_hash(), hash);
            switch(&mut race, LaneSpec::plain(from));
            assert_eq!(race.state_hash(), hash, "{} to {} and back", from.id, to.id);
        }
    }
}

#[test]
fn switching_there_and_back_in_one_tick_changes_nothing() {
    // A method with memory must forget it: it restarts.
    for method in GENERAL_METHODS.iter().filter(|method| method.restart.is_none()) {
        let mut straight = solo(&scene("harbour"), method.id);
        let mut detour = solo(&scene("harbour"), method.id);
        run(&mut straight, 500);
        run(&mut detour, 100);
        let other = LaneSpec::plain(GENERAL_METHODS.last().unwrap());
        switch(&mut detour, LaneSpec { substeps: 3, ..other });
        switch(&mut detour, LaneSpec::plain(method));
        run(&mut detour, 400);
        assert_eq!(detour.state_hash(), straight.state_hash(), "{}", method.id);
    }
}

/// A spring with drag, so that every method carries memory between its ticks.
fn damped_spring() -> Scene {
    let mut scene = scene("spring");
    scene.bodies[0].values[2] = 0.8;
    scene
}

/// Runs a race for 77 ticks under one method, interrupts it with `change`, and compares the rest with a race that
/// starts there under the second method.
fn goes_on_as_if_started_there(from: &'static Method, to: &'static Method, change: fn(&mut Race)) {
    let scene = damped_spring();
    let mut race = solo(&scene, from.id);
    run(&mut race, 77);
    change(&mut race);
    if from != to {
        switch(&mut race, LaneSpec::plain(to));
    }
    let State { q, v } = state(&race.entrants()[0].lane);
    let mut there = scene.clone();
    there.tick_hz = race.tick_hz();
    there.bodies[0].values[3..5].copy_from_slice(&[q, v]);
    let mut fresh = solo(&there, to.id);
    let start = fresh.entrants()[0].lane.bodies()[0].stepper.q()[0];
    run(&mut race, 100);
    run(&mut fresh, 100);
    let (race, fresh) = (&race.entrants()[0].lane, &fresh.entrants()[0].lane);
    assert_eq!(bits(race), bits(fresh), "{} to {}", from.id, to.id);
    assert_ne!(state(fresh).q, start, "{} moves", to.id);
}

#[test]
fn after_a_switch_the_new_method_acts_as_if_started_there() {
    for to in GENERAL_METHODS {
        let from = method(if to.id == "rk4" { "improved-euler" } else { "rk4" }).unwrap();
        goes_on_as_if_started_there(from, to, |_| ());
    }
}

#[test]
fn after_a_kick_every_method_acts_as_if_started_there() {
    for method in GENERAL_METHODS {
        goes_on_as_if_started_there(method, method, |race| act(race, Action::Kick(1.0)));
    }
}

#[test]
fn after_a_change_of_tick_rate_every_method_acts_as_if_started_there() {
    for method in GENERAL_METHODS {
        goes_on_as_if_started_there(method, method, |race| act(race, Action::TickHz(100.into())));
        goes_on_as_if_started_there(method, method, |race| act(race, Action::TickHz(49.into())));
    }
}

/// A ship, a damped spring and a helm: between them they take every input.
fn mixed() -> Scene {
    let mut mixed = scene("helm");
    mixed.script.clear();
    mixed.bodies.extend(scene("ship").bodies);
    mixed.bodies.extend(damped_spring().bodies);
    mixed
}

#[test]
fn setting_a_value_to_itself_changes_no_bit_of_lanes_or_truth() {
    let set_again: [fn(&mut Race); 5] = [
        |race| act(race, Action::Throttle(0.5)),
        |race| act(race, Action::Rudder(-0.25)),
        |race| act(race, Action::Kick(0.0)),
        |race| act(race, Action::TickHz(7.into())),
        |race| {
            let spec = LaneSpec::plain(race.entrants()[0].lane.solver().method().unwrap());
            assert!(switch(race, spec).is_empty());
        },
    ];
    for method in GENERAL_METHODS {
        let begun = || {
            let mut race = solo(&mixed(), method.id);
            act(&mut race, Action::Throttle(0.5));
            act(&mut race, Action::Rudder(-0.25));
            act(&mut race, Action::TickHz(7.into()));
            run(&mut race, 40);
            race
        };
        let ended = |mut race: Race| {
            run(&mut race, 40);
            let lane = &race.entrants()[0].lane;
            (race.t().to_bits(), bits(lane), bits(race.truth()))
        };
        let left = ended(begun());
        for (n, again) in set_again.iter().enumerate() {
            let mut told = begun();
            again(&mut told);
            assert!(ended(told) == left, "{}, case {n}", method.id);
        }
    }
}

#[test]
fn an_action_without_effect_changes_no_bit() {
    for method in GENERAL_METHODS {
        let begun = || {
            let mut studio = Studio::new(mixed());
            studio.apply(StageCommand::Method(method));
            (0..40).for_each(|_| studio.tick());
            studio
        };
        let ended = |mut studio: Studio| {
            (0..40).for_each(|_| studio.tick());
            (bits(&studio.race().entrants()[0].lane), bits(studio.race().truth()))
        };
        let left = ended(begun());
        let (pick, hz) = (begun().active(), begun().clock().tick_hz());
        for command in [
            Command::Stage(StageCommand::Method(method)),
            Command::Stage(StageCommand::Pick(pick)),
            Command::Stage(StageCommand::TickHz(hz)),
            Command::Run(RunCommand::Act(Action::Throttle(1.0))),
            Command::Run(RunCommand::ThrottleUp),
            Command::Run(RunCommand::Act(Action::Rudder(0.0))),
        ] {
            let mut told = begun();
            told.apply(command.clone());
            assert!(ended(told) == left, "{}: {command:?}", method.id);
        }
    }
}

#[test]
fn evaluations_keep_counting_across_a_switch() {
    let mut race = solo(&scene("spring"), "rk4");
    run(&mut race, 10);
    switch(&mut race, LaneSpec::plain(method("explicit-euler").unwrap()));
    run(&mut race, 5);
    assert_eq!(race.entrants()[0].lane.evaluations(), 4 * 10 + 5);
}

/// The state of the first body in a lane.
fn state(lane: &Lane) -> State<f64> {
    let stepper = &lane.bodies()[0].stepper;
    State { q: stepper.q()[0], v: stepper.v()[0] }
}

fn close(found: f64, wanted: f64) -> bool {
    (found - wanted).abs() <= 1e-11 * (1.0 + wanted.abs())
}

#[test]
fn a_throttle_acts_on_truth_and_lanes_from_its_tick_on() {
    let scene = scene("ship");
    let mut race = solo(&scene, "rk4");
    run(&mut race, 10);
    act(&mut race, Action::Throttle(-0.5));
    run(&mut race, 20);

    let ahead = Ship::BLANK.with_parameters(&scene.bodies[0].values);
    let astern = Ship { throttle: -0.5, ..ahead.clone() };
    let h = 1.0 / f64::from(scene.tick_hz);
    let turned = ahead.exact(10.0 * h, &ahead.start()).unwrap();
    let wanted = astern.exact(20.0 * h, &turned).unwrap();
    let truth = state(race.truth());
    assert!(close(truth.q, wanted.q) && close(truth.v, wanted.v), "{truth:?}, {wanted:?}");
    let without = ahead.exact(30.0 * h, &ahead.start()).unwrap();
    assert!((truth.v - without.v).abs() > 1.0, "a throttle changes something");
    let lane = state(&race.entrants()[0].lane);
    assert!((lane.v - wanted.v).abs() < 1e-5, "{lane:?}, {wanted:?}");
}

#[test]
fn a_kick_acts_on_truth_and_lanes_from_its_tick_on() {
    let scene = scene("spring");
    let mut race = solo(&scene, "rk4");
    run(&mut race, 31);
    let before = state(&race.entrants()[0].lane);
    act(&mut race, Action::Kick(-2.0));
    let kicked = state(&race.entrants()[0].lane);
    run(&mut race, 40);

    let spring = Spring::default().with_parameters(&scene.bodies[0].values);
    let gained = -2.0 * spring.kick / spring.mass;
    assert_eq!((kicked.q, kicked.v), (before.q, before.v + gained));
    let h = 1.0 / f64::from(scene.tick_hz);
    let mut wanted = spring.exact(31.0 * h, &spring.start()).unwrap();
    wanted.v += gained;
    let wanted = spring.exact(40.0 * h, &wanted).unwrap();
    let truth = state(race.truth());
    assert!(close(truth.q, wanted.q) && close(truth.v, wanted.v), "{truth:?}, {wanted:?}");
    let lane = state(&race.entrants()[0].lane);
    assert!((lane.v - wanted.v).abs() < 1e-3, "{lane:?}, {wanted:?}");
}

#[test]
fn a_change_of_tick_rate_keeps_the_time_and_the_truth() {
    let scene = scene("spring");
    let mut race = solo(&scene, "rk4");
    run(&mut race, 60);
    let t = race.t();
    act(&mut race, Action::TickHz(100.into()));
    assert_eq!(race.t(), t);
    run(&mut race, 50);
    let wanted = t + 0.5;
    assert!((race.t() - wanted).abs() < 1e-12, "{}", race.t());
    let spring = Spring::default().with_parameters(&scene.bodies[0].values);
    let there = spring.exact(wanted, &spring.start()).unwrap();
    let truth = state(race.truth());
    assert!(close(truth.q, there.q) && close(truth.v, there.v), "{truth:?}, {there:?}");
}

/// A ship and a damped spring that explicit Euler loses and Runge-Kutta brings to rest: `h ω` is 2, the limits at
/// this damping are 0.4 and 2.9.
fn ship_and_lively_spring() -> Scene {
    let mut scene = scene("harbour");
    scene.tick_hz = 10.into();
    let lively = vec![1.0, 400.0, 8.0, 1.0, 0.0, 3.0];
    scene.bodies = ["ship", "spring"].map(scene_body).into();
    scene.bodies[1].values = lively;
    scene.script.clear();
    scene
}

fn scene_body(kind: &str) -> SceneBody {
    let bodies = scene("harbour").bodies;
    bodies.into_iter().find(|body| body.kind.id == kind).expect("one of each in the harbour")
}

/// The race of a scene under explicit Euler, in which a body has halted.
fn halted(scene: &Scene) -> Race {
    halted_before(scene, |_| ()).0
}

/// The same, before the eyes of an observer.
fn halted_before<O: Observer>(scene: &Scene, observer: impl FnOnce(&Race) -> O) -> (Race, O) {
    let mut race = solo(scene, "explicit-euler");
    let mut observer = observer(&race);
    while race.entrants()[0].lane.halted().is_none() {
        race.step(&mut observer);
        assert!(race.tick() < 1000);
    }
    (race, observer)
}

/// The state of a body to the bit.
fn body_bits(body: &LaneBody) -> Vec<u64> {
    body.stepper.q().iter().chain(body.stepper.v()).map(|x| x.to_bits()).collect()
}

fn rk4() -> LaneSpec {
    LaneSpec::plain(method("rk4").unwrap())
}

#[test]
fn a_body_that_blew_up_resumes_from_the_truth_and_the_others_continue() {
    let scene = ship_and_lively_spring();
    let (mut race, mut seen) = halted_before(&scene, |race| Observations::new(race, scene.seconds));
    let halt = race.entrants()[0].lane.halted().unwrap().clone();
    assert_eq!((halt.body, halt.is_blow_up()), (1, true));
    run(&mut race, 10);
    let ship = body_bits(&race.entrants()[0].lane.bodies()[0]);
    let switch = Action::Lane { lane: LaneId(1), spec: rk4() };
    let resumed = race.perform(&switch, &mut seen).expect("another method").resumed;
    assert_eq!(resumed, [Resumed { halt, from: ResumedFrom::Truth }]);
    let (lane, truth) = (&race.entrants()[0].lane, race.truth());
    assert_eq!(lane.halted(), None);
    assert_eq!(body_bits(&lane.bodies()[0]), ship, "the ship had not halted");
    let spring = &lane.bodies()[1];
    assert_eq!(body_bits(spring), body_bits(&truth.bodies()[1]));
    assert_eq!(spring.previous_q, spring.stepper.q(), "it is not drawn on its way there");
    let history = &seen.past().histories(LaneId(1))[1];
    let jump = history.samples().rev().find(|sample| sample.jumped);
    assert_eq!(jump.map(|sample| sample.t), Some(race.t()));
    let mut flown: Vec<usize> = history.samples().map(|sample| sample.entry).collect();
    flown.dedup();
    assert_eq!(flown, [0], "a lane of a race keeps its colour");
    run(&mut race, 1000);
    assert_eq!(race.entrants()[0].lane.halted(), None);
}

#[test]
fn a_body_resumes_from_its_last_good_state_if_the_truth_failed_too() {
    let mut race = solo(&scene("spring"), "semi-implicit-euler");
    run(&mut race, 100);
    let last = bits(&race.entrants()[0].lane);
    act(&mut race, Action::Kick(1e300));
    run(&mut race, 10);
    assert!(race.truth().halted().is_some());
    let resumed = switch(&mut race, rk4());
    let from: Vec<_> = resumed.iter().map(|resumed| resumed.from).collect();
    assert_eq!(from, [ResumedFrom::LastGood]);
    assert_eq!(bits(&race.entrants()[0].lane), last);
    run(&mut race, 10);
    assert_ne!(bits(&race.entrants()[0].lane), last, "it goes on");
}

#[test]
fn a_throttle_set_during_a_halt_holds_after_resuming() {
    // The ship at 21 s swings ever wider.
    let mut scene = scene("surge");
    scene.bodies = vec![scene.bodies[2].clone()];
    let mut race = halted(&scene);
    act(&mut race, Action::Throttle(-0.5));
    let last = bits(&race.entrants()[0].lane);
    act(&mut race, Action::Kick(1.0));
    assert_eq!(bits(&race.entrants()[0].lane), last, "a halted body feels no kick");
    assert_eq!(switch(&mut race, rk4()).len(), 1);
    run(&mut race, 3000);
    // After 6000 time constants both ships have the speed that the throttle asks for.
    let (lane, truth) = (state(&race.entrants()[0].lane), state(race.truth()));
    assert!((lane.v - truth.v).abs() < 1e-9, "{lane:?}, the truth {truth:?}");
    assert!((truth.v + 10.0).abs() < 1e-9, "{truth:?}");
}

#[test]
fn a_new_method_is_not_blamed_for_an_inherited_blow_up() {
    let mut studio = Studio::new(scene("stiff"));
    for command in [
        Command::Stage(StageCommand::Pick(1)),
        Command::Stage(StageCommand::TickRate(Step::Previous)),
        Command::Stage(StageCommand::TickRate(Step::Previous)),
    ] {
        studio.apply(command);
    }
    while studio.race().entrants()[0].lane.halted().is_none() {
        studio.tick();
        assert!(studio.race().tick() < 1000);
    }
    (0..30).for_each(|_| studio.tick());
    studio.apply(StageCommand::Pick(3));
    assert_eq!(
        studio.viewer.notice.as_deref(),
        Some("stiff spring had blown up: resumed from the exact solution")
    );
    for _ in 0..1000 {
        studio.tick();
        assert!(
            !studio.viewer.notice.as_deref().unwrap().contains("Runge-Kutta 4"),
            "{:?}",
            studio.viewer.notice.as_deref()
        );
    }
    assert_eq!(studio.race().entrants()[0].lane.halted(), None);
}
