//! Custom bodies against built-in ones with the same equation.

use glam::DVec2;
use regatta::measure::Judge;
use regatta::prelude::{Extras, Options, ParameterOf, Range, State};
use regatta::run::Race;
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::Solver;
use regatta::sim::bodies::{Custom, FalseClaims};
use regatta::sim::integrators::{GENERAL_METHODS, METHODS};

use super::{Orbit, Spring};
use crate::words::everything;

fn twins() -> [(Scene, Scene); 3] {
    let parse = |body: &str| {
        let text = format!("title = 't'\ntick_hz = 60\nseconds = 20\n{body}");
        Scene::parse("t.toml", &text).unwrap()
    };
    let spring = |damping: f64| {
        let text =
            "[[spring]]\nmass_kg = 1.3\nstiffness_n_per_m = 41.7\nx0_m = 0.7\nv0_m_per_s = 0.2";
        let built_in = parse(&format!("{text}\ndamping_n_s_per_m = {damping}"));
        let spring = Spring { mass: 1.3, stiffness: 41.7, damping };
        let energy: Option<fn(&Spring, &State<f64>) -> f64> =
            (damping == 0.0).then_some(|spring: &Spring, state: &State<f64>| {
                spring.mass * state.v * state.v / 2.0 + spring.stiffness * state.q * state.q / 2.0
            });
        let extras = Extras { energy, is_linear: true, ..Extras::default() };
        let options = Options { name: "spring", extras, ..Options::default() };
        (built_in, Scene::of(&spring, State { q: 0.7, v: 0.2 }, options).unwrap())
    };
    let orbit = {
        let built_in = parse("[[orbit]]\nmu_m3_per_s2 = 40\nx0_m = 3\nvy0_m_per_s = 3");
        let energy = |orbit: &Orbit, state: &State<DVec2>| {
            state.v.length_squared() / 2.0 - orbit.mu / state.q.length()
        };
        let extras = Extras { energy: Some(energy), ..Extras::default() };
        let options = Options { name: "orbit", extras, ..Options::default() };
        let start = State { q: DVec2::new(3.0, 0.0), v: DVec2::new(0.0, 3.0) };
        (built_in, Scene::of(&Orbit { mu: 40.0 }, start, options).unwrap())
    };
    [spring(0.0), spring(0.3), orbit]
}

#[test]
fn custom_bodies_match_built_in_ones_to_the_bit_under_every_method() {
    for (built_in, own) in twins() {
        for method in GENERAL_METHODS {
            let [mut a, mut b] = [&built_in, &own].map(|scene| {
                let body = &scene.bodies[0];
                (body.kind.build)(&body.values, Solver::Method(method))
            });
            for tick in 0..600 {
                let t = f64::from(tick) / 60.0;
                let [first, second] = [&mut a, &mut b].map(|body| body.advance(t, 1.0 / 60.0, 1));
                assert_eq!(first, second);
                if first.is_err() {
                    break;
                }
                let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                let name = &own.bodies[0].name;
                assert_eq!(bits(a.q()), bits(b.q()), "{} on the {name} at tick {tick}", method.id);
                assert_eq!(bits(a.v()), bits(b.v()), "{} on the {name} at tick {tick}", method.id);
            }
            assert_eq!(a.evaluations(), b.evaluations(), "{}", method.id);
            assert_eq!(a.lost_time(), b.lost_time(), "{}", method.id);
        }
    }
}

#[test]
fn custom_bodies_have_the_verdicts_of_built_in_ones() {
    for (built_in, own) in twins() {
        let judges = [&built_in, &own].map(Judge::new);
        for method in GENERAL_METHODS {
            for tick_hz in [15, 60] {
                let spec = LaneSpec::plain(method);
                let [a, b] =
                    judges.each_ref().map(|judge| everything(&judge.verdict(spec, tick_hz)));
                // The error of an exact method is the rounding of the truth, which differs.
                let rounding = "accurate · within 10⁻";
                if method.exact_if_linear && a.starts_with(rounding) {
                    assert!(b.starts_with(rounding), "{b}");
                    continue;
                }
                assert_eq!(a, b, "{} at {tick_hz} Hz on the {}", method.id, own.bodies[0].name);
            }
        }
    }
}

