//! The cost of a step, its length, and the times at which it evaluates forces.

use glam::DVec2;
use regatta::sim::integrators::{
    AdaptiveEuler, GENERAL_METHODS, Integrator, Method, integrator, method,
};
use regatta::sim::{Counted, State};

use super::systems::{Problem, Timetable, fixed_step, spring};

#[test]
fn adaptive_euler_costs_two_evaluations_a_substep_and_one_a_rejection() {
    let counted = Counted::new(spring(20.0, 0.1));
    let tolerance = method("adaptive-euler").unwrap().tolerance.unwrap();
    let mut adaptive = AdaptiveEuler::with_tolerance(&0.0, tolerance);
    let mut state = State { q: 1.0, v: 0.0 };
    for tick in 0..40 {
        adaptive.step(&counted, f64::from(tick) * 0.1, 0.1, &mut state).unwrap();
    }
    let (accepted, rejected) = adaptive.attempts();
    assert!(accepted > 400 && rejected > 2, "too easy: {accepted} accepted, {rejected} rejected");
    assert_eq!(counted.evaluations(), 2 * accepted + rejected);
}

/// Runs three ticks of 0.1 s from `t`, and returns the change of the state and the times of the force evaluations.
fn run(method: &Method, power: i32, t: f64, substeps: u32) -> (State<f64>, Vec<f64>) {
    run_by(integrator(method, &DVec2::ZERO), power, t, substeps)
}

fn run_by(
    mut integrator: Box<dyn Integrator<Problem<DVec2>>>,
    power: i32,
    t: f64,
    substeps: u32,
) -> (State<f64>, Vec<f64>) {
    let (system, timetable) = Timetable::new(power);
    let v = if power == 0 { 1.0 } else { 0.0 };
    let mut state = State { q: DVec2::new(0.0, 1.0), v: DVec2::new(v, 0.0) };
    for tick in 0..3 {
        let at = t + 0.1 * f64::from(tick);
        integrator.steps(&system, at, 0.1, substeps, &mut state).unwrap();
    }
    (State { q: state.q.x, v: state.v.x - v }, timetable.asked.take())
}

#[test]
fn a_tick_lasts_exactly_as_long_as_asked() {
    // Without force, a speed of 1 makes the coordinate a clock: the sum of all substeps.
    let keeping_speed = GENERAL_METHODS.iter().filter(|method| method.order > 0);
    assert_eq!(keeping_speed.clone().count() + 1, GENERAL_METHODS.len(), "all but Jakobsen's");
    for method in keeping_speed {
        for substeps in [1, 2, 7, 16] {
            let (clock, asked) = run(method, 0, 5.0, substeps);
            assert!((clock.q - 0.3).abs() < 1e-14, "{}: {} s of 0.3 s", method.id, clock.q);
            if method.tolerance.is_some() && method.keeps_time {
                assert!(asked.len() > 20 * 3, "{} took only {} substeps", method.id, asked.len());
            }
        }
    }
}

#[test]
fn forces_are_evaluated_within_the_step_and_at_the_right_time() {
    for method in GENERAL_METHODS {
        for (t, substeps) in [(0.0, 1), (5.0, 1), (5.0, 4)] {
            let (_, asked) = run(method, 0, t, substeps);
            assert!(asked.iter().all(|time| (t..=t + 0.3 + 1e-14).contains(time)), "{asked:?}");
            let part = 0.1 / f64::from(substeps);
            for substep in 0..3 * substeps {
                let from = t + part * f64::from(substep);
                let here = from - 1e-14..from + part + 1e-14;
                assert!(asked.iter().any(|time| here.contains(time)), "{}: {asked:?}", method.id);
            }
        }
    }
}

#[test]
fn order_p_integrates_polynomials_in_time_of_degree_p_minus_1_exactly() {
    for method in GENERAL_METHODS.iter().filter(|method| method.order > 0) {
        let power = method.order as i32;
        for (t, substeps) in [(0.0, 1), (5.0, 1), (5.0, 4)] {
            let end: f64 = t + 0.3;
            let gained = end.powi(power) - f64::powi(t, power);
            let (state, _) = run_by(fixed_step(method, &DVec2::ZERO), power, t, substeps);
            let error = (state.v / gained - 1.0).abs();
            assert!(error < 1e-12, "{}: off by {error:e} from {t} s", method.id);
        }
        // And not every force: Simpson's rule, by which both Runge-Kutta 4 integrate, ends at degree 3,
        // the midpoint rule at 1.
        let (state, _) = run_by(fixed_step(method, &DVec2::ZERO), power + 4, 0.0, 1);
        let error = (state.v / f64::powi(0.3, power + 4) - 1.0).abs();
        assert!(error > 1e-12, "{} cannot be that good: {error:e}", method.id);
    }
}
