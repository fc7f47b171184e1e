//! One step of Bulirsch and Stoer's extrapolation. It makes the step by the midpoint rule with 2, 4, 6 … substeps, and
//! extrapolates the results to a step size of zero. Bulirsch & Stoer, *Numerical treatment of ordinary differential
//! equations by extrapolation methods* (1966); Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*,
//! II.9.

use super::walls::{SmoothPiece, distances_to_ends};
use crate::body::{Body, Distances, NO_BOUNDARIES, Piece};
use crate::state::{State, Vector, largest};
use crate::system::System;

/// The number of columns of the extrapolation table; the last column has order 16. More columns gain nothing in `f64`.
const COLUMNS: usize = 8;

/// The first column whose intermediate states are checked against the boundaries of the force law's piece.
const FIRST_SAMPLED: usize = 2;

/// The extrapolation table and the scratch of a step.
#[derive(Clone, Debug)]
pub(super) struct Extrapolation<V> {
    /// The increment of the state by each column, with the finest column first.
    table: [State<V>; COLUMNS],
    /// The derivative at the start of the step.
    pub(super) begin: State<V>,
    /// The derivative at an intermediate state.
    d: State<V>,
    /// The increment one substep ago, and the current increment.
    before: State<V>,
    now: State<V>,
    stage: State<V>,
    /// The smallest distances of [`Body::distances_to_ends`] at the intermediate states.
    pub(super) min_distances: Distances,
    /// Number of evaluations so far.
    pub(super) evaluations: u64,
    /// The largest coordinate and velocity at the starts of steps so far, first of lengths, then of angles. They are
    /// kept for a body with [`Body::has_jumps`], whose force may be the difference of large terms. The rounding of such
    /// terms does not shrink as the motion settles. A placement keeps these values, because the curve between ticks
    /// places the body at every tick.
    pub(super) largest: [[f64; 2]; 2],
}

impl<V: Vector> Extrapolation<V> {
    pub(super) fn new(like: &State<V>) -> Self {
        let state = || like.clone();
        Self {
            table: std::array::from_fn(|_| state()),
            begin: state(),
            d: state(),
            before: state(),
            now: state(),
            stage: state(),
            min_distances: NO_BOUNDARIES,
            evaluations: 0,
            largest: [[0.0; 2]; 2],
        }
    }

    /// Returns the increment of the state by the last attempt.
    pub(super) fn added(&self) -> &State<V> {
        &self.table[0]
    }

    /// Returns the state after the last attempt, which started from `y`.
    pub(super) fn end(&mut self, y: &State<V>) -> &State<V> {
        self.stage.assign_sum(y, 1.0, &self.table[0]);
        &self.stage
    }

