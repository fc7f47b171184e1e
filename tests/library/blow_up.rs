//! A method that blows up hurts nobody else: it halts, once, and says when and why.

use regatta::run::Observations;
use regatta::run::race::{ESCAPE, LaneBody, Mode, Race};
use regatta::scene::{Action, LaneId, LaneSpec, Scene};
use regatta::sim::Clock;
use regatta::sim::integrators::{GENERAL_METHODS, StepFailure, method};
use regatta::studio::{RunCommand, StageCommand, Studio};

use crate::scenes::edited;

/// Ticks of the long race: 83 min at 60 Hz.
const TICKS: u64 = 60_000;
/// Ticks in which it is held against the race without the lane: 300 times as long as that lane lives.
const SIDE_BY_SIDE: u64 = 10_000;

fn stiff() -> Scene {
    Scene::built_in("stiff").expect("a built-in scene")
}

fn lanes(without: &str) -> impl Iterator<Item = LaneSpec> {
    GENERAL_METHODS.iter().map(LaneSpec::plain).filter(move |spec| spec.method.id != without)
}

/// The bits of each lane but the named method's, with the id of the lane's method.
fn states(race: &Race, without: &str) -> Vec<(&'static str, Vec<u64>)> {
    let others = race.entrants().iter().filter(|entrant| entrant.spec.method.id != without);
    let bits = others.map(|entrant| {
        let values = entrant.lane.bodies().iter().flat_map(|body| {
            let values = body.stepper.q().iter().chain(body.stepper.v());
            values.copied().collect::<Vec<_>>()
        });
        let bits = values.inspect(|value| assert!(value.is_finite())).map(f64::to_bits);
        (entrant.spec.method.id, bits.collect())
    });
    bits.collect()
}

#[test]
fn explicit_euler_on_the_stiff_spring_halts_once_and_alone() {
    let blown = "explicit-euler";
    let mut with = Race::new(&stiff(), lanes(""));
    let mut without = Race::new(&stiff(), lanes(blown));
    let mut seen = Observations::new(&with, stiff().seconds);
    let mut halt = None;
    for tick in 0..TICKS {
        with.step(&mut seen);
        let lane = &with.entrants()[0].lane;
        match (&halt, lane.halted()) {
            (None, Some(found)) => {
                assert_eq!(found.tick, tick, "it halts in the tick that it cannot complete");
                halt = Some(found.clone());
            }
            (before, now) => assert_eq!(before.as_ref(), now, "a halt stays as it is"),
        }
        if tick < SIDE_BY_SIDE {
            without.step(&mut ());
            if tick % 1000 == 0 {
                assert_eq!(states(&with, blown), states(&without, blown), "at tick {tick}");
            }
        }
    }
    assert_eq!(with.entrants()[0].spec.method.id, blown);

    let halt = halt.expect("explicit Euler multiplies the amplitude by 1.94 a tick");
    // 1.94ⁿ passes 1e38 at n = 132; the velocity, 100 times the stretch, at 125.
    assert!((120..=132).contains(&halt.tick), "{halt:?}");
    let StepFailure::Escaped { coordinate, value } = halt.failure else {
        panic!("halted for {:?}", halt.failure)
    };
    assert_eq!(&*coordinate, "v");
    assert!(value.is_finite() && value.abs() > ESCAPE && value.abs() < 3.0 * ESCAPE, "{value:e}");
    assert!(states(&with, "").iter().all(|(_, bits)| bits.len() == 2));
    for entrant in with.entrants() {
        for sample in seen.past().histories(entrant.id)[0].samples() {
            let numbers = [sample.t, sample.q, sample.v];
            assert!(numbers.iter().all(|x| x.is_finite() && x.abs() <= ESCAPE), "{sample:?}");
        }
    }
    let reached = with.t();
    assert!((reached - TICKS as f64 / 60.0).abs() < 1e-9, "{reached} s");
}

