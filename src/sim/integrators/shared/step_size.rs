//! Step size control of an adaptive method. It decides which substep of a tick to try, whether to accept it, and which
//! substep to try next. The step size carries over from tick to tick.
//!
//! The control compares the error of a substep with the tolerance, without dividing it by the step. All pairs here
//! propagate the better of their two solutions, so that the error per second is proportional to the tolerance, and a
//! method of order p takes `tolerance^(-1/p)` substeps.

use super::LastStep;
use crate::integrators::failure::StepFailure;
use crate::integrators::integrator::Tolerance;
use crate::state::{State, Vector};

/// The factor by which a step is shortened to aim below the tolerance, so that few attempts are rejected.
const SAFETY: f64 = 0.9;
/// The smallest and the largest factor of the step in one attempt.
const FACTORS: (f64, f64) = (0.2, 5.0);
/// A step that could grow by less than this factor keeps its size, which saves the computation of a power. With a
/// larger factor, steps would stay shorter than necessary.
const MIN_GROWTH: f64 = 1.25;
/// A step keeps its size up to this error, relative to the tolerance. With a larger limit, the next step would often be
/// rejected.
const MAX_STEADY_ERROR: f64 = 0.8;
/// The maximum number of attempts in one tick. Ticks usually take 1 to 50. Without a limit, a tick with a discontinuous
/// force would never end.
const MAX_ATTEMPTS: u32 = 10_000;

/// Returns the factor for the length of the next step. `root` is the error relative to the tolerance, to the power 1 /
/// p.
#[inline]
pub(in crate::integrators) fn factor(root: f64) -> f64 {
    let factor = (SAFETY / root).clamp(FACTORS.0, FACTORS.1);
    if factor.is_nan() { FACTORS.0 } else { factor }
}

/// Returns [`factor`] for an error of order p, or 1 if the step is accepted and could hardly grow.
#[inline]
pub(super) fn steady_factor(error: f64, order: u32) -> f64 {
    let steady = (0..order).fold(1.0, |product, _| product * (SAFETY / MIN_GROWTH));
    if (steady..=MAX_STEADY_ERROR).contains(&error) {
        1.0
    } else {
        factor(libm::pow(error, 1.0 / f64::from(order)))
    }
}

/// The step size of an adaptive method.
#[derive(Clone)]
pub(super) struct StepSize {
    pub(super) tolerance: Tolerance,
    /// The length of the last tick.
    last_step: LastStep,
    /// The length of the first substep to try in a tick of the same length.
    next: f64,
    /// The numbers of substeps accepted and rejected since construction or reset.
    pub(super) attempts: (u64, u64),
}

impl StepSize {
    pub(super) fn new(tolerance: Tolerance) -> Self {
        Self { tolerance, last_step: LastStep::NONE, next: 0.0, attempts: (0, 0) }
    }

    pub(super) fn reset(&mut self) {
        *self = Self::new(self.tolerance);
    }

    /// Begins a tick of `h`. The first substep is carried from the last tick, or covers the whole tick if the last tick
    /// had another length.
    #[inline]
    pub(super) fn begin_tick(&mut self, h: f64) -> TickProgress<'_> {
        let continues = self.last_step.is_continued_by(h);
        let carried = if continues { self.next } else { h };
        TickProgress { size: self, continues, h, left: h, carried, trial: h, attempts: 0 }
    }
}

/// The progress through a tick.
pub(super) struct TickProgress<'a> {
    size: &'a mut StepSize,
    /// Whether memory from the last tick is valid in this tick.
    pub(super) continues: bool,
    h: f64,
    left: f64,
    carried: f64,
    trial: f64,
    attempts: u32,
}

impl TickProgress<'_> {
    /// Returns the length of the substep to try next. The last substep ends exactly with the tick.
    #[inline]
    pub(super) fn trial(&mut self) -> Result<f64, StepFailure> {
        if self.attempts == MAX_ATTEMPTS {
            return Err(StepFailure::TooManySubsteps { limit: MAX_ATTEMPTS });
        }
        self.attempts += 1;
        // The comparison is by magnitude, so that a negative `h` steps back.
        self.trial = if self.carried.abs() < self.left.abs() { self.carried } else { self.left };
        Ok(self.trial)
    }

    /// Returns the time from the start of the tick to the start of the substep.
    #[inline]
    pub(super) fn elapsed(&self) -> f64 {
        self.h - self.left
    }

    #[inline]
    pub(super) fn is_finished(&self) -> bool {
        self.left == 0.0
    }

    /// Accepts or rejects a substep from `y` whose error is its length times `error`. `factor` maps the error relative
    /// to the tolerance to the factor for the next step. It is not called after a substep that the end of the tick cut
    /// short.
    #[inline]
    pub(super) fn accepts<V: Vector>(
        &mut self,
        error: &State<V>,
        y: &State<V>,
        factor: impl FnOnce(f64) -> f64,
    ) -> bool {
        let error = self.size.tolerance.relative_error(self.trial, error, y);
        let is_good = error <= 1.0;
        if is_good {
            self.size.attempts.0 += 1;
            if self.trial == self.carried {
                self.carried *= factor(error);
            }
            self.left -= self.trial;
            if self.is_finished() {
                self.size.next = self.carried;
                self.size.last_step.end(self.h);
            }
        } else {
            self.size.attempts.1 += 1;
            self.carried = self.trial * factor(error);
        }
        is_good
    }
}