    /// Evaluates the derivative at `y`, where the next attempts start.
    pub(super) fn begin<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        piece: &Piece,
        t: f64,
        y: &State<V>,
    ) {
        self.evaluations += 1;
        SmoothPiece { body, piece }.derivative(t, y, &mut self.begin);
        for angles in [false, true].into_iter().filter(|_| body.has_jumps()) {
            let of = |x: &V| largest_of(x, |i| body.is_angle(i) == angles);
            let [q, v] = &mut self.largest[usize::from(angles)];
            (*q, *v) = (q.max(of(&y.q)), v.max(of(&y.v)));
        }
    }

    /// Attempts a step of `h` from `y` by the given piece of the force law. Returns the number of columns needed;
    /// `None` if no column reaches `tolerance`, relative to the largest value of the same unit. The error is estimated
    /// for the column before the one whose result is used, so that the actual error is far smaller.
    pub(super) fn attempt<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        piece: &Piece,
        t: f64,
        h: f64,
        y: &State<V>,
        tolerance: f64,
    ) -> Option<usize> {
        self.min_distances = NO_BOUNDARIES;
        for column in 0..COLUMNS {
            self.midpoint(body, piece, t, h, 2 * (column + 1), y);
            // Extrapolates by Aitken and Neville. Afterwards `table[0]` has the highest order, and `table[1]` has the
            // next.
            for i in (0..column).rev() {
                let ratio = (column + 1) as f64 / (i + 1) as f64;
                let (coarse, fine) = self.table.split_at_mut(i + 1);
                extrapolate(&mut coarse[i], &fine[0], 1.0 / (ratio * ratio - 1.0));
            }
            if column >= 2 && self.passes(body, h, y, tolerance) {
                return Some(column + 1);
            }
        }
        None
    }

    /// Writes the increment from `y` by `n` substeps of the midpoint rule to the next entry of the table. The increment
    /// is kept separate from `y`, so that round-off is relative to the small increment.
    fn midpoint<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        piece: &Piece,
        t: f64,
        h: f64,
        n: usize,
        y: &State<V>,
    ) {
        let system = SmoothPiece { body, piece };
        let switches = body.switches();
        let samples_room = switches > 0 && n > 2 * FIRST_SAMPLED;
        let Self { table, begin, d, before, now, stage, min_distances, evaluations, .. } = self;
        let part = h / n as f64;
        fill(before, 0.0);
        fill(now, 0.0);
        now.add_scaled(part, begin);
        for i in 1..=n {
            stage.assign_sum(y, 1.0, now);
            system.derivative(t + part * i as f64, stage, d);
            if samples_room {
                let distances = distances_to_ends(body, piece, t + part * i as f64, stage);
                for (least, distance) in min_distances.iter_mut().zip(distances).take(switches) {
                    *least = [least[0].min(distance[0]), least[1].min(distance[1])];
                }
            }
            if i < n {
                before.add_scaled(2.0 * part, d);
                std::mem::swap(before, now);
            }
        }
        *evaluations += n as u64;
        // Gragg's smoothing takes the mean of the last two increments, and adds half a substep along the last slope.
        let sum = &mut table[n / 2 - 1];
        fill(sum, 0.0);
        sum.add_scaled(0.5, before);
        sum.add_scaled(0.5, now);
        sum.add_scaled(0.5 * part, d);
    }

    /// Whether the last two columns agree to `tolerance`, relative to the magnitude of the state and its change.
    /// Angles and lengths are scaled separately.
    fn passes<B: Body<Vector = V>>(&self, body: &B, h: f64, y: &State<V>, tolerance: f64) -> bool {
        let part = |y: &V, slope: &V, last: &V, before: &V, angles: bool, most: f64| {
            let of = |x: &V| largest_of(x, |i| body.is_angle(i) == angles);
            let scale = (of(y) + h.abs() * of(slope)).max(most);
            let mut pairs = last.components().iter().zip(before.components()).enumerate();
            // The comparison is written so that a NaN does not pass.
            pairs
                .all(|(i, (a, b))| body.is_angle(i) != angles || (a - b).abs() <= tolerance * scale)
        };
        let Self { table, begin, .. } = self;
        [true, false].into_iter().all(|angles| {
            let [most_q, most_v] = self.largest[usize::from(angles)];
            part(&y.q, &begin.q, &table[0].q, &table[1].q, angles, most_q)
                && part(&y.v, &begin.v, &table[0].v, &table[1].v, angles, most_v)
        })
    }
}

fn fill<V: Vector>(state: &mut State<V>, value: f64) {
    state.q.components_mut().fill(value);
    state.v.components_mut().fill(value);
}

/// Overwrites `coarse` with `fine + (fine - coarse) weight`.
fn extrapolate<V: Vector>(coarse: &mut State<V>, fine: &State<V>, weight: f64) {
    let each = |coarse: &mut V, fine: &V| {
        for (coarse, fine) in coarse.components_mut().iter_mut().zip(fine.components()) {
            *coarse = fine + (fine - *coarse) * weight;
        }
    };
    each(&mut coarse.q, &fine.q);
    each(&mut coarse.v, &fine.v);
}

/// Returns the largest magnitude of the components with these indices.
fn largest_of<V: Vector>(vector: &V, is_chosen: impl Fn(usize) -> bool) -> f64 {
    let components = vector.components().iter().enumerate();
    largest(components.filter(|&(i, _)| is_chosen(i)).map(|(_, component)| component))
}
