//! The true motion of one body between ticks: its recent past on a fine time grid that no tick rate
//! changes, and its state at any moment of the last tick. Bounded, and allocated once.

use std::collections::VecDeque;
use std::mem::discriminant;

use glam::DVec2;

use super::lane::LaneBody;
use crate::sim::bodies::Input;
use crate::sim::{Solver, Stepper};

/// Grid points in the stretch of time that is kept: several for each pixel of a plot.
const GRID: usize = 4096;

/// Room for samples off the grid: those at which an input bent the curve.
const OFF_GRID: usize = 512;

/// The kinds of input that wait for a tick to begin: more would make the list grow.
const KINDS_OF_INPUT: usize = 3;

/// One moment of the true motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthSample {
    /// Time in seconds.
    pub t: f64,
    /// The first coordinate.
    pub q: f64,
    /// Its velocity.
    pub v: f64,
    /// Where the body was, in metres.
    pub at: DVec2,
}

impl TruthSample {
    fn of(t: f64, stepper: &dyn Stepper) -> Self {
        Self { t, q: stepper.q()[0], v: stepper.v()[0], at: stepper.place() }
    }

    fn is_finite(&self) -> bool {
        self.q.is_finite() && self.v.is_finite() && self.at.is_finite()
    }
}

/// The last tick of the truth.
#[derive(Clone, Copy, Debug)]
pub(super) struct LastTick {
    /// When it began, in seconds.
    pub(super) from_s: f64,
    /// When it ended.
    pub(super) to_s: f64,
}

/// The true motion of one body as a curve.
pub struct TruthCurve {
    /// A copy of the true body, which is moved about within the last tick. The truth itself is only
    /// read, so that no bit of it depends on what is drawn.
    between: Box<dyn Stepper>,
    /// What was done to the truth since the last tick: `between` takes it when that tick is over.
    pending: Vec<Input>,
    spacing_s: f64,
    samples: VecDeque<TruthSample>,
}

impl TruthCurve {
    /// The curve of `truth` at its start, with room for the last `span_s` seconds.
    pub(super) fn new(truth: &LaneBody, span_s: f64) -> Self {
        let mut curve = Self {
            between: truth.stepper.with_solver(Solver::Truth, 0.0),
            pending: Vec::with_capacity(KINDS_OF_INPUT),
            spacing_s: span_s / GRID as f64,
            samples: VecDeque::with_capacity(GRID + OFF_GRID),
        };
        curve.keep(0.0, truth);
        curve
    }

    /// The recent past, oldest first: at every point of the grid, and on both sides of an input.
    pub fn samples(
        &self,
    ) -> impl DoubleEndedIterator<Item = &TruthSample> + ExactSizeIterator + Clone {
        self.samples.iter()
    }

    /// The coordinates and velocities at the part `part`, 0 to 1, of the last tick of `truth`.
    pub(super) fn state(
        &self,
        truth: &LaneBody,
        LastTick { from_s, to_s }: LastTick,
        part: f64,
    ) -> (Vec<f64>, Vec<f64>) {
        let mut copy = self.between.with_solver(Solver::Truth, from_s);
        copy.set(from_s, &truth.previous_q, &truth.previous_v);
        let reached = copy.advance(from_s, part * (to_s - from_s), 1);
        if reached.is_err() || copy.q().iter().chain(copy.v()).any(|value| !value.is_finite()) {
            return (truth.previous_q.clone(), truth.previous_v.clone());
        }
        (copy.q().to_vec(), copy.v().to_vec())
    }

    /// Takes in the tick that `truth` has just made. Never allocates.
    pub(super) fn extend(&mut self, truth: &LaneBody, LastTick { from_s, to_s }: LastTick) {
        for input in self.pending.drain(..) {
            self.between.input(from_s, input);
        }
        // A tick longer than all that is kept has as many points as are kept.
        let spacing_s = self.spacing_s.max((to_s - from_s) / GRID as f64);
        let first = libm::floor(from_s / spacing_s);
        let count = (libm::floor(to_s / spacing_s) - first) as u64;
        if count == 0 {
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

    fn push(&mut self, sample: TruthSample) {
        let follows = self.samples.back().is_none_or(|&last| last != sample && last.t <= sample.t);
        if !follows || !sample.is_finite() {
            return;
        }
        if self.samples.len() == GRID + OFF_GRID {
            self.samples.pop_front();
        }
        self.samples.push_back(sample);
    }
}
