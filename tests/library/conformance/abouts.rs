//! Claims on the cards that compare one method with another.

use regatta::sim::State;
use regatta::sim::bodies::Spring;
use regatta::sim::integrators::{Family, GENERAL_METHODS, integrator, method};

use super::systems::{Kepler, Problem, fresh, kepler_orbit, problem, spring};

/// The states of a spring after each of `steps` steps of `h`.
fn course(id: &str, spring: Spring, h: f64, steps: u32) -> Vec<State<f64>> {
    let (system, mut integrator) = (problem(spring), fresh(method(id).expect("a method")));
    let mut state = State { q: 1.0, v: 0.7 };
    let states = (0..steps).map(|step| {
        integrator.step(&system, h * f64::from(step), h, &mut state).unwrap();
        state
    });
    states.collect()
}

#[test]
fn midpoint_gains_like_improved_euler_and_adams_bashforth_2_twice_as_fast() {
    let gain = |id| {
        let states = course(id, spring(1.0, 0.0), 0.1, 20_000);
        let amplitude = |state: &State<f64>| libm::hypot(state.q, state.v);
        libm::log(amplitude(&states[19_999]) / amplitude(&states[9_999]))
    };
    let unit = gain("improved-euler");
    assert!(unit > 0.1, "{unit}");
    assert!((gain("midpoint") / unit - 1.0).abs() < 0.01, "{} {unit}", gain("midpoint"));
    let adams = gain("adams-bashforth-2");
    assert!((adams / unit - 2.0).abs() < 0.05, "{adams} {unit}");
}

#[test]
fn no_explicit_method_is_cheaper_than_ssp_rk3_and_bounded_on_a_spring() {
    let bounded = GENERAL_METHODS.iter().filter(|method| {
        method.family == Family::Explicit && method.stability_limit.is_some_and(|z| z > 0.0)
    });
    let cheapest = bounded.min_by_key(|method| method.evaluations).expect("two there are");
    assert_eq!(cheapest.id, "ssp-rk3");
    let states = course("ssp-rk3", spring(1.0, 0.0), 0.5, 10_000);
    let last = states.last().expect("some");
    assert!(libm::hypot(last.q, last.v) < 1e-3, "it dies away: {last:?}");
}

#[test]
fn pefrl_is_more_accurate_than_yoshida_4_at_the_same_cost() {
    let error = |id, evaluations: u32| {
        let start = kepler_orbit(0.3, 0.0);
        let mut state = start;
        let card = method(id).expect("a method");
        let mut integrator = integrator::<Problem<_>>(card, &state.q);
        let steps = evaluations / card.evaluations.expect("on the card");
        integrator.steps(&problem(Kepler), 0.0, 5.0, steps, &mut state).unwrap();
        (state.q - kepler_orbit(0.3, 5.0).q).length()
    };
    for evaluations in [360, 720, 1440] {
        let [pefrl, yoshida4] = ["pefrl", "yoshida4"].map(|id| error(id, evaluations));
        println!("{evaluations} evaluations: {pefrl:.1e}, {yoshida4:.1e}");
        assert!(pefrl < yoshida4 / 5.0, "{evaluations} evaluations: {pefrl:e}, {yoshida4:e}");
    }
}

#[test]
fn stormer_verlet_follows_velocity_verlet_even_under_drag() {
    for ratio in [0.0, 0.1] {
        let paths = ["stormer-verlet", "velocity-verlet"]
            .map(|id| course(id, spring(3.0, ratio), 0.1, 1000));
        for (step, (stormer, velocity)) in paths[0].iter().zip(&paths[1]).enumerate() {
            let off = (stormer.q - velocity.q).abs().max((stormer.v - velocity.v).abs());
            assert!(off < 1e-12, "ζ = {ratio}, step {step}: {off:e}");
        }
    }
}
