//! Composition of drifts and kicks, for higher-order symplectic methods.

use crate::sim::state::{Elementwise, State};
use crate::sim::system::{StateOf, System};

/// For each `(c, d)` of `stages` a drift `q += c h v` and a kick `v += d h a`, then the `last` drift.
///
/// Time advances with the drifts, and a kick uses the current velocity: forces that depend on velocity
/// reduce the order.
#[inline(always)]
pub(in crate::sim::integrators) fn compose<S: System>(
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
