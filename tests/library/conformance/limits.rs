//! The largest stable steps on damped oscillators, measured on the real stepper.

use regatta::sim::State;
use regatta::sim::integrators::{DAMPING_RATIOS, GENERAL_METHODS, Method};

use super::systems::{fresh, problem, spring};

/// The largest `h ω` at which a method that carries something stays stable in the long run: the Verlets go
/// on with a force that was taken at a predicted velocity.
const LONG_RUN: [(&str, [f64; 3]); 3] = [
    ("velocity-verlet", [1.810, 1.354, 0.472]),
    ("stormer-verlet", [1.810, 1.354, 0.472]),
    ("adams-bashforth-2", [0.539, 0.765, 1.000]),
];

/// Half a unit of the last digit, and a little for the search.
const RESOLUTION: f64 = 6e-4;

/// The spectral radius of the map of one step of a fresh method, by differences.
fn radius(method: &Method, ratio: f64, h: f64) -> f64 {
    let system = problem(spring(1.0, ratio));
    let step = |q: f64, v: f64| {
        let mut state = State { q, v };
        fresh(method).step(&system, 0.0, h, &mut state).unwrap();
        [state.q, state.v]
    };
    let [from, by_q, by_v] = [step(0.3, -0.2), step(1.3, -0.2), step(0.3, 0.8)];
    let [[a, c], [b, d]] = [by_q, by_v].map(|to| [to[0] - from[0], to[1] - from[1]]);
    let (half_trace, determinant) = ((a + d) / 2.0, a * d - b * c);
    assert!(half_trace.is_finite() && determinant.is_finite(), "{}", method.id);
    match half_trace * half_trace - determinant {
        apart if apart > 0.0 => half_trace.abs() + apart.sqrt(),
        _ => determinant.sqrt(),
    }
}

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

/// The first `h` beyond which `stable` ends.
fn limit(stable: impl Fn(f64) -> bool) -> f64 {
    let coarse = 0.01;
    let ends = (1..600).map(|n| coarse * f64::from(n)).find(|&h| !stable(h));
    let mut beyond = ends.expect("every explicit method has a limit below 6");
    let mut within = beyond - coarse;
    while beyond - within > 1e-4 {
        let middle = (within + beyond) / 2.0;
        if stable(middle) { within = middle } else { beyond = middle }
    }
    within
}

#[test]
fn the_one_step_map_leaves_the_unit_circle_at_the_step_on_the_card() {
    let mut wrong = String::new();
    // Under drag the adaptive listing cuts its steps as it likes.
    for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
        assert_eq!(
            method.stability_limit.is_some(),
            method.damped_limits.is_some(),
            "{}",
            method.id
        );
        let (id, Some(undamped)) = (method.id, method.stability_limit) else { continue };
        let damped = DAMPING_RATIOS.into_iter().zip(method.damped_limits.unwrap());
        let (mut off, mut card) = (false, Vec::new());
        for (ratio, listed) in [(0.0, undamped)].into_iter().chain(damped) {
            // Without drag some are unstable at every step, but by z⁴/8: too little to see at first.
            let lowest = if ratio == 0.0 { 0.06 } else { 0.0 };
            let found = limit(|h| h < lowest || radius(method, ratio, h) < 1.0 + 1e-9);
            println!("{id:26} {ratio:4} {found:.4}");
            let at_once = listed == 0.0 && found <= lowest;
            off |= !at_once && (found - listed).abs() >= RESOLUTION;
            card.push(if found <= lowest { 0.0 } else { (1e3 * found).round() / 1e3 });
        }
        if off {
            let (undamped, damped) = (card[0], &card[1..]);
            wrong += &format!(
                "{id}: its card is to say\n    stability_limit: Some({undamped:?}),\n    damped_limits: Some({damped:?}),\n"
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
                    "{id} at ζ = {ratio}: a swing of 1 is {within:.1} below {limit}, and {beyond:.1} beyond\n"
                );
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
