//! The true motion of one body between ticks. A time grid, independent of the tick rate, holds the body's recent past;
//! any moment of the last tick can be computed. The curve is bounded, and allocated once.

use std::collections::vec_deque;
use std::mem::discriminant;

use glam::DVec2;

use super::quantity::Quantity;
use super::sample::{Energies, SweptRange};
use super::windowed_log::WindowedLog;
use crate::race::{LaneBody, LastTick, hermite, slope};
use crate::sim::bodies::Input;
use crate::sim::{Solver, Stepper};

/// Number of grid points in the displayed duration, which is several for each pixel of a plot.
const GRID: usize = 4096;

/// Maximum number of products of the exact flow for the points of one tick, which are some milliseconds of work. A
/// point of n coordinates takes n² products. If there are few points, the curve between two of them is a cubic.
const MAX_PRODUCTS: usize = 2_000_000;

/// Minimum number of points that a tick may have, at any cost.
const MIN_POINTS: usize = 16;

/// Capacity for samples off the grid, which are made at inputs.
const OFF_GRID: usize = 512;

/// Capacity for pending inputs, one of each kind.
const KINDS_OF_INPUT: usize = 3;

/// Maximum number of points that refine the curve between two samples.
const MAX_BETWEEN: f64 = 1e4;

/// Largest relative difference at which the flow counts as reaching a sample.
const FOLLOWS: f64 = 1e-9;

/// Number of further grid points to keep, for rewinding without repetition.
const SPARE: usize = GRID / 2;

/// Number of samples per block with a known extent, which is about the number of blocks.
const BLOCK: usize = 64;

/// One moment of the true motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthSample {
    /// Time in seconds.
    pub t: f64,
    /// The recorded coordinate.
    pub q: f64,
    /// Range of the recorded coordinate at ticks since the previous sample.
    pub swept: SweptRange,
    /// Velocity of the recorded coordinate.
    pub v: f64,
    /// Place of the body, in metres.
    pub at: DVec2,
    /// Energies, if the body conserves energy.
    pub energies: Option<Energies>,
    /// Whether the body was placed at this moment, so that no path leads from the previous sample.
    pub jumped: bool,
}

impl TruthSample {
    fn of(t: f64, coordinate: usize, stepper: &dyn Stepper) -> Self {
        let (q, v) = (stepper.q()[coordinate], stepper.v()[coordinate]);
        let (swept, at) = (SweptRange::at(q), stepper.place());
        let energies = Energies::of(stepper);
        Self { t, q, swept, v, at, energies, jumped: false }
    }

    fn is_finite(&self) -> bool {
        self.q.is_finite() && self.v.is_finite() && self.at.is_finite()
    }
}

/// The true motion of one body as a curve.
pub struct TruthCurve {
    /// A copy of the true body under the inputs of the last tick, for moments within that tick. The truth itself is
    /// only read, so that drawing never changes a bit of the truth.
    between: Box<dyn Stepper>,
    /// Inputs since the last tick, which `between` gets at the next tick.
    pending: Vec<Input>,
    /// Whether the truth has changed in another way, so that a new copy is due.
    is_stale: bool,
    spacing_s: f64,
    /// Index of the recorded coordinate.
    coordinate: usize,
    samples: WindowedLog<TruthSample>,
    /// Smallest and largest place in each block of samples, along x and up.
    extents: WindowedLog<[DVec2; 2]>,
    /// Range of the recorded coordinate at ticks since the newest sample.
    since: SweptRange,
}

/// The end of a [`TruthCurve`] at some tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct TruthMark {
    /// Number of samples since the start.
    samples: u64,
    since: SweptRange,
}

impl TruthCurve {
    /// Creates the curve of `truth` from its start, for the coordinate with this index, with a capacity of `span_s`
    /// seconds.
    pub(super) fn new(truth: &LaneBody, coordinate: usize, span_s: f64) -> Self {
        let mut curve = Self {
            between: truth.stepper.with_solver(Solver::Truth, 0.0),
            pending: Vec::with_capacity(KINDS_OF_INPUT),
            is_stale: false,
            spacing_s: span_s / GRID as f64,
            coordinate,
            samples: WindowedLog::new(GRID + OFF_GRID, SPARE),
            extents: WindowedLog::new((GRID + OFF_GRID) / BLOCK + 1, SPARE / BLOCK + 1),
            since: SweptRange::NOTHING,
        };
        curve.push_present(0.0, truth);
        curve
    }

