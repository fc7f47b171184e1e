//! The truth where there is no closed form: Bulirsch and Stoer's extrapolation, run to round-off, and beside
//! it a second solution by other steps, whose distance says how good the first one is.
//!
//! It is no method of the table: it takes what substeps it wants, and its evaluations are not counted.

use super::bodies::Body;
use super::drive::{Drive, Jump};
use super::integrators::StepFailure;
use super::system::{Counted, State, Vector};

use extrapolation::Extrapolation;
use track::{Pace, Track};

mod extrapolation;
mod track;

/// What a reference solution aims at: its error over a built-in scene's duration, relative to the largest
/// coordinate and to the largest velocity. `tests/bodies/reference.rs` holds it against a closed form and
/// against Runge-Kutta at a fine step, and finds it twenty times better than that. What it reaches on a
/// run is estimated there: [`Stepper::truth_error`](super::Stepper::truth_error). A motion that
/// magnifies what it starts with, such as a pendulum on its head, magnifies this error too.
pub const REFERENCE_ACCURACY: f64 = 1e-10;

/// The distance of the two solutions is one sample of their errors: how much larger these may be.
/// `tests/bodies/fifty_digits.rs` measures what this is worth.
const MARGIN: f64 = 8.0;

/// The evaluations that a solution may take for each call, about the work of 30 calls of a built-in
/// scene, beside what it has saved. With fewer, a stiff body would have no truth at a coarse tick; with
/// many more, one without hope would keep its judge waiting.
const GRANTED: u64 = 6_000;

/// The most evaluations that are saved for hard stretches; there are as many at the start. Some tenths of a
/// second's work.
const SAVED: u64 = 4_000_000;

/// A reference solution.
#[derive(Clone, Debug)]
pub(super) struct Reference<V> {
    solution: Track<V>,
    /// The same by other steps.
    check: Track<V>,
    work: Extrapolation<V>,
    apart: State<V>,
    /// Whether both are where the body is.
    is_placed: bool,
    /// Evaluations that may be spent from now on.
    saved: u64,
    failed: Option<StepFailure>,
    /// The simulated seconds since the state was given.
    elapsed: f64,
    /// Since then, the farthest that the two were apart, in coordinates and in velocities.
    farthest: [f64; 2],
    /// The largest velocity and the largest acceleration since then.
    fastest: [f64; 2],
}

impl<V: Vector> Reference<V> {
    pub(super) fn new(like: &State<V>) -> Self {
        Self {
            solution: Track::new(like, Pace::Long),
            check: Track::new(like, Pace::Uneven),
            work: Extrapolation::new(like),
            apart: like.clone(),
            is_placed: false,
            saved: SAVED,
            failed: None,
            elapsed: 0.0,
            farthest: [0.0; 2],
            fastest: [0.0; 2],
        }
    }

    /// Begins anew: the body was given its state.
    fn place(&mut self) {
        self.is_placed = false;
        self.saved = SAVED;
        self.failed = None;
        self.elapsed = 0.0;
        (self.farthest, self.fastest) = ([0.0; 2], [0.0; 2]);
    }

    /// Takes notice that a force changed or an impulse was given, and that `state` is now that of the
    /// body: what the solution may be off stays.
    fn push<B: Body<Vector = V>>(&mut self, body: &B, state: &State<V>) {
        self.failed = None;
        if self.is_placed {
            self.check.apart(&self.solution, &mut self.apart);
            self.solution.begin(body, state);
            self.check.begin_beside(body, &self.solution, &self.apart);
        }
    }

    /// Advances `y` from `t` to exactly `t + h` (s).
    ///
    /// After a failure it fails at once, until it is placed or pushed.
    fn solve<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        t: f64,
        h: f64,
        y: &mut State<V>,
    ) -> Result<(), StepFailure> {
        if let Some(failure) = &self.failed {
            return Err(failure.clone());
        }
        let Self { solution, check, work, .. } = self;
        if !self.is_placed {
            solution.begin(body, y);
            check.begin(body, y);
            self.is_placed = true;
        }
        self.saved = (self.saved + GRANTED).min(SAVED);
        work.evaluations = 0;
        let solved = solution.advance(body, t, h, work, self.saved);
        self.fastest =
            [self.fastest[0].max(largest(&y.v)), self.fastest[1].max(largest(&work.begin.v))];
        let solved = solved.and_then(|()| check.advance(body, t, h, work, self.saved));
        self.saved = self.saved.saturating_sub(work.evaluations);
        if solved.is_err() {
            let failure = StepFailure::ReferenceFailed { evaluations: work.evaluations };
            self.failed = Some(failure.clone());
            return Err(failure);
        }
        solution.write(y);
        self.elapsed += h.abs();
        solution.apart(check, &mut self.apart);
        self.farthest = [
            self.farthest[0].max(largest(&self.apart.q)),
            self.farthest[1].max(largest(&self.apart.v)),
        ];
        Ok(())
    }

    /// How far `y`, where it has come to, may be off: in a coordinate and in a velocity. An estimate.
    fn error(&self, y: &State<V>) -> [f64; 2] {
        if self.failed.is_some() {
            return [f64::INFINITY; 2];
        }
        // Both solutions share the rounding of time and of the force law's constants, which make the
        // motion early or late, and that of what is returned.
        let late = f64::EPSILON * self.elapsed;
        let size = [largest(&y.q), largest(&y.v)];
        let fastest = [self.fastest[0].max(size[1]), self.fastest[1]];
        [0, 1].map(|i| MARGIN * self.farthest[i] + late * fastest[i] + f64::EPSILON * size[i])
    }
}

impl<B: Body> Drive<B> for Reference<B::Vector> {
    fn advance(
        &mut self,
        body: &Counted<B>,
        t: f64,
        h: f64,
        _substeps: u32,
        state: &mut State<B::Vector>,
    ) -> Result<(), StepFailure> {
        // Not through `body`, which counts: the truth is no contender.
        self.solve(&body.system, t, h, state)
    }

    fn jump(
        &mut self,
        jump: Jump,
        _t: f64,
        body: &mut B,
        state: &mut State<B::Vector>,
        change: impl FnOnce(&mut B, &mut State<B::Vector>) -> bool,
    ) -> bool {
        let is_changed = change(body, state);
        match jump {
            _ if !is_changed => {}
            Jump::Placed => self.place(),
            Jump::Pushed => self.push(body, state),
        }
        is_changed
    }

    fn truth_error(&self, _body: &Counted<B>, state: &State<B::Vector>) -> Option<[f64; 2]> {
        Some(self.error(state))
    }

    fn heap_bytes(&self) -> usize {
        self.work.heap_bytes()
    }
}

/// The largest magnitude; infinite where one is not a number.
fn largest<V: Vector>(vector: &V) -> f64 {
    let size = |x: &f64| if x.is_nan() { f64::INFINITY } else { x.abs() };
    vector.components().iter().map(size).fold(0.0, f64::max)
}
