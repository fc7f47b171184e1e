//! Measures how a body approaches a fixed target, by its half-life and its overshoot.
//!
//! Only a target at rest counts. Behind a moving one a follower keeps a distance, so that the distance would never
//! halve. Between ticks the distance is interpolated, or a coarse tick would round the half-life to a whole number of
//! ticks.

use crate::sim::Stepper;

/// An approach to a target that began at the start, or at the last input or placement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chase {
    target: f64,
    began_s: f64,
    /// Signed distance at the beginning.
    first: f64,
    /// Last moment (s), and the distance at that moment.
    last: (f64, f64),
    /// Time (s) at which half of the distance was left.
    halved_s: Option<f64>,
    /// Largest overshoot, relative to the first distance.
    beyond: f64,
}

impl Chase {
    /// Returns the chase of `body` from time `t` (s) on; `None` if the body has no target, a moving one, or has already
    /// arrived.
    pub fn new(body: &dyn Stepper, t: f64) -> Option<Self> {
        let target = body.pursuit(t).filter(|pursuit| pursuit.is_still)?.target;
        let first = target - body.q()[0];
        let chase =
            Self { target, began_s: t, first, last: (t, first), halved_s: None, beyond: 0.0 };
        (first != 0.0 && first.is_finite()).then_some(chase)
    }

    /// Adds the body's place, which is its first coordinate, at time `t` (s).
    pub fn add_place(&mut self, place: f64, t: f64) {
        let ((before_s, before), now) = (self.last, self.target - place);
        let (before, part) = (before / self.first, now / self.first);
        if self.halved_s.is_none() && part <= 0.5 {
            // Between ticks, the distance is interpolated exponentially before the target, and linearly through the
            // target.
            let within = match part > 0.0 {
                true => libm::log(before / 0.5) / libm::log(before / part),
                false => (before - 0.5) / (before - part),
            };
            self.halved_s = Some(before_s + within * (t - before_s));
        }
        self.beyond = self.beyond.max(-part);
        self.last = (t, now);
    }

    /// Returns the time (s) to cover half of the distance; `None` until half is covered.
    pub fn half_life_s(&self) -> Option<f64> {
        self.halved_s.map(|halved_s| halved_s - self.began_s)
    }

    /// Returns the overshoot in percent of the first distance.
    pub fn overshoot_percent(&self) -> f64 {
        100.0 * self.beyond
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::sim::Solver;
    use crate::sim::integrators::method;

    /// Returns the chase of 2 m under a method, by a body of this order with a rate of 10 /s.
    fn chase(order: u32, id: &str, hz: f64) -> Chase {
        let head = "title = 't'\ntick_hz = 60\nseconds = 2\n";
        let text = format!("{head}[[follow]]\norder = {order}\nrate_per_s = 10\nx0_m = -1\n");
        let body = &Scene::parse("t", &text).unwrap().bodies[0];
        let mut body = (body.kind.build)(&body.values, Solver::Method(method(id).unwrap()));
        let mut chase = Chase::new(&*body, 0.0).unwrap();
        for tick in 0..2 * hz as u32 {
            body.advance(f64::from(tick) / hz, 1.0 / hz, 1).unwrap();
            chase.add_place(body.q()[0], f64::from(tick + 1) / hz);
        }
        chase
    }

    fn half_life_ms(order: u32, id: &str, hz: f64) -> f64 {
        1e3 * chase(order, id, hz).half_life_s().unwrap()
    }

    #[test]
    fn half_lives_at_30_60_and_144_hz_match_the_formulas() {
        let table = [
            ("lerp-per-frame", [219.3, 109.6, 45.7]),
            ("lerp-dt", [57.0, 63.4, 66.9]),
            ("exponential-decay", [69.3, 69.3, 69.3]),
        ];
        for (id, wanted) in table {
            let found = [30.0, 60.0, 144.0].map(|hz| half_life_ms(1, id, hz));
            assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 0.05), "{id}: {found:?}");
        }
    }

    #[test]
    fn overshoot_is_the_distance_beyond_the_target() {
        // At k dt = 1.5, half of the distance is left on the other side.
        let overshoot = chase(1, "lerp-dt", 10.0 / 1.5).overshoot_percent();
        assert!((overshoot - 50.0).abs() < 1e-9, "{overshoot}");
        for (order, id) in [(1, "exponential-decay"), (2, "critically-damped-spring")] {
            assert_eq!(chase(order, id, 30.0).overshoot_percent(), 0.0, "{id}");
        }
        // The body moves in a straight line from 2 m before the target to 1 m beyond, and is half-way after a third of
        // the step.
        let half_life = half_life_ms(1, "lerp-dt", 10.0 / 1.5);
        assert!((half_life - 50.0).abs() < 1e-9, "{half_life}");
    }

    #[test]
    fn only_a_follower_away_from_a_fixed_target_is_a_chase() {
        for (body, is_chase) in [
            ("[[follow]]\nrate_per_s = 1\n", true),
            ("[[follow]]\nrate_per_s = 1\nx0_m = 1\n", false),
            ("[[follow]]\nrate_per_s = 1\nramp_m_per_s = 1\n", false),
            ("[[follow]]\nrate_per_s = 1\nsine_m = 1\n", false),
            ("[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 1\n", false),
        ] {
            let text = format!("title = 't'\ntick_hz = 60\nseconds = 2\n{body}");
            let scene = Scene::parse("t", &text).unwrap();
            let body = (scene.bodies[0].kind.build)(&scene.bodies[0].values, Solver::Truth);
            assert_eq!(Chase::new(&*body, 0.0).is_some(), is_chase, "{text}");
        }
    }
}
