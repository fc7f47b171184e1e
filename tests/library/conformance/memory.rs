//! The memory of methods, and when it must be dropped.

use glam::DVec2;
use regatta::sim::State;
use regatta::sim::integrators::{GENERAL_METHODS, Integrator, Method, integrator};

use super::systems::{Problem, Timetable, bits, fresh, problem, spring};

/// Methods with memory: of a force, a slope, a position, or a substep length.
fn methods_with_memory() -> impl Iterator<Item = &'static Method> {
    GENERAL_METHODS.iter().filter(|method| method.restart.is_some())
}

/// Steps a lively damped spring `n` times by `h`.
fn run(integrator: &mut dyn Integrator<Problem<f64>>, state: &mut State<f64>, h: f64, n: u32) {
    let spring = problem(spring(20.0, 0.1));
    for step in 0..n {
        integrator.step(&spring, h * f64::from(step), h, state).unwrap();
    }
}

#[test]
fn memory_is_dropped_after_a_change_of_state() {
    assert!(methods_with_memory().count() >= 7);
    for method in methods_with_memory() {
        for kick in [State { q: 0.0, v: 0.25 }, State { q: 0.25, v: 0.0 }] {
            let (mut used, mut kicked) = (fresh(method), State { q: -0.3, v: 11.0 });
            run(&mut *used, &mut kicked, 0.03, 10);
            kicked.add_scaled(1.0, &kick);
            let mut new = kicked;
            run(&mut *used, &mut kicked, 0.03, 10);
            run(&mut *fresh(method), &mut new, 0.03, 10);
            assert_eq!(bits(&kicked), bits(&new), "{} after {kick:?}", method.id);
        }
    }
}

#[test]
fn memory_is_dropped_after_a_change_of_step() {
    for method in methods_with_memory() {
        for h in [0.02, 0.04, -0.03] {
            let (mut used, mut going_on) = (fresh(method), State { q: -0.3, v: 11.0 });
            run(&mut *used, &mut going_on, 0.03, 10);
            let mut new = going_on;
            run(&mut *used, &mut going_on, h, 10);
            run(&mut *fresh(method), &mut new, h, 10);
            assert_eq!(bits(&going_on), bits(&new), "{} by {h} s", method.id);
        }
    }
}

#[test]
fn a_carried_step_changes_sign_when_time_reverses() {
    // Jakobsen's takes from the velocity both ways.
    for method in GENERAL_METHODS.iter().filter(|method| method.order > 0) {
        let (system, _) = Timetable::new(1);
        let mut state = State { q: DVec2::new(0.0, 1.0), v: DVec2::new(0.0, 0.0) };
        let mut integrator = integrator(method, &state.q);
        integrator.step(&system, 0.0, 0.1, &mut state).unwrap();
        integrator.step(&system, 0.1, -0.1, &mut state).unwrap();
        assert!(state.v.x.abs() < 1e-15, "{}: {} m/s left", method.id, state.v.x);
    }
}
