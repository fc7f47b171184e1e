//! Verdicts and advice against plain runs: energies, amplitudes and errors counted out here once more.

use regatta::measure::{
    Adviser, CRITERIA, CriterionResult, Finding, Judge, MAX_HORIZON_S, NoTruth, NotJudged, Outcome,
    TOLERANCE, Verdict,
};
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::integrators::method;
use regatta::sim::{Solver, Stepper};

use crate::dice::Dice;

pub(super) const LOOKS_RIGHT: usize = 1;

pub(super) fn scene(seconds: f64, bodies: &str) -> Scene {
    let text = format!("title = \"t\"\ntick_hz = 60\nseconds = {seconds}\n{bodies}\n");
    Scene::parse("t", &text).unwrap()
}

pub(super) fn spec(id: &str) -> LaneSpec {
    LaneSpec::plain(method(id).unwrap())
}

fn verdict(scene: &Scene, id: &str, tick_hz: u32) -> Verdict {
    Judge::new(scene).verdict(spec(id), tick_hz)
}

fn body(scene: &Scene, solver: Solver) -> Box<dyn Stepper> {
    (scene.bodies[0].kind.build)(&scene.bodies[0].values, solver)
}

/// Applies `see` to the first body after each tick of a plain run.
pub(super) fn run<T>(
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
fn verdicts_on_a_spring_match_energy_and_swing_of_the_run() {
    let scene = spring();
    for (id, tick_hz, word) in [
        ("explicit-euler", 60, Outcome::Grows),
        ("improved-euler", 10, Outcome::Grows),
        ("improved-euler", 60, Outcome::LooksRight),
        ("rk4", 10, Outcome::DiesAway),
        ("bdf2", 10, Outcome::DiesAway),
        ("bdf2", 60, Outcome::LooksRight),
        ("implicit-euler", 60, Outcome::DiesAway),
        ("rk4", 60, Outcome::Accurate),
    ] {
        let found = verdict(&scene, id, tick_hz);
        assert_eq!(found.outcome(), word, "{found}");
        let energies = |seconds| {
            run(&scene, spec(id).solver(), tick_hz, seconds, |body| body.energy().unwrap() / 40.0)
        };
        let last = *energies(20.0).last().unwrap();
        let change = found.comparison().unwrap().energy_change.unwrap();
        assert!((change + 1.0 - last).abs() < 0.02 * last.max(0.01), "{id}: {change}, to {last}");
        let grows = last > 1.0;
        let (time, other) = match grows {
            true => (found.long_term.doubles_in_s, found.long_term.halves_in_s),
            false => (found.long_term.halves_in_s, found.long_term.doubles_in_s),
        };
        assert_eq!((other, found.long_term.is_bounded), (None, Some(!grows)), "{id}");
        let time = time.unwrap();
        if time < 2000.0 {
            let reached = *energies(time).last().unwrap();
            let wanted = if grows { 4.0 } else { 0.25 };
            assert!((reached / wanted - 1.0).abs() < 0.25, "{id}: {reached} after {time} s");
        }
    }
}

#[test]
fn a_pendulums_word_and_number_follow_its_energy() {
    let scene = pendulum();
    let start = body(&scene, Solver::Truth).energy().unwrap();
    for (id, tick_hz, word, is_bounded) in [
        ("explicit-euler", 60, Outcome::Grows, false),
        ("improved-euler", 10, Outcome::Grows, false),
        ("improved-euler", 60, Outcome::LooksRight, false),
        ("semi-implicit-euler", 10, Outcome::LooksRight, true),
        ("semi-implicit-euler", 60, Outcome::LooksRight, true),
        // Wider by an eighth and narrower by a twentieth than in truth, from the first turn to the last.
        ("semi-implicit-euler", 5, Outcome::Bounded, true),
        ("velocity-verlet", 5, Outcome::Bounded, true),
        ("rk4", 10, Outcome::LooksRight, true),
        ("bdf2", 10, Outcome::DiesAway, true),
        ("bdf2", 60, Outcome::LooksRight, true),
        ("implicit-euler", 60, Outcome::DiesAway, true),
        ("rk4", 60, Outcome::Accurate, true),
    ] {
        let found = verdict(&scene, id, tick_hz);
        assert_eq!(
            (found.outcome(), found.long_term.is_bounded),
            (word, Some(is_bounded)),
            "{found}"
        );
        let energies = run(&scene, spec(id).solver(), tick_hz, 20.0, |b| b.energy().unwrap());
        let last = energies.last().unwrap() / start - 1.0;
        let change = found.comparison().unwrap().energy_change.unwrap();
        assert!((change - last).abs() < 1e-6 * (1.0 + last.abs()), "{id}: {change}, not {last}");
        let largest = energies.iter().map(|e| 100.0 * (e / start - 1.0));
        let largest = largest.max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap();
        let drift = found.energy_drift_percent().unwrap();
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
        assert_eq!(verdict(&scene, id, tick_hz).long_term.doubles_in_s, Some(at), "{id}");
    }
    for (id, tick_hz, seconds) in [("rk4", 10, 1000.0), ("bdf2", 60, 1500.0)] {
        let last = angles(id, tick_hz, seconds).iter().rposition(|part| *part > 0.5).unwrap();
        let at = (last + 2) as f64 / f64::from(tick_hz);
        let found = verdict(&scene, id, tick_hz).long_term.halves_in_s.unwrap();
        assert!((found / at - 1.0).abs() < 1e-3, "{id}: {found} s, not {at}");
    }
    // Halved within the first turns is not timed.
    assert_eq!(verdict(&scene, "implicit-euler", 10).long_term.halves_in_s, None);
}

#[test]
fn a_damped_motion_that_dies_away_is_not_judged_as_losing_energy() {
    let damped = "[[spring]]\nmass_kg = 2\nstiffness_n_per_m = 80\ndamping_n_s_per_m = 0.3";
    let free = "[[ship]]\nthrust_n = 2000\ndrag_n_s_per_m = 0\nmass_kg = 1000\nv0_m_per_s = 3";
    for (body, id, word) in [
        (damped, "implicit-euler", Outcome::Bounded),
        (damped, "bdf2", Outcome::Bounded),
        (free, "semi-implicit-euler", Outcome::Accurate),
        (free, "rk4", Outcome::Rounding),
    ] {
        let found = verdict(&scene(20.0, body), id, 10);
        assert_eq!(
            (found.outcome(), found.long_term.is_bounded),
            (word, Some(true)),
            "{id}: {found}"
        );
        let times = (
            found.long_term.halves_in_s,
            found.long_term.doubles_in_s,
            found.comparison().unwrap().energy_change,
        );
        assert_eq!(times, (None, None, None), "{id}: {found}");
    }
}

#[test]
fn a_motion_with_too_vague_a_truth_is_not_judged() {
    // Released so near the top that each return there multiplies the error of the truth.
    let top = |seconds| scene(seconds, "[[pendulum]]\nlength_m = 0.4\ntheta0_rad = 3.14159");
    let found = verdict(&top(15.0), "rk4", 60);
    assert!(found.outcome() != Outcome::NoTruth, "{found}");
    for (seconds, least, most) in [(30.0, TOLERANCE / 2.0, 0.02), (60.0, 0.02, 0.1)] {
        let found = verdict(&top(seconds), "rk4", 60);
        let Finding::NoTruth(NoTruth::Vague(part)) = found.finding else { panic!("{found}") };
        assert!(part > least && part < most, "{found}");
    }
}

#[test]
fn no_run_is_judged_beyond_the_end_of_its_scene() {
    // 1.6 ticks: the second one ends after the scene.
    let scene = scene(0.8, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 36");
    let found = verdict(&scene, "explicit-euler", 2);
    assert_eq!(found.seconds, 0.5, "{found:?}");
    // 0.8 ticks.
    for id in ["explicit-euler", "rk4", "dormand-prince-54"] {
        let found = verdict(&scene, id, 1);
        assert_eq!(found.finding, Finding::NotJudged(NotJudged::ShorterThanATick));
        assert_eq!(found.long_term.is_bounded, None);
        let adviser = Adviser::new(&scene, 1);
        assert!(
            CRITERIA.iter().all(|&of| adviser.meets(spec(id), of) == CriterionResult::Unknown),
            "{id}"
        );
    }
    assert_ne!(verdict(&scene, "rk4", 100).outcome(), Outcome::NotJudged);
}

#[test]
fn looks_right_requires_the_width_and_frequency_of_the_truth() {
    let slowest = |scene: &Scene, id: &str| {
        Adviser::new(scene, 60).slowest(spec(id), CRITERIA[LOOKS_RIGHT]).unwrap()
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
fn a_motion_without_swing_looks_right_within_a_twentieth_of_its_range() {
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
        let adviser = Adviser::new(&scene, 60);
        let hz = adviser.slowest(spec(id), CRITERIA[LOOKS_RIGHT]).unwrap();
        assert!(hz > 1 && error(hz) <= 0.05 && error(hz - 1) > 0.05, "{id}: {hz} Hz");
    }
}

#[test]
fn advice_names_fewest_substeps_slowest_rate_and_stiffest_spring() {
    // Semi-implicit Euler looks right from 12.41 Hz on: up to z = 0.4833, as above, and no more than ten times the
    // stiffness is tried.
    for (tick_hz, substeps, slowest_hz, stiffness_factor) in [
        (60, 1, 13, Some(10.0)),
        (13, 1, 13, Some(1.0)),
        (10, 2, 7, Some(2.4)),
        (5, 3, 5, Some(1.4)),
        (4, 4, 4, Some(1.6)),
        (3, 5, 3, Some(1.4)),
    ] {
        let adviser = Adviser::new(&six_radians(), tick_hz);
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
fn only_a_constant_frequency_error_is_reported() {
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
        let found = verdict(&scene, id, tick_hz).comparison().unwrap().frequency_error.unwrap();
        assert!((found / wanted - 1.0).abs() < 0.03, "{id}, {tick_hz} Hz: {found}, not {wanted}");
    }
    // As the swing gets wider or narrower, it gets slower or faster.
    for id in ["explicit-euler", "improved-euler", "implicit-euler", "bdf2"] {
        assert_eq!(verdict(&scene, id, 60).comparison().unwrap().frequency_error, None, "{id}");
    }
}

#[test]
fn growth_after_a_late_kick_counts_from_the_kick() {
    let at_rest = "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 36\nx0_m = 0";
    let kicked = scene(20.0, &format!("{at_rest}\n[[command]]\nat_s = 15\nkick = 1.0"));
    let found = verdict(&kicked, "improved-euler", 30).comparison().unwrap().energy_change.unwrap();
    // Improved Euler multiplies the energy of a spring by 1 + (ω h)⁴/4 in each step.
    let wanted = f64::powi(1.0 + f64::powi(6.0 / 30.0, 4) / 4.0, 5 * 30) - 1.0;
    assert!((found / wanted - 1.0).abs() < 1e-6, "{found}, not {wanted}");
}

#[test]
fn the_frequency_error_is_right_for_several_turns_in_a_tick() {
    // 100 rad/s: a turn and a half in a tick, a fortieth of one in a step.
    let scene = scene(20.0, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 10000");
    let spec = LaneSpec { substeps: 64, ..spec("velocity-verlet") };
    let found = Judge::new(&scene).verdict(spec, 10);
    let z: f64 = 100.0 / 640.0;
    let wanted = 2.0 * libm::asin(z / 2.0) / z - 1.0;
    let error = found.comparison().unwrap().frequency_error.unwrap();
    assert!((error / wanted - 1.0).abs() < 1e-6, "{error}, not {wanted}: {found}");
}

#[test]
fn advice_counts_the_evaluations_of_all_bodies_in_a_second() {
    let both = "[[ship]]\nthrust_n = 2000\ndrag_n_s_per_m = 100\nmass_kg = 1000\n\
                [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 39.47841760435743";
    let adviser = Adviser::new(&scene(20.0, both), 60);
    for criterion in CRITERIA {
        let met = adviser.meets(spec("rk4"), criterion).met().unwrap().clone();
        // Four a step, of two bodies.
        assert_eq!((met.substeps, met.evaluations_per_s), (1, 480.0), "{}", criterion.id());
    }
    // The ship bears ten times the drag.
    let met = adviser.meets(spec("rk4"), CRITERIA[2]).met().unwrap().clone();
    assert!(met.stiffness_factor.is_some_and(|factor| factor < 10.0), "{met:?}");
    assert_eq!(met.limited_by.as_deref(), Some("stiffness (spring)"));
}

#[test]
fn the_worst_body_decides_and_every_body_counts() {
    let free = "[[spring]]\nname = \"free\"\nmass_kg = 1\nstiffness_n_per_m = 39.4784";
    let stiff = "[[spring]]\nname = \"stiff\"\nmass_kg = 1\nstiffness_n_per_m = 1e6";
    let ship = "[[ship]]\nname = \"ship\"\nthrust_n = 2000\ndrag_n_s_per_m = 100\nmass_kg = 1000";
    let of = |bodies: &[&str]| scene(20.0, &bodies.join("\n"));
    for (bodies, id, index, is_bounded) in [
        (&[free, stiff, ship][..], "explicit-euler", 1, false),
        (&[ship, free], "explicit-euler", 1, false),
        (&[free, ship], "explicit-euler", 0, false),
        (&[ship, free], "velocity-verlet", 1, true),
        (&[free, ship], "velocity-verlet", 0, true),
    ] {
        let scene = of(bodies);
        let judge = Judge::new(&scene);
        let found = judge.verdict(spec(id), 60);
        assert_eq!(found.body_name, scene.bodies[index].name, "{found}");
        assert_eq!((found.body, found.long_term.is_bounded), (index, Some(is_bounded)), "{found}");
        let alone: Vec<Verdict> =
            bodies.iter().map(|body| Judge::new(&of(&[body])).verdict(spec(id), 60)).collect();
        assert_eq!(found.evaluations, alone.iter().map(|v| v.evaluations).sum::<u64>());
        assert_eq!(found.finding, alone[index].finding);
        assert!(found.to_string().contains(&found.body_name));
        assert!(!alone[index].to_string().contains(&found.body_name));
    }
}

#[test]
fn a_scene_is_judged_under_its_throttle_and_for_at_most_a_minute() {
    let long = scene(600.0, "[[ship]]\nthrust_n = 2000\ndrag_n_s_per_m = 100\nmass_kg = 1000");
    let judge = Judge::at_throttle(&long, 0.3);
    assert_eq!((judge.throttle(), judge.horizon_s()), (0.3, MAX_HORIZON_S));
    assert_eq!(judge.verdict(spec("rk4"), 10).seconds, MAX_HORIZON_S);
    assert_eq!(Judge::at_throttle(&spring(), -1.0).horizon_s(), 20.0);
    assert_eq!(Judge::over(&spring(), 7.5).verdict(spec("rk4"), 10).horizon_s, 7.5);
}

/// The extremes of the first coordinate of a plain run, one for each half turn, interpolated between ticks.
fn extremes(scene: &Scene, solver: Solver, tick_hz: u32) -> Vec<f64> {
    let x = run(scene, solver, tick_hz, scene.seconds, |body| body.q()[0].abs());
    let tops = x.windows(3).filter(|x| x[1] >= x[0] && x[1] > x[2]);
    tops.map(|x| {
        let bend = x[0] - 2.0 * x[1] + x[2];
        x[1] - (x[2] - x[0]).powi(2) / (8.0 * bend)
    })
    .collect()
}

#[test]
fn a_damped_swing_looks_right_wherever_its_extremes_fall() {
    let damped = |stiffness: f64| {
        let spring = format!(
            "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = {stiffness}\ndamping_n_s_per_m = 1\nx0_m = 1"
        );
        scene(20.0, &spring)
    };
    let spec = spec("semi-implicit-euler");
    for stiffness in [90.0, 99.0, 150.0, 180.0, 240.0, 300.0] {
        let scene = damped(stiffness);
        let [lane, truth] =
            [extremes(&scene, spec.solver(), 60), extremes(&scene, Solver::Truth, 6000)];
        assert!(lane.iter().zip(&truth).all(|(a, b)| (a - b).abs() < 0.05), "{stiffness}");
        let meets = Adviser::new(&scene, 60).meets(spec, CRITERIA[LOOKS_RIGHT]);
        let met = meets.met().unwrap().clone();
        assert_eq!(met.substeps, 1, "{stiffness}: {met:?}");
        // Advice for a factor of stiffness is true of every stiffer spring up to it.
        let factor = met.stiffness_factor.unwrap();
        for part in [0.25, 0.5, 0.75, 1.0] {
            let stiffer = damped(stiffness * (1.0 + part * (factor - 1.0)));
            let meets = Adviser::new(&stiffer, 60).meets(spec, CRITERIA[LOOKS_RIGHT]);
            assert_eq!(meets.met().map(|met| met.substeps), Some(1), "{stiffness}: {factor}");
        }
    }
    // A motion that comes to rest too soon or too late does not look right.
    for (id, looks_right) in [("implicit-euler", false), ("rk4", true)] {
        let meets = Adviser::new(&damped(150.0), 60).meets(self::spec(id), CRITERIA[LOOKS_RIGHT]);
        assert_eq!(meets.met().is_some_and(|met| met.substeps == 1), looks_right, "{id}");
    }
}

#[test]
fn a_chain_of_many_modes_looks_right_by_the_amplitude_of_its_modes() {
    for stiffness in [400, 480] {
        let chain = format!("[[chain]]\nmasses = 64\nmass_kg = 1\nstiffness_n_per_m = {stiffness}");
        let adviser = Adviser::new(&scene(5.0, &chain), 60);
        let least = (1..=4).find(|&substeps| {
            let spec = LaneSpec { substeps, ..spec("velocity-verlet") };
            adviser.slowest(spec, CRITERIA[LOOKS_RIGHT]).is_some_and(|hz| hz <= 60)
        });
        assert_eq!(least, Some(1), "{stiffness}");
    }
}

#[test]
fn every_stiffness_up_to_the_advised_factor_is_bounded() {
    let scaled = |factor: f64| {
        let text = format!(
            "[[pendulum]]\nlength_m = 0.4\ntheta0_rad = 2.2\ngravity_m_per_s2 = {}",
            9.81 * factor
        );
        scene(10.0, &text)
    };
    for (id, tick_hz) in [("semi-implicit-euler", 12), ("velocity-verlet", 9)] {
        let adviser = Adviser::new(&scaled(1.0), tick_hz);
        let meets = adviser.meets(spec(id), CRITERIA[0]);
        let met = meets.met().unwrap();
        let factor = met.stiffness_factor.unwrap();
        for tenth in (11..).map(f64::from).take_while(|tenth| tenth / 10.0 <= factor.min(2.0)) {
            let lane = LaneSpec { substeps: met.substeps, ..spec(id) };
            let found = Judge::new(&scaled(tenth / 10.0)).verdict(lane, tick_hz);
            assert_eq!(found.long_term.is_bounded, Some(true), "{id}: {tenth} tenths of {factor}");
        }
    }
}

#[test]
fn an_adaptive_method_on_an_oscillator_is_judged_by_its_long_run() {
    let spring = "[[spring]]\nmass_kg = 7.019\nstiffness_n_per_m = 157.057\nx0_m = 1.578\nv0_m_per_s = -1.839";
    let scene = scene(20.0, spring);
    let year_s = 365.0 * 86_400.0;
    let (mut grow, mut stay) = (0, 0);
    for (id, substeps) in [
        ("adaptive-euler", 2),
        ("adaptive-euler", 1),
        ("bogacki-shampine-32", 1),
        ("dormand-prince-54", 1),
    ] {
        let spec = LaneSpec { substeps, ..spec(id) };
        let found = Judge::new(&scene).verdict(spec, 135);
        // The mean energy of the first and of the last 50 s of a long run.
        let mut lane = body(&scene, spec.solver());
        let (ticks, window, mut sums) = (135 * 1000, 135 * 50, [0.0; 2]);
        for tick in 0..ticks {
            lane.advance(f64::from(tick) / 135.0, 1.0 / 135.0, substeps).unwrap();
            let place = [tick < window, tick >= ticks - window].iter().position(|is_in| *is_in);
            if let Some(place) = place {
                sums[place] += lane.energy().unwrap();
            }
        }
        let doubles = 2.0 * std::f64::consts::LN_2 * 950.0 / libm::log(sums[1] / sums[0]);
        if (0.0..year_s).contains(&doubles) {
            grow += 1;
            assert_eq!(
                found.long_term.is_bounded,
                Some(false),
                "{id} ×{substeps} doubles in {doubles} s: {found}"
            );
            let told = found.long_term.doubles_in_s.unwrap();
            assert!((told / doubles - 1.0).abs() < 0.1, "{id} ×{substeps}: {told}, not {doubles}");
        } else {
            stay += 1;
            assert_eq!(
                (found.long_term.is_bounded, found.long_term.doubles_in_s),
                (Some(true), None),
                "{id}: {found}"
            );
        }
    }
    assert!(grow > 0 && stay > 0, "{grow} grow, {stay} stay");
}

#[test]
fn an_undamped_spring_that_looks_right_has_the_width_of_the_truth() {
    let (mut dice, mut refused) = (Dice::new(44_02), 0);
    for _ in 0..60 {
        let omega = 2.0 + 18.0 * dice.part();
        let [x0, v0] = [dice.between(0.3, 1.5), omega * dice.between(-1.5, 1.5)];
        let tick_hz = (omega / dice.between(0.2, 0.48)).round() as u32;
        let spring = format!(
            "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = {}\nx0_m = {x0}\nv0_m_per_s = {v0}",
            omega * omega
        );
        // v² + ω² x² - h ω² x v is constant, and x² is at most this over ω² (1 - z² / 4).
        let off = |steps: u32| {
            let h = 1.0 / f64::from(steps * tick_hz);
            let (exact, z) = ((v0 / omega).hypot(x0), h * omega);
            let kept = exact * exact - h * x0 * v0;
            (kept / (1.0 - z * z / 4.0)).sqrt() / exact - 1.0
        };
        let adviser = Adviser::new(&scene(20.0, &spring), tick_hz);
        let meets = adviser.meets(spec("semi-implicit-euler"), CRITERIA[LOOKS_RIGHT]);
        let told = meets.met().unwrap().substeps;
        assert!(off(told).is_finite() && off(told).abs() <= 0.0501, "×{told}: {spring}");
        refused += u32::from(told > 1 && off(told - 1).abs() > 0.05);
    }
    assert!((5..=55).contains(&refused), "{refused} are refused for their width");
}

#[test]
fn a_damped_spring_that_looks_right_has_the_reach_of_the_truth() {
    let scene = scene(
        20.0,
        "[[spring]]\nmass_kg = 1.606\nstiffness_n_per_m = 3464\ndamping_n_s_per_m = 1.86\n\
         x0_m = 1.238\nv0_m_per_s = -57.43",
    );
    let adviser = Adviser::new(&scene, 115);
    let meets = adviser.meets(spec("semi-implicit-euler"), CRITERIA[LOOKS_RIGHT]);
    let substeps = meets.met().unwrap().substeps;
    let furthest = |solver: Solver, substeps: u32| {
        let (mut body, mut furthest) = (body(&scene, solver), 0.0_f64);
        for tick in 0..115 * 16 {
            let h = 1.0 / (115.0 * 16.0);
            let (each, parts) = if solver == Solver::Truth { (1, 1) } else { (16, substeps) };
            if tick % each == 0 {
                body.advance(f64::from(tick) * h, f64::from(each) * h, parts).unwrap();
            }
            furthest = furthest.max(body.q()[0].abs());
        }
        furthest
    };
    let solver = spec("semi-implicit-euler").solver();
    let (truth, lane) = (furthest(Solver::Truth, 1), furthest(solver, substeps));
    assert!((truth - 1.6886).abs() < 2e-3, "{truth}");
    assert!((lane / truth - 1.0).abs() < 0.05, "{lane} by {substeps}, not {truth}");
    assert!(furthest(solver, substeps - 1) / truth > 1.04, "one fewer would do");
}

#[test]
fn a_body_that_swings_less_than_three_times_is_judged_by_its_first_swings() {
    let pendulum = "[[pendulum]]\nlength_m = 0.3939\nmass_kg = 0.3703\ngravity_m_per_s2 = 1.782\n\
                    theta0_rad = 2.144\nomega0_rad_per_s = 1.096";
    let spring = "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1";
    for (body, tick_hz, lengths, substeps) in
        [(pendulum, 4, [6.0, 10.0, 30.0], 1), (spring, 3, [8.0, 16.0, 60.0], 1)]
    {
        for seconds in lengths {
            let adviser = Adviser::new(&scene(seconds, body), tick_hz);
            let found = adviser.meets(spec("velocity-verlet"), CRITERIA[LOOKS_RIGHT]);
            assert_eq!(found.met().unwrap().substeps, substeps, "{seconds} s of {body}");
        }
    }
}

#[test]
fn a_barely_accurate_motion_has_no_margin() {
    for (id, tick_hz, body) in [
        ("midpoint", 10, "[[orbit]]\nmu_m3_per_s2 = 2.562\nx0_m = 0.4876\nvy0_m_per_s = 3.028"),
        (
            "velocity-verlet",
            2,
            "[[pendulum]]\nlength_m = 2.132\nmass_kg = 3.701\ntheta0_rad = 2.308\n\
             omega0_rad_per_s = -0.9921",
        ),
    ] {
        let adviser = Adviser::new(&scene(20.0, body), tick_hz);
        let met = adviser.meets(spec(id), CRITERIA[2]).met().unwrap().clone();
        assert!(met.substeps > 1 && met.stiffness_factor == Some(1.0), "{id}: {met:?}");
    }
}
