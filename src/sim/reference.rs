//! The truth where there is no closed form: Bulirsch and Stoer's extrapolation, run to round-off.
//!
//! It is no method of the table: it takes what substeps it wants, and its evaluations are not counted.

use super::integrators::StepFailure;
use super::system::{State, System, Vector};

/// The stated error of a reference solution over a built-in scene's duration, relative to the largest
/// coordinate and to the largest velocity. `tests/bodies/reference.rs` holds it against a closed form and
/// against Runge-Kutta at a fine step, and finds it twenty times better than that. A motion that
/// magnifies what it starts with, such as a pendulum on its head, magnifies this error too.
pub const REFERENCE_ACCURACY: f64 = 1e-10;

/// The most columns of the extrapolation; the last has order 16. More gain nothing in f64.
const COLUMNS: usize = 8;

/// The error allowed in a step, relative as above. What is estimated is the error of the column before
/// the one that is kept, so that what is made is far smaller.
const TOLERANCE: f64 = 1e-14;

/// A step that passes with this many columns was too short: the next is twice as long.
const EASY: usize = 6;

/// What a step that does not pass is cut to.
const CUT: f64 = 0.25;

/// The most steps in one call, a thousand times what any built-in scene takes: a force that jumps, or a
/// body far too stiff for its tick.
const MOST_STEPS: u32 = 10_000;

/// The midpoint rule with 2, 4, 6 … substeps, extrapolated to none. Bulirsch & Stoer, *Numerical
/// treatment of ordinary differential equations by extrapolation methods* (1966); Hairer, Nørsett &
/// Wanner, *Solving Ordinary Differential Equations I*, II.9.
#[derive(Debug)]
pub(super) struct Reference<V> {
    /// The step to try next; `None` tries all that is left.
    next: Option<f64>,
    /// What the step adds to the state, by the finest column so far and by the coarser ones.
    table: Vec<State<V>>,
    /// The derivative at the step's beginning.
    begin: State<V>,
    /// The derivative on the way.
    d: State<V>,
    /// What was added to the state one substep ago, and by now.
    before: State<V>,
    now: State<V>,
    stage: State<V>,
}

impl<V: Vector> Reference<V> {
    pub(super) fn new(like: &State<V>) -> Self {
        let state = || like.clone();
        Self {
            next: None,
            table: vec![state(); COLUMNS],
            begin: state(),
            d: state(),
            before: state(),
            now: state(),
            stage: state(),
        }
    }

    /// Forgets the step's length.
    pub(super) fn reset(&mut self) {
        self.next = None;
    }

    /// Advances `y` from `t` to exactly `t + h` (s).
    pub(super) fn solve<S: System<Vector = V>>(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        y: &mut State<V>,
    ) -> Result<(), StepFailure> {
        let mut carried = self.next.map_or(h, |next| next.copysign(h));
        let mut left = h;
        system.derivative(t, y, &mut self.begin);
        for _ in 0..MOST_STEPS {
            let trial = if carried.abs() < left.abs() { carried } else { left };
            let Some(columns) = self.attempt(system, t + (h - left), trial, y) else {
                carried = CUT * trial;
                continue;
            };
            y.add_scaled(1.0, &self.table[0]);
            // A step cut short by the end of the call says nothing about the next one.
            if trial == carried && columns <= EASY {
                carried *= 2.0;
            }
            if trial == left {
                self.next = Some(carried);
                return Ok(());
            }
            left -= trial;
            system.derivative(t + (h - left), y, &mut self.begin);
        }
        Err(StepFailure::TooManySubsteps { limit: MOST_STEPS })
    }

    /// Puts what a step of `h` adds to `y` into `table[0]`, and returns how many columns it took; `None`
    /// where all of them are not enough.
    fn attempt<S: System<Vector = V>>(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        y: &State<V>,
    ) -> Option<usize> {
        for column in 0..COLUMNS {
            self.midpoint(system, t, h, 2 * (column + 1), y);
            // Aitken and Neville: in the end `table[0]` has the highest order, `table[1]` the next.
            for i in (0..column).rev() {
                let ratio = (column + 1) as f64 / (i + 1) as f64;
                let (coarse, fine) = self.table.split_at_mut(i + 1);
                extrapolate(&mut coarse[i], &fine[0], 1.0 / (ratio * ratio - 1.0));
            }
            if column >= 2 && self.passes(h, y) {
                return Some(column + 1);
            }
        }
        None
    }

    /// What `n` substeps of the midpoint rule add to `y`, into the next place of the table. Kept apart
    /// from `y`, so that round-off is relative to the little that is added.
    fn midpoint<S: System<Vector = V>>(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        n: usize,
        y: &State<V>,
    ) {
        let Self { table, begin, d, before, now, stage, .. } = self;
        let part = h / n as f64;
        fill(before, 0.0);
        fill(now, 0.0);
        now.add_scaled(part, begin);
        for i in 1..=n {
            stage.assign_sum(y, 1.0, now);
            system.derivative(t + part * i as f64, stage, d);
            if i < n {
                before.add_scaled(2.0 * part, d);
                std::mem::swap(before, now);
            }
        }
        // Gragg's smoothing: half of the last two places and of where the last slope leads.
        let sum = &mut table[n / 2 - 1];
        fill(sum, 0.0);
        sum.add_scaled(0.5, before);
        sum.add_scaled(0.5, now);
        sum.add_scaled(0.5 * part, d);
    }

    /// Whether the last two orders agree, relative to what the state and its change amount to.
    fn passes(&self, h: f64, y: &State<V>) -> bool {
        let part = |y: &V, slope: &V, last: &V, before: &V| {
            let scale = largest(y) + h.abs() * largest(slope);
            let mut pairs = last.components().iter().zip(before.components());
            // Written so that a NaN does not pass.
            pairs.all(|(a, b)| (a - b).abs() <= TOLERANCE * scale)
        };
        let Self { table, begin, .. } = self;
        part(&y.q, &begin.q, &table[0].q, &table[1].q)
            && part(&y.v, &begin.v, &table[0].v, &table[1].v)
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

fn largest<V: Vector>(vector: &V) -> f64 {
    vector.components().iter().fold(0.0, |most, x| x.abs().max(most))
}
