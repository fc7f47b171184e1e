//! The derivative of the acceleration in a direction, by the system's formula or by a difference.
//!
//! A difference is central if the result of a step depends on it. It then reaches a part of the way that the step will
//! move the state. The rounding of the acceleration changes a step by a few units of round-off, so that the derivative
//! of a linear force is exact in effect. The derivative of a curved force is off by `O(h²)`, which keeps second order.
//! A difference that only steers an iteration is a forward difference from the known force. It is so short that a
//! corner of the force is seldom within its reach.

use crate::state::quotient;
use crate::state::{State, Vector, assert_length, largest};
use crate::system::{Query, System};

/// The reach of a difference, as a fraction of the motion of a step. With a larger fraction, curvature would distort
/// the slope more. With a smaller one, rounding would.
const PART: f64 = 1.0 / 16.0;

/// The smallest reach, in metres or radians and per second, and relative to the state. It is the square root of
/// round-off. Without it, the slope of a body at rest would be rounding.
const MIN_REACH: f64 = 1.5e-8;

/// The base value of a forward difference, and its step as a part of the direction.
pub(in crate::integrators) struct Forward<'a, V> {
    pub(in crate::integrators) from: &'a V,
    pub(in crate::integrators) part: f64,
}

/// Overwrites `x` with `weight` at the coordinates `first`, `first + apart` and so on, and 0 elsewhere.
#[inline(always)]
pub(super) fn comb<V: Vector>(x: &mut V, first: usize, apart: usize, weight: f64) {
    let x = x.components_mut();
    // A single coordinate stays in a register.
    if let [x] = x {
        *x = weight;
        return;
    }
    x.fill(0.0);
    let mut next = first;
    while let Some(x) = x.get_mut(next) {
        *x = weight;
        next += apart;
    }
}

/// Scratch for the differences.
#[derive(Clone)]
pub(in crate::integrators) struct Slopes<V> {
    /// The largest displacements of coordinates and of velocities.
    reach: [f64; 2],
    moved: State<V>,
    behind: V,
}

impl<V: Vector> Slopes<V> {
    pub(in crate::integrators) fn new(like: &V) -> Self {
        let moved = State { q: like.clone(), v: like.clone() };
        Self { reach: [0.0; 2], moved, behind: like.clone() }
    }

    /// Chooses the reach of central differences for a step of `h` from `y`, where the acceleration is `a`.
    #[inline]
    pub(in crate::integrators) fn reach_for(&mut self, h: f64, y: &State<V>, a: &V) {
        assert_length(a.components().len(), y.q.components().len());
        let [q, v, a] = [&y.q, &y.v, a].map(|part| largest(part.components()));
        let change = v + h.abs() * a;
        let reach = |ahead: f64, now: f64| (PART * ahead).max(MIN_REACH * (1.0 + now));
        self.reach = [reach(h.abs() * change, q), reach(change, v)];
    }

    /// Overwrites `slope` with the derivative of the acceleration at `y` in the direction `along`. A difference is
    /// central if `forward` is `None`.
    #[inline]
    pub(in crate::integrators) fn differentiate(
        &mut self,
        system: &(impl System<Vector = V> + ?Sized),
        t: f64,
        y: &State<V>,
        along: &State<V>,
        forward: Option<Forward<'_, V>>,
        slope: &mut V,
    ) {
        if system.query(t, Query::Slope { state: y, along, slope: &mut *slope }) {
            return;
        }
        let Self { reach, moved, behind } = self;
        if let Some(Forward { from, part }) = forward {
            moved.assign_sum(y, part, along);
            system.acceleration(t, &moved.q, &moved.v, slope);
            return quotient(slope.components_mut(), from.components(), part);
        }
        let [q, v] = [&along.q, &along.v].map(|part| largest(part.components()));
        let part = (reach[0] / q).min(reach[1] / v);
        if part.is_infinite() {
            slope.components_mut().fill(0.0);
            return;
        }
        moved.assign_sum(y, part, along);
        system.acceleration(t, &moved.q, &moved.v, slope);
        moved.assign_sum(y, -part, along);
        system.acceleration(t, &moved.q, &moved.v, behind);
        quotient(slope.components_mut(), behind.components(), 2.0 * part);
    }
}
