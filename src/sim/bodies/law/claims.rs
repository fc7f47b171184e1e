//! Gives the claims of a law to the [checker](crate::bodies::claims).

use std::sync::Arc;

use super::Law;
use crate::bodies::claims::{self, Checked, ClaimHorizon, Claimant};
use crate::body::Body;
use crate::law::{CoordinateText, Equations, LawFault, Part};
use crate::state::State;
use crate::system::System;

/// The rounding of a sum of terms, in parts of their magnitudes.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Claimant for Law {
    // The tolerance is for rounding, with room for terms that cancel.
    const TOLERANCE: f64 = 1e-9;
    const START_KEYS: [&'static str; 2] = ["start", "start_velocity"];

    fn name(&self, coordinate: usize) -> &str {
        &self.equations.text().coordinates[coordinate].name
    }

    fn claimed(&self, t: f64, to: &mut State<Vec<f64>>) -> bool {
        self.equations.solve(&mut self.registers.borrow_mut(), t, |i, [q, v, _]| {
            (to.q[i], to.v[i]) = (q, v);
        })
    }

    fn claimed_slope(&self, t: f64, wanted: &State<Vec<f64>>) -> State<Vec<f64>> {
        let mut slope = wanted.clone();
        self.equations.solve(&mut self.registers.borrow_mut(), t, |i, [_, v, a]| {
            (slope.q[i], slope.v[i]) = (v, a);
        });
        slope
    }

    fn claimed_energy(&self, State { q, v }: &State<Vec<f64>>) -> Option<f64> {
        self.equations.energy(&mut self.registers.borrow_mut(), q, Some(v))
    }

    fn power(&self, t: f64, State { q, v }: &State<Vec<f64>>) -> Option<[f64; 2]> {
        let mut a = v.clone();
        self.acceleration(t, q, v, &mut a);
        let [moved, turned, size] = self.equations.power(&self.registers.borrow(), [q, v, &a])?;
        // A rotor exchanges nothing, but its terms cancel to rounding only.
        let leaks = (moved + turned).abs();
        let leaks = if leaks <= ROUNDING * size { 0.0 } else { leaks };
        let power = [leaks, moved.abs() + turned.abs()];
        power.iter().all(|power| power.is_finite()).then_some(power)
    }

    fn without_claims(&self) -> Self {
        Self { steering: [1.0, 0.0], checked: Checked::without_claims(), ..self.clone() }
    }
}

/// Checks that, with these parameter values, the accelerations are finite at the start and the text's claims hold. The
/// claims are checked at every tick of the horizon too.
///
/// # Errors
/// The first violation, with its position in the text.
pub fn check_law(
    equations: &Arc<Equations>,
    values: &[f64],
    horizon: ClaimHorizon,
) -> Result<(), LawFault> {
    let law = Law::new(equations.clone(), values);
    check_start(&law)?;
    claims::check(&law, horizon).map_err(|found| {
        let part = found.coordinate.map_or(Part::Energy, Part::Exact);
        LawFault::new(part, 0..equations.part(part).len(), found.what, found.remedy)
    })
}

/// Checks that the accelerations are finite at the start.
pub(super) fn check_start(law: &Law) -> Result<(), LawFault> {
    let State { q, v } = law.start();
    let mut a = v.clone();
    law.acceleration(0.0, &q, &v, &mut a);
    law.equations.not_finite(&law.registers.borrow()).map_or(Ok(()), Err)?;
    law.equations.event_fault(&mut law.registers.borrow_mut(), &q).map_or(Ok(()), Err)
}

/// Returns the key to which a fault of the whole text points, which is the first parameter.
pub(super) fn first_key(text: &[CoordinateText], constants: &[String]) -> String {
    constants.first().cloned().unwrap_or_else(|| format!("{}.start", text[0].name))
}
