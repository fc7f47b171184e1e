//! Implicit spring: backward Euler of the critically damped spring, solved by hand.

use std::marker::PhantomData;

use super::card::{Method, SECOND_ORDER_FOLLOWER};
use super::failure::StepFailure;
use super::integrator::Integrator;
use super::shared::chase::{each, pursuit};
use crate::sim::state::State;
use crate::sim::system::{Pursuit, System};

pub(super) const CARD: Method = Method {
    id: "implicit-spring",
    name: "Implicit spring",
    about: "stable at any frame rate, without an exponential; follows more slowly the lower the rate",
    source: "Holden, Spring-It-On: The Game Developer's Spring-Roll-Call (2021)",
    formula: &["v′ = (v + h ω² (g − x)) / (1 + ω h)²", "x′ = x + h v′"],
    code: include_str!("../../../assets/methods/implicit-spring.step"),
    ..SECOND_ORDER_FOLLOWER
};

/// `v' = (v + h ω² (g - x)) / (1 + 2 h ω + h² ω²)`, `x' = x + h v'`, for the target `g` at the end of the step.
#[derive(Clone)]
pub struct ImplicitSpring<V>(PhantomData<V>);

impl<S: System> Integrator<S> for ImplicitSpring<S::Vector> {
    fn new(_like: &S::Vector) -> Self {
        Self(PhantomData)
    }

    #[inline]
    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        let Pursuit { target: g, rate: omega, .. } = pursuit(&CARD, system, t + h)?;
        let (pull, z) = (omega * omega * h, omega * h);
        let resistance = 1.0 + 2.0 * z + z * z;
        each(&g, state, |g, x, v| {
            let end = (v + pull * (g - x)) / resistance;
            (x + h * end, end)
        });
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::sim::Solver;
    use crate::sim::bodies::kind;
    use crate::sim::integrators::method;

    #[test]
    fn a_step_solves_the_equations_of_backward_euler() {
        // Towards a target that steps, moves away and swings.
        let values = [2.0, 5.0, 1.0, 0.5, 0.3, 1.2, -1.0, 0.7, 0.5];
        let solver = Solver::Method(method("implicit-spring").unwrap());
        for h in [1.0 / 144.0, 1.0 / 30.0, 0.5] {
            let mut body = (kind("follow").unwrap().build)(&values, solver);
            for tick in 0..40 {
                let (t, [x, v]) = (f64::from(tick) * h, [body.q()[0], body.v()[0]]);
                body.advance(t, h, 1).unwrap();
                let (q, w, mut a) = (body.q().to_vec(), body.v().to_vec(), [0.0]);
                body.acceleration(t + h, &q, &w, &mut a);
                assert!((q[0] - (x + h * w[0])).abs() < 1e-13, "{h} s, tick {tick}");
                assert!((w[0] - (v + h * a[0])).abs() < 1e-12, "{h} s, tick {tick}");
            }
        }
    }
}
