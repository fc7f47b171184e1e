//! Velocity Verlet, which makes half a kick, a drift, and half a kick by the force at the end.

use super::prelude::*;
use super::shared::LastStep;

pub(super) const CARD: Method = Method {
    id: "velocity-verlet",
    name: "Velocity Verlet",
    about: "second order for one evaluation a step, and bounded on a spring up to h ω = 2; drag lowers that limit",
    order: 2,
    order_with_drag: 2,
    evaluations: Some(1),
    restart: Some(
        "by evaluating the force at the start, otherwise reused from the end of the last step",
    ),
    damped_limits: Some([1.912, 1.757, 1.0]),
    source: "Swope, Andersen, Berens & Wilson, A computer simulation method for the calculation of equilibrium constants for the formation of physical clusters of molecules (1982)",
    formula: &["v½ = v + ½h a", "q′ = q + h v½", "a′ = a(t + h, q′, v½ + ½h a)", "v′ = v½ + ½h a′"],
    ..SYMPLECTIC
};

/// Velocity Verlet, by the [formula](Method::formula) on its card.
///
/// The force at the end uses the predicted velocity there, which keeps second order under drag. With the half-step
/// velocity `v½`, the method would be first order.
#[derive(Clone)]
pub struct VelocityVerlet<V> {
    a: V,
    /// The force at the end, with which the next step starts.
    a_end: V,
    /// The velocity that is predicted for the end of the step.
    v_end: V,
    last_step: LastStep,
}

impl<S: System> Integrator<S> for VelocityVerlet<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        let [a, a_end, v_end] = [like.clone(), like.clone(), like.clone()];
        Self { a, a_end, v_end, last_step: LastStep::NONE }
    }

    #[inline(always)]
    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { a, a_end, v_end, last_step } = self;
        if !last_step.is_continued_by(h) {
            system.acceleration(t, &y.q, &y.v, a);
        }
        let State { q, v } = y;
        S::Vector::kick_and_drift(h / 2.0, a, v, h, q);

        v_end.assign_sum(v, h / 2.0, a);
        system.acceleration(t + h, q, v_end, a_end);
        v.add_scaled(h / 2.0, a_end);
        std::mem::swap(a, a_end);
        last_step.end(h);
        Ok(())
    }

    fn reset(&mut self) {
        self.last_step = LastStep::NONE;
    }
}
