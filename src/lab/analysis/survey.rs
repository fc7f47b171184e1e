//! Follows the true motion of one body in adaptive steps, and measures the range of each component.

use crate::lab::action::Action;
use crate::lab::interpolation::hermite;
use crate::sim::Stepper;
use crate::sim::integrators::StepFailure;

/// The part of a step at which it is checked: irrational, so that regular steps do not resonate with a period.
const CHECKED_AT: f64 = 0.381_966_011_250_105_1;
/// The first step as a part of the duration: far below any period that can be followed.
const FIRST_STEP: f64 = 1e-7;
/// The largest error of the cubic through both ends of a step, as a part of the motion's range: steps of about a sixth
/// of a radian.
const CHORD: f64 = 1e-5;
/// A range smaller than this part of the magnitude is rounding, and this part is used in its place.
const ROUNDING: f64 = 1e-9;
/// The least and the greatest ratio of a step to the one before.
const FACTORS: (f64, f64) = (0.3, 2.0);
/// The parts into which a step is divided to find an extreme.
const BETWEEN: u32 = 4;
/// One in this many moments is reserved for the end of the motion, in case the others do not reach it.
const KEPT: usize = 4;

/// A moment of the true motion.
#[derive(Clone, Debug)]
pub(super) struct TruthNode {
    pub(super) t: f64,
    /// Coordinates, then velocities.
    pub(super) x: Vec<f64>,
    /// Velocities, then accelerations: the slopes of `x`.
    pub(super) slope: Vec<f64>,
}

impl TruthNode {
    pub(super) fn of(body: &dyn Stepper, t: f64) -> Self {
        let x = [body.q(), body.v()].concat();
        let mut slope = [body.v(), body.v()].concat();
        let n = body.q().len();
        body.acceleration(t, body.q(), body.v(), &mut slope[n..]);
        Self { t, x, slope }
    }

    /// Component `i` at the part `s` of the way to `next`, by the cubic through both.
    pub(super) fn between(&self, next: &Self, i: usize, s: f64) -> f64 {
        let h = next.t - self.t;
        hermite(s, h, [self.x[i], next.x[i]], [self.slope[i], next.slope[i]])
    }

    fn is_finite(&self) -> bool {
        self.x.iter().chain(&self.slope).all(|x| x.is_finite())
    }
}

/// The range of each component, coordinates first.
#[derive(Clone, Debug)]
pub(super) struct Ranges(pub(super) Vec<(f64, f64)>);

impl Ranges {
    pub(super) fn at(body: &dyn Stepper) -> Self {
        Self(body.q().iter().chain(body.v()).map(|&x| (x, x)).collect())
    }

    /// Extends the ranges by the motion between two moments.
    pub(super) fn take_in(&mut self, from: &TruthNode, to: &TruthNode) {
        for (i, range) in self.0.iter_mut().enumerate() {
            let turns = from.slope[i] * to.slope[i] < 0.0;
            let steps = if turns { 1..=BETWEEN } else { BETWEEN..=BETWEEN };
            for step in steps {
                let x = from.between(to, i, f64::from(step) / f64::from(BETWEEN));
                *range = (range.0.min(x), range.1.max(x));
            }
        }
    }
}

/// A script's action on a body, and its time in seconds.
#[derive(Clone, Debug)]
pub(super) struct TimedInput {
    pub(super) t: f64,
    pub(super) action: Action,
}

/// Follows `body` from its start over `seconds`, applies its inputs in order, and passes both ends of each step to `see`.
/// The steps are so short that the cubic through both ends is as good as exact. If that would take more than `most`
/// moments, the rest of the motion is sampled at scattered moments, and `see` receives each as both ends.
///
/// # Errors
/// If the truth fails or is not finite.
pub(super) fn follow_truth(
    body: &mut dyn Stepper,
    mut inputs: &[TimedInput],
    seconds: f64,
    most: usize,
    mut see: impl FnMut(&TruthNode, &TruthNode),
) -> Result<(), StepFailure> {
    let mut ranges = Ranges::at(body);
    let mut here = TruthNode::of(body, 0.0);
    let mut step = FIRST_STEP * seconds;
    let mut moments = 0;
    let kept = most / KEPT;
    while here.t < seconds && moments + kept < most {
        if let Some((next, rest)) = inputs.split_first()
            && next.t <= here.t
        {
            next.action.apply_to(body, here.t);
            (here, inputs) = (TruthNode::of(body, here.t), rest);
            step = FIRST_STEP * seconds;
            continue;
        }
        let seconds = inputs.first().map_or(seconds, |next| next.t.min(seconds));
        let end = if here.t + 1.001 * step < seconds { here.t + step } else { seconds };
        let check = TruthNode::of_advanced(body, here.t, here.t + CHECKED_AT * (end - here.t))?;
        let there = TruthNode::of_advanced(body, check.t, end)?;
        moments += 2;
        ranges.take_in(&here, &check);
        ranges.take_in(&check, &there);
        see(&here, &check);
        see(&check, &there);
        let part = (check.t - here.t) / (there.t - here.t);
        let off = worst_chord(&here, &check, &there, part, &ranges);
        let factor = libm::sqrt(libm::sqrt(CHORD / off));
        step = (end - here.t) * if factor > FACTORS.0 { factor.min(FACTORS.1) } else { FACTORS.0 };
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
                && next.t <= t
            {
                here = TruthNode::of_advanced(body, here.t, next.t.max(here.t))?;
                next.action.apply_to(body, here.t);
                inputs = rest;
            }
            let there = TruthNode::of_advanced(body, here.t, t)?;
            see(&there, &there);
            here = there;
        }
    }
    Ok(())
}

impl TruthNode {
    fn of_advanced(body: &mut dyn Stepper, from: f64, to: f64) -> Result<Self, StepFailure> {
        body.advance(from, to - from, 1)?;
        let moment = Self::of(body, to);
        match moment.x.iter().find(|x| !x.is_finite()) {
            Some(&value) => {
                Err(StepFailure::NotFinite { coordinate: "the exact solution".into(), value })
            }
            None if moment.is_finite() => Ok(moment),
            None => Err(StepFailure::NotFinite {
                coordinate: "its acceleration".into(),
                value: f64::NAN,
            }),
        }
    }
}

/// The largest error of the cubic from `here` to `there` at `check`, as a part of the range of its kind of component.
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
