//! The swings of a body under a method, with the body's width in each half turn, and its passages through its centre.
//! Both are found between the method's steps.
//!
//! At a coarse tick a step seldom falls on a peak, so that by its steps alone even an exact method would seem to lose
//! amplitude. A picture with drawing between the ticks shows the peak.

use crate::run::race::hermite;
use crate::sim::Stepper;
use crate::sim::numerics::bisect;

/// Number of parts of a step at which its curve is evaluated for a peak. In a step of a third of a turn, these parts
/// miss 0.2 % of a peak.
const PARTS: u32 = 16;

/// Measures a run step by step.
///
/// The motion between two steps is the polynomial of degree five through the coordinates, velocities and
/// accelerations at both. It finds a peak to 0.2 % in steps of up to a quarter of a turn, and to 0.7 % in steps of a
/// third.
#[derive(Clone, Debug)]
pub(super) struct Swings {
    /// The coordinate whose passages through its centre divide the half turns.
    coordinate: usize,
    centres: Vec<f64>,
    amplitudes: Vec<f64>,
    /// The last three states, with the oldest first, while a step is added. At other times, the last entry is a buffer.
    nodes: [Node; 3],
    /// Whether the oldest state precedes the next one by one step, which is false at the start and after an input.
    has_before: bool,
    /// Largest distance of any coordinate from its centre in each half turn so far, in amplitudes.
    pub(super) half_turns: Vec<f64>,
    /// Times at which the coordinate crossed its centre upwards, in seconds.
    pub(super) crossings: Vec<f64>,
}

/// A state after a step.
#[derive(Clone, Debug, Default)]
struct Node {
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    /// The acceleration, once evaluated.
    a: Option<Vec<f64>>,
    /// Index of the state's half turn.
    half_turn: usize,
}

impl Node {
    fn set(&mut self, stepper: &dyn Stepper, t: f64, half_turn: usize) {
        self.q.clear();
        self.q.extend_from_slice(stepper.q());
        self.v.clear();
        self.v.extend_from_slice(stepper.v());
        (self.t, self.a, self.half_turn) = (t, None, half_turn);
    }

    fn acceleration(&mut self, stepper: &dyn Stepper, i: usize) -> f64 {
        let Self { t, q, v, a, .. } = self;
        let all = a.get_or_insert_with(|| {
            let mut a = vec![0.0; q.len()];
            stepper.acceleration(*t, q, v, &mut a);
            a
        });
        all[i]
    }
}

impl Swings {
    /// Starts with the state of `stepper`, with a centre and an amplitude for each coordinate.
    pub(super) fn new(
        coordinate: usize,
        centres: Vec<f64>,
        amplitudes: Vec<f64>,
        stepper: &dyn Stepper,
    ) -> Self {
        let mut swings = Self {
            coordinate,
            centres,
            amplitudes,
            nodes: Default::default(),
            has_before: false,
            half_turns: vec![0.0],
            crossings: Vec::new(),
        };
        swings.nodes[1].set(stepper, 0.0, 0);
        swings.cover(1);
        swings
    }

    /// Returns the distance of a coordinate from its centre in one of the states.
    fn distance(&self, node: usize, i: usize) -> f64 {
        self.nodes[node].q[i] - self.centres[i]
    }

    /// Widens a state's half turn to include the state.
    fn cover(&mut self, node: usize) {
        let part = |i: usize| self.distance(node, i).abs() / self.amplitudes[i];
        let reached = (0..self.centres.len()).map(part).fold(0.0, f64::max);
        let widest = &mut self.half_turns[self.nodes[node].half_turn];
        *widest = widest.max(reached);
    }

    /// Adds the state after another step, at time `t` (s).
    pub(super) fn add(&mut self, stepper: &dyn Stepper, t: f64) {
        self.nodes[2].set(stepper, t, self.half_turns.len() - 1);
        self.divide();
        if self.distance(1, self.coordinate) < 0.0 && self.distance(2, self.coordinate) >= 0.0 {
            self.crossings.push(self.crossing());
        }
        for i in 0..self.centres.len() {
            let goes_down = |to: usize| self.nodes[to].q[i] < self.nodes[to - 1].q[i];
            // A first step shows a peak only to a motion that begins outwards.
            let goes_out = || self.nodes[1].v[i] * self.distance(1, i) > 0.0;
            if self.has_before && goes_down(1) != goes_down(2) {
                self.find_peak(stepper, 0, i);
                self.find_peak(stepper, 1, i);
            } else if !self.has_before && goes_out() {
                self.find_peak(stepper, 1, i);
            }
        }
        self.nodes.rotate_left(1);
        self.has_before = true;
    }

