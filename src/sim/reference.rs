//! The reference solution, which is the truth of a body without a closed form. It is made by Bulirsch and Stoer's
//! extrapolation to round-off. A second solution has other steps, and the difference of the two estimates the error.
//!
//! The reference solution is not a method of the table, because it chooses its own substeps and its evaluations do not
//! count.

use std::cell::RefCell;

use super::body::Body;
use super::exact_since_start::ExactSinceStart;
use super::integrators::{StepFailure, Stepped};
use super::propagator::Propagator;
use super::state::{State, Vector, largest, nan_is_infinite};
use super::system::{Counted, StateOf};

use extrapolation::Extrapolation;
use flights::Flights;
use trajectory::{StepControl, Trajectory, TrajectoryEnd};

mod extrapolation;
mod flights;
mod trajectory;
mod walls;

/// The accuracy at which a reference solution aims. It is the error of the solution over the duration of a built-in
/// scene, relative to the largest coordinate and to the largest velocity. `tests/library/bodies/reference.rs` compares
/// reference solutions with a closed form and with Runge-Kutta at a fine step, to a tighter bound. `truth_error` of a
/// [`Stepper`](super::Stepper) estimates the error of each run. A motion that amplifies its initial deviations, such as
/// a pendulum started upright, amplifies this error too.
pub const REFERENCE_ACCURACY: f64 = 1e-10;

/// The ratio of the error estimate to the difference of the two solutions, which is only one sample of their errors.
/// `tests/library/bodies/fifty_digits.rs` measures the estimate.
const MARGIN: f64 = 8.0;

/// Number of evaluations granted per call, in addition to the saved ones. It is about the work of 30 calls in a
/// built-in scene. With fewer evaluations, a stiff body would have no truth at a coarse tick. With many more, the judge
/// would wait long for a hopeless body.
const EVALUATIONS_PER_CALL: u64 = 6_000;

/// The maximum number of evaluations that are saved for hard stretches, which is some tenths of a second of work. All
/// of them are available at the start.
const MAX_SAVED_EVALUATIONS: u64 = 4_000_000;

/// The maximum [work](Body::reference_work) of a body with a reference solution, per simulated second. This work takes
/// about a second in an unoptimised build, and about a tenth of a second in an optimised one.
pub const MAX_REFERENCE_WORK: f64 = 1e6;

/// The evaluation budget of a reference solution.
#[derive(Clone, Copy, Debug)]
struct Allowance {
    /// Number of evaluations left to spend.
    saved: u64,
    /// Number of evaluations granted per call.
    per_call: u64,
    /// Maximum number of saved evaluations; all of them are available at the start.
    most: u64,
}

impl Allowance {
    fn new(per_call: u64, most: u64) -> Self {
        Self { saved: most, per_call, most }
    }
}

/// A reference solution, or the exact motion while the body knows it.
#[derive(Clone, Debug)]
pub(super) struct Reference<V> {
    /// The exact motion; `None` if the body does not know its motion from the start, or did not begin there.
    exact: Option<Box<ExactSinceStart<V>>>,
    /// The numerical solutions; `None` if they would take too much work.
    solutions: Option<Box<Solutions<V>>>,
    /// Whether both solutions have started from the state of the body.
    has_begun: bool,
    allowance: Allowance,
    failed: Option<StepFailure>,
    /// Simulated seconds since the body was placed.
    elapsed: f64,
    /// The largest difference of the two solutions since the body was placed, in coordinates and in velocities.
    largest_difference: [f64; 2],
    /// The largest velocity and the largest acceleration since the body was placed.
    fastest: [f64; 2],
    /// A body with walls has its flights.
    flights: Option<Box<RefCell<Flights<V>>>>,
}

/// The two solutions, which hold some forty vectors of the body's coordinates.
#[derive(Clone, Debug)]
struct Solutions<V> {
    solution: Trajectory<V>,
    /// The second solution, with other steps.
    check: Trajectory<V>,
    work: Extrapolation<V>,
    difference: State<V>,
}