#[test]
fn a_halted_lane_keeps_its_last_good_state() {
    let mut race = Race::new(&stiff(), lanes("").take(1));
    let mut seen = Observations::new(&race, stiff().seconds);
    let mut last = states(&race, "");
    while race.entrants()[0].lane.halted().is_none() {
        last = states(&race, "");
        race.step(&mut seen);
        assert!(race.tick() < 1000);
    }
    let samples = seen.past().histories(LaneId(1))[0].samples().count();
    for _ in 0..100 {
        race.step(&mut seen);
    }
    assert_eq!(states(&race, ""), last);
    assert_eq!(
        seen.past().histories(LaneId(1))[0].samples().count(),
        samples,
        "nothing is recorded"
    );
    let body = &race.entrants()[0].lane.bodies()[0];
    assert_eq!(body.previous_q, body.stepper.q(), "nothing is drawn moving");
    assert_eq!(body.previous_v, body.stepper.v());
}

/// The harbour with a second spring, which is damped.
fn harbour_of_springs() -> Scene {
    let [mut harbour, mut damped] =
        ["harbour", "damped"].map(|name| Scene::built_in(name).expect("a built-in scene"));
    damped.bodies[0].name = "damped spring".into();
    harbour.bodies.splice(1..1, damped.bodies);
    harbour
}

/// Its bodies and one of them alone, under explicit Euler.
fn harbour_and(body: usize) -> [Race; 2] {
    let harbour = harbour_of_springs();
    let alone = edited(&harbour, |scene| scene.bodies = vec![harbour.bodies[body].clone()]);
    let euler = LaneSpec::plain(method("explicit-euler").expect("a method"));
    [harbour, alone].map(|scene| Race::new(&scene, [euler]))
}

