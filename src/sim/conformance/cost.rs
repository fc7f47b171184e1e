//! Measures the cost of a step, and the time by which it advances.

use std::collections::BTreeSet;

use glam::DVec2;

use super::problems::{Kepler, Problem, fresh, kepler_orbit, problem, spring};
use super::{Claim, Measured, yes_or_no};
use crate::integrators::{Method, StepFailure, integrator};
use crate::state::{State, Vector};
use crate::system::System;

/// Returns the number of evaluations of the first step, and the different numbers of the `steps` later steps.
fn costs<V: Vector>(
    method: &Method,
    counted: Problem<V>,
    mut state: State<V>,
    h: f64,
    steps: u32,
) -> Result<(u64, BTreeSet<u64>), StepFailure> {
    let mut integrator = integrator(method, &state.q);
    integrator.step(&counted, 0.0, h, &mut state)?;
    let (first, mut before, mut others) =
        (counted.evaluations(), counted.evaluations(), BTreeSet::new());
    for step in 1..=steps {
        integrator.step(&counted, h * f64::from(step), h, &mut state)?;
        others.insert(counted.evaluations() - before);
        before = counted.evaluations();
    }
    Ok((first, others))
}

/// Returns the number of evaluations of the first step, and the different numbers of later steps on several problems.
pub(super) fn counts(method: &Method) -> Result<(u64, BTreeSet<u64>), StepFailure> {
    const STEPS: u32 = 100;
    let start = State { q: 1.0, v: 0.0 };
    let (first, mut counts) = costs(method, problem(spring(5.0, 0.1)), start, 0.25, STEPS)?;
    let (_, others) = costs(method, problem(Kepler), kepler_orbit(0.3, 0.0), 0.05, 30)?;
    counts.extend(others);
    Ok((first, counts))
}

/// Measures the evaluations per step. They must equal the card's count at every step, or vary if the card gives no
/// count.
pub(super) fn evaluations(method: &Method) -> Claim {
    let claimed = method.evaluations.map_or("it decides".to_owned(), |count| count.to_string());
    let (measured, holds) = match counts(method) {
        Err(failure) => (failure.to_string(), false),
        Ok((first, counts)) => {
            let (least, most) = (counts.first().copied(), counts.last().copied());
            let [least, most] = [least, most].map(|count| count.expect("of many steps"));
            // A method that reuses evaluations needs one more at its first step.
            let owed = u64::from(method.restart.is_some());
            let holds = match method.evaluations.map(u64::from) {
                Some(count) => (least, most, first) == (count, count, count + owed),
                None => least != most,
            };
            let range = if least == most { most.to_string() } else { format!("{least} to {most}") };
            (format!("{range} a step, {first} at the first"), holds)
        }
    };
    Claim { field: "evaluations", claimed, measured, holds }
}

/// A coordinate at constant speed 1, which measures time, and a damped spring.
struct ClockAndDrag;

impl System for ClockAndDrag {
    type Vector = DVec2;
    fn acceleration(&self, _t: f64, q: &DVec2, v: &DVec2, a: &mut DVec2) {
        *a = DVec2::new(0.0, -400.0 * q.y - 4.0 * v.y);
    }
}

/// Measures whether a step of `h` advances the motion by `h`, or by less if the method reports the rest as left out. A
/// method of order 0 is judged only by its report.
pub(super) fn keeps_time(method: &Method) -> Claim {
    let measure = || -> Measured {
        let mut state = State { q: DVec2::new(0.0, 1.0), v: DVec2::new(1.0, 0.0) };
        let system = problem(ClockAndDrag);
        let mut integrator = integrator(method, &state.q);
        for tick in 0..30 {
            integrator.reset();
            integrator.step(&system, 0.1 * f64::from(tick), 0.1, &mut state)?;
        }
        let (clock, lost) = (state.q.x, integrator.lost_time());
        if method.order == 0 {
            // The motion of a method that does not converge need not be even, so that its coordinate is no clock.
            return Ok((lost == 0.0, format!("it reports {lost:.6} s lost of 3 s")));
        }
        let off = (clock + lost - 3.0).abs();
        if off.is_nan() || off >= 1e-12 {
            let words = format!("3 s take {clock:.6} s, of which it reports {lost:.6} s lost");
            return Err(words.into());
        }
        Ok((lost == 0.0, format!("3 s take {clock:.6} s")))
    };
    let mut claim = yes_or_no("keeps_time", method.keeps_time, measure());
    if claim.holds && method.keeps_time && method.order > 0 {
        claim.holds = substeps_add_up(method);
    }
    claim
}

/// Whether the substeps of a tick add up to the tick.
fn substeps_add_up(method: &Method) -> bool {
    [1, 2, 7, 16].into_iter().all(|n| {
        let still = problem(spring(0.0, 0.0));
        let mut state = State { q: 0.0, v: 1.0 };
        let stepped = fresh(method).steps(&still, 5.0, 0.3, n, &mut state);
        stepped.is_ok() && (state.q - 0.3).abs() < 1e-14
    })
}
