//! How an adaptive method covers a tick: which substep it tries, whether it keeps it, and what it tries
//! next. The step is carried from tick to tick.
//!
//! The error of a substep is held against the tolerance as it is, not divided by the step: as all pairs
//! here keep the better of their two solutions, the error for each second is then proportional to the
//! tolerance, and a method of order p takes `tolerance^(-1/p)` substeps.

use super::last_step::LastStep;
use crate::sim::integrators::failure::StepFailure;
use crate::sim::integrators::tolerance::Tolerance;
use crate::sim::system::{State, Vector};

/// Aims below the tolerance, so that the next attempt is rarely rejected.
const SAFETY: f64 = 0.9;
/// The least and the most by which one attempt changes the step.
const FACTORS: (f64, f64) = (0.2, 5.0);
/// A step that could grow by less is left as it is, which saves a power; larger, and the step is shorter
/// than it need be.
const WORTH_WHILE: f64 = 1.25;
/// So is one whose error is at most this part of what is allowed; larger, and the next is often rejected.
const COMFORTABLE: f64 = 0.8;
/// Attempts in one tick. Usual ticks take 1 to 50; without a limit a force that jumps would hang.
const MAX_ATTEMPTS: u32 = 10_000;

/// What the step is to be multiplied by, where `root` is the error in units of what is allowed, to the
/// power 1 / p.
#[inline]
pub(in crate::sim::integrators) fn factor(root: f64) -> f64 {
    let factor = (SAFETY / root).clamp(FACTORS.0, FACTORS.1);
    if factor.is_nan() { FACTORS.0 } else { factor }
}

/// As [`factor`] for an error of the order p, but 1 where the step is good and could hardly grow.
#[inline]
pub(in crate::sim::integrators) fn steady_factor(error: f64, order: u32) -> f64 {
    let steady = (0..order).fold(1.0, |product, _| product * (SAFETY / WORTH_WHILE));
    if (steady..=COMFORTABLE).contains(&error) {
        1.0
    } else {
        factor(libm::pow(error, 1.0 / f64::from(order)))
    }
}

/// The step size of an adaptive method.
#[derive(Clone)]
pub(in crate::sim::integrators) struct StepSize {
    pub(in crate::sim::integrators) tolerance: Tolerance,
    /// The last tick.
    last_step: LastStep,
    /// The substep to try first in a tick that continues the last.
    next: f64,
    accepted: u64,
    rejected: u64,
}

impl StepSize {
    pub(in crate::sim::integrators) fn new(tolerance: Tolerance) -> Self {
        Self { tolerance, last_step: LastStep::NONE, next: 0.0, accepted: 0, rejected: 0 }
    }

    /// Substeps accepted since construction or reset.
    pub(in crate::sim::integrators) fn accepted(&self) -> u64 {
        self.accepted
    }

    /// Substeps rejected since construction or reset.
    pub(in crate::sim::integrators) fn rejected(&self) -> u64 {
        self.rejected
    }

    pub(in crate::sim::integrators) fn reset(&mut self) {
        *self = Self::new(self.tolerance);
    }

    /// Sets out to cover a tick of `h`: first by the substep carried from the last tick, or, where that was of
    /// another length, in one substep.
    #[inline]
    pub(in crate::sim::integrators) fn cover(&mut self, h: f64) -> Cover<'_> {
        let continues = self.last_step.is_continued_by(h);
        let carried = if continues { self.next } else { h };
        Cover { size: self, continues, h, left: h, carried, trial: h, attempts: 0 }
    }
}

/// A tick on the way to its end.
pub(in crate::sim::integrators) struct Cover<'a> {
    size: &'a mut StepSize,
    continues: bool,
    h: f64,
    left: f64,
    carried: f64,
    trial: f64,
    attempts: u32,
}

impl Cover<'_> {
    /// Whether what was carried from the last tick fits this one.
    #[inline]
    pub(in crate::sim::integrators) fn continues_the_last(&self) -> bool {
        self.continues
    }

    /// The substep to try next; the last one ends exactly where the tick does.
    #[inline]
    pub(in crate::sim::integrators) fn trial(&mut self) -> Result<f64, StepFailure> {
        if self.attempts == MAX_ATTEMPTS {
            return Err(StepFailure::TooManySubsteps { limit: MAX_ATTEMPTS });
        }
        self.attempts += 1;
        // By magnitude, so that a negative `h` steps back.
        self.trial = if self.carried.abs() < self.left.abs() { self.carried } else { self.left };
        Ok(self.trial)
    }

    /// The time from the start of the tick to the start of the substep.
    #[inline]
    pub(in crate::sim::integrators) fn gone(&self) -> f64 {
        self.h - self.left
    }

    #[inline]
    pub(in crate::sim::integrators) fn is_over(&self) -> bool {
        self.left == 0.0
    }

    /// The error of the substep just tried, in units of what is allowed.
    #[inline]
    pub(in crate::sim::integrators) fn error<V: Vector>(
        &self,
        h: f64,
        error: &State<V>,
        y: &State<V>,
    ) -> f64 {
        self.size.tolerance.measure(h, error, y)
    }

    /// Whether a substep with this error is kept. `factor` says what to multiply the step by, where that
    /// is asked for: one cut short by the end of the tick tells nothing about the next.
    #[inline]
    pub(in crate::sim::integrators) fn accepts(
        &mut self,
        error: f64,
        factor: impl FnOnce(f64) -> f64,
    ) -> bool {
        let is_good = error <= 1.0;
        if is_good {
            self.size.accepted += 1;
            if self.trial == self.carried {
                self.carried *= factor(error);
            }
            self.left -= self.trial;
            if self.is_over() {
                self.size.next = self.carried;
                self.size.last_step.end(self.h);
            }
        } else {
            self.size.rejected += 1;
            self.carried = self.trial * factor(error);
        }
        is_good
    }
}