    /// Returns the heap memory of the curve in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        self.between.bytes(Solver::Truth) + self.samples.heap_bytes() + self.extents.heap_bytes()
    }

    /// Returns the samples, with the oldest first. There is one at every point of the grid, and one on each side of an
    /// input.
    pub fn samples(&self) -> vec_deque::Iter<'_, TruthSample> {
        self.samples.shown()
    }

    /// Returns the samples from time `t` (s) on, with the oldest first. If the body was placed at `t`, they begin with
    /// the placement.
    pub fn since(&self, t: f64) -> vec_deque::Iter<'_, TruthSample> {
        let skipped = self.samples.count_before(t, |sample| (sample.t, sample.jumped));
        self.samples.range(skipped)
    }

    /// Returns the largest distance of the body from `centre_m` [since](Self::since) `t` (s), along x and up, in
    /// metres.
    pub fn reach_m(&self, centre_m: DVec2, t: f64) -> DVec2 {
        let (since, end) = (self.since(t), self.samples.mark() as usize);
        let (first, last) = ((end - since.len()).div_ceil(BLOCK), end / BLOCK);
        let blocks = last.saturating_sub(first);
        let (before, after) = match blocks {
            0 => (since.len(), 0),
            _ => (since.len() - (end - first * BLOCK), end - last * BLOCK),
        };
        let samples = since.clone().take(before).chain(since.rev().take(after));
        let extents = self.extents.range(self.extents.len() - blocks).flatten();
        let places = samples.map(|sample| &sample.at).chain(extents);
        places.map(|at| (at - centre_m).abs()).fold(DVec2::ZERO, DVec2::max)
    }

    /// Returns the present of the true body `truth` at time `t` (s), which is the curve's end, on or off the grid.
    pub fn present(&self, truth: &LaneBody, t: f64) -> TruthSample {
        TruthSample::of(t, self.coordinate, &*truth.stepper)
    }

    /// Returns the index of the recorded coordinate.
    pub fn coordinate(&self) -> usize {
        self.coordinate
    }

    /// Returns a quantity over time through consecutive `samples` of the true body `truth`, at least every `spacing_s`
    /// seconds. For a body of one coordinate, points follow the exact flow from each sample if the flow reaches the
    /// next sample. After inputs or edits, and for several coordinates, points lie on a cubic.
    pub fn finer(
        truth: &LaneBody,
        quantity: Quantity,
        samples: &[TruthSample],
        spacing_s: f64,
    ) -> Vec<[f64; 2]> {
        let mut flow = Flow::of(truth);
        let mut points = Vec::new();
        for pair in samples.windows(2) {
            let [from, to] = [&pair[0], &pair[1]];
            let wide = to.t - from.t;
            let follows = flow.leads(from, to);
            let count = libm::ceil(wide / spacing_s).clamp(1.0, MAX_BETWEEN) as u32;
            for i in 0..count {
                let part = f64::from(i) / f64::from(count);
                let t = from.t + part * wide;
                let state = if follows { flow.state(from, t) } else { None };
                points.push([t, quantity.value(state.unwrap_or_else(|| cubic(from, to, part)))]);
            }
        }
        points.extend(samples.last().map(|last| [last.t, quantity.value([last.q, last.v])]));
        points
    }

    /// Returns a quantity of the true body `truth` at time `t` (s) between two consecutive samples, on the curve of
    /// [`finer`](Self::finer).
    pub fn between(
        truth: &LaneBody,
        quantity: Quantity,
        [from, to]: [&TruthSample; 2],
        t: f64,
    ) -> f64 {
        let mut flow = Flow::of(truth);
        let state = flow.leads(from, to).then(|| flow.state(from, t)).flatten();
        quantity.value(state.unwrap_or_else(|| cubic(from, to, (t - from.t) / (to.t - from.t))))
    }

    /// Returns coordinates and velocities of `truth` within or beyond its last tick. During the tick, `part` runs from
    /// 0 to 1.
    pub(super) fn state(
        &self,
        truth: &LaneBody,
        LastTick { from_s, to_s }: LastTick,
        part: f64,
    ) -> (Vec<f64>, Vec<f64>) {
        let present = &truth.stepper;
        let is_within = part < 1.0;
        let (body, from, q, v) = match is_within {
            true if !self.is_stale => {
                (&self.between, from_s, &truth.previous_q[..], &truth.previous_v[..])
            }
            true => (present, from_s, &truth.previous_q[..], &truth.previous_v[..]),
            false => (present, to_s, present.q(), present.v()),
        };
        let h = if is_within { part } else { part - 1.0 } * (to_s - from_s);
        if h == 0.0 {
            return (q.to_vec(), v.to_vec());
        }
        let mut copy = body.with_solver(Solver::Truth, from);
        copy.set(from, q, v);
        let reached = copy.advance(from, h, 1);
        if reached.is_err() || copy.q().iter().chain(copy.v()).any(|value| !value.is_finite()) {
            return (q.to_vec(), v.to_vec());
        }
        (copy.q().to_vec(), copy.v().to_vec())
    }

    /// Adds the tick that `truth` has just made. Allocates only after a [change](Self::invalidate_copy) of the truth.
    pub(super) fn extend(&mut self, truth: &LaneBody, LastTick { from_s, to_s }: LastTick) {
        self.refresh(truth, from_s);
        for input in self.pending.drain(..) {
            self.between.input(from_s, input);
        }
        // A tick longer than the curve gets as many points as the whole curve, or as the work limit allows.
        let coordinates = truth.coordinates().len();
        let most = (MAX_PRODUCTS / (coordinates * coordinates)).clamp(MIN_POINTS, GRID);
        let spacing_s = self.spacing_s.max((to_s - from_s) / most as f64);
        let first = libm::floor(from_s / spacing_s);
        let count = (libm::floor(to_s / spacing_s) - first) as u64;
        if count == 0 {
            self.since = self.since.extended_by(truth.stepper.q()[self.coordinate]);
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
            self.push(TruthSample::of(t, self.coordinate, &*self.between));
        }
        // If the grid is finer than the ticks, only grid points are drawn.
        if t < to_s && to_s - from_s < spacing_s {
            self.since = self.since.extended_by(truth.stepper.q()[self.coordinate]);
        }
    }

    /// Adds the present of `truth` at time `t`, before and after an input, because the curve has a corner at inputs.
    /// Never allocates.
    pub(super) fn push_present(&mut self, t: f64, truth: &LaneBody) {
        self.push(self.present(truth, t));
    }

    /// Adds the present of `truth` at time `t` as a new beginning, because the body was placed. Never allocates.
    pub(super) fn jump(&mut self, t: f64, truth: &LaneBody) {
        self.push(TruthSample { jumped: true, ..self.present(truth, t) });
    }

    /// Records an input to the truth.
    pub(super) fn note_input(&mut self, input: Input) {
        self.pending.retain(|waiting| discriminant(waiting) != discriminant(&input));
        self.pending.push(input);
    }

    /// Records any other change of the truth.
    pub(super) fn invalidate_copy(&mut self) {
        self.is_stale = true;
    }

    /// Copies `truth` again if it changed before time `t` (s).
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
            let swept = self.since.extended_by(sample.q);
            self.since = SweptRange::NOTHING;
            self.samples.push(TruthSample { swept, ..sample });
            if self.samples.mark().is_multiple_of(BLOCK as u64) {
                let block = self.samples.range(self.samples.len().saturating_sub(BLOCK));
                let places = block.map(|sample| sample.at);
                let extent = [
                    places.clone().fold(DVec2::INFINITY, DVec2::min),
                    places.fold(DVec2::NEG_INFINITY, DVec2::max),
                ];
                self.extents.push(extent);
            }
        }
    }

    /// Marks the present, for rewinding.
    pub(super) fn mark(&self) -> TruthMark {
        TruthMark { samples: self.samples.mark(), since: self.since }
    }

    /// Whether a repetition from the mark `from` restores the samples shown at `mark`.
    pub(super) fn fills(&self, from: TruthMark, mark: TruthMark) -> bool {
        self.samples.fills(from.samples, mark.samples)
    }

    /// Rewinds to a mark. The mark may also lie in the recorded future.
    pub(super) fn rewind(&mut self, mark: TruthMark) {
        self.samples.rewind(mark.samples);
        self.extents.rewind(mark.samples / BLOCK as u64);
        self.since = mark.since;
        self.pending.clear();
        self.is_stale = true;
    }

    /// Drops the recorded future.
    pub(super) fn forget_future(&mut self) {
        self.samples.forget_future();
        self.extents.forget_future();
    }
}