impl<V: Vector> Solutions<V> {
    fn new(like: &State<V>) -> Box<Self> {
        Box::new(Self {
            solution: Trajectory::new(like, StepControl::Long),
            check: Trajectory::new(like, StepControl::Uneven),
            work: Extrapolation::new(like),
            difference: like.clone(),
        })
    }
}

/// Whether a reference solution of the body would take too much work.
pub(super) fn is_beyond_reference<B: Body>(body: &B) -> bool {
    body.reference_work() > MAX_REFERENCE_WORK
}

impl<V: Vector> Reference<V> {
    /// Returns the truth of `body` from `state` at time `t` (s).
    pub(super) fn new<B: Body<Vector = V>>(body: &B, state: &State<V>, t: f64) -> Self {
        // The solutions are allocated here, so that no tick allocates.
        let solutions = (!is_beyond_reference(body)).then(|| Solutions::new(state));
        let allowance = Allowance::new(EVALUATIONS_PER_CALL, MAX_SAVED_EVALUATIONS);
        let exact = ExactSinceStart::new(body, t, state);
        let flights = body.wall(0, t).map(|_| Box::new(RefCell::new(Flights::new(t, state))));
        Self { exact, flights, ..Self::with_allowance(solutions, allowance) }
    }

    fn with_allowance(solutions: Option<Box<Solutions<V>>>, allowance: Allowance) -> Self {
        Self {
            exact: None,
            solutions,
            has_begun: false,
            allowance,
            failed: None,
            elapsed: 0.0,
            largest_difference: [0.0; 2],
            fastest: [0.0; 2],
            flights: None,
        }
    }

    /// Advances `y` from `t` to exactly `t + h` (s).
    ///
    /// After a failure every call fails at once, until the body is placed or pushed.
    pub(super) fn solve<B: Body<Vector = V>>(
        &mut self,
        body: &B,
        t: f64,
        h: f64,
        y: &mut State<V>,
    ) -> Stepped {
        if let Some(failure) = &self.failed {
            return Err(failure.clone());
        }
        if is_beyond_reference(body) {
            let (work_per_s, most) = (body.reference_work(), MAX_REFERENCE_WORK);
            let failure = StepFailure::ReferenceTooExpensive { work_per_s, most };
            self.failed = Some(failure.clone());
            return Err(failure);
        }
        let Self { solutions, allowance, .. } = self;
        let solutions = solutions.get_or_insert_with(|| Solutions::new(y));
        let Solutions { solution, check, work, difference } = &mut **solutions;
        if !self.has_begun {
            solution.begin(body, t, y);
            check.begin(body, t, y);
            self.has_begun = true;
        }
        allowance.saved = (allowance.saved + allowance.per_call).min(allowance.most);
        work.evaluations = 0;
        let solved = solution.advance(body, t, h, work, allowance.saved);
        self.fastest = [self.fastest[0].max(size(&y.v)), self.fastest[1].max(size(&work.begin.v))];
        let solved = solved.and_then(|()| check.advance(body, t, h, work, allowance.saved));
        allowance.saved = allowance.saved.saturating_sub(work.evaluations);
        if let Err(ended) = solved {
            let failure = match ended {
                TrajectoryEnd::Budget => {
                    allowance.saved = 0;
                    StepFailure::ReferenceFailed { evaluations: work.evaluations }
                }
                TrajectoryEnd::Sticks => StepFailure::Sticks,
            };
            self.failed = Some(failure.clone());
            return Err(failure);
        }
        solution.write(y);
        self.elapsed += h.abs();
        solution.subtract(check, difference);
        self.largest_difference = [
            self.largest_difference[0].max(size(&difference.q)),
            self.largest_difference[1].max(size(&difference.v)),
        ];
        Ok(())
    }

