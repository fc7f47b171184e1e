//! The true motion of one body between ticks: its recent past on a fine time grid that no tick rate
//! changes, and its state at any moment of the last tick. Bounded, and allocated once.

use std::collections::vec_deque;
use std::mem::discriminant;

use glam::DVec2;

use super::log::Log;
use super::swept::Swept;
use crate::lab::lane::LaneBody;
use crate::lab::race::LastTick;
use crate::sim::bodies::Input;
use crate::sim::{Solver, Stepper};

/// Grid points in the stretch of time that is kept: several for each pixel of a plot.
const GRID: usize = 4096;

/// Room for samples off the grid: those at which an input bent the curve.
const OFF_GRID: usize = 512;

/// The kinds of input that wait for a tick to begin: more would make the list grow.
const KINDS_OF_INPUT: usize = 3;

/// Grid points kept beside, to go back to at once.
const SPARE: usize = GRID / 2;

/// One moment of the true motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthSample {
    /// Time in seconds.
    pub t: f64,
    /// The first coordinate.
    pub q: f64,
    /// What the first coordinate passed over since the sample before, as far as ticks show it.
    pub swept: Swept,
    /// Its velocity.
    pub v: f64,
    /// Where the body was, in metres.
    pub at: DVec2,
}

impl TruthSample {
    fn of(t: f64, stepper: &dyn Stepper) -> Self {
        let q = stepper.q()[0];
        Self { t, q, swept: Swept::at(q), v: stepper.v()[0], at: stepper.place() }
    }

    fn is_finite(&self) -> bool {
        self.q.is_finite() && self.v.is_finite() && self.at.is_finite()
    }
}

/// The true motion of one body as a curve.
pub struct TruthCurve {
    /// A copy of the true body under what pushed it in the last tick, which is moved about within that tick. The
    /// truth itself is only read, so that no bit of it depends on what is drawn.
    between: Box<dyn Stepper>,
    /// What was done to the truth since the last tick: `between` takes it when that tick is over.
    pending: Vec<Input>,
    /// Whether the truth was changed otherwise: a new copy is to be made.
    is_stale: bool,
    spacing_s: f64,
    samples: Log<TruthSample>,
    /// What ticks showed of the first coordinate since the newest sample.
    since: Swept,
}

/// Where a [`TruthCurve`] was at some tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct TruthMark {
    /// How much was recorded since the start.
    samples: u64,
    since: Swept,
}

impl TruthCurve {
    /// The curve of `truth` at its start, with room for the last `span_s` seconds.
    pub(super) fn new(truth: &LaneBody, span_s: f64) -> Self {
        let mut curve = Self {
            between: truth.stepper.with_solver(Solver::Truth, 0.0),
            pending: Vec::with_capacity(KINDS_OF_INPUT),
            is_stale: false,
            spacing_s: span_s / GRID as f64,
            samples: Log::new(GRID + OFF_GRID, SPARE),
            since: Swept::NOTHING,
        };
        curve.keep(0.0, truth);
        curve
    }

    /// The recent past, oldest first: at every point of the grid, and on both sides of an input.
    pub fn samples(&self) -> vec_deque::Iter<'_, TruthSample> {
        self.samples.shown()
    }

    /// The coordinates and velocities at the part `part`, 0 to 1, of the last tick of `truth`.
    pub(super) fn state(
        &self,
        truth: &LaneBody,
        LastTick { from_s, to_s }: LastTick,
        part: f64,
    ) -> (Vec<f64>, Vec<f64>) {
        let body = if self.is_stale { &truth.stepper } else { &self.between };
        let mut copy = body.with_solver(Solver::Truth, from_s);
        copy.set(from_s, &truth.previous_q, &truth.previous_v);
        let reached = copy.advance(from_s, part * (to_s - from_s), 1);
        if reached.is_err() || copy.q().iter().chain(copy.v()).any(|value| !value.is_finite()) {
            return (truth.previous_q.clone(), truth.previous_v.clone());
        }
        (copy.q().to_vec(), copy.v().to_vec())
    }

    /// Takes in the tick that `truth` has just made. Never allocates, but after the truth was
    /// [changed](Self::change).
    pub(super) fn extend(&mut self, truth: &LaneBody, LastTick { from_s, to_s }: LastTick) {
        self.refresh(truth, from_s);
        for input in self.pending.drain(..) {
            self.between.input(from_s, input);
        }
        // A tick longer than all that is kept has as many points as are kept.
        let spacing_s = self.spacing_s.max((to_s - from_s) / GRID as f64);
        let first = libm::floor(from_s / spacing_s);
        let count = (libm::floor(to_s / spacing_s) - first) as u64;
        if count == 0 {
            self.since = self.since.and(truth.stepper.q()[0]);
            return;
        }
        self.between.set(from_s, &truth.previous_q, &truth.previous_v);
        let mut t = from_s;
        for i in 1..=count {
            let next = ((first + i as f64) * spacing_s).min(to_s);
            if self.between.advance(t, next - t, 1).is_err() {
                return;
            }
            t = next;
            self.push(TruthSample::of(t, &*self.between));
        }
        // Where the grid is finer than the ticks, its own points are all there is to see.
        if t < to_s && to_s - from_s < spacing_s {
            self.since = self.since.and(truth.stepper.q()[0]);
        }
    }

    /// Keeps the present of `truth`, at time `t`: before and after an input, where the curve has a
    /// corner. Never allocates.
    pub(super) fn keep(&mut self, t: f64, truth: &LaneBody) {
        self.push(TruthSample::of(t, &*truth.stepper));
    }

    /// Takes notice of an input that was given to the truth.
    pub(super) fn bend(&mut self, input: Input) {
        self.pending.retain(|waiting| discriminant(waiting) != discriminant(&input));
        self.pending.push(input);
    }

    /// Takes notice of anything else that was done to the truth.
    pub(super) fn change(&mut self) {
        self.is_stale = true;
    }

    /// Makes a new copy of `truth`, where it was changed before time `t` (s).
    pub(super) fn refresh(&mut self, truth: &LaneBody, t: f64) {
        if std::mem::take(&mut self.is_stale) {
            self.between = truth.stepper.with_solver(Solver::Truth, t);
            self.pending.clear();
        }
    }

    fn push(&mut self, sample: TruthSample) {
        let is_another =
            |last: &TruthSample| sample != TruthSample { swept: sample.swept, ..*last };
        let newest = self.samples.newest();
        let follows = newest.is_none_or(|last| is_another(last) && last.t <= sample.t);
        if follows && sample.is_finite() {
            let swept = self.since.and(sample.q);
            self.since = Swept::NOTHING;
            self.samples.push(TruthSample { swept, ..sample });
        }
    }

    /// Where it is now.
    pub(super) fn mark(&self) -> TruthMark {
        TruthMark { samples: self.samples.mark(), since: self.since }
    }

    /// Whether a run begun again at the mark `from` will show at `mark` what it showed then.
    pub(super) fn fills(&self, from: TruthMark, mark: TruthMark) -> bool {
        self.samples.fills(from.samples, mark.samples)
    }

    /// Goes back to a mark, or forward to one of the future that is kept.
    pub(super) fn rewind(&mut self, mark: TruthMark) {
        self.samples.rewind(mark.samples);
        self.since = mark.since;
        self.pending.clear();
        self.is_stale = true;
    }

    /// Forgets the future: another one begins.
    pub(super) fn forget_future(&mut self) {
        self.samples.forget_future();
    }
}