/// The motion of a true body without further inputs, for one coordinate.
struct Flow {
    copy: Box<dyn Stepper>,
    is_known: bool,
}

impl Flow {
    fn of(truth: &LaneBody) -> Self {
        let copy = truth.stepper.with_solver(Solver::Truth, 0.0);
        Self { copy, is_known: truth.coordinates().len() == 1 }
    }

    /// Returns coordinate and velocity at time `t` (s), starting from a sample.
    fn state(&mut self, from: &TruthSample, t: f64) -> Option<[f64; 2]> {
        if !self.is_known {
            return None;
        }
        self.copy.set(from.t, &[from.q], &[from.v]);
        self.copy.advance(from.t, t - from.t, 1).ok()?;
        Some([self.copy.q()[0], self.copy.v()[0]])
    }

    /// Whether the motion from one sample reaches the other.
    fn leads(&mut self, from: &TruthSample, to: &TruthSample) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= FOLLOWS * a.abs().max(b.abs());
        self.state(from, to.t).is_some_and(|[q, v]| near(q, to.q) && near(v, to.v))
    }
}

/// Returns coordinate and velocity at a fraction of the way between two samples, on the cubic through both with their
/// velocities. If both samples have the same time, it returns those of the first.
fn cubic(from: &TruthSample, to: &TruthSample, part: f64) -> [f64; 2] {
    let h = to.t - from.t;
    if h <= 0.0 {
        return [from.q, from.v];
    }
    let (q, v) = ([from.q, to.q], [from.v, to.v]);
    [hermite(part, h, q, v), slope(part, h, q, v)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Race;
    use crate::scene::Scene;

    #[test]
    fn points_between_samples_are_on_the_exact_motion() {
        let race = Race::of_scene(&Scene::built_in("spring").unwrap());
        let truth = &race.truth().bodies()[0];
        let tau = std::f64::consts::TAU;
        let sample = |t: f64| TruthSample {
            q: libm::cos(tau * t),
            v: -tau * libm::sin(tau * t),
            ..TruthSample::of(t, 0, &*truth.stepper)
        };
        let samples: Vec<TruthSample> = (0..5).map(|i| sample(0.1 * f64::from(i))).collect();
        let points = TruthCurve::finer(truth, Quantity::Position, &samples, 0.001);
        assert!(points.len() >= 400 && points.windows(2).all(|pair| pair[1][0] > pair[0][0]));
        for [t, q] in &points {
            assert!((q - libm::cos(tau * t)).abs() < 1e-11, "{q} at {t} s");
        }
        for [t, v] in TruthCurve::finer(truth, Quantity::Velocity, &samples, 0.001) {
            assert!((v + tau * libm::sin(tau * t)).abs() < 1e-10, "{v} at {t} s");
        }
        // The flow does not make this jump, so that the ends stay, and the cubic joins them.
        let put = TruthSample { q: 3.0, ..samples[1] };
        let points = TruthCurve::finer(truth, Quantity::Position, &[samples[0], put], 0.01);
        assert_eq!((points[0][1], points[points.len() - 1][1]), (1.0, 3.0));
        let [q, v] = cubic(&samples[0], &samples[1], 0.5);
        assert!((q - libm::cos(tau * 0.05)).abs() < 1e-3, "{q}");
        assert!((v + tau * libm::sin(tau * 0.05)).abs() < 1e-2, "{v}");
    }

    #[test]
    fn the_reach_covers_all_samples_after_any_rewind() {
        let mut race = Race::of_scene(&Scene::built_in("damped").unwrap());
        let mut curve = TruthCurve::new(&race.truth().bodies()[0], 0, 5.0);
        let check = |curve: &TruthCurve, t: f64| {
            for since_s in [f64::NEG_INFINITY, t - 3.3, t - 0.05] {
                let centre_m = DVec2::new(0.25, -1.0);
                let places = curve.since(since_s).map(|s| (s.at - centre_m).abs());
                let reach_m = places.fold(DVec2::ZERO, DVec2::max);
                assert_eq!(curve.reach_m(centre_m, since_s), reach_m, "since {since_s} at {t}");
            }
        };
        let mut marks = Vec::new();
        for _ in 0..800 {
            race.step(&mut ());
            curve.extend(&race.truth().bodies()[0], race.last_tick());
            check(&curve, race.t());
            marks.push((curve.mark(), race.t()));
        }
        for place in [790, 700, 650, 799, 100] {
            let (mark, t) = marks[place];
            curve.rewind(mark);
            check(&curve, t);
        }
    }

    #[test]
    fn a_tick_of_many_masses_has_fewer_points() {
        let points = |masses: u32| {
            let text = format!(
                "title = 't'\ntick_hz = 60\nseconds = 1\n[[chain]]\nmasses = {masses}\nmass_kg = 1\n\
                 stiffness_n_per_m = 800\n"
            );
            let mut race = Race::of_scene(&Scene::parse("t", &text).unwrap());
            let mut curve = TruthCurve::new(&race.truth().bodies()[0], 0, 0.01);
            race.step(&mut ());
            let tick = LastTick { from_s: 0.0, to_s: 1.0 / 60.0 };
            curve.extend(&race.truth().bodies()[0], tick);
            curve.samples().count()
        };
        assert!((4000..=4097).contains(&points(8)), "{}", points(8));
        assert!((28..=32).contains(&points(256)), "{}", points(256));
    }
}
