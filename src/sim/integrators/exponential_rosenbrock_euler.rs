//! Exponential Rosenbrock-Euler: linearises the equation at the start of the step and solves that exactly.

use super::prelude::*;
use super::shared::jacobian::Jacobian;
use super::shared::linear_flow::{LinearFlow, response};

pub(super) const CARD: Method = Method {
    id: "exponential-rosenbrock-euler",
    name: "Exponential Rosenbrock-Euler",
    about: "exact at any step on springs, drag and other linear forces, with no damping added; second order \
            elsewhere",
    order: 2,
    order_with_drag: 2,
    matrices: 14,
    evaluation_cost: 3,
    exact_if_linear: true,
    source: "Pope, An exponential method of numerical integration of ordinary differential equations (1963); Hochbruck & Ostermann, Exponential integrators (2010)",
    formula: &[
        "y′ = y + h φ₁(h J) f(t, y) + h² φ₂(h J) fₜ",
        "J = ∂f/∂y, fₜ = (f(t + h, y) − f(t, y)) / h",
        "φ₁(z) = (exp(z) − 1) / z, φ₂(z) = (φ₁(z) − 1) / z",
    ],
    ..LINEARISED
};

/// `y' = y + h φ1(h J) f + h² φ2(h J) f_t` on the whole state `y = (q, v)`, with `J = ∂f/∂y` and `f_t = ∂f/∂t` at the
/// start. `y' - y` is the solution at `τ = 1` of `x' = h J x + h f + τ h² f_t` from 0 at `τ = 0`.
///
/// `f_t` is the difference over the step, so that a force linear in time is exact too.
#[derive(Clone)]
pub struct ExponentialRosenbrockEuler<V> {
    a: V,
    /// The acceleration at the end of the step, with the state unchanged.
    a_later: V,
    jacobian: Jacobian<V>,
    flow: LinearFlow,
    /// `x`, `h f` and `h² f_t`: coordinates, then velocities multiplied by a time that makes their scale alike.
    x: Vec<f64>,
    f: Vec<f64>,
    f_t: Vec<f64>,
}

impl<V: Vector> ExponentialRosenbrockEuler<V> {
    /// The step for several coordinates, whose derivatives `jacobian` already has.
    fn step_together(
        &mut self,
        system: &dyn System<Vector = V>,
        h: f64,
        y: &mut State<V>,
    ) -> Stepped {
        let Self { a, a_later, jacobian, flow, x, f, f_t } = self;
        let n = a.components().len();

        // Velocities are multiplied by the step, or by less on a stiff system.
        let [norm_q, norm_v] = jacobian.norms(system);
        let stiffness = (h * h * norm_q).sqrt().max(1.0);
        let time = h / stiffness;
        for i in 0..n {
            let (a, a_later) = (a.components()[i], a_later.components()[i]);
            (f[i], f[n + i]) = (h * y.v.components()[i], time * (h * a));
            f_t[n + i] = time * (h * (a_later - a));
        }
        x.fill(0.0);
        let norm = stiffness.max((time * h).abs() * norm_q + h.abs() * norm_v);
        flow.advance(x, f, f_t, norm, &mut |x, slope| {
            let (x_q, x_v) = x.split_at(n);
            let (slope_q, slope_v) = slope.split_at_mut(n);
            slope_q.iter_mut().zip(x_v).for_each(|(slope, v)| *slope = v / time);
            let slopes = jacobian.times(system, x_q, slope_q).components();
            slope_v.iter_mut().zip(slopes).for_each(|(slope, a)| *slope = time * (h * a));
            slope_q.iter_mut().for_each(|slope| *slope *= h);
        })?;
        for i in 0..n {
            y.q.components_mut()[i] += x[i];
            y.v.components_mut()[i] += x[n + i] / time;
        }
        Ok(())
    }
}

impl<S: System<Vector: Vector>> Integrator<S> for ExponentialRosenbrockEuler<S::Vector> {
    fn new(like: &S::Vector) -> Self {
        <Self as Integrator<S>>::coupled(like, Coupling::All)
    }

    fn coupled(like: &S::Vector, coupling: Coupling) -> Self {
        let n = like.components().len();
        let [x, f, f_t] = [(); 3].map(|()| vec![0.0; 2 * n]);
        Self {
            a: like.clone(),
            a_later: like.clone(),
            jacobian: Jacobian::new(like, coupling),
            flow: LinearFlow::new(2 * n, coupling),
            x,
            f,
            f_t,
        }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, y: &mut StateOf<S>) -> Stepped {
        let Self { a, a_later, jacobian, .. } = self;
        system.acceleration(t, &y.q, &y.v, a);
        system.acceleration(t + h, &y.q, &y.v, a_later);
        jacobian.compute(system, t, h, y, a);
        let State { q, v } = y;
        let ([q], [v]) = (q.components_mut(), v.components_mut()) else {
            return self.step_together(system, h, y);
        };
        // φ1 and φ2 of a 2×2 matrix, from the response of one coordinate to pushes.
        let [da_dq, da_dv] = jacobian.of_one();
        let [s, s1, s2] = response(h * h * da_dq, h * da_dv);
        let (a, more) = (a.components()[0], a_later.components()[0] - a.components()[0]);
        *q += h * *v * (1.0 + h * h * da_dq * s2) + h * h * (a * s1 + more * s2);
        *v += h * (h * da_dq * *v * s1 + a * s + more * s1);
        Ok(())
    }
}
