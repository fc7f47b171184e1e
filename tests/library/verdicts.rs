//! Verdicts that were false once, each on the scene where it was.

use regatta::measure::{Adviser, CRITERIA, Judge, Outcome, Verdict};
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::Solver;
use regatta::sim::TickRate;
use regatta::sim::integrators::{GENERAL_METHODS, method};

fn scene(seconds: f64, body: &str) -> Scene {
    let text = format!("title = \"t\"\ntick_hz = 60\nseconds = {seconds}\n{body}\n");
    Scene::parse("t", &text).unwrap()
}

fn spec(id: &str) -> LaneSpec {
    LaneSpec::plain(method(id).unwrap())
}

fn verdict(scene: &Scene, id: &str, tick_hz: impl Into<TickRate>) -> Verdict {
    Judge::over(scene, scene.seconds).verdict(spec(id), tick_hz)
}

fn built_in(name: &str) -> Scene {
    Scene::built_in(name).unwrap()
}

const BOUNDED: usize = 0;

#[test]
fn agreeing_with_a_failed_truth_does_not_count() {
    for body in [
        "[[pendulum]]\nlength_m = 1e-11",
        "[[pendulum]]\nlength_m = 1e-9",
        "[[pendulum]]\nlength_m = 1\ndamping_n_m_s = 1e5",
    ] {
        let scene = scene(2.0, body);
        let judge = Judge::new(&scene);
        for method in GENERAL_METHODS {
            let found = judge.verdict(LaneSpec::plain(method), 60);
            let mut lane =
                (scene.bodies[0].kind.build)(&scene.bodies[0].values, Solver::Method(method));
            let strays = (0..120).any(|tick| {
                lane.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).is_err()
                    || lane.q()[0].is_nan()
                    || lane.q()[0].abs() >= 10.0
            });
            let praised = found.outcome() <= Outcome::Accurate;
            assert!(!(strays && praised), "{body}: {} strays, and is {found}", method.id);
        }
    }
}

#[test]
fn a_growth_that_nobody_sees_within_the_scene_looks_right() {
    // Improved Euler doubles the swing in 769 s, which nobody sees in 20.
    let found = verdict(&built_in("spring"), "improved-euler", 60);
    assert_eq!(found.outcome(), Outcome::LooksRight);
    assert!((768.0..770.0).contains(&found.long_term.doubles_in_s.unwrap()));
}

