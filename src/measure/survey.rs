//! The moments of the true motion of one body, and the range of each component.

use crate::run::race::hermite;
use crate::sim::Stepper;
use crate::sim::integrators::StepFailure;

/// Number of parts of a step that are searched for an extreme.
const BETWEEN: u32 = 4;

/// A node of the curve of the true motion, which is the state and its slopes at one moment.
#[derive(Clone, Debug)]
pub(super) struct TruthNode {
    pub(super) t: f64,
    /// Coordinates, followed by velocities.
    pub(super) x: Vec<f64>,
    /// Velocities, followed by accelerations, which are the slopes of `x`.
    pub(super) slope: Vec<f64>,
}

impl TruthNode {
    pub(super) fn of(body: &dyn Stepper, t: f64) -> Self {
        let x = [body.q(), body.v()].concat();
        let mut slope = [body.v(), body.v()].concat();
        let n = body.q().len();
        body.acceleration(t, body.q(), body.v(), &mut slope[n..]);
        Self { t, x, slope }
    }

    /// Returns component `i` at the fraction `s` of the way to `next`, on the cubic through both moments.
    pub(super) fn between(&self, next: &Self, i: usize, s: f64) -> f64 {
        let h = next.t - self.t;
        hermite(s, h, [self.x[i], next.x[i]], [self.slope[i], next.slope[i]])
    }

    /// Advances `body` between these times.
    ///
    /// # Errors
    /// If the body fails or is not finite.
    pub(super) fn of_advanced(
        body: &mut dyn Stepper,
        from: f64,
        to: f64,
    ) -> Result<Self, StepFailure> {
        body.advance(from, to - from, 1)?;
        let moment = Self::of(body, to);
        match moment.x.iter().find(|x| !x.is_finite()) {
            Some(&value) => {
                Err(StepFailure::NotFinite { coordinate: "the exact solution".into(), value })
            }
            None if moment.is_finite() => Ok(moment),
            None => Err(StepFailure::NotFinite {
                coordinate: "its acceleration".into(),
                value: f64::NAN,
            }),
        }
    }

    fn is_finite(&self) -> bool {
        self.x.iter().chain(&self.slope).all(|x| x.is_finite())
    }
}

/// The range of each component, with the coordinates first.
#[derive(Clone, Debug)]
pub(super) struct Ranges(pub(super) Vec<(f64, f64)>);

impl Ranges {
    pub(super) fn at(body: &dyn Stepper) -> Self {
        Self(body.q().iter().chain(body.v()).map(|&x| (x, x)).collect())
    }

    /// Extends the ranges by the motion between two moments.
    pub(super) fn extend(&mut self, from: &TruthNode, to: &TruthNode) {
        for (i, range) in self.0.iter_mut().enumerate() {
            let turns = from.slope[i] * to.slope[i] < 0.0;
            let steps = if turns { 1..=BETWEEN } else { BETWEEN..=BETWEEN };
            for step in steps {
                let x = from.between(to, i, f64::from(step) / f64::from(BETWEEN));
                *range = (range.0.min(x), range.1.max(x));
            }
        }
    }
}
