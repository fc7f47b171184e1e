//! Building blocks that several methods share. The two smallest are here, and each of the others has its own file.

use crate::state::{Elementwise, State};
use crate::system::{StateOf, System};

pub(super) mod embedded_pair;
pub(super) mod jacobian;
mod krylov;
pub(super) mod linear_flow;
pub(super) mod linearisation;
mod lu;
pub(super) mod newton;
pub(super) mod slopes;
pub(super) mod stages;
pub(super) mod step_size;

/// Composes a step of drifts and kicks, for symplectic methods of higher order.
///
/// For each `(c, d)` of `stages`, makes a drift `q += c h v` and a kick `v += d h a`. Then makes the `last` drift.
///
/// Time advances with the drifts, and a kick uses the current velocity, so that forces that depend on velocity reduce
/// the order.
#[inline(always)]
pub(in crate::integrators) fn compose<S: System>(
    system: &S,
    t: f64,
    h: f64,
    State { q, v }: &mut StateOf<S>,
    a: &mut S::Vector,
    stages: &[(f64, f64)],
    last: f64,
) {
    let mut drifted = 0.0;
    for (c, d) in stages {
        q.add_scaled(c * h, v);
        drifted += c;
        system.acceleration(t + drifted * h, q, v, a);
        v.add_scaled(d * h, a);
    }
    q.add_scaled(last * h, v);
}

/// The length of the last step of a method with memory, which is valid only for a next step of the same length.
///
/// A method compares the lengths of steps itself. The caller reports a jump of the state or the forces by
/// [`Integrator::reset`](crate::integrators::Integrator::reset), because detecting a jump would cost a copy of the
/// state and a comparison per step.
#[derive(Clone)]
pub(in crate::integrators) struct LastStep {
    /// The length in seconds. Without valid memory it is NaN, which equals nothing.
    h: f64,
}

impl LastStep {
    /// No valid memory, as before the first step and after a jump.
    pub(in crate::integrators) const NONE: Self = Self { h: f64::NAN };

    /// Whether a step of `h` is as long as the last step. Forgets the last step until the next step [ends](Self::end),
    /// so that a failed step leaves no memory.
    #[inline(always)]
    pub(in crate::integrators) fn is_continued_by(&mut self, h: f64) -> bool {
        std::mem::replace(&mut self.h, f64::NAN) == h
    }

    /// Records that a step of `h` has ended.
    #[inline(always)]
    pub(in crate::integrators) fn end(&mut self, h: f64) {
        self.h = h;
    }
}
