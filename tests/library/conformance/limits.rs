//! The largest stable steps on damped oscillators, measured on the real stepper.

use regatta::conformance::limits;
use regatta::sim::State;
use regatta::sim::integrators::{DAMPING_RATIOS, GENERAL_METHODS, Method};

use super::systems::{fresh, problem, spring};

/// The largest `h ω` at which a method that carries something stays stable in the long run: the Verlets go
/// on with a force that was taken at a predicted velocity.
pub(crate) const LONG_RUN: [(&str, [f64; 3]); 3] = [
    ("velocity-verlet", [1.810, 1.354, 0.472]),
    ("stormer-verlet", [1.810, 1.354, 0.472]),
    ("adams-bashforth-2", [0.539, 0.765, 1.000]),
];

/// Half a unit of the last digit, and a little for the search.
const RESOLUTION: f64 = 6e-4;

/// How far a swing has grown after many steps; it stops once that is beyond all doubt.
fn growth(method: &Method, ratio: f64, h: f64) -> f64 {
    let system = problem(spring(1.0, ratio));
    let mut state = State { q: 0.6, v: 0.8 };
    let mut integrator = fresh(method);
    for step in 0..100_000 {
        integrator.step(&system, h * f64::from(step), h, &mut state).unwrap();
        if state.q.abs() > 1e9 {
            break;
        }
    }
    libm::hypot(state.q, state.v)
}

#[test]
fn the_one_step_map_leaves_the_unit_circle_at_the_step_on_the_card() {
    let mut wrong = String::new();
    // Under drag the adaptive listing cuts its steps as it likes.
    for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
        assert_eq!(
            method.stability_limit.is_some(),
            method.damped_limits.is_some(),
            "{}: give both `stability_limit` and `damped_limits`, or neither",
            method.id
        );
        let (id, Some(undamped)) = (method.id, method.stability_limit) else { continue };
        let found = limits(method).unwrap().map(Option::unwrap);
        println!("{id:26} {found:.4?}");
        let listed = [&[undamped], &method.damped_limits.unwrap()[..]].concat();
        let off =
            found.iter().zip(&listed).any(|(found, listed)| (found - listed).abs() >= RESOLUTION);
        let card = found.map(|found| (1e3 * found).round() / 1e3);
        if off {
            let (undamped, damped) = (card[0], &card[1..]);
            wrong += &format!(
                "{id}: write on its card\n    stability_limit: Some({undamped:?}),\n    damped_limits: Some({damped:?}),\n"
            );
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn long_runs_are_stable_up_to_the_limit_of_the_map_with_memory() {
    let mut wrong = String::new();
    for method in GENERAL_METHODS {
        let (id, Some(one_step)) = (method.id, method.damped_limits) else { continue };
        let carried = LONG_RUN.iter().find(|(carrying, _)| *carrying == id);
        assert_eq!(carried.is_some(), method.restart.is_some(), "{id}");
        let limits = carried.map_or(one_step, |(_, limits)| *limits);
        for (ratio, limit) in DAMPING_RATIOS.into_iter().zip(limits) {
            let (within, beyond) = (limit - RESOLUTION, limit + RESOLUTION);
            let [within, beyond] = [within, beyond].map(|h| growth(method, ratio, h));
            println!("{id:26} {ratio:4} {limit:.3} {within:.1e} {beyond:.1e}");
            if !(within < 0.5 && beyond > 5.0) {
                wrong += &format!(
                    "{id} at ζ = {ratio}: a swing of 1 becomes {within:.1} below {limit} (at most 0.5), and {beyond:.1} above it \
                     (at least 5); correct `damped_limits`, or LONG_RUN\n"
                );
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