#[test]
fn a_motion_that_settles_is_reported_as_settled() {
    let scene =
        scene(20.0, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 900\ndamping_n_s_per_m = 2");
    let found = verdict(&scene, "semi-implicit-euler", 20);
    assert!(
        found.error().unwrap() > 0.3 && found.comparison().unwrap().last_error < 0.01,
        "{found:?}"
    );
    let has_settled = |detail: &String| detail.ends_with(", settled by 20 s");
    assert!(found.details().iter().any(has_settled), "{:?}", found.details());
}

#[test]
fn a_scene_of_512_periods_is_judged_like_one_of_511() {
    for (seconds, body) in [
        (511.0, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 39.47841760435743"),
        (512.0, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 39.47841760435743"),
    ] {
        let found = verdict(&scene(seconds, body), "rk4", 60);
        assert!((0.003..0.0034).contains(&found.error().unwrap()), "{seconds} s: {found:?}");
    }
}

#[test]
fn a_pendulum_is_not_judged_by_the_map_about_one_of_its_states() {
    let scene = scene(20.0, "[[pendulum]]\nlength_m = 0.4\ntheta0_rad = 0.7");
    // At 3 Hz it turns over and over, to 2170 rad.
    let found = verdict(&scene, "semi-implicit-euler", 3);
    assert_eq!(
        (found.outcome(), found.long_term.is_bounded),
        (Outcome::Grows, Some(false)),
        "{found}"
    );
    // The frequency of its swing is lower than that about its rest by 0.49/16, and the method's error is of that.
    let found = verdict(&scene, "semi-implicit-euler", 30);
    let error = found.comparison().unwrap().frequency_error.unwrap();
    let z = (9.81_f64 / 0.4).sqrt() / 30.0;
    assert!((error / (z * z / 24.0) - 1.0).abs() < 0.25, "{error}, of {}", z * z / 24.0);
}

#[test]
fn an_orbit_is_bounded_only_if_it_stays() {
    let own = built_in("orbit");
    for hz in [5, 6, 8] {
        assert_eq!(verdict(&own, "rk4", hz).long_term.is_bounded, Some(false), "{hz} Hz");
    }
    let other =
        scene(20.0, "[[orbit]]\nmu_m3_per_s2 = 20433.1559\nx0_m = 81.0876\nvy0_m_per_s = -4.4574");
    for hz in [1, 14] {
        let found = verdict(&other, "semi-implicit-euler", hz);
        assert_eq!(found.long_term.is_bounded, Some(false), "{hz} Hz: {found}");
    }
}

#[test]
fn adams_bashforth_is_bounded_if_it_takes_a_year_to_double() {
    let adviser = Adviser::new(&built_in("spring"), 60);
    let slowest = adviser.slowest(spec("adams-bashforth-2"), CRITERIA[BOUNDED]).unwrap();
    // |λ| = 1 + z⁴/4 a tick, and ln 2 in a year.
    let growth = |hz: f64| (std::f64::consts::TAU / hz).powi(4) / 4.0 * hz * 365.0 * 86_400.0;
    let wanted = (1..).find(|&hz| growth(f64::from(hz)) < std::f64::consts::LN_2).unwrap();
    assert!(slowest.abs_diff(wanted) <= 2, "{slowest} Hz, not {wanted}");
    let found = verdict(&built_in("spring"), "adams-bashforth-2", 791);
    assert!((9.0..11.0).contains(&(found.long_term.doubles_in_s.unwrap() / 86_400.0)), "{found:?}");
}

#[test]
fn energy_drifts_relative_to_the_energy_in_motion() {
    let ship = scene(20.0, "[[ship]]\nthrust_n = 1234.5\ndrag_n_s_per_m = 0\nmass_kg = 777");
    let found = verdict(&ship, "rk4", 7);
    assert_eq!(found.outcome(), Outcome::Rounding);
    assert!(found.energy_drift_percent().is_none_or(|drift| drift.abs() < 1e-9), "{found:?}");
    let still = scene(20.0, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\nx0_m = 0");
    assert_eq!(verdict(&still, "rk4", 60).energy_drift_percent(), None);
}

#[test]
fn an_undeterminable_growth_is_left_unknown() {
    let damped = scene(20.0, "[[pendulum]]\nlength_m = 1\ndamping_n_m_s = 0.2\ntheta0_rad = 2");
    for id in ["dormand-prince-54", "rk4", "gauss-legendre-4"] {
        let found = verdict(&damped, id, 60);
        assert_eq!(
            (found.long_term.doubles_in_s, found.long_term.is_bounded),
            (None, Some(true)),
            "{id}: {found}"
        );
        assert!(found.outcome() <= Outcome::Accurate, "{id}: {found}");
    }
    // The loss of an adaptive method changes as the swing gets smaller.
    let spring = scene(20.0, "[[spring]]\nmass_kg = 1.509\nstiffness_n_per_m = 5841.83");
    let found = verdict(&spring, "bogacki-shampine-32", 28);
    let body = &spring.bodies[0];
    let mut lane = (body.kind.build)(&body.values, spec("bogacki-shampine-32").solver());
    let start = lane.energy().unwrap();
    let ticks = (0..).take_while(|&tick| {
        lane.advance(f64::from(tick) / 28.0, 1.0 / 28.0, 1).unwrap();
        lane.energy().unwrap() > start / 4.0
    });
    let halves = ticks.count() as f64 / 28.0;
    assert!(
        (found.long_term.halves_in_s.unwrap() / halves - 1.0).abs() < 0.02,
        "{found:?}, not {halves} s"
    );
}

#[test]
fn only_rounding_errors_count_as_rounding() {
    assert_eq!(verdict(&built_in("ship"), "explicit-euler", 2).outcome(), Outcome::LooksRight);
    // A fast fly-by is nearly straight, and explicit Euler nearly right on it.
    let fast = scene(
        1.0,
        "[[orbit]]\nmu_m3_per_s2 = 6.488\nx0_m = 3.381\nvx0_m_per_s = 1e5\nvy0_m_per_s = 2.718",
    );
    let found = verdict(&fast, "explicit-euler", 60);
    assert!(found.outcome() != Outcome::Rounding || found.error().unwrap() < 1e-9, "{found:?}");
}

#[test]
fn a_motion_needing_too_much_work_is_not_judged() {
    let stiff = scene(20.0, "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1e12");
    let found = verdict(&stiff, "dormand-prince-54", 1000);
    assert_eq!(found.outcome(), Outcome::NotJudged, "{found}");
    assert_eq!(found.to_string(), "not judged · too much work");
    let long = scene(20.0, "[[chain]]\nmasses = 256\nmass_kg = 1\nstiffness_n_per_m = 800");
    let found = verdict(&long, "gauss-legendre-4", 60);
    assert_eq!(found.outcome(), Outcome::NotJudged, "{found}");
}

#[test]
fn the_recommended_lanes_meet_their_criterion_in_a_race() {
    use regatta::measure::{TOLERANCE, recommended};
    use regatta::run::Race;
    for name in ["spring", "stiff", "ship", "harbour", "orbit"] {
        let scene = built_in(name);
        let adviser = Adviser::new(&scene, scene.tick_hz);
        let accurate = 2;
        let advised: Vec<_> = ["rk4", "velocity-verlet", "pefrl", "position-verlet"]
            .map(|id| regatta::measure::MethodAdvice {
                spec: spec(id),
                verdict: adviser.verdict(spec(id)),
                met: CRITERIA.map(|criterion| adviser.meets(spec(id), criterion)),
            })
            .into();
        let taken = recommended(&advised, accurate).unwrap();
        let substeps = advised[taken].met[accurate].met().unwrap().substeps;
        let lane = LaneSpec { substeps, ..advised[taken].spec };
        let mut race = Race::new(&scene, [lane]);
        let mut errors = vec![0.0_f64; scene.bodies.len()];
        let mut sizes = vec![0.0_f64; scene.bodies.len()];
        for _ in 0..(scene.seconds * f64::from(scene.tick_hz)) as u64 {
            race.step(&mut ());
            let bodies = race.entrants()[0].lane.bodies().iter().zip(race.truth().bodies());
            for (i, (lane, truth)) in bodies.enumerate() {
                for (q, exact) in lane.stepper.q().iter().zip(truth.stepper.q()) {
                    errors[i] = errors[i].max((q - exact).abs());
                    sizes[i] = sizes[i].max(exact.abs());
                }
            }
        }
        for (error, size) in errors.iter().zip(&sizes) {
            assert!(*error <= 2.0 * TOLERANCE * size, "{name}: {error} of {size}");
        }
    }
}

#[test]
fn a_scene_is_judged_with_the_inputs_of_its_script() {
    let text = "title = \"t\"\ntick_hz = 60\nseconds = 20\n[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 400\n\
                x0_m = 0\n[[command]]\nat_s = 1\nkick = 1.0\n";
    let kicked = Scene::parse("t", text).unwrap();
    let found = verdict(&kicked, "explicit-euler", 60);
    assert!(matches!(found.outcome(), Outcome::Grows | Outcome::BlewUp), "{found}");
    assert_eq!(verdict(&kicked, "dormand-prince-54", 60).outcome(), Outcome::Accurate);
    // The helm turns, and explicit Euler's course with it: off by metres.
    let helm = built_in("helm");
    let found = verdict(&helm, "explicit-euler", helm.tick_hz);
    assert!(found.error().unwrap() > 0.03, "{found}");
    let adviser = Adviser::new(&helm, helm.tick_hz);
    let met = adviser.meets(spec("explicit-euler"), CRITERIA[BOUNDED]);
    let factor = met.met().unwrap().stiffness_factor.expect("it is known");
    assert!((1.0..10.0).contains(&factor), "{factor} times the side drag");
}

#[test]
fn an_overflowing_map_is_unbounded_without_a_panic() {
    for body in [
        "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 4e9",
        "[[spring]]\nmass_kg = 1e-15\nstiffness_n_per_m = 40",
        "[[ship]]\nthrust_n = 1\ndrag_n_s_per_m = 1e9\nmass_kg = 1",
    ] {
        let scene = scene(1.0, body);
        for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
            let found = verdict(&scene, method.id, 60);
            let is_implicit = method.evaluations.is_none();
            assert!(
                is_implicit || found.long_term.is_bounded != Some(true),
                "{body}, {}: {found}",
                method.id
            );
        }
    }
}

#[test]
fn accurate_motions_look_right_and_fast_ones_do_not() {
    let looks_right = 1;
    for (hz, body, id) in [
        (60, "[[pendulum]]\nlength_m = 12", "rk4"),
        (60, "[[pendulum]]\nlength_m = 0.36\ntheta0_rad = 0.82", "dormand-prince-54"),
        (20, "[[spring]]\nmass_kg = 80.1143\nstiffness_n_per_m = 164359", "dormand-prince-54"),
        (
            60,
            "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 10000\ndamping_n_s_per_m = 100",
            "dormand-prince-54",
        ),
    ] {
        let adviser = Adviser::new(&scene(5.0, body), hz);
        assert!(adviser.verdict(spec(id)).outcome() <= Outcome::Accurate, "{body}");
        let meets = adviser.meets(spec(id), CRITERIA[looks_right]);
        assert_eq!(meets.met().map(|met| met.substeps), Some(1), "{body}: {meets:?}");
    }
    let surge = Adviser::new(&built_in("surge"), 1);
    let meets = surge.meets(spec("position-verlet"), CRITERIA[looks_right]);
    assert!(meets.met().is_none_or(|met| met.substeps > 1), "{meets:?}");
}

#[test]
fn a_motion_without_return_has_no_doubling_time() {
    let ship = scene(20.0, "[[ship]]\nthrust_n = 1234.5\ndrag_n_s_per_m = 0\nmass_kg = 777");
    assert_eq!(verdict(&ship, "adaptive-euler-as-printed", 7).long_term.doubles_in_s, None);
    let hyperbola = scene(
        20.0,
        "[[orbit]]\nmu_m3_per_s2 = 10969.2\nx0_m = 4.26479\nvx0_m_per_s = -12.9282\nvy0_m_per_s = 73.04756",
    );
    let found = verdict(&hyperbola, "midpoint", 20);
    assert_eq!(found.long_term.doubles_in_s, None, "{found}");
}
