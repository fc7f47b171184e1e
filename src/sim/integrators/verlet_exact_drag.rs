//! Verlet with exact drag: half a step of exact decay, a step of velocity Verlet, half a step of exact decay.

use super::prelude::*;
use super::shared::jacobian::Jacobian;
use super::shared::linear_flow::LinearFlow;

pub(super) const CARD: Method = Method {
    id: "verlet-exact-drag",
    name: "Verlet, exact drag",
    about: "velocity Verlet whose drag is exact and stable at any step: bounded up to h ω = 2 however damped",
    order: 2,
    order_with_drag: 2,
    matrices: 5,
    symplectic: true,
    reversible: true,
    stability_limit: Some(2.0),
    // The drag shrinks both eigenvalues alike.
    damped_limits: Some([2.0, 2.0, 2.0]),
    source: "Strang, On the construction and comparison of difference schemes (1968); in molecular dynamics Bussi & Parrinello, Accurate sampling using Langevin dynamics (2007)",
    formula: &[
        "D = ∂a/∂v, w = exp(½h D) v, r = a(t, q, w) − D w",
        "v½ = w + ½h r, q′ = q + h v½, u = v½ + ½h r",
        "r′ = a(t + h, q′, u) − D u",
        "v′ = exp(½h D) (v½ + ½h r′)",
    ],
    ..LINEARISED
};

/// With `D = ∂a/∂v` at the start and `r = a - D v`, the rest of the force: `v1 = exp(h D / 2) v`,
/// `v½ = v1 + h r(t, q, v1) / 2`, `q' = q + h v½`, `v2 = v½ + h r(t + h, q', v½ + h r / 2) / 2`,
/// `v' = exp(h D / 2) v2`.
///
/// `D` is the full matrix, including the coupling of coordinates.
#[derive(Clone)]
pub struct VerletExactDrag<V> {
    /// `a`, and then `r`.
    a: V,
    /// The velocity predicted for the end.
    v_end: V,
    /// `D`
    drag: Jacobian<V>,
    decay: LinearFlow,
    /// Zeros, because nothing drives the decay.
    zeros: Vec<f64>,
}

impl<V: Vector> VerletExactDrag<V> {
    /// `v = exp(h D / 2) v` for several coordinates.
    fn decay(&mut self, system: &dyn System<Vector = V>, h: f64, v: &mut V) -> Stepped {
        let Self { drag, decay, zeros, .. } = self;
        let [_, rate] = drag.norms(system);
        let norm = (h / 2.0 * rate).abs();
        decay.advance(v.components_mut(), zeros, zeros, norm, &mut |v, slope| {
            let slopes = drag.times(system, &[], v).components();
            slope.iter_mut().zip(slopes).for_each(|(slope, dv)| *slope = h / 2.0 * dv);
        })
    }
}

/// Overwrites `r` with `a - D v`.
#[inline]
fn rest<V: Vector>(
    system: &impl System<Vector = V>,
    drag: &mut Jacobian<V>,
    t: f64,
    q: &V,
    v: &V,
    r: &mut V,
) {
    system.acceleration(t, q, v, r);
    r.add_scaled(-1.0, drag.times(system, &[], v.components()));
}

impl<S: System<Vector: Vector>> Integrator<S> for VerletExactDrag<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        let n = like.components().len();
        Self {
            a: like.clone(),
            v_end: like.clone(),
            drag: Jacobian::by_velocity(like, coupling),
            decay: LinearFlow::new(n, coupling),
            zeros: vec![0.0; n],
        }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        system.acceleration(t, &y.q, &y.v, &mut self.a);
        self.drag.compute(system, t, h, y, &self.a);
        let State { q, v } = y;
        // The exponential of a single coordinate, used for both halves.
        let alone = (v.components().len() == 1).then(|| libm::exp(h / 2.0 * self.drag.of_one()[1]));
        match alone {
            Some(decay) => v.components_mut()[0] *= decay,
            None => self.decay(system, h, v)?,
        }

        let Self { a: r, v_end, drag, .. } = self;
        rest(system, drag, t, q, v, r);
        S::Vector::kick_and_drift(h / 2.0, r, v, h, q);
        v_end.assign_sum(v, h / 2.0, r);
        rest(system, drag, t + h, q, v_end, r);
        v.add_scaled(h / 2.0, r);

        match alone {
            Some(decay) => v.components_mut()[0] *= decay,
            None => self.decay(system, h, v)?,
        }
        Ok(())
    }
}