    /// Estimates the error of the current state `y`, in a coordinate and in a velocity.
    fn error(&self, y: &State<V>) -> [f64; 2] {
        if self.failed.is_some() {
            return [f64::INFINITY; 2];
        }
        // Both solutions share the rounding of the result, of the time and of the force law's constants. The latter
        // two shift the motion in time.
        let late = f64::EPSILON * self.elapsed;
        let sizes = [size(&y.q), size(&y.v)];
        let fastest = [self.fastest[0].max(sizes[1]), self.fastest[1]];
        [0, 1].map(|i| {
            MARGIN * self.largest_difference[i] + late * fastest[i] + f64::EPSILON * sizes[i]
        })
    }
}

/// Functions that check the claims of laws and custom bodies within a budget of evaluations.
impl<V: Vector> Reference<V> {
    /// Returns a reference solution that fails after about this number of evaluations in all.
    pub(super) fn within(like: &State<V>, evaluations: u64) -> Self {
        Self::with_allowance(Some(Solutions::new(like)), Allowance::new(0, evaluations))
    }

    /// Returns the number of evaluations that the reference solution may still use.
    pub(super) fn saved_evaluations(&self) -> u64 {
        self.allowance.saved
    }
}

impl<B: Body> Propagator<B> for Reference<B::Vector> {
    fn step(&mut self, body: &Counted<B>, t: f64, h: f64, _n: u32, y: &mut StateOf<B>) -> Stepped {
        // Bypasses the counters of `body`, because the truth does not compete.
        let body = &body.system;
        if self.exact.as_mut().is_some_and(|exact| exact.step(body, t + h, y)) {
            return Ok(());
        }
        self.solve(body, t, h, y)
    }

    fn restart(&mut self, t: f64, is_placing: bool, body: &B, state: &StateOf<B>) {
        if is_placing {
            let Self {
                exact, solutions, allowance: Allowance { per_call, most, .. }, flights, ..
            } = self;
            let (exact, solutions, flights) = (exact.take(), solutions.take(), flights.take());
            let allowance = Allowance::new(*per_call, *most);
            *self = Self { exact, flights, ..Self::with_allowance(solutions, allowance) };
        } else if let Some(solutions) = self.solutions.as_mut().filter(|_| self.has_begun) {
            // Keeps the difference of the two solutions.
            let Solutions { solution, check, difference, .. } = &mut **solutions;
            check.subtract(solution, difference);
            solution.begin(body, t, state);
            check.begin_beside(body, t, solution, difference);
        }
        self.failed = None;
        if let Some(flights) = &mut self.flights {
            flights.get_mut().begin(t, state);
        }
        if let Some(exact) = &mut self.exact {
            exact.jump(t, is_placing, state);
        }
    }

    fn true_bounce(&self, body: &B, impact: u64) -> Option<[f64; 2]> {
        self.flights.as_ref()?.borrow_mut().bounce(body, impact)
    }

    fn is_closed_form(&self) -> bool {
        self.exact.as_ref().is_some_and(|exact| exact.is_untouched)
    }

    fn truth_error(&self, body: &Counted<B>, state: &StateOf<B>) -> Option<[f64; 2]> {
        let exact = self.exact.as_ref().filter(|exact| exact.is_untouched);
        Some(exact.map_or_else(|| self.error(state), |exact| exact.error(&body.system, state)))
    }

    fn heap_bytes(&self) -> usize {
        let solutions = self.solutions.as_deref().map_or(0, size_of_val);
        let flights = self.flights.as_deref();
        let flights = flights.map_or(0, |it| size_of_val(it) + it.borrow().heap_bytes());
        solutions + flights + self.exact.as_deref().map_or(0, size_of_val)
    }
}

/// Returns the largest magnitude of a component; infinite if a component is NaN.
fn size<V: Vector>(vector: &V) -> f64 {
    nan_is_infinite(largest(vector.components()))
}
