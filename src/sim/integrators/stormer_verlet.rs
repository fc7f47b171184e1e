//! Störmer-Verlet, which computes the next position from the last two and the force. The velocity follows from the
//! positions.

use super::prelude::*;
use super::shared::LastStep;

pub(super) const CARD: Method = Method {
    id: "stormer-verlet",
    name: "Störmer-Verlet",
    about: "the form of games that keep positions only: velocity Verlet's path, its velocities from differences of positions",
    order: 2,
    order_with_drag: 2,
    evaluations: Some(1),
    restart: Some("by placing the position of one step ago on the parabola through q, v and a"),
    damped_limits: Some([1.912, 1.757, 1.0]),
    source: "Störmer, Sur les trajectoires des corpuscules électrisés (1907); Verlet, Computer \"Experiments\" on Classical Fluids (1967); Jakobsen, Advanced Character Physics (2001)",
    formula: &[
        "q′ = 2 q − q₋₁ + h² a",
        "a′ = a(t + h, q′, (3 q′ − 4 q + q₋₁) / (2 h))",
        "v′ = (q′ − q) / h + ½h a′",
    ],
    ..SYMPLECTIC
};

/// Störmer-Verlet, by the [formula](Method::formula) on its card. `p` is the position one step ago.
///
/// The plain difference `(q' - q) / h` is the velocity half a step ago, and only first order. Half a kick by the force
/// at the end, which the next step needs anyway, makes the velocity second order.
#[derive(Clone)]
pub struct StormerVerlet<V> {
    p: V,
    a: V,
    /// The position at the end of the step.
    q_end: V,
    last_step: LastStep,
}

impl<S: System> Integrator<S> for StormerVerlet<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let [p, a, q_end] = [like.clone(), like.clone(), like.clone()];
        Self { p, a, q_end, last_step: LastStep::NONE }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { p, a, q_end, last_step } = self;
        let State { q, v } = y;
        if !last_step.is_continued_by(h) {
            system.acceleration(t, q, v, a);
            p.assign_sum(q, -h, v);
            p.add_scaled(h * h / 2.0, a);
        }
        q_end.assign_scaled(2.0, q);
        q_end.add_terms([(-1.0, p), (h * h, a)]);

        // The force at the end uses the slope at the end of the parabola through all three positions.
        v.assign_scaled(1.5 / h, q_end);
        v.add_terms([(-2.0 / h, q), (0.5 / h, p)]);
        system.acceleration(t + h, q_end, v, a);

        v.assign_scaled(1.0 / h, q_end);
        v.add_terms([(-1.0 / h, q), (h / 2.0, a)]);
        std::mem::swap(p, q);
        std::mem::swap(q, q_end);
        last_step.end(h);
        Ok(())
    }

    fn reset(&mut self) {
        self.last_step = LastStep::NONE;
    }
}
