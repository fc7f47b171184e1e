//! Adaptive Euler: one whole step against two half steps gives the error, which sets the step.

use super::{Family, Integrator, Method, State, StepFailure, System, Vector};

pub(super) const CARD: Method = Method {
    id: "adaptive-euler",
    name: "Adaptive Euler",
    about: "the chapter's step doubling, corrected: covers each tick in as many substeps as its tolerance asks",
    family: Family::Adaptive,
    order: 2,
    order_with_drag: 2,
    evaluations: None,
    symplectic: false,
    reversible: false,
    stability_limit: None,
    tolerance: Some(TOLERANCE),
    restart: Some("by trying the whole tick as one step"),
    keeps_time: true,
    as_printed: false,
    source: "Bourg & Bywalec, Physics for Game Developers 2e, ch. 7, corrected; step control after Hairer, Nørsett & Wanner, Solving ODEs I, II.4",
};

/// A millimetre and a millimetre per second, or a thousandth of the value: what can be seen.
const TOLERANCE: Tolerance = Tolerance { absolute_q: 1e-3, absolute_v: 1e-3, relative: 1e-3 };

/// Aims below the tolerance, so that the next attempt is rarely rejected.
const SAFETY: f64 = 0.9;
/// The least and the most by which one attempt changes the step.
const FACTORS: (f64, f64) = (0.2, 5.0);
/// Attempts in one tick. Usual ticks take 1 to 50; without a limit a force that jumps would hang.
const MAX_ATTEMPTS: u32 = 10_000;

/// The error that a substep may make: `absolute + relative |y|` in every component.
///
/// `f64::INFINITY` in an absolute part leaves that half of the state out of the control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Absolute part for coordinates, in metres or radians.
    pub absolute_q: f64,
    /// Absolute part for velocities, per second.
    pub absolute_v: f64,
    /// Part relative to the component's magnitude.
    pub relative: f64,
}

impl Tolerance {
    /// The largest component of the error `h (k1 - k2) / 2`, in units of what is allowed.
    fn error<V: Vector>(&self, h: f64, k1: &State<V>, k2: &State<V>, y: &State<V>) -> f64 {
        let worst = |absolute: f64, k1: &V, k2: &V, y: &V| {
            let rows = k1.components().iter().zip(k2.components()).zip(y.components());
            rows.fold(0.0, |worst: f64, ((k1, k2), y)| {
                let error = (h / 2.0 * (k1 - k2)).abs() / (absolute + self.relative * y.abs());
                // `max` would drop a NaN, and with it the news that the step is worthless.
                if error <= worst { worst } else { error }
            })
        };
        let q = worst(self.absolute_q, &k1.q, &k2.q, &y.q);
        let v = worst(self.absolute_v, &k1.v, &k2.v, &y.v);
        if v <= q { q } else { v }
    }
}

/// Step doubling: `y1` by one Euler step of `h`, `y2` by two of `h/2`. Their difference is the error;
/// the extrapolated `2 y2 - y1` is kept, which is second order.
pub struct AdaptiveEuler<V> {
    tolerance: Tolerance,
    /// The step to try next, carried from tick to tick; `None` tries the whole tick.
    next: Option<f64>,
    accepted: u64,
    rejected: u64,
    k1: State<V>,
    k2: State<V>,
    half: State<V>,
}

impl<V: Vector> AdaptiveEuler<V> {
    /// The method with a tolerance other than its card's.
    pub fn with_tolerance(like: &V, tolerance: Tolerance) -> Self {
        let zero = State { q: like.clone(), v: like.clone() };
        Self {
            tolerance,
            next: None,
            accepted: 0,
            rejected: 0,
            k1: zero.clone(),
            k2: zero.clone(),
            half: zero,
        }
    }

    /// Substeps accepted since construction or reset.
    pub fn accepted(&self) -> u64 {
        self.accepted
    }

    /// Substeps rejected since construction or reset.
    pub fn rejected(&self) -> u64 {
        self.rejected
    }
}

impl<S: System> Integrator<S> for AdaptiveEuler<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self::with_tolerance(like, TOLERANCE)
    }

    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        y: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        let Self { tolerance, next, accepted, rejected, k1, k2, half } = self;
        let mut carried = next.map_or(h, |next| next.copysign(h));
        let mut left = h;
        system.derivative(t, y, k1);
        for _ in 0..MAX_ATTEMPTS {
            // By magnitude, so that a negative `h` steps back.
            let trial = if carried.abs() < left.abs() { carried } else { left };
            half.assign(y);
            half.add_scaled(trial / 2.0, k1);
            system.derivative(t + (h - left) + trial / 2.0, half, k2);

            let error = tolerance.error(trial, k1, k2, y);
            let factor = (SAFETY / error.sqrt()).clamp(FACTORS.0, FACTORS.1);
            let factor = if factor.is_nan() { FACTORS.0 } else { factor };
            if error <= 1.0 {
                *accepted += 1;
                // 2 y2 - y1 = y + h k2
                y.add_scaled(trial, k2);
                // A step cut short by the end of the tick says nothing about the next one.
                if trial == carried {
                    carried *= factor;
                }
                if trial == left {
                    *next = Some(carried);
                    return Ok(());
                }
                left -= trial;
                system.derivative(t + (h - left), y, k1);
            } else {
                *rejected += 1;
                carried = trial * factor;
            }
        }
        Err(StepFailure::TooManySubsteps { limit: MAX_ATTEMPTS })
    }

    fn reset(&mut self) {
        self.next = None;
        self.accepted = 0;
        self.rejected = 0;
    }
}
