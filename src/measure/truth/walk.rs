//! Follows the true motion of one body in adaptive steps.

use super::BodyTruth;
use crate::sim::integrators::StepFailure;
use crate::sim::{Solver, Stepper};
use crate::survey::{Ranges, TruthNode};

/// Position of the check within a step, which is irrational so that regular steps do not resonate with a period.
const CHECKED_AT: f64 = 0.381_966_011_250_105_1;
/// First step relative to the duration, which is far below any period that can be followed.
const FIRST_STEP: f64 = 1e-7;
/// Largest error of the cubic through both ends of a step, relative to the motion's range. This error leads to steps of
/// about a sixth of a radian.
const CHORD: f64 = 1e-5;
/// A range counts as rounding if it is below this fraction of the magnitude; it is replaced by this fraction of the
/// magnitude.
const ROUNDING: f64 = 1e-9;
/// Minimum and maximum ratio of a step to the previous one.
const FACTORS: (f64, f64) = (0.3, 2.0);
/// Divisor of the number of moments. The quotient is the number of moments that are reserved for the end of the motion,
/// in case the others do not reach it.
const KEPT: usize = 4;

impl BodyTruth {
    /// Follows `body` from its start over `seconds`, applying its inputs in order, and passes both ends of each step to
    /// `see`. Steps are so short that the cubic through both ends is as good as exact.
    ///
    /// If this would take more than `most` moments, the rest of the motion is sampled at scattered moments. `see` then
    /// receives each of these moments as both ends.
    ///
    /// # Errors
    /// If the solver fails or is not finite.
    pub(super) async fn walk(
        &self,
        body: &mut dyn Stepper,
        solver: Solver,
        seconds: f64,
        most: usize,
        see: impl FnMut(&TruthNode, &TruthNode),
    ) -> Result<(), StepFailure> {
        let mut work =
            WalkWork { solver, of_moment: self.work_of_moment(), moments: 0, counted: 0 };
        let walked = self.walk_counting(&mut work, body, seconds, most, see).await;
        self.meter.count(work.newly_done(body)).await;
        walked
    }

    async fn walk_counting(
        &self,
        work: &mut WalkWork,
        body: &mut dyn Stepper,
        seconds: f64,
        most: usize,
        mut see: impl FnMut(&TruthNode, &TruthNode),
    ) -> Result<(), StepFailure> {
        let mut inputs = &self.inputs[..];
        let mut ranges = Ranges::at(body);
        let mut here = TruthNode::of(body, 0.0);
        let mut step = FIRST_STEP * seconds;
        let kept = most / KEPT;
        while here.t < seconds && work.moments + kept < most {
            if let Some((next, rest)) = inputs.split_first()
                && next.at_s <= here.t
            {
                next.action.apply_to(body, here.t);
                (here, inputs) = (TruthNode::of(body, here.t), rest);
                step = FIRST_STEP * seconds;
                continue;
            }
            let seconds = inputs.first().map_or(seconds, |next| next.at_s.min(seconds));
            let end = if here.t + 1.001 * step < seconds { here.t + step } else { seconds };
            let check = TruthNode::of_advanced(body, here.t, here.t + CHECKED_AT * (end - here.t))?;
            let there = TruthNode::of_advanced(body, check.t, end)?;
            work.moments += 2;
            ranges.extend(&here, &check);
            ranges.extend(&check, &there);
            see(&here, &check);
            see(&check, &there);
            self.meter.count(work.newly_done(body)).await;
            let part = (check.t - here.t) / (there.t - here.t);
            let off = worst_chord(&here, &check, &there, part, &ranges);
            let factor = libm::sqrt(libm::sqrt(CHORD / off));
            let factor = if factor > FACTORS.0 { factor.min(FACTORS.1) } else { FACTORS.0 };
            step = (end - here.t) * factor;
            here = there;
        }
        let left = seconds - here.t;
        if left > 0.0 {
            let mut parts: Vec<f64> = (1..=kept).map(|k| (k as f64 * CHECKED_AT).fract()).collect();
            parts.sort_by(f64::total_cmp);
            let start = here.t;
            for part in parts {
                let t = start + part * left;
                while let Some((next, rest)) = inputs.split_first()
                    && next.at_s <= t
                {
                    here = TruthNode::of_advanced(body, here.t, next.at_s.max(here.t))?;
                    next.action.apply_to(body, here.t);
                    inputs = rest;
                }
                let there = TruthNode::of_advanced(body, here.t, t)?;
                work.moments += 1;
                see(&there, &there);
                self.meter.count(work.newly_done(body)).await;
                here = there;
            }
        }
        Ok(())
    }
}

/// Work of a walk, in evaluations of one coordinate.
struct WalkWork {
    solver: Solver,
    /// Work per moment of the truth.
    of_moment: u64,
    /// Number of moments visited.
    moments: usize,
    /// Work that the meter has counted.
    counted: u64,
}

impl WalkWork {
    /// Returns the work since the last call.
    fn newly_done(&mut self, body: &dyn Stepper) -> u64 {
        let all = match self.solver {
            Solver::Truth => self.moments as u64 * self.of_moment,
            _ => body.evaluations() * body.q().len() as u64,
        };
        all - std::mem::replace(&mut self.counted, all)
    }
}

/// Returns the largest error of the cubic from `here` to `there` at `check`, relative to the range of all coordinates
/// or of all velocities.
fn worst_chord(
    here: &TruthNode,
    check: &TruthNode,
    there: &TruthNode,
    part: f64,
    ranges: &Ranges,
) -> f64 {
    let n = here.x.len() / 2;
    let covered = |half: std::ops::Range<usize>| {
        let cover = |i: usize| {
            let (low, high) = ranges.0[i];
            (high - low).max(ROUNDING * low.abs().max(high.abs()))
        };
        half.map(cover).fold(0.0, f64::max)
    };
    let (q, v) = (covered(0..n), covered(n..2 * n));
    let off = (0..2 * n).map(|i| {
        let scale = if i < n { q } else { v };
        let off = (here.between(there, i, part) - check.x[i]).abs();
        if scale > 0.0 { off / scale } else { 0.0 }
    });
    off.fold(1e-300, f64::max)
}
