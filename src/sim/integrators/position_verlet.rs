//! Position Verlet: half a drift, a whole kick, half a drift.

use super::{Family, Integrator, Method, State, StepFailure, System, Vector};

pub(super) const CARD: Method = Method {
    id: "position-verlet",
    name: "Position Verlet",
    about: "second order for one evaluation a step and nothing carried; drag leaves it first order",
    family: Family::Symplectic,
    order: 2,
    order_with_drag: 1,
    evaluations: Some(1),
    symplectic: true,
    reversible: true,
    stability_limit: Some(2.0),
    tolerance: None,
    restart: None,
    keeps_time: true,
    as_printed: false,
    source: "Tuckerman, Berne & Martyna, Reversible multiple time scale molecular dynamics (1992)",
};

/// `q½ = q + h v / 2`, `v' = v + h a(t + h/2, q½, v)`, `q' = q½ + h v' / 2`.
#[derive(Clone)]
pub struct PositionVerlet<V> {
    a: V,
}

impl<S: System> Integrator<S> for PositionVerlet<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        Self { a: like.clone() }
    }

    #[inline]
    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        State { q, v }: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        let Self { a } = self;
        q.add_scaled(h / 2.0, v);
        system.acceleration(t + h / 2.0, q, v, a);
        S::Vector::kick_and_drift(h, a, v, h / 2.0, q);
        Ok(())
    }
}
