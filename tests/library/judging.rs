//! Verdicts and advice against plain runs: energies, amplitudes and errors counted out here once more.

use regatta::lab::{
    Adviser, CRITERIA, CriterionResult, Judge, LONGEST_HORIZON_S, LaneSpec, NoTruth, NotJudged,
    Outcome, Scene, TOLERANCE, Verdict,
};
use regatta::sim::integrators::method;
use regatta::sim::{Solver, Stepper};

const LOOKS_RIGHT: usize = 1;

fn scene(seconds: f64, bodies: &str) -> Scene {
    let text = format!("title = \"t\"\ntick_hz = 60\nseconds = {seconds}\n{bodies}\n");
    Scene::parse("t", &text).unwrap()
}

fn spec(id: &str) -> LaneSpec {
    LaneSpec::plain(method(id).unwrap())
}

fn verdict(scene: &Scene, id: &str, tick_hz: u32) -> Verdict {
    Judge::new(scene, 1.0).verdict(spec(id), tick_hz)
}

fn body(scene: &Scene, solver: Solver) -> Box<dyn Stepper> {
    (scene.bodies[0].kind.build)(&scene.bodies[0].values, solver)
}

/// What `see` makes of the first body after each tick of a plain run.
fn run<T>(
    scene: &Scene,
    solver: Solver,
    tick_hz: u32,
    seconds: f64,
    see: impl Fn(&dyn Stepper) -> T,
) -> Vec<T> {
    let (mut body, hz) = (body(scene, solver), f64::from(tick_hz));
    let ticks = 0..(seconds * hz).round() as u32;
    ticks
        .map(|tick| {
            body.advance(f64::from(tick) / hz, 1.0 / hz, 1).unwrap();
            see(&*body)
        })
        .collect()
}

/// 2 kg on 80 N/m.
fn spring() -> Scene {
    scene(20.0, "[[spring]]\nmass_kg = 2\nstiffness_n_per_m = 80")
}

