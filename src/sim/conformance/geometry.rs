//! Measures whether a method conserves phase-space area, and whether it is reversible.

use super::problems::{Problem, UnitPendulum, fixed_step, problem, spring};
use super::{Claim, Measured, yes_or_no};
use crate::integrators::{Method, StepFailure};
use crate::numerics::{OFFSETS, fourth_order};
use crate::state::State;

/// The length of a step in seconds, large enough that a violation is far above round-off.
const STEP: f64 = 0.8;
const FROM: State<f64> = State { q: 1.2, v: 0.5 };

/// A defect below this number is rounding. The rounding of the differences is 3e-13.
const KEPT: f64 = 1e-12;

/// A defect above this number is a violation. The smallest violation is that of Dormand-Prince, whose area changes by
/// 5e-5.
const LOST: f64 = 1e-5;

/// Returns the state after one step of a fresh method.
fn map(
    method: &Method,
    system: &Problem<f64>,
    mut state: State<f64>,
) -> Result<State<f64>, StepFailure> {
    fixed_step(method, &0.0).step(system, 0.0, STEP, &mut state)?;
    Ok(state)
}

/// Returns the determinant of the one-step map's Jacobian, by central differences of fourth order.
fn area(method: &Method, system: Problem<f64>) -> Result<f64, StepFailure> {
    let d = 1e-3;
    let column = |dq: f64, dv: f64| {
        let [mut q, mut v] = [[0.0; 4]; 2];
        for (i, n) in OFFSETS.into_iter().enumerate() {
            let start = State { q: FROM.q + n * dq, v: FROM.v + n * dv };
            State { q: q[i], v: v[i] } = map(method, &system, start)?;
        }
        Ok([q, v].map(|values| fourth_order(values, d)))
    };
    let (by_q, by_v) = (column(d, 0.0)?, column(0.0, d)?);
    Ok(by_q[0] * by_v[1] - by_q[1] * by_v[0])
}

/// Whether both defects are zero. Returns an error if a defect lies between the two thresholds.
fn both_kept(off: [Result<f64, StepFailure>; 2], what: &str) -> Measured {
    let [straight, curved] = off;
    let off = [straight?, curved?];
    let words = format!("{what} {:.1e} on a spring, {:.1e} on a pendulum", off[0], off[1]);
    let is_decided = off.iter().all(|off| *off < KEPT || *off > LOST && off.is_finite());
    if is_decided { Ok((off.iter().all(|off| *off < KEPT), words)) } else { Err(words.into()) }
}

/// Measures whether a step conserves phase-space area, on a linear and on a nonlinear system.
pub(super) fn symplectic(method: &Method) -> Claim {
    yes_or_no("symplectic", method.symplectic, keeps_area(method))
}

pub(super) fn keeps_area(method: &Method) -> Measured {
    let off = [area(method, problem(spring(1.0, 0.0))), area(method, problem(UnitPendulum))];
    let off = off.map(|area| area.map(|area| (area - 1.0).abs()));
    both_kept(off, "area changes by")
}

/// Returns the distance of the state from its start after a step of `h` and a step of `-h`.
fn there_and_back(method: &Method, system: Problem<f64>) -> Result<f64, StepFailure> {
    let mut integrator = fixed_step(method, &0.0);
    let mut state = FROM;
    integrator.step(&system, 0.0, STEP, &mut state)?;
    integrator.step(&system, STEP, -STEP, &mut state)?;
    Ok((state.q - FROM.q).abs().max((state.v - FROM.v).abs()))
}

/// Measures whether a step back undoes a step, on a linear and on a nonlinear system.
pub(super) fn reversible(method: &Method) -> Claim {
    yes_or_no("reversible", method.reversible, is_reversible(method))
}

pub(super) fn is_reversible(method: &Method) -> Measured {
    let on = [problem(spring(1.0, 0.0)), problem(UnitPendulum)];
    let off = on.map(|system| there_and_back(method, system));
    both_kept(off, "there and back it is off by")
}
