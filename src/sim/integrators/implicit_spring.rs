//! Implicit spring: backward Euler of the critically damped spring, solved by hand.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "implicit-spring",
    name: "Implicit spring",
    about: "stable at any frame rate, without an exponential; follows more slowly the lower the rate",
    source: "Holden, Spring-It-On: The Game Developer's Spring-Roll-Call (2021)",
    formula: &["v′ = (v + h ω² (g − x)) / (1 + ω h)²", "x′ = x + h v′"],
    code: include_str!("../../../assets/methods/implicit-spring.step"),
    follower: Some(FollowerSetting::rate("(x, v) = implicit_spring(x, v, dt, target, {});")),
    ..SECOND_ORDER_FOLLOWER
};

/// Implicit spring, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct ImplicitSpring;

impl FollowerRule for ImplicitSpring {
    const CARD: &'static Method = &CARD;

    #[inline]
    fn step(h: f64, omega: f64, g: f64, x: f64, v: f64) -> (f64, f64) {
        let (pull, z) = (omega * omega * h, omega * h);
        let end = (v + pull * (g - x)) / (1.0 + 2.0 * z + z * z);
        (x + h * end, end)
    }
}

#[cfg(all(test, feature = "lab"))]
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