/// The spring of 1 Hz.
fn hertz() -> Scene {
    scene(20.0, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 39.47841760435743")
}

/// The spring of 6 rad/s.
fn six_radians() -> Scene {
    scene(20.0, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 36")
}

const LET_GO_RAD: f64 = 0.7;

fn pendulum() -> Scene {
    scene(20.0, &format!("[[pendulum]]\nlength_m = 0.4\ntheta0_rad = {LET_GO_RAD}"))
}

#[test]
fn a_springs_energy_and_the_times_of_its_swing_are_those_of_the_run() {
    let scene = spring();
    for (id, tick_hz, word) in [
        ("explicit-euler", 60, Outcome::GainsEnergy),
        ("improved-euler", 10, Outcome::GainsEnergy),
        ("improved-euler", 60, Outcome::OutOfPhase),
        ("rk4", 10, Outcome::LosesEnergy),
        ("bdf2", 10, Outcome::LosesEnergy),
        ("bdf2", 60, Outcome::OutOfPhase),
        ("implicit-euler", 60, Outcome::LosesEnergy),
        ("rk4", 60, Outcome::Accurate),
    ] {
        let found = verdict(&scene, id, tick_hz);
        assert_eq!(found.outcome, word, "{found}");
        let energies = |seconds| {
            run(&scene, spec(id).solver(), tick_hz, seconds, |body| body.energy().unwrap() / 40.0)
        };
        let last = *energies(20.0).last().unwrap();
        let change = found.energy_change.unwrap();
        assert!((change + 1.0 - last).abs() < 0.02 * last.max(0.01), "{id}: {change}, to {last}");
        let grows = last > 1.0;
        let (time, other) = match grows {
            true => (found.doubles_in_s, found.halves_in_s),
            false => (found.halves_in_s, found.doubles_in_s),
        };
        assert_eq!((other, found.is_bounded), (None, Some(!grows)), "{id}");
        let time = time.unwrap();
        if time < 2000.0 {
            let reached = *energies(time).last().unwrap();
            let wanted = if grows { 4.0 } else { 0.25 };
            assert!((reached / wanted - 1.0).abs() < 0.25, "{id}: {reached} after {time} s");
        }
    }
}

#[test]
fn a_pendulums_word_follows_the_mean_of_its_energy() {
    let scene = pendulum();
    let start = body(&scene, Solver::Truth).energy().unwrap();
    for (id, tick_hz, word, is_bounded) in [
        ("explicit-euler", 60, Outcome::GainsEnergy, false),
        ("improved-euler", 10, Outcome::GainsEnergy, false),
        ("improved-euler", 60, Outcome::OutOfPhase, false),
        ("semi-implicit-euler", 10, Outcome::OutOfPhase, true),
        ("semi-implicit-euler", 60, Outcome::OutOfPhase, true),
        // Wider by an eighth and narrower by a twentieth than in truth, from the first turn to the last.
        ("semi-implicit-euler", 5, Outcome::OutOfPhase, true),
        ("velocity-verlet", 5, Outcome::OutOfPhase, true),
        ("rk4", 10, Outcome::OutOfPhase, true),
        ("bdf2", 10, Outcome::LosesEnergy, true),
        ("bdf2", 60, Outcome::OutOfPhase, true),
        ("implicit-euler", 60, Outcome::LosesEnergy, true),
        ("rk4", 60, Outcome::Accurate, true),
    ] {
        let found = verdict(&scene, id, tick_hz);
        assert_eq!((found.outcome, found.is_bounded), (word, Some(is_bounded)), "{found}");
        let energies = run(&scene, spec(id).solver(), tick_hz, 20.0, |b| b.energy().unwrap());
        let last = &energies[energies.len() * 3 / 4..];
        let mean = last.iter().sum::<f64>() / last.len() as f64 / start - 1.0;
        let change = found.energy_change.unwrap();
        assert!((change - mean).abs() < 0.02 * (1.0 + mean).max(0.1), "{id}: {change}, not {mean}");
        let largest = energies.iter().map(|e| 100.0 * (e / start - 1.0));
        let largest = largest.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap();
        let drift = found.energy_drift.unwrap();
        assert!((drift - largest).abs() < 1e-3 * largest.abs(), "{id}: {drift}, not {largest}");
    }
}

#[test]
fn a_pendulum_has_doubled_and_halved_when_its_angle_has() {
    let scene = pendulum();
    let angles = |id, tick_hz, seconds| {
        run(&scene, spec(id).solver(), tick_hz, seconds, |body| body.q()[0].abs() / LET_GO_RAD)
    };
    for (id, tick_hz) in [("explicit-euler", 60), ("improved-euler", 10)] {
        let first = angles(id, tick_hz, 20.0).iter().position(|part| *part >= 2.0).unwrap();
        let at = (first + 1) as f64 / f64::from(tick_hz);
        assert_eq!(verdict(&scene, id, tick_hz).doubles_in_s, Some(at), "{id}");
    }
    for (id, tick_hz, seconds) in [("rk4", 10, 1000.0), ("bdf2", 60, 1500.0)] {
        let last = angles(id, tick_hz, seconds).iter().rposition(|part| *part > 0.5).unwrap();
        let at = (last + 2) as f64 / f64::from(tick_hz);
        let found = verdict(&scene, id, tick_hz).halves_in_s.unwrap();
        assert!((found / at - 1.0).abs() < 1e-3, "{id}: {found} s, not {at}");
    }
    // Halved within the first turns is not timed.
    assert_eq!(verdict(&scene, "implicit-euler", 10).halves_in_s, None);
}

#[test]
fn what_is_to_die_away_does_not_lose_energy_when_it_does() {
    let damped = "[[spring]]\nmass_kg = 2\nstiffness_n_per_m = 80\ndamping_n_s_per_m = 0.3";
    let free = "[[ship]]\nthrust_n = 2000\ndrag_n_s_per_m = 0\nmass_kg = 1000\nv0_m_per_s = 3";
    for (body, id, word) in [
        (damped, "implicit-euler", Outcome::OutOfPhase),
        (damped, "bdf2", Outcome::OutOfPhase),
        (free, "semi-implicit-euler", Outcome::Accurate),
        (free, "rk4", Outcome::Rounding),
    ] {
        let found = verdict(&scene(20.0, body), id, 10);
        assert_eq!((found.outcome, found.is_bounded), (word, Some(true)), "{id}: {found}");
        let times = (found.halves_in_s, found.doubles_in_s, found.energy_change);
        assert_eq!(times, (None, None, None), "{id}: {found}");
    }
}

#[test]
fn what_nobody_can_know_is_not_judged() {
    // Let go so near the top that each return there multiplies what the truth may be off.
    let top = |seconds| scene(seconds, "[[pendulum]]\nlength_m = 0.4\ntheta0_rad = 3.14159");
    let found = verdict(&top(15.0), "rk4", 60);
    assert!(found.outcome != Outcome::NoTruth && found.no_truth.is_none(), "{found}");
    for (seconds, least, most) in [(30.0, TOLERANCE / 2.0, 0.02), (60.0, 0.02, 0.1)] {
        let found = verdict(&top(seconds), "rk4", 60);
        let Some(NoTruth::Vague(part)) = found.no_truth else { panic!("{found}") };
        assert!(part > least && part < most, "{found}");
        assert_eq!(found.outcome, Outcome::NoTruth);
    }
}

#[test]
fn nothing_is_held_against_its_truth_beyond_the_end_of_its_scene() {
    // 1.6 ticks: the second one ends after the scene.
    let scene = scene(0.8, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 36");
    let found = verdict(&scene, "explicit-euler", 2);
    assert_eq!(found.seconds, 0.5, "{found:?}");
    // 0.8 ticks.
    for id in ["explicit-euler", "rk4", "dormand-prince-54"] {
        let found = verdict(&scene, id, 1);
        assert_eq!(found.outcome, Outcome::NotJudged, "{found}");
        assert_eq!(found.not_judged, Some(NotJudged::ShorterThanATick));
        assert_eq!((found.is_bounded, found.no_truth, found.frequency_error), (None, None, None));
        let adviser = Adviser::new(&scene, 1.0, 1);
        assert!(
            CRITERIA.iter().all(|&of| adviser.meets(spec(id), of) == CriterionResult::Unknown),
            "{id}"
        );
    }
    assert!(verdict(&scene, "rk4", 100).not_judged.is_none());
}

#[test]
fn what_looks_right_is_as_wide_and_as_fast_as_the_truth() {
    let slowest = |scene: &Scene, id: &str| {
        Adviser::new(scene, 1.0, 60).slowest(spec(id), CRITERIA[LOOKS_RIGHT]).unwrap()
    };
    // By its frequency: 2 asin(z/2) / z is 1.01 at z = 0.4833.
    assert_eq!(slowest(&six_radians(), "semi-implicit-euler"), 13);
    let small = scene(20.0, "[[pendulum]]\nlength_m = 0.4\ntheta0_rad = 0.05");
    assert_eq!(slowest(&small, "semi-implicit-euler"), 11);
    // By its amplitude: grown by a twentieth, e^(z³ω 20 s / 8), and lost by one, e^(-zω 19 s / 2).
    let hz = slowest(&hertz(), "improved-euler");
    assert!((43..=45).contains(&hz), "{hz} Hz");
    let hz = slowest(&hertz(), "implicit-euler");
    assert!((7200..=7800).contains(&hz), "{hz} Hz");
}

#[test]
fn what_does_not_swing_looks_right_within_a_twentieth_of_its_range() {
    let scene = scene(
        20.0,
        "[[ship]]\nthrust_n = 2000\ndrag_n_s_per_m = 1000\nmass_kg = 100\nv0_m_per_s = 90",
    );
    for id in ["semi-implicit-euler", "explicit-euler"] {
        let error = |hz: u32| {
            let off = |of: fn(&dyn Stepper) -> f64, range: f64| {
                let lane = run(&scene, spec(id).solver(), hz, 20.0, of);
                let truth = run(&scene, Solver::Truth, hz, 20.0, of);
                lane.iter().zip(&truth).map(|(a, b)| (a - b).abs() / range).fold(0.0, f64::max)
            };
            // From 0 to 48.8 m, and from 90 to 2 m/s.
            off(|body| body.q()[0], 48.8).max(off(|body| body.v()[0], 88.0))
        };
        let adviser = Adviser::new(&scene, 1.0, 60);
        let hz = adviser.slowest(spec(id), CRITERIA[LOOKS_RIGHT]).unwrap();
        assert!(hz > 1 && error(hz) <= 0.05 && error(hz - 1) > 0.05, "{id}: {hz} Hz");
    }
}

#[test]
fn advice_is_of_the_fewest_substeps_the_slowest_rate_and_the_stiffest_spring() {
    // Semi-implicit Euler looks right from 12.41 Hz on: up to z = 0.4833, as above. By fewer than three ticks a
    // turn nobody sees how wide the stiffer springs swing.
    for (tick_hz, substeps, slowest_hz, stiffness_factor) in [
        (60, 1, 13, Some(22.0)),
        (13, 1, 13, Some(1.0)),
        (10, 2, 7, Some(2.4)),
        (5, 3, 5, Some(1.4)),
        (4, 4, 4, None),
        (3, 5, 3, None),
    ] {
        let adviser = Adviser::new(&six_radians(), 1.0, tick_hz);
        assert_eq!(adviser.tick_hz(), tick_hz);
        let met = adviser
            .meets(spec("semi-implicit-euler"), CRITERIA[LOOKS_RIGHT])
            .met()
            .unwrap()
            .clone();
        assert_eq!((met.substeps, met.slowest_hz), (substeps, Some(slowest_hz)), "{tick_hz} Hz");
        assert!(
            stiffness_factor.is_none_or(|factor| met.stiffness_factor == Some(factor)),
            "{met:?}"
        );
        assert_eq!(met.evaluations_per_s, f64::from(substeps * tick_hz), "{tick_hz} Hz");
        assert_eq!(met.limited_by.as_deref(), Some("stiffness"));
    }
}

#[test]
fn a_frequency_error_is_told_where_it_stays_the_same() {
    let scene = pendulum();
    for (id, tick_hz) in
        [("semi-implicit-euler", 60), ("semi-implicit-euler", 30), ("velocity-verlet", 30)]
    {
        let hz = f64::from(tick_hz);
        // From the first time that it rises through the middle to the last but one, so that both make as many.
        let seconds = |solver: Solver| {
            let angles = run(&scene, solver, tick_hz, 20.0, |body| body.q()[0]);
            let rises = angles.windows(2).enumerate().filter(|(_, x)| x[0] < 0.0 && x[1] >= 0.0);
            let at: Vec<f64> = rises.map(|(i, x)| i as f64 + x[0] / (x[0] - x[1])).collect();
            (at[14] - at[0]) / hz
        };
        let wanted = seconds(Solver::Truth) / seconds(spec(id).solver()) - 1.0;
        let found = verdict(&scene, id, tick_hz).frequency_error.unwrap();
        assert!((found / wanted - 1.0).abs() < 0.03, "{id}, {tick_hz} Hz: {found}, not {wanted}");
    }
    // As the swing gets wider or narrower, it gets slower or faster.
    for id in ["explicit-euler", "improved-euler", "implicit-euler", "bdf2"] {
        assert_eq!(verdict(&scene, id, 60).frequency_error, None, "{id}");
    }
}

#[test]
fn a_frequency_error_is_that_of_a_step_however_often_the_body_turns_in_a_tick() {
    // 100 rad/s: a turn and a half in a tick, a fortieth of one in a step.
    let scene = scene(20.0, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 10000");
    let spec = LaneSpec { substeps: 64, ..spec("velocity-verlet") };
    let found = Judge::new(&scene, 1.0).verdict(spec, 10);
    let z: f64 = 100.0 / 640.0;
    let wanted = 2.0 * libm::asin(z / 2.0) / z - 1.0;
    let error = found.frequency_error.unwrap();
    assert!((error / wanted - 1.0).abs() < 1e-6, "{error}, not {wanted}: {found}");
}

#[test]
fn advice_counts_the_evaluations_of_all_bodies_in_a_second() {
    let both = "[[ship]]\nthrust_n = 2000\ndrag_n_s_per_m = 100\nmass_kg = 1000\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 39.47841760435743";
    let adviser = Adviser::new(&scene(20.0, both), 1.0, 60);
    for criterion in CRITERIA {
        let met = adviser.meets(spec("rk4"), criterion).met().unwrap().clone();
        // Four a step, of two bodies.
        assert_eq!((met.substeps, met.evaluations_per_s), (1, 480.0), "{}", criterion.id());
        assert_eq!(met.limited_by.as_deref(), Some("stiffness (spring)"));
    }
}

#[test]
fn the_body_that_fares_worst_speaks_and_all_are_counted() {
    let free = "[[spring]]\nname = \"free\"\nmass_kg = 1\nstiffness_n_per_m = 39.4784";
    let stiff = "[[spring]]\nname = \"stiff\"\nmass_kg = 1\nstiffness_n_per_m = 1e6";
    let ship = "[[ship]]\nname = \"ship\"\nthrust_n = 2000\ndrag_n_s_per_m = 100\nmass_kg = 1000";
    let of = |bodies: &[&str]| scene(20.0, &bodies.join("\n"));
    for (bodies, id, place, is_bounded) in [
        (&[free, stiff, ship][..], "explicit-euler", 1, false),
        (&[ship, free], "explicit-euler", 1, false),
        (&[free, ship], "explicit-euler", 0, false),
        (&[ship, free], "velocity-verlet", 1, true),
        (&[free, ship], "velocity-verlet", 0, true),
    ] {
        let scene = of(bodies);
        let judge = Judge::new(&scene, 1.0);
        let found = judge.verdict(spec(id), 60);
        assert_eq!(found.body_name.as_deref(), Some(scene.bodies[place].name.as_str()), "{found}");
        assert_eq!((found.body, found.is_bounded), (place, Some(is_bounded)), "{found}");
        let alone: Vec<Verdict> =
            bodies.iter().map(|body| Judge::new(&of(&[body]), 1.0).verdict(spec(id), 60)).collect();
        assert_eq!(found.evaluations, alone.iter().map(|v| v.evaluations).sum::<u64>());
        assert_eq!((found.outcome, found.error), (alone[place].outcome, alone[place].error));
        assert_eq!(alone[place].body_name, None);
    }
}

#[test]
fn a_scene_is_judged_under_its_throttle_and_over_a_minute_of_it() {
    let long = scene(600.0, "[[ship]]\nthrust_n = 2000\ndrag_n_s_per_m = 100\nmass_kg = 1000");
    let judge = Judge::new(&long, 0.3);
    assert_eq!((judge.throttle(), judge.horizon_s()), (0.3, LONGEST_HORIZON_S));
    assert_eq!(judge.verdict(spec("rk4"), 10).seconds, LONGEST_HORIZON_S);
    assert_eq!(Judge::new(&spring(), -1.0).horizon_s(), 20.0);
    assert_eq!(Judge::over(&spring(), 1.0, 7.5).verdict(spec("rk4"), 10).horizon_s, 7.5);
}