    /// Starts a new half turn if the newest state has passed the centre.
    fn divide(&mut self) {
        let is_below = |node| self.distance(node, self.coordinate) < 0.0;
        if is_below(1) != is_below(2) {
            self.half_turns.push(0.0);
            self.nodes[2].half_turn += 1;
        }
        self.cover(2);
    }

    /// Ends the motion before an input.
    pub(super) fn finish_before_input(&mut self, stepper: &dyn Stepper) {
        for i in 0..self.centres.len() {
            if self.has_before {
                self.find_peak(stepper, 0, i);
            }
        }
    }

    /// Continues from the state after an input, at time `t` (s).
    pub(super) fn resume_after_input(&mut self, stepper: &dyn Stepper, t: f64) {
        self.nodes[2].set(stepper, t, self.half_turns.len() - 1);
        self.divide();
        self.nodes.rotate_left(1);
        self.has_before = false;
    }

    /// Returns the time in seconds at which the swinging coordinate crosses its centre in the newest step.
    fn crossing(&self) -> f64 {
        let ([from, to], i) = ([&self.nodes[1], &self.nodes[2]], self.coordinate);
        let h = to.t - from.t;
        let q = [self.distance(1, i), self.distance(2, i)];
        let [part, _] = bisect([0.0, 1.0], 40, |s| hermite(s, h, q, [from.v[i], to.v[i]]) < 0.0);
        from.t + part * h
    }

    /// Widens half turns to include the peak of coordinate `i` between a state and the next one.
    fn find_peak(&mut self, stepper: &dyn Stepper, from: usize, i: usize) {
        let q = [self.distance(from, i), self.distance(from + 1, i)];
        let ends = [from, from + 1].map(|node| &self.nodes[node]);
        let (h, v) = (ends[1].t - ends[0].t, ends.map(|node| node.v[i]));
        let half_turns = ends.map(|node| node.half_turn);
        let a = [from, from + 1].map(|node| self.nodes[node].acceleration(stepper, i));
        let step = Step::new(h, q, v, a);
        for part in (1..PARTS).map(|part| f64::from(part) / f64::from(PARTS)) {
            let distance = step.at(part);
            let is_first = match i == self.coordinate {
                true => (distance < 0.0) == (q[0] < 0.0),
                false => part < 0.5,
            };
            let widest = &mut self.half_turns[half_turns[usize::from(!is_first)]];
            // `max` ignores a NaN.
            *widest = widest.max(distance.abs() / self.amplitudes[i]);
        }
    }
}

/// A coordinate over a step of `h` seconds, as the polynomial of degree five through the ends of the step.
struct Step {
    h: f64,
    q: [f64; 2],
    v: [f64; 2],
    a: [f64; 2],
}

impl Step {
    /// Creates a step. Some methods have velocities at other times than coordinates; for example, those of
    /// semi-implicit Euler are half a step late. Both velocities are shifted by the same amount, so that they lead from
    /// one coordinate to the other.
    fn new(h: f64, q: [f64; 2], v: [f64; 2], a: [f64; 2]) -> Self {
        let mean = (q[1] - q[0]) / h - h * (a[0] - a[1]) / 12.0;
        let shift = mean - (v[0] + v[1]) / 2.0;
        Self { h, q, v: v.map(|v| v + shift), a }
    }

    /// Returns the coordinate at a fraction of the step.
    fn at(&self, part: f64) -> f64 {
        let Self { h, q, v, a } = *self;
        let side = |s: f64, q: f64, v: f64, a: f64| {
            let r = 1.0 - s;
            r * r
                * r
                * (q * (1.0 + 3.0 * s + 6.0 * s * s) + v * s * (1.0 + 3.0 * s) + a * s * s / 2.0)
        };
        side(part, q[0], h * v[0], h * h * a[0]) + side(1.0 - part, q[1], -h * v[1], h * h * a[1])
    }
}

#[cfg(test)]
mod tests;
