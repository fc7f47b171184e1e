//! Measures whether a method that chooses its steps meets its tolerance without wasting work.

use super::problems::{Kepler, Problem, fresh, kepler_orbit, problem, spring};
use super::{Claim, Measured, yes_or_no};
use crate::body::Body;
use crate::integrators::{Method, Override, StepFailure, integrator};
use crate::state::{State, Vector, nan_is_infinite};

/// The accepted range of the error, in units of the tolerance. A smaller error is wasted work.
const MET: std::ops::Range<f64> = 0.1..3.0;

/// Returns the error after an arc of one time unit, in units of the allowed error. The arc starts on the exact motion,
/// and the error is averaged over several starting points.
fn error_an_arc<V: Vector>(
    method: &Method,
    system: &Problem<V>,
    tolerance: f64,
    truth: &dyn Fn(f64) -> State<V>,
) -> Result<f64, StepFailure> {
    const ARCS: u32 = 32;
    let mut sum = 0.0;
    for arc in 0..ARCS {
        let t = f64::from(arc) * std::f64::consts::TAU / f64::from(ARCS);
        let mut state = truth(t);
        let mut integrator = integrator(method, &state.q);
        integrator.set(Override::tolerance(tolerance));
        integrator.step(system, t, 1.0, &mut state)?;
        let end = truth(t + 1.0);
        let found = state.q.components().iter().chain(state.v.components());
        let wanted = end.q.components().iter().chain(end.v.components());
        let errors = found.zip(wanted).map(|(found, wanted)| {
            nan_is_infinite((found - wanted).abs() / (tolerance * (1.0 + wanted.abs())))
        });
        sum += errors.fold(0.0, f64::max);
    }
    Ok(sum / f64::from(ARCS))
}

/// Whether the tolerance changes the steps of the method.
fn responds_to_tolerance(method: &Method) -> Result<bool, StepFailure> {
    let run = |tolerance: f64| {
        let mut state = State { q: 1.0, v: 0.0 };
        let mut integrator = fresh(method);
        integrator.set(Override::tolerance(tolerance));
        integrator.step(&problem(spring(20.0, 0.1)), 0.0, 0.1, &mut state)?;
        Ok(state)
    };
    Ok(run(1e-3)? != run(1e-7)?)
}

/// Returns whether the errors on a spring and on an orbit fit the tolerance, for several tolerances, and describes the
/// errors.
fn arcs(method: &Method) -> Result<(bool, String), StepFailure> {
    let spring = spring(1.0, 0.0);
    let swing = |t| spring.exact(t, &spring.start()).expect("a closed form");
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for tolerance in [1e-5, 1e-6, 1e-7, 1e-8] {
        let on_spring = error_an_arc(method, &problem(spring.clone()), tolerance, &swing)?;
        let on_orbit =
            error_an_arc(method, &problem(Kepler), tolerance, &|t| kepler_orbit(0.3, t))?;
        least = least.min(on_spring).min(on_orbit);
        most = most.max(on_spring).max(on_orbit);
    }
    let holds = MET.contains(&least) && MET.contains(&most);
    Ok((holds, format!("its error is {least:.2} to {most:.2} times the tolerance")))
}

/// Measures whether the method has a tolerance and meets it. A method as printed in the chapter must only respond to
/// the tolerance.
pub(super) fn tolerance(method: &Method) -> Claim {
    let measure = || -> Measured {
        let heeds = responds_to_tolerance(method)?;
        if !heeds || method.tolerance.is_none() || method.is_as_printed() {
            let words = if heeds { "it heeds one" } else { "it heeds none" };
            return Ok((heeds, words.to_owned()));
        }
        let (holds, words) = arcs(method)?;
        if holds { Ok((true, words)) } else { Err(words.into()) }
    };
    yes_or_no("tolerance", method.tolerance.is_some(), measure())
}
