//! What an adaptive method allows.

use crate::sim::system::{State, Vector};

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
    /// The same number for all three parts.
    pub const fn uniform(tolerance: f64) -> Self {
        Self { absolute_q: tolerance, absolute_v: tolerance, relative: tolerance }
    }

    /// The largest component of `h error`, in units of what is allowed beside `y`.
    #[inline]
    pub(in crate::sim::integrators) fn measure<V: Vector>(
        &self,
        h: f64,
        error: &State<V>,
        y: &State<V>,
    ) -> f64 {
        let worst = |absolute: f64, error: &V, y: &V| {
            let rows = error.components().iter().zip(y.components());
            rows.fold(0.0, |worst: f64, (error, y)| {
                let error = (h * error).abs() / (absolute + self.relative * y.abs());
                larger(worst, error)
            })
        };
        larger(worst(self.absolute_q, &error.q, &y.q), worst(self.absolute_v, &error.v, &y.v))
    }
}

/// As `a.max(b)`, which would drop a NaN, and with it the news that the step is worthless.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}
