//! A fan of futures, which shows the next second of a body under each method of the scene, and in truth, from the
//! body's current state. It is computed on copies and leaves the run undisturbed.

use glam::DVec2;

use crate::run::race::LaneBody;
use crate::scene::LaneSpec;
use crate::sim::{Solver, Stepper, TickRate};

/// Length of a future in seconds, and its maximum number of ticks.
const LENGTH_S: f64 = 1.0;
const MAX_TICKS: u32 = 1000;
/// Number of steps of the truth per second, rounded up to whole steps per tick. They are enough for a smooth curve.
const EXACT_STEPS: u32 = 120;
/// Maximum number of methods, and of coordinates of a body, because each frame steps all of them.
const MAX_METHODS: usize = 9;
const MAX_COORDINATES: usize = 8;

/// A moment of a future.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FutureMoment {
    /// Time in seconds of the run.
    pub t: f64,
    /// Position of the body in metres.
    pub at: DVec2,
    /// The plotted coordinate and its velocity.
    pub state: [f64; 2],
}

/// The future of a body under one method, or in truth.
#[derive(Clone, Debug, PartialEq)]
pub struct FutureCurve {
    /// Index of the method on the menu; `None` for the truth.
    pub entry: Option<usize>,
    /// A moment for each tick, and more for the truth, until the method fails.
    pub moments: Vec<FutureMoment>,
}

/// Whether a body has too many coordinates for futures.
pub fn has_no_futures(of: &LaneBody) -> bool {
    of.coordinates().len() > MAX_COORDINATES || of.stepper.is_beyond_reference()
}

/// Computes the second after time `t` (s) of a body at a tick rate, under each of `methods` and last in truth. `held`
/// is the state in which a person holds the body, and `plotted` the index of the coordinate in the moments' states. The
/// result is empty if the body has halted or has too many coordinates.
pub fn futures(
    of: &LaneBody,
    t: f64,
    tick_hz: TickRate,
    held: Option<(&[f64], &[f64])>,
    plotted: usize,
    methods: &[LaneSpec],
) -> Vec<FutureCurve> {
    if of.halted().is_some() || has_no_futures(of) {
        return Vec::new();
    }
    let mut from = of.stepper.clone();
    if let Some((q, v)) = held {
        from.set(t, q, v);
    }
    let follow = |solver: Solver, h: f64, substeps: u32| {
        let mut stepper = from.with_solver(solver, t);
        let moment = |t: f64, stepper: &dyn Stepper| FutureMoment {
            t,
            at: stepper.place(),
            state: [stepper.q()[plotted], stepper.v()[plotted]],
        };
        let mut moments = vec![moment(t, &*stepper)];
        let steps = libm::round(LENGTH_S / h) as u32;
        for step in 0..steps.min(MAX_TICKS) {
            let before = t + f64::from(step) * h;
            if stepper.advance(before, h, substeps).is_err() {
                break;
            }
            let now = moment(before + h, &*stepper);
            if !now.state.iter().all(|value| value.is_finite()) {
                break;
            }
            moments.push(now);
        }
        moments
    };
    let h = tick_hz.step_s();
    let of_methods = methods.iter().take(MAX_METHODS).enumerate().map(|(entry, spec)| {
        FutureCurve { entry: Some(entry), moments: follow(spec.solver(), h, spec.substeps) }
    });
    let finer = h / (f64::from(EXACT_STEPS) / tick_hz.hz()).ceil();
    let exact = FutureCurve { entry: None, moments: follow(Solver::Truth, finer, 1) };
    of_methods.chain([exact]).collect()
}