#[test]
fn a_custom_exact_solution_is_the_truth_until_an_intervention() {
    let exact = |spring: &Spring, t: f64| {
        let omega = (spring.stiffness / spring.mass).sqrt();
        State { q: libm::cos(omega * t), v: -omega * libm::sin(omega * t) }
    };
    let spring = Spring { mass: 2.0, stiffness: 50.0, damping: 0.0 };
    let start = State { q: 1.0, v: 0.0 };
    let extras = Extras { exact: Some(exact), ..Extras::default() };
    let scene = Scene::of(&spring, start, Options { extras, ..Options::default() }).unwrap();
    let body = &scene.bodies[0];
    let mut truth = (body.kind.build)(&body.values, Solver::Truth);
    for tick in 0..600 {
        truth.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    let wanted = exact(&spring, 10.0);
    assert_eq!([truth.q()[0], truth.v()[0]], [wanted.q, wanted.v]);
    let off = truth.truth_error().expect("a truth")[0];
    assert!(off > 0.0 && off < 1e-12, "{off}");
}

#[test]
fn custom_parameters_act_in_a_run_and_have_their_units() {
    let parameters = vec![
        ParameterOf::number("stiffness_n_per_m", Range::POSITIVE, |s: &mut Spring| {
            &mut s.stiffness
        }),
        ParameterOf::number("damping_n_s_per_m", Range::NON_NEGATIVE, |s| &mut s.damping),
    ];
    let energy = |spring: &Spring, state: &State<f64>| {
        spring.mass * state.v * state.v / 2.0 + spring.stiffness * state.q * state.q / 2.0
    };
    let extras = Extras { parameters, energy: Some(energy), ..Extras::default() };
    let spring = Spring { mass: 1.0, stiffness: 40.0, damping: 0.0 };
    let start = State { q: 1.0, v: 0.0 };
    let scene = Scene::of(&spring, start, Options { extras, ..Options::default() }).unwrap();
    let body = &scene.bodies[0];
    assert_eq!(body.values, [40.0, 0.0]);
    assert_eq!(body.kind.parameters[0].unit, "N/m");
    assert_eq!(body.kind.leading, "stiffness_n_per_m");
    let mut stepper = (body.kind.build)(&body.values, Solver::Method(&METHODS[0]));
    let mut a = [0.0];
    assert_eq!(stepper.energy(), Some(20.0));
    assert!(stepper.set_parameter(0.0, 0, 90.0) && !stepper.set_parameter(0.0, 0, 90.0));
    stepper.acceleration(0.0, &[1.0], &[0.0], &mut a);
    assert_eq!((a[0], stepper.energy()), (-90.0, Some(45.0)));
    assert!(stepper.set_parameter(0.0, 1, 0.5));
    assert_eq!(stepper.energy(), None, "drag conserves no energy");
    let claims = stepper.body().downcast_ref::<Custom>().expect("a custom body").false_claims();
    assert_eq!(claims, FalseClaims { energy: true, exact: false });
    assert!(stepper.set_parameter(0.0, 1, 0.0));
    assert_eq!(stepper.energy(), Some(45.0));
}

#[test]
fn a_body_without_parameters_gets_a_force_factor() {
    let spring = Spring { mass: 1.0, stiffness: 40.0, damping: 0.0 };
    let scene = Scene::of(&spring, State { q: 1.0, v: 0.0 }, Options::default()).unwrap();
    let body = &scene.bodies[0];
    let stepper = (body.kind.build)(&[2.5], Solver::Method(&METHODS[0]));
    let mut a = [0.0];
    stepper.acceleration(0.0, &[1.0], &[0.0], &mut a);
    assert_eq!((body.values[0], a[0]), (1.0, -100.0));
    let mut race = Race::of_scene(&scene);
    race.run(60);
    assert_eq!(
        race.entrants().len(),
        GENERAL_METHODS.iter().filter(|method| method.is_for_games()).count()
    );
}
