//! A method that blows up hurts nobody else: it halts, once, and says when and why.

use regatta::lab::{Clock, Command, ESCAPE, Lab, LaneSpec, Mode, Race, Scene};
use regatta::sim::integrators::{METHODS, StepFailure, method};

/// Ticks of the long race: 4 h 38 min at 60 Hz.
const TICKS: u64 = 1_000_000;
/// Ticks in which it is held against the race without the lane: 1000 times as long as that lane lives.
const SIDE_BY_SIDE: u64 = 150_000;

fn stiff() -> Scene {
    Scene::built_in("stiff").expect("a built-in scene")
}

fn entries(without: &str) -> impl Iterator<Item = (usize, LaneSpec)> {
    let lanes = METHODS.iter().map(LaneSpec::plain).enumerate();
    lanes.filter(move |(_, spec)| spec.method.id != without)
}

/// The bits of each lane but the named method's, with the lane's place on the list.
fn states(race: &Race, without: &str) -> Vec<(usize, Vec<u64>)> {
    let others = race.entrants().iter().filter(|entrant| METHODS[entrant.entry].id != without);
    let bits = others.map(|entrant| {
        let values = entrant.lane.bodies().iter().flat_map(|body| {
            let values = body.stepper.q().iter().chain(body.stepper.v());
            values.copied().collect::<Vec<_>>()
        });
        let bits = values.inspect(|value| assert!(value.is_finite())).map(f64::to_bits);
        (entrant.entry, bits.collect())
    });
    bits.collect()
}

#[test]
fn explicit_euler_on_the_stiff_spring_halts_once_and_a_million_ticks_go_on() {
    let blown = "explicit-euler";
    let mut with = Race::new(&stiff(), entries(""));
    let mut without = Race::new(&stiff(), entries(blown));
    let mut halt = None;
    for tick in 0..TICKS {
        with.step();
        with.record();
        let lane = &with.entrants()[0].lane;
        match (&halt, lane.halted()) {
            (None, Some(found)) => {
                assert_eq!(found.tick, tick, "it halts in the tick that it cannot complete");
                halt = Some(found.clone());
            }
            (before, now) => assert_eq!(before.as_ref(), now, "a halt stays as it is"),
        }
        if tick < SIDE_BY_SIDE {
            without.step();
            if tick % 1000 == 0 {
                assert_eq!(states(&with, blown), states(&without, blown), "at tick {tick}");
            }
        }
    }
    assert_eq!(METHODS[with.entrants()[0].entry].id, blown);

    let halt = halt.expect("explicit Euler multiplies the amplitude by 1.94 a tick");
    // 1.94ⁿ passes 1e38 at n = 132; the velocity, 100 times the stretch, at 125.
    assert!((120..=132).contains(&halt.tick), "{halt:?}");
    let StepFailure::Escaped { coordinate: "v", value } = halt.failure else {
        panic!("halted for {:?}", halt.failure)
    };
    assert!(value.is_finite() && value.abs() > ESCAPE && value.abs() < 3.0 * ESCAPE, "{value:e}");
    for entrant in with.entrants() {
        assert!(states(&with, "").iter().all(|(_, bits)| bits.len() == 2));
        for sample in entrant.histories[0].samples() {
            let numbers = [sample.t, sample.q, sample.v];
            assert!(numbers.iter().all(|x| x.is_finite() && x.abs() <= ESCAPE), "{sample:?}");
        }
    }
    let reached = with.t();
    assert!((reached - TICKS as f64 / 60.0).abs() < 1e-9, "{reached} s");
}

#[test]
fn a_halted_lane_keeps_its_last_good_state() {
    let mut race = Race::new(&stiff(), entries("").take(1));
    let mut last = states(&race, "");
    while race.entrants()[0].lane.halted().is_none() {
        last = states(&race, "");
        race.step();
        race.record();
        assert!(race.tick() < 1000);
    }
    let samples = race.entrants()[0].histories[0].samples().len();
    for _ in 0..100 {
        race.step();
        race.record();
    }
    assert_eq!(states(&race, ""), last);
    assert_eq!(race.entrants()[0].histories[0].samples().len(), samples, "nothing is recorded");
    let body = &race.entrants()[0].lane.bodies()[0];
    assert_eq!(body.previous_q, body.stepper.q(), "nothing is drawn moving");
    assert_eq!(body.previous_v, body.stepper.v());
}

#[test]
fn a_halt_is_announced_once_with_its_tick_and_its_reason() {
    let mut lab = Lab::new(stiff());
    lab.apply(Command::ToggleRace);
    assert_eq!(lab.mode(), Mode::Race);
    let mut notices = Vec::new();
    for _ in 0..20_000 {
        lab.set_notice("nothing new");
        lab.tick();
        notices.extend(lab.notice().filter(|notice| *notice != "nothing new").map(String::from));
    }
    let entrants = lab.race().entrants();
    let halted = entrants.iter().filter(|entrant| entrant.lane.halted().is_some());
    assert_eq!(notices.len(), halted.count(), "one notice a halt: {notices:?}");
    let name = method("explicit-euler").unwrap().name;
    let tick = entrants[0].lane.halted().expect("explicit Euler halts").tick;
    let begins = format!("{name} halted at tick {tick}: ");
    let of_euler: Vec<_> = notices.iter().filter(|notice| notice.starts_with(&begins)).collect();
    let [notice] = of_euler[..] else { panic!("{notices:?}") };
    assert!(notice.contains("left the stage: v reached"), "{notice}");
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
