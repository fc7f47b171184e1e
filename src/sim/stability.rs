//! What a method makes of a body in one tick: the map about the present state, how it grows, and how
//! fast it turns, against the exact flow.
//!
//! The map is found by differencing the stepper itself, never from a formula, so that it holds for any
//! method on any body: two-sided, at distances scaled to the state. The input stays as it is.
//!
//! - A method that carries something from step to step is followed over three ticks, and the map is that
//!   of state and memory together; on a nonlinear body, under the forces of here and now, straightened.
//! - A method that chooses its substeps steps the differenced copies as one, with the same substeps for
//!   all: the map is that of the steps it takes here, its control frozen.
//! - On a nonlinear body the map is that of small deviations here and now. What grows in truth, such as
//!   a pendulum's fall from the top, is not held against a method. No such map says what
//!   becomes of the motion in the long run.

use super::integrators::StepFailure;
use super::{Solver, Stepper};

mod comparison;
mod flock;
mod modes;
mod probe;
mod search;
mod spectrum;
mod tick;
mod trend;
mod true_modes;

use comparison::against;
pub use comparison::{FOREVER_S, Stability};
use flock::Flock;
pub use modes::{NormalMode, normal_modes, undriven};
use probe::{COPIES, Carrier, Probe, rates, scale, state_of};
pub use search::{RATES_HZ, RateSearch};
use spectrum::{Derivatives, Eigenvalue};
pub use tick::Tick;
use true_modes::true_modes;

impl Stability {
    /// Of `body` as it is, under `solver`.
    ///
    /// What it says of growth and loss holds at any length of tick. Frequencies it compares only where every mode makes less
    /// than half a turn in the tick. How often a mode turns in truth is known at any length of tick on a linear body; on
    /// a nonlinear one only where it turns no more than one and a half times in a tick, or no faster than the forces at
    /// its start would have it.
    ///
    /// # Errors
    /// The failure of the method, or of the exact flow, in the first ticks from here.
    pub fn of(body: &dyn Stepper, solver: Solver, tick: Tick) -> Result<Self, StepFailure> {
        let truth = true_modes(body, tick)?;
        let Some(values) = eigenvalues(body, solver, tick)? else {
            return Ok(Self::OVERFLOW);
        };
        Ok(against(&truth, &values, tick.h))
    }
}

/// The eigenvalues of `body` under `solver`, from its present state; `None` where the map overflows.
fn eigenvalues(
    body: &dyn Stepper,
    solver: Solver,
    tick: Tick,
) -> Result<Option<Vec<Eigenvalue>>, StepFailure> {
    let mut first = body.with_solver(solver, tick.t);
    first.set(tick.t, body.q(), body.v());
    let here = state_of(&*first);
    first.advance(tick.t, tick.h, tick.substeps)?;
    let there = state_of(&*first);

    let mut probe = Probe::new(body, solver, tick);
    let scale = scale(&here, &there, tick.h);
    // What such a method carries is the length of its steps, and that is frozen.
    if solver.method().is_some_and(|method| method.tolerance.is_some()) {
        let [map] = probe.derivatives(&here, &scale)?;
        return Ok(spectrum::of_map(&map));
    }
    let derivatives = Derivatives {
        now: probe.derivatives(&here, &scale)?,
        later: probe.derivatives(&there, &scale)?,
    };
    if let Some(method) = solver.method()
        && derivatives.has_memory()
        && derivatives.bends()
    {
        // Over three ticks the forces change more than the memory does: only a body with the forces of
        // here and now can tell it.
        let rates = rates(body, &here, &scale, tick.t);
        let flock = Flock::straightened(body, rates, tick.t, method, COPIES.len());
        let mut probe = Probe { carrier: Carrier::Together(flock), tick };
        let derivatives = Derivatives {
            now: probe.derivatives(&here, &scale)?,
            later: probe.derivatives(&here, &scale)?,
        };
        return Ok(spectrum::eigenvalues(&derivatives));
    }
    Ok(spectrum::eigenvalues(&derivatives))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::bodies::kind;
    use crate::sim::integrators::method;

    fn near(found: f64, wanted: f64) -> bool {
        (found - wanted).abs() <= 1e-9 * wanted.abs()
    }

    #[test]
    fn a_frequency_error_is_told_up_to_half_a_turn_in_a_tick_and_not_beyond() {
        let midpoint = Solver::Method(method("implicit-midpoint").unwrap());
        for (turned, told) in
            [(3.1, true), (3.2, false), (8.0, false), (13.0, false), (30.0, false)]
        {
            let spring = (kind("spring").unwrap().build)(
                &[1.0, turned * turned, 0.0, 1.0, 0.0, 1.0],
                Solver::Truth,
            );
            let found = Stability::of(&*spring, midpoint, Tick { t: 0.0, h: 1.0, substeps: 1 });
            let error = found.unwrap().frequency_error;
            let wanted = 2.0 * libm::atan(turned / 2.0) / turned - 1.0;
            assert_eq!(error.is_some(), told, "{turned} rad");
            assert!(
                error.is_none_or(|error| near(error, wanted)),
                "{turned} rad: {error:?}, not {wanted}"
            );
        }
    }
}