#[test]
fn a_blow_up_halts_one_body_and_changes_no_bit_of_the_others() {
    // The springs are lost within half an hour, the ship never.
    let (ship, ticks) = (2, 150_000);
    let [mut harbour, mut alone] = harbour_and(ship);
    for _ in 0..ticks {
        harbour.step(&mut ());
        alone.step(&mut ());
    }
    let bodies = harbour.entrants()[0].lane.bodies();
    let halted: Vec<_> = bodies.iter().map(|body| body.halted().is_some()).collect();
    assert_eq!(halted, [true, true, false]);
    let bits = |body: &LaneBody| {
        let values = body.stepper.q().iter().chain(body.stepper.v());
        values.map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(bits(&bodies[ship]), bits(&alone.entrants()[0].lane.bodies()[0]));
    assert!(bodies[ship].stepper.q()[0] > 10_000.0, "the ship sails on");

    let lane = &harbour.entrants()[0].lane;
    let ticks: Vec<u64> = lane.halts().map(|halt| halt.tick).collect();
    assert_eq!(lane.halts().map(|halt| halt.body).collect::<Vec<_>>(), [0, 1]);
    assert!(ticks[0] != ticks[1], "one after the other: {ticks:?}");
    assert_eq!(lane.halted().map(|halt| halt.tick), ticks.iter().min().copied());
}

#[test]
fn a_halted_body_keeps_its_last_good_state_while_others_run() {
    let spring = 0;
    let [mut harbour, mut alone] = harbour_and(spring);
    while alone.entrants()[0].lane.halted().is_none() {
        harbour.step(&mut ());
        alone.step(&mut ());
    }
    let mut seen = Observations::new(&harbour, 20.0);
    for _ in 0..100 {
        harbour.step(&mut seen);
    }
    let lane = &harbour.entrants()[0].lane;
    let (kept, single) = (&lane.bodies()[spring], &alone.entrants()[0].lane.bodies()[0]);
    assert_eq!((kept.stepper.q(), kept.stepper.v()), (single.stepper.q(), single.stepper.v()));
    let histories = seen.past().histories(LaneId(1));
    assert_eq!(histories[spring].samples().count(), 0, "nothing is recorded of it");
    assert!(histories[2].samples().count() > 0);
}

#[test]
fn each_halt_is_announced_once_with_method_body_tick_and_reason() {
    let names = ["spring", "damped spring", "ship"];
    let stiff = Scene::built_in("stiff").expect("a built-in scene");
    for (scene, ticks) in [(stiff, 20_000), (harbour_of_springs(), 80_000)] {
        let is_harbour = scene.name == "harbour";
        let mut studio = Studio::new(scene);
        studio.apply(StageCommand::ToggleRace);
        assert_eq!(studio.mode(), Mode::Race);
        let mut notices = Vec::new();
        for _ in 0..ticks {
            studio.viewer.set_notice("nothing new");
            studio.tick();
            let news = studio.viewer.notice.as_deref().filter(|notice| *notice != "nothing new");
            notices.extend(news.map(String::from));
        }
        let halts =
            studio.race().entrants().iter().flat_map(|e| e.lane.halts().map(move |h| (e, h)));
        let mut expected: Vec<String> = halts
            .map(|(entrant, halt)| {
                let method = entrant.spec.method.name;
                let body = &studio.scene().bodies[halt.body].name;
                assert!(!is_harbour || names.contains(&body.as_str()));
                let fate = entrant.lane.bodies()[halt.body].fate().expect("it halted");
                format!("{method}: {body} {fate}")
            })
            .collect();
        expected.sort();
        notices.sort();
        assert_eq!(notices, expected);
        assert!(notices.len() > usize::from(is_harbour), "{notices:?}");
        assert!(notices.iter().all(|notice| notice.contains(" blew up at ")), "{notices:?}");
    }
}

#[test]
fn the_notice_of_a_halt_leaves_with_its_lane() {
    let mut studio = Studio::new(Scene::built_in("stiff").expect("a built-in scene"));
    studio.apply(StageCommand::ToggleRace);
    while studio.viewer.notice.as_deref().is_none() {
        studio.tick();
        assert!(studio.race().tick() < 1000);
    }
    studio.apply(StageCommand::ToggleRace);
    assert_eq!(studio.viewer.notice.as_deref(), None);
}

#[test]
fn an_unbounded_kick_halts_the_body_with_its_reason() {
    for (mass, times, reason) in
        [(1e-300, 1.0, "blew up: v became infinite"), (1e-10, 1e15, "blew up: v reached ")]
    {
        let text = format!(
            "title = 'light'\ntick_hz = 60\nseconds = 1\nmethods = ['rk4']\n\
             [[spring]]\nname = 'light'\nmass_kg = {mass:e}\nstiffness_n_per_m = 1e-300\nkick_n_s = 1e15\n\
             [[ship]]\nthrust_n = 1\ndrag_n_s_per_m = 1\nmass_kg = 1\nkick_n_s = 0\n"
        );
        let mut studio = Studio::new(Scene::parse("light.toml", &text).expect("a good scene"));
        (0..5).for_each(|_| studio.tick());
        let before = states(studio.race(), "");
        studio.apply(RunCommand::Act(Action::Kick(times)));
        assert_eq!(states(studio.race(), ""), before, "the state stays the last good one");
        for lane in [studio.race().truth(), &studio.race().entrants()[0].lane] {
            let [spring, ship] = lane.bodies() else { panic!("two bodies") };
            assert!(ship.halted().is_none());
            let halt = spring.halted().expect("a kick of 1e45 m/s or more");
            assert_eq!((halt.tick, halt.body), (5, 0));
            assert!(halt.failure.to_string().starts_with(reason), "{}", halt.failure);
            assert_eq!(spring.previous_v, spring.stepper.v(), "nothing is drawn moving");
        }
        studio.tick();
        let notice = studio.viewer.notice.as_deref().expect("a halt is told");
        assert!(notice.contains(&format!("halted at tick 5: light {reason}")), "{notice}");
        assert!(notice.starts_with("the exact solution halted at tick 5: "), "{notice}");
    }
}

#[test]
fn a_day_at_60_hz_is_5_184_000_ticks_exactly() {
    let mut clock = Clock::new(60);
    let second = 1_000_000_000;
    // 144 frames a second of unequal length, none of them a whole number of ticks.
    let frame = |n: i64| second * (n + 1) / 144 - second * n / 144;
    let mut ticks = 0;
    for n in 0..144 * 86_400 {
        let due = clock.advance(frame(n));
        assert_eq!(due.dropped, 0);
        ticks += u64::from(due.ticks);
    }
    assert_eq!((ticks, clock.alpha()), (5_184_000, 0.0));
}
