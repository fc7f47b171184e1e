//! A custom spring: a scene from three numbers.

use std::f64::consts::TAU;

use crate::lab::scene::{Scene, SceneErrors, USUAL_SECONDS};
use crate::sim::number::round;

/// The fewest periods in a scene of a slow spring.
const MIN_PERIODS: f64 = 10.0;

/// The largest number of a spring that is taken.
const MAX_NUMBER: f64 = 1e12;

/// A damped spring on a mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MySpring {
    /// The mass in kg.
    pub mass_kg: f64,
    /// The stiffness in N/m.
    pub stiffness_n_per_m: f64,
    /// The damping in N s/m.
    pub damping_n_s_per_m: f64,
}

impl Default for MySpring {
    /// The example of the documentation.
    fn default() -> Self {
        Self { mass_kg: 12.0, stiffness_n_per_m: 900.0, damping_n_s_per_m: 4.0 }
    }
}

impl MySpring {
    /// The spring on this mass in kg that swings at this frequency in Hz without damping, and is damped by this part of
    /// what just lets it swing no more.
    pub fn of_frequency(mass_kg: f64, frequency_hz: f64, damping_ratio: f64) -> Self {
        let omega = TAU * frequency_hz;
        Self {
            mass_kg,
            stiffness_n_per_m: mass_kg * omega * omega,
            damping_n_s_per_m: 2.0 * damping_ratio * mass_kg * omega,
        }
    }

    /// The frequency in Hz at which it would swing without damping.
    pub fn frequency_hz(self) -> f64 {
        libm::sqrt(self.stiffness_n_per_m / self.mass_kg) / TAU
    }

    /// Its damping as a part of what just lets it swing no more.
    pub fn damping_ratio(self) -> f64 {
        self.damping_n_s_per_m / (2.0 * libm::sqrt(self.stiffness_n_per_m * self.mass_kg))
    }

    /// Finds whether a scene may have these numbers.
    ///
    /// # Errors
    /// The first number that it may not have, in words.
    pub fn check(self) -> Result<(), String> {
        let Self { mass_kg, stiffness_n_per_m, damping_n_s_per_m } = self;
        let (least, most) = (f64::MIN_POSITIVE, MAX_NUMBER);
        let ranges = [
            ("the mass", mass_kg, least),
            ("the stiffness", stiffness_n_per_m, least),
            ("the damping", damping_n_s_per_m, 0.0),
        ];
        let wrong = ranges.into_iter().find(|(_, value, from)| !(*from..=most).contains(value));
        wrong.map_or(Ok(()), |(name, value, from)| {
            let wanted = if from > 0.0 { "positive" } else { "0 or more" };
            let wanted = if value > most { "at most 10¹²" } else { wanted };
            Err(format!("{name} would be {}; it must be {wanted}", round(value, 4)))
        })
    }

    /// The text of a scene of the spring alone, pulled out by a metre, at this tick rate in Hz.
    pub fn scene_text(self, tick_hz: u32) -> String {
        let Self { mass_kg, stiffness_n_per_m, damping_n_s_per_m } = self;
        let (frequency, ratio) = (self.frequency_hz(), self.damping_ratio());
        let seconds = (MIN_PERIODS / frequency).max(USUAL_SECONDS);
        let damped = match ratio {
            0.0 => "undamped".to_owned(),
            ratio => format!("damping ratio {}", round(ratio, 3)),
        };
        // A number in TOML has a point or an exponent; `{:?}` writes either.
        format!(
            "title = \"My spring\"\n\
             about = \"{} Hz, {damped}, pulled out by 1 m.\"\n\
             tick_hz = {tick_hz}\n\
             seconds = {seconds:?}\n\
             methods = [\"explicit-euler\", \"semi-implicit-euler\", \"velocity-verlet\", \"rk4\", \"implicit-euler\"]\n\n\
             [[spring]]\n\
             name = \"my spring\"\n\
             mass_kg = {mass_kg:?}\n\
             stiffness_n_per_m = {stiffness_n_per_m:?}\n\
             damping_n_s_per_m = {damping_n_s_per_m:?}\n\
             x0_m = 1.0\n",
            round(frequency, 3),
        )
    }

    /// That scene.
    ///
    /// # Errors
    /// If a scene may not have these numbers.
    pub fn scene(self, tick_hz: u32) -> Result<Scene, SceneErrors> {
        Scene::parse("my-spring", &self.scene_text(tick_hz))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spring_is_the_same_by_its_stiffness_and_by_its_frequency() {
        let spring = MySpring { mass_kg: 12.0, stiffness_n_per_m: 900.0, damping_n_s_per_m: 4.0 };
        assert!((spring.frequency_hz() - 75f64.sqrt() / TAU).abs() < 1e-15);
        assert!((spring.damping_ratio() - 4.0 / (2.0 * 10_800f64.sqrt())).abs() < 1e-15);
        let same = MySpring::of_frequency(12.0, spring.frequency_hz(), spring.damping_ratio());
        assert!((same.stiffness_n_per_m - 900.0).abs() < 1e-9, "{same:?}");
        assert!((same.damping_n_s_per_m - 4.0).abs() < 1e-12, "{same:?}");
    }

    #[test]
    fn its_scene_has_its_numbers_and_lasts_some_swings() {
        let slow = MySpring::of_frequency(2.0, 0.1, 0.25);
        for (spring, seconds) in [(slow, 100.0), (MySpring::of_frequency(1e-3, 40.0, 0.0), 20.0)] {
            let scene = spring.scene(50).unwrap();
            assert_eq!((scene.name.as_str(), scene.tick_hz), ("my-spring", 50));
            assert!((scene.seconds - seconds).abs() < 1e-9, "{} s", scene.seconds);
            let [body] = &scene.bodies[..] else { panic!("one body") };
            let value = |key| body.values[body.kind.parameter(key).unwrap().0];
            let MySpring { mass_kg, stiffness_n_per_m, damping_n_s_per_m } = spring;
            assert_eq!(value("mass_kg"), mass_kg);
            assert_eq!(value("stiffness_n_per_m"), stiffness_n_per_m);
            assert_eq!(value("damping_n_s_per_m"), damping_n_s_per_m);
        }
    }
}
