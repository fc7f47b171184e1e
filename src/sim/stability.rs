//! Stability of a method on a body: the one-tick map linearised about the current state, its growth and
//! its frequencies, compared with the exact flow.
//!
//! The map is found by central differences of the stepper itself, never from a formula, so that it
//! holds for any method on any body. The distances are scaled to the state, and the input stays
//! constant.
//!
//! - A method with memory is followed over three ticks, and the map is that of state and memory
//!   together. On a nonlinear body the forces are first linearised about the current state.
//! - A method that chooses its substeps steps the displaced copies as one ensemble, with the same
//!   substeps for all: the map is that of the steps it takes here, with its control frozen.
//! - On a nonlinear body the map holds for small deviations from the current state. Growth that the
//!   true motion has too, such as the fall of an upright pendulum, is not counted against a method. No
//!   such map predicts the motion in the long run.

use super::integrators::StepFailure;
use super::{Solver, Stepper};

mod comparison;
mod ensemble;
mod modes;
mod power;
mod search;
mod small_motion;
mod spectrum;
mod tick;
mod tick_map;
mod trend;
mod true_modes;

use comparison::compare;
pub use comparison::{FOREVER_S, Stability};
use ensemble::Ensemble;
pub use modes::{NormalMode, normal_modes, unforced};
pub use power::spectral_radius;
pub use search::{RATES_HZ, RateSearch};
pub use small_motion::{CoupledMotion, NoSmallMotion, SmallMotion};
use spectrum::{Derivatives, Eigenvalue};
pub use tick::Tick;
use tick_map::{Copies, OFFSETS, TickMap, force_jacobian, scale, state_of};
use true_modes::true_modes;

impl Stability {
    /// Stability of `solver` on `body` at its current state.
    ///
    /// Growth and loss are valid at any length of tick. Frequencies are compared only if every mode
    /// makes less than half a turn in the tick. On a linear body the true frequency of a mode is known
    /// at any length of tick; on a nonlinear body only if it makes at most one and a half turns in a
    /// tick, or turns no faster than under the forces linearised at the start.
    ///
    /// # Errors
    /// The failure of the method or of the exact flow in the first ticks.
    pub fn of(body: &dyn Stepper, solver: Solver, tick: Tick) -> Result<Self, StepFailure> {
        let truth = true_modes(body, tick)?;
        let Some(values) = eigenvalues(body, solver, tick)? else {
            return Ok(Self::OVERFLOW);
        };
        Ok(compare(&truth, &values, tick.h))
    }
}

/// The eigenvalues of `body` under `solver` from its current state; `None` if the map overflows.
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

    let mut tick_map = TickMap::new(body, solver, tick);
    let scale = scale(&here, &there, tick.h);
    // The memory of an adaptive method is its step size, which is frozen.
    if solver.method().is_some_and(|method| method.tolerance.is_some()) {
        let [map] = tick_map.derivatives(&here, &scale)?;
        return Ok(spectrum::eigenvalues_of_map(&map));
    }
    let derivatives = Derivatives {
        now: tick_map.derivatives(&here, &scale)?,
        later: tick_map.derivatives(&there, &scale)?,
    };
    if let Some(method) = solver.method()
        && derivatives.has_memory()
        && derivatives.is_nonlinear()
    {
        // Over three ticks the change of the forces would be taken for memory. Linearised forces do not
        // change.
        let force_jacobian = force_jacobian(body, &here, &scale, tick.t);
        let ensemble = Ensemble::linearised(body, force_jacobian, tick.t, method, OFFSETS.len());
        let mut tick_map = TickMap { copies: Copies::Ensemble(ensemble), tick };
        let derivatives = Derivatives {
            now: tick_map.derivatives(&here, &scale)?,
            later: tick_map.derivatives(&here, &scale)?,
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
    fn a_frequency_error_is_known_up_to_half_a_turn_per_tick_and_not_beyond() {
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
