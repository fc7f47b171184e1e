//! Long runs: energy drift and reversibility.

use regatta::sim::integrators::{Family, GENERAL_METHODS, Method};
use regatta::sim::{State, System};

use super::systems::{UnitPendulum, fresh, problem, spring};

/// Beyond this energy error no motion is left.
const LOST: f64 = 1e6;

/// The error of the energy over a run, as its amplitude and the rise of the straight line through it.
struct Drift {
    amplitude: f64,
    rise: f64,
}

impl Drift {
    /// The share of the error that is trend.
    fn trend(&self) -> f64 {
        (self.rise / self.amplitude).abs()
    }
}

/// The pendulum's energy over `steps` steps of `h`; `None` if it was lost on the way.
fn drift(method: &Method, h: f64, steps: u32) -> Option<Drift> {
    let (pendulum, mut integrator) = (problem(UnitPendulum), fresh(method));
    let mut state = State { q: 1.2, v: 0.5 };
    let energy = |s: &State<f64>| s.v * s.v / 2.0 - libm::cos(s.q);
    let first = energy(&state);
    let (mut least, mut most) = (0.0_f64, 0.0_f64);
    let (middle, mut sum, mut moment, mut square) = (f64::from(steps - 1) / 2.0, 0.0, 0.0, 0.0);
    for step in 0..steps {
        integrator.step(&pendulum, h * f64::from(step), h, &mut state).unwrap();
        let error = energy(&state) - first;
        if !error.is_finite() || error.abs() > LOST {
            return None;
        }
        (least, most) = (least.min(error), most.max(error));
        let at = f64::from(step) - middle;
        (sum, moment, square) = (sum + error, moment + at * error, square + at * at);
    }
    assert!(sum.is_finite());
    Some(Drift { amplitude: most - least, rise: moment / square * f64::from(steps) })
}

#[test]
fn only_symplectic_methods_keep_energy_without_a_trend() {
    for method in GENERAL_METHODS {
        // A trend is seen sooner than that there is none.
        let drift = drift(method, 0.3, if method.symplectic { 1_000_000 } else { 200_000 });
        let trend = drift.as_ref().map_or(f64::INFINITY, Drift::trend);
        let amplitude = drift.map_or(f64::INFINITY, |drift| drift.amplitude);
        println!("{:26} energy error {amplitude:.1e}, trend {trend:.1e} of it", method.id);
        if method.symplectic {
            // A power of the step, with the base of the worst method of each order, and half as much again. The best,
            // Gauss-Legendre, still has an error of 8e-6.
            let allowed = 1.5 * f64::powi(0.13, method.order as i32);
            assert!((1e-6..allowed).contains(&amplitude), "{}: {amplitude:e}", method.id);
            assert!(trend < 1e-4, "{}: {trend:e}", method.id);
        } else if [Family::Explicit, Family::Adaptive].contains(&method.family) {
            // Others may be symplectic in coordinates of their own, and show no trend in these.
            assert!(trend > 1e-3, "{}: {trend:e}", method.id);
        }
    }
}

/// How far from its start `steps` steps of `h` and as many of `-h` leave the state.
fn out_and_back(method: &Method, system: impl System<Vector = f64> + 'static) -> f64 {
    const H: f64 = 0.1;
    const STEPS: u32 = 100_000;
    let start = State { q: 1.2, v: 0.5 };
    let mut state = start;
    let (system, mut integrator) = (problem(system), fresh(method));
    let out = (0..STEPS).map(|n| (H * f64::from(n), H));
    let back = (1..=STEPS).rev().map(|n| (H * f64::from(n), -H));
    for (t, h) in out.chain(back) {
        integrator.step(&system, t, h, &mut state).unwrap();
        if !state.q.is_finite() || state.q.abs() > LOST {
            return f64::INFINITY;
        }
    }
    (state.q - start.q).abs().max((state.v - start.v).abs())
}

#[test]
fn only_reversible_methods_return_after_a_hundred_thousand_steps() {
    // Backwards by steps of -h: on forces without drag the same as turning the velocity round.
    for method in GENERAL_METHODS {
        // Rounding errors add up on a spring; on a pendulum they also grow, because they change its frequency.
        let on_spring = (out_and_back(method, spring(1.0, 0.0)), 1e-12, true);
        let on_pendulum = (out_and_back(method, UnitPendulum), 1e-9, false);
        for (off, rounded, is_linear) in [on_spring, on_pendulum] {
            println!("{:26} {off:.1e}", method.id);
            if method.reversible || is_linear && method.exact_if_linear {
                assert!(off < rounded, "{}: {off:e}", method.id);
            } else {
                assert!(off > 1e-5, "{}: {off:e}", method.id);
            }
        }
    }
}
