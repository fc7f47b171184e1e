//! Adaptive Euler as the chapter prints it, where a shortened step still ends the tick.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "adaptive-euler-as-printed",
    name: "Adaptive Euler (as printed)",
    about: "the chapter's listing: under drag it runs in slow motion, for it never makes up the time that it cuts \
            off a step; without drag it is semi-implicit Euler",
    order: 1,
    order_with_drag: 1,
    tolerance: Some(TOLERANCE),
    keeps_time: false,
    source: "Bourg & Bywalec, Physics for Game Developers 2e (2013), ch. 7, listing of the adaptive step size",
    formula: &[
        "v₁ = v + h a, v½ = v + ½h a",
        "v₂ = v½ + ½h a(t + ½h, q, v½), e = |v₁ − v₂|",
        "s = h min(1, √(tolerance / e))",
        "v′ = v + s a, q′ = q + s v′",
    ],
    ..AS_PRINTED
};

/// The listing checks only the velocity, with an absolute tolerance. It prints no value. With this value, the motion of
/// the chapter's ship advances by 2.55 s in 8.5 s.
const TOLERANCE: Tolerance =
    Tolerance { absolute_q: f64::INFINITY, absolute_v: 1e-3, relative: 0.0 };

/// `v1` is the velocity after one step of `h`, `v2` that after two steps of `h/2`, and `e = |v1 - v2|`. If `h
/// √(tolerance / e)` is less than `h`, the method makes a single step of that length, without another check.
#[derive(Clone)]
pub struct AdaptiveEulerAsPrinted<V> {
    tolerance: Tolerance,
    lost_time: f64,
    a: V,
    v1: V,
    v2: V,
}

impl<V: Vector> AdaptiveEulerAsPrinted<V> {
    /// Returns the method with this tolerance; only `absolute_v` is used.
    pub fn with_tolerance(like: &V, tolerance: Tolerance) -> Self {
        Self { tolerance, lost_time: 0.0, a: like.clone(), v1: like.clone(), v2: like.clone() }
    }
}

impl<S: System<Vector: Vector>> Integrator<S> for AdaptiveEulerAsPrinted<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self::with_tolerance(like, TOLERANCE)
    }

    #[inline]
    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let Self { tolerance, lost_time, a, v1, v2 } = self;
        system.acceleration(t, q, v, a);
        v1.assign_sum(v, h, a);

        // The listing evaluates the same force again.
        system.acceleration(t, q, v, a);
        v2.assign_sum(v, h / 2.0, a);
        system.acceleration(t + h / 2.0, q, v2, a);
        v2.add_scaled(h / 2.0, a);

        let factor = (tolerance.absolute_v / largest_difference(v1, v2)).sqrt();
        if factor < 1.0 {
            let h_new = h * factor;
            system.acceleration(t, q, v, a);
            v.add_scaled(h_new, a);
            q.add_scaled(h_new, v);
            *lost_time += h - h_new;
        } else {
            v.assign(v1);
            q.add_scaled(h, v);
        }
        Ok(())
    }

    fn set(&mut self, with: Override) {
        if let Override::Tolerance(tolerance) = with {
            self.tolerance = tolerance;
        }
    }

    fn lost_time(&self) -> f64 {
        self.lost_time
    }
}

fn largest_difference<V: Vector>(v1: &V, v2: &V) -> f64 {
    let pairs = v1.components().iter().zip(v2.components());
    pairs.map(|(v1, v2)| (v1 - v2).abs()).fold(0.0, f64::max)
}
