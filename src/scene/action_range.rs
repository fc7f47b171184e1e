//! Checks that a scene file can express an action, so that every recording of a run can be read back.

use super::{MAX_COORDINATE, MAX_SUBSTEPS, TOLERANCES};
use crate::sim::bodies::MAX_VALUE;
use crate::{Action, LaneSpec, Swing};

impl Action {
    /// Returns the action with throttle and rudder clamped to -1 to 1. `None` if a number is out of its range, because
    /// then no scene file could express the action.
    pub fn clamped_in_range(mut self) -> Option<Self> {
        if let Action::Throttle(part) | Action::Rudder(part) = &mut self {
            *part = part.clamp(-1.0, 1.0);
        }
        let is_in_range = match &self {
            Action::Throttle(part) | Action::Rudder(part) => !part.is_nan(),
            Action::Method(_) | Action::Solo { .. } => true,
            Action::Lane { spec, .. } => spec.is_in_range(),
            Action::Substeps { substeps, .. } => (1..=MAX_SUBSTEPS).contains(substeps),
            Action::Tolerance { tolerance, .. } => {
                (TOLERANCES.0..=TOLERANCES.1).contains(tolerance)
            }
            Action::TickHz(tick_hz) => tick_hz.is_in_range(),
            Action::Kick(value) | Action::Set { value, .. } => value.abs() <= MAX_VALUE,
            Action::Push { by, .. } => by.iter().all(|x| x.abs() <= MAX_COORDINATE),
            Action::Place { q, v, .. } => q.iter().chain(&v[..]).all(|x| x.abs() <= MAX_COORDINATE),
        };
        is_in_range.then_some(self)
    }
}

impl LaneSpec {
    /// Whether the lane's numbers are in their ranges and its method accepts them.
    pub fn is_in_range(&self) -> bool {
        let Self { method, substeps, tolerance, joint, .. } = self;
        let takes = |given: f64| {
            method.tolerance.is_some() && (TOLERANCES.0..=TOLERANCES.1).contains(&given)
        };
        let is_told = |joint: Swing| method.has_joint() && joint.is_in_range();
        (1..=MAX_SUBSTEPS).contains(substeps)
            && tolerance.is_none_or(takes)
            && joint.is_none_or(is_told)
    }
}
