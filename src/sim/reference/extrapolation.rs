//! One step of Bulirsch and Stoer's extrapolation: the midpoint rule with 2, 4, 6 … substeps, extrapolated
//! to none. Bulirsch & Stoer, *Numerical treatment of ordinary differential equations by extrapolation
//! methods* (1966); Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.9.

use crate::sim::bodies::Body;
use crate::sim::system::{State, System, Vector};

/// The most columns of the extrapolation; the last has order 16. More gain nothing in f64.
const COLUMNS: usize = 8;

/// From this column on, the states on the way tell whether the step leaves its piece of the force law.
const TELLING: usize = 2;

/// A body's force law, one of its smooth pieces continued to everywhere.
struct Smooth<'a, B> {
    body: &'a B,
    piece: usize,
}

impl<B: Body> System for Smooth<'_, B> {
    type Vector = B::Vector;

    #[inline]
    fn acceleration(&self, t: f64, q: &B::Vector, v: &B::Vector, a: &mut B::Vector) {
        self.body.acceleration_on(self.piece, t, q, v, a);
    }
}

/// What a step is made in.
#[derive(Clone, Debug)]
pub(super) struct Extrapolation<V> {
    /// What the step adds to the state, by the finest column so far and by the coarser ones.
    table: Vec<State<V>>,
    /// The derivative at the step's beginning.
    pub(super) begin: State<V>,
    /// The derivative on the way.
    d: State<V>,
    /// What was added to the state one substep ago, and by now.
    before: State<V>,
    now: State<V>,
    stage: State<V>,
    /// The least room on the way, as [`Body::room`] has it.
    pub(super) least_room: [f64; 2],
    /// Evaluations so far.
    pub(super) evaluations: u64,
}

impl<V: Vector> Extrapolation<V> {
    pub(super) fn new(like: &State<V>) -> Self {
        let state = || like.clone();
        Self {
            table: vec![state(); COLUMNS],
            begin: state(),
            d: state(),
            before: state(),
            now: state(),
            stage: state(),
            least_room: [f64::INFINITY; 2],
            evaluations: 0,
        }
    }

    /// The memory that it takes beyond its own size and that of its coordinate vectors, in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        let column = size_of::<State<V>>() + 2 * self.begin.q.heap_bytes();
        self.table.len() * column
    }

    /// What the last attempt adds to the state.
    pub(super) fn added(&self) -> &State<V> {
        &self.table[0]
    }

    /// The state to which the last attempt leads from `y`.
    pub(super) fn end(&mut self, y: &State<V>) -> &State<V> {
        self.stage.assign_sum(y, 1.0, &self.table[0]);
        &self.stage
    }

    /// Takes the derivative at `y`, where steps are to begin.
    pub(super) fn begin<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        piece: usize,
        t: f64,
        y: &State<V>,
    ) {
        self.evaluations += 1;
        Smooth { body, piece }.derivative(t, y, &mut self.begin);
    }

    /// Attempts a step of `h` from `y` by the given piece of the force law, and returns how many columns it
    /// took; `None` where all of them are not enough for an error of `tolerance`, relative to the largest
    /// value of the same unit. What is estimated is the error of the column before the one that is kept, so
    /// that what is made is far smaller.
    pub(super) fn attempt<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        piece: usize,
        t: f64,
        h: f64,
        y: &State<V>,
        tolerance: f64,
    ) -> Option<usize> {
        self.least_room = [f64::INFINITY; 2];
        for column in 0..COLUMNS {
            self.midpoint(body, piece, t, h, 2 * (column + 1), y);
            // Aitken and Neville: in the end `table[0]` has the highest order, `table[1]` the next.
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

    /// What `n` substeps of the midpoint rule add to `y`, into the next place of the table. Kept apart
    /// from `y`, so that round-off is relative to the little that is added.
    fn midpoint<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        piece: usize,
        t: f64,
        h: f64,
        n: usize,
        y: &State<V>,
    ) {
        let system = Smooth { body, piece };
        let is_telling = n > 2 * TELLING;
        let Self { table, begin, d, before, now, stage, least_room, evaluations } = self;
        let part = h / n as f64;
        fill(before, 0.0);
        fill(now, 0.0);
        now.add_scaled(part, begin);
        for i in 1..=n {
            stage.assign_sum(y, 1.0, now);
            system.derivative(t + part * i as f64, stage, d);
            if is_telling {
                let room = body.room(piece, stage);
                *least_room = [least_room[0].min(room[0]), least_room[1].min(room[1])];
            }
            if i < n {
                before.add_scaled(2.0 * part, d);
                std::mem::swap(before, now);
            }
        }
        *evaluations += n as u64;
        // Gragg's smoothing: half of the last two places and of where the last slope leads.
        let sum = &mut table[n / 2 - 1];
        fill(sum, 0.0);
        sum.add_scaled(0.5, before);
        sum.add_scaled(0.5, now);
        sum.add_scaled(0.5 * part, d);
    }

    /// Whether the last two orders agree, relative to what the state and its change amount to: angles
    /// among themselves, and lengths.
    fn passes<B: Body<Vector = V>>(&self, body: &B, h: f64, y: &State<V>, tolerance: f64) -> bool {
        let part = |y: &V, slope: &V, last: &V, before: &V, angles: bool| {
            let of = |x: &V| largest(x, |i| body.is_angle(i) == angles);
            let scale = of(y) + h.abs() * of(slope);
            let mut pairs = last.components().iter().zip(before.components()).enumerate();
            // Written so that a NaN does not pass.
            pairs
                .all(|(i, (a, b))| body.is_angle(i) != angles || (a - b).abs() <= tolerance * scale)
        };
        let Self { table, begin, .. } = self;
        [true, false].into_iter().all(|angles| {
            part(&y.q, &begin.q, &table[0].q, &table[1].q, angles)
                && part(&y.v, &begin.v, &table[0].v, &table[1].v, angles)
        })
    }
}

fn fill<V: Vector>(state: &mut State<V>, value: f64) {
    state.q.components_mut().fill(value);
    state.v.components_mut().fill(value);
}

/// `coarse` becomes `fine + (fine - coarse) weight`.
fn extrapolate<V: Vector>(coarse: &mut State<V>, fine: &State<V>, weight: f64) {
    let each = |coarse: &mut V, fine: &V| {
        for (coarse, fine) in coarse.components_mut().iter_mut().zip(fine.components()) {
            *coarse = fine + (fine - *coarse) * weight;
        }
    };
    each(&mut coarse.q, &fine.q);
    each(&mut coarse.v, &fine.v);
}

/// The largest magnitude of the components chosen.
fn largest<V: Vector>(vector: &V, is_chosen: impl Fn(usize) -> bool) -> f64 {
    let components = vector.components().iter().enumerate();
    components.filter(|&(i, _)| is_chosen(i)).fold(0.0, |most, (_, x)| x.abs().max(most))
}
