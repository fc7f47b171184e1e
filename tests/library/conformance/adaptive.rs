//! Adaptive methods: the accuracy and the cost of a tolerance.

use glam::DVec2;
use regatta::sim::integrators::{
    BogackiShampine32, DormandPrince54, Family, GENERAL_METHODS, Integrator, Method, Override,
    StepFailure, Tolerance, integrator,
};
use regatta::sim::{Counted, State, System};

use super::systems::{bits, fresh, problem, spring};

fn adaptive() -> impl Iterator<Item = &'static Method> {
    GENERAL_METHODS.iter().filter(|method| method.family == Family::Adaptive)
}

#[test]
fn work_depends_on_the_tolerance_by_the_order() {
    let evaluations = |method: &Method, tolerance| {
        let system = problem(spring(1.0, 0.0));
        let mut state = State { q: 1.0, v: 0.7 };
        let mut integrator = fresh(method);
        integrator.set(Override::tolerance(tolerance));
        for tick in 0..8 {
            integrator.step(&system, 2.5 * f64::from(tick), 2.5, &mut state).unwrap();
        }
        system.evaluations() as f64
    };
    for method in adaptive() {
        for tolerance in [1e-5, 1e-6] {
            let times = evaluations(method, tolerance / 64.0) / evaluations(method, tolerance);
            let order = 64_f64.log2() / times.log2();
            println!("{:22} {tolerance:e}: order {order:.3}", method.id);
            let wanted = f64::from(method.order);
            assert!((order / wanted - 1.0).abs() < 0.1, "{}: {order}", method.id);
        }
    }
}

/// Evaluations of a stiff damped spring in 40 ticks, with the substeps accepted and rejected.
fn cost<I: Integrator<Counted<regatta::sim::bodies::Spring>>>(
    mut integrator: I,
    counts: fn(&I) -> (u64, u64),
) -> (u64, u64, u64) {
    let system = Counted::new(spring(20.0, 0.1));
    let mut state = State { q: 1.0, v: 0.0 };
    for tick in 0..40 {
        integrator.step(&system, f64::from(tick) * 0.1, 0.1, &mut state).unwrap();
    }
    let (accepted, rejected) = counts(&integrator);
    (system.evaluations(), accepted, rejected)
}

#[test]
fn pairs_reuse_their_last_slope_across_substeps_and_ticks() {
    let tight = Tolerance::uniform(1e-7);
    let pair = BogackiShampine32::with_tolerance(&0.0, tight);
    let (evaluations, accepted, rejected) = cost(pair, |pair| pair.attempts());
    assert!(accepted > 400 && rejected > 0, "too easy: {accepted} accepted, {rejected} rejected");
    assert_eq!(evaluations, 1 + 3 * (accepted + rejected));

    let pair = DormandPrince54::with_tolerance(&0.0, tight);
    let (evaluations, accepted, rejected) = cost(pair, |pair| pair.attempts());
    assert!(accepted > 100 && rejected > 0, "too easy: {accepted} accepted, {rejected} rejected");
    assert_eq!(evaluations, 1 + 6 * (accepted + rejected));
}

#[test]
fn a_tolerance_survives_a_reset() {
    for method in adaptive() {
        let run = |tolerance: Option<f64>, reset: bool| {
            let mut state = State { q: 1.0, v: 0.0 };
            let mut integrator = fresh(method);
            if let Some(tolerance) = tolerance {
                integrator.set(Override::tolerance(tolerance));
            }
            if reset {
                integrator.reset();
            }
            integrator.step(&problem(spring(20.0, 0.1)), 0.0, 0.1, &mut state).unwrap();
            bits(&state)
        };
        assert_eq!(run(Some(1e-5), true), run(Some(1e-5), false), "{}", method.id);
        assert_ne!(run(Some(1e-5), true), run(None, true), "{}", method.id);
    }
}

/// A force that is undefined, in one coordinate of two.
struct Undefined;

impl System for Undefined {
    type Vector = DVec2;
    fn acceleration(&self, _t: f64, q: &DVec2, _v: &DVec2, a: &mut DVec2) {
        *a = DVec2::new(f64::NAN, -q.y);
    }
}

#[test]
fn a_step_with_an_undefined_force_is_never_accepted() {
    for method in adaptive() {
        let mut state = State { q: DVec2::ONE, v: DVec2::ZERO };
        let mut integrator = integrator(method, &state.q);
        let stepped = integrator.step(&problem(Undefined), 0.0, 0.1, &mut state);
        assert!(matches!(stepped, Err(StepFailure::TooManySubsteps { .. })), "{}", method.id);
    }
}
