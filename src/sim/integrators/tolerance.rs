//! The tolerance of an adaptive method.

use crate::sim::state::{State, Vector};

/// The allowed error of a substep: `absolute + relative |y|` in every component.
///
/// An absolute part of `f64::INFINITY` excludes that half of the state from the control.
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
    /// One number for all three parts.
    pub const fn uniform(tolerance: f64) -> Self {
        Self { absolute_q: tolerance, absolute_v: tolerance, relative: tolerance }
    }

    /// The largest component of `h error`, relative to the tolerance at `y`.
    #[inline]
    pub(in crate::sim::integrators) fn relative_error<V: Vector>(
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

/// The larger number; unlike `f64::max` it keeps a NaN, so that a worthless step is rejected.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}
