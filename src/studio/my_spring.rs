//! A custom spring, and the scene that is made from its numbers.

use std::f64::consts::{PI, TAU};

use crate::measure::{Adviser, Criterion};
use crate::scene::{LaneSpec, Scene, SceneErrors, USUAL_SECONDS, check_entered, tick_rate_line};
use crate::sim::TickRate;
use crate::sim::bodies::Range;
use crate::sim::integrators::method;
use crate::sim::number::{round, significant};
use crate::tools::port::Wish;

/// Minimum number of periods in the scene of a slow spring.
const MIN_PERIODS: f64 = 10.0;

/// Distance from the new rest, relative to the step, within which a spring has settled.
const SETTLED: f64 = 0.02;

/// A mass on a damped spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MySpring {
    /// Mass in kg.
    pub mass_kg: f64,
    /// Stiffness in N/m.
    pub stiffness_n_per_m: f64,
    /// Damping in N s/m.
    pub damping_n_s_per_m: f64,
    /// Stretch at the start, in m.
    pub x0_m: f64,
    /// Velocity at the start in m/s, in the direction of stretch.
    pub v0_m_per_s: f64,
    /// Gravity in m/s², in the direction of stretch.
    pub gravity_m_per_s2: f64,
}

impl Default for MySpring {
    /// Returns the example of the documentation.
    fn default() -> Self {
        Self {
            mass_kg: 12.0,
            stiffness_n_per_m: 900.0,
            damping_n_s_per_m: 4.0,
            x0_m: 1.0,
            v0_m_per_s: 0.0,
            gravity_m_per_s2: 0.0,
        }
    }
}

impl MySpring {
    /// Creates a spring from its mass in kg, its undamped frequency in Hz and its damping ratio (1 is critical).
    pub fn of_frequency(mass_kg: f64, frequency_hz: f64, damping_ratio: f64) -> Self {
        Self { mass_kg, ..Self::default() }.swinging(frequency_hz, damping_ratio)
    }

    /// Returns a spring with the same mass and start, but with this undamped frequency in Hz and this damping ratio.
    pub fn swinging(self, frequency_hz: f64, damping_ratio: f64) -> Self {
        let omega = TAU * frequency_hz;
        Self {
            stiffness_n_per_m: self.mass_kg * omega * omega,
            damping_n_s_per_m: 2.0 * damping_ratio * self.mass_kg * omega,
            ..self
        }
    }

    /// Returns the motion that a player should see.
    pub fn wish(self) -> Wish {
        let [frequency_hz, damping_ratio] = [self.frequency_hz(), self.damping_ratio()];
        Wish { frequency_hz, damping_ratio, mass_kg: self.mass_kg }
    }

    /// Returns a spring with the same start that moves as `wish` asks.
    pub fn with_wish(self, wish: &Wish) -> Self {
        Self { mass_kg: wish.mass_kg, ..self }.swinging(wish.frequency_hz, wish.damping_ratio)
    }

    /// Returns the stretch at rest under gravity, in m.
    pub fn sag_m(self) -> f64 {
        self.mass_kg * self.gravity_m_per_s2 / self.stiffness_n_per_m
    }

    /// Returns the undamped frequency in Hz.
    pub fn frequency_hz(self) -> f64 {
        libm::sqrt(self.stiffness_n_per_m / self.mass_kg) / TAU
    }

    /// Returns the damping ratio (1 is critical).
    pub fn damping_ratio(self) -> f64 {
        self.damping_n_s_per_m / (2.0 * libm::sqrt(self.stiffness_n_per_m * self.mass_kg))
    }

    /// Returns the overshoot of a step, which is the part of the way by which the mass goes beyond its new rest, from 0
    /// to 1.
    pub fn overshoot(self) -> f64 {
        let ratio = self.damping_ratio();
        if ratio >= 1.0 {
            return 0.0;
        }
        libm::exp(-PI * ratio / libm::sqrt(1.0 - ratio * ratio))
    }

    /// Returns the time (s) after which the mass stays within 2 % of a step from its new rest, or `None` if it never
    /// does.
    pub fn settles_s(self) -> Option<f64> {
        let (omega, ratio) = (TAU * self.frequency_hz(), self.damping_ratio());
        let decay = ratio * omega;
        if decay <= 0.0 {
            return None;
        }
        let split = omega * libm::sqrt((1.0 - ratio * ratio).abs());
        // The product of both rates is ω², and their difference would lose digits under strong damping.
        let slowest = omega * omega / (decay + split);
        let is_far = |t: f64| {
            let place = if ratio < 1.0 {
                let (cos, sin) = (libm::cos(split * t), libm::sin(split * t));
                libm::exp(-decay * t) * (cos + decay / split * sin)
            } else if ratio > 1.0 {
                let [slow, fast] = [slowest, decay + split].map(|rate| libm::exp(-rate * t));
                (slow + fast + decay / split * (slow - fast)) / 2.0
            } else {
                libm::exp(-decay * t) * (1.0 + omega * t)
            };
            place.abs() > SETTLED
        };
        // The mass comes near in the last half swing that begins too far away, or without swings after the start.
        let (mut far_s, mut near_s) = match ratio < 1.0 {
            true => {
                let turn_s = PI / split;
                let last = libm::floor(-libm::log(SETTLED) / (decay * turn_s));
                (last * turn_s, (last + 1.0) * turn_s)
            }
            false => (0.0, 20.0 / slowest),
        };
        for _ in 0..200 {
            let middle_s = far_s.midpoint(near_s);
            *(if is_far(middle_s) { &mut far_s } else { &mut near_s }) = middle_s;
        }
        Some(near_s)
    }

    /// Says how far the mass overshoots after a step, and when it has settled.
    pub fn response_in_words(self) -> String {
        let overshoot = overshoot_in_words(self.overshoot());
        match self.settles_s() {
            Some(settles_s) => {
                let within = round(100.0 * SETTLED, 3);
                format!("{overshoot}, within {within} % after {} s", significant(settles_s, 2))
            }
            None => format!("{overshoot}, never settles"),
        }
    }

    /// Checks that a scene may have these numbers.
    ///
    /// # Errors
    /// If a number is out of range, or if the mass would not move. The message names the number.
    pub fn check(self) -> Result<(), String> {
        for (name, value, range) in [
            ("mass", self.mass_kg, Range::POSITIVE),
            ("stiffness", self.stiffness_n_per_m, Range::POSITIVE),
            ("damping", self.damping_n_s_per_m, Range::NON_NEGATIVE),
            ("stretch at start", self.x0_m, Range::ANY),
            ("velocity at start", self.v0_m_per_s, Range::ANY),
            ("gravity", self.gravity_m_per_s2, Range::ANY),
            ("stretch at start beyond that at rest", self.x0_m - self.sag_m(), Range::ANY),
        ] {
            check_entered(name, value, range)?;
        }
        match self.x0_m == self.sag_m() && self.v0_m_per_s == 0.0 {
            true => Err("it would rest: give it another stretch or a velocity first".into()),
            false => Ok(()),
        }
    }

    /// Returns the text of a scene with only the spring, at this tick rate in Hz. The coordinate counts from the place
    /// where the mass hangs at rest, because gravity does not change the motion around it.
    pub fn scene_text(self, tick_hz: impl Into<TickRate>) -> String {
        let Self { mass_kg, stiffness_n_per_m, damping_n_s_per_m, v0_m_per_s, .. } = self;
        let (sag_m, x0_m) = (self.sag_m(), self.x0_m - self.sag_m());
        let hung = match sag_m {
            0.0 => String::new(),
            sag_m => {
                format!(" It rests at a stretch of {} m, from which x is counted.", round(sag_m, 4))
            }
        };
        let pushed = match v0_m_per_s {
            0.0 => String::new(),
            v0 => format!(", let go at {} m/s", round(v0, 4)),
        };
        let (frequency, ratio) = (self.frequency_hz(), self.damping_ratio());
        let seconds = (MIN_PERIODS / frequency).max(USUAL_SECONDS);
        let damped = match ratio {
            0.0 => "undamped".to_owned(),
            ratio => format!("damping ratio {}", round(ratio, 3)),
        };
        // A number in TOML needs a point or an exponent, and `{:?}` writes one of them.
        format!(
            "title = \"My spring\"\n\
             about = \"{} Hz, {damped}, pulled out by {} m{pushed}.{hung}\"\n\
             {}\
             seconds = {seconds:?}\n\
             methods = [\"explicit-euler\", \"semi-implicit-euler\", \"velocity-verlet\", \"rk4\", \"implicit-euler\"]\n\n\
             [[spring]]\n\
             name = \"my spring\"\n\
             mass_kg = {mass_kg:?}\n\
             stiffness_n_per_m = {stiffness_n_per_m:?}\n\
             damping_n_s_per_m = {damping_n_s_per_m:?}\n\
             x0_m = {x0_m:?}\n\
             v0_m_per_s = {v0_m_per_s:?}\n",
            round(frequency, 3),
            round(x0_m, 4),
            tick_rate_line(tick_hz.into()),
        )
    }

    /// Returns the scene under the method that is recommended for the spring to look right. Explicit Euler is one key
    /// away.
    ///
    /// # Errors
    /// If a scene may not have these numbers.
    pub fn advised_scene(self, tick_hz: impl Into<TickRate>) -> Result<Scene, SceneErrors> {
        let tick_hz = tick_hz.into();
        let mut scene = self.scene(tick_hz)?;
        let adviser = Adviser::new(&scene, tick_hz);
        let methods = scene.methods_for_games();
        let Some(best) = adviser.cheapest(Criterion::LooksRight, methods) else {
            scene.opening_method = method("semi-implicit-euler");
            return Ok(scene);
        };
        match scene.lanes.iter_mut().find(|lane| lane.method == best.method) {
            Some(lane) => *lane = best,
            None => scene.lanes.insert(1, best),
        }
        scene.opening_method = Some(best.method);
        scene.hint = Some(hint(best, &scene.lanes));
        Scene::parse(&scene.name, &scene.to_toml())
    }

    /// Returns the scene that [`scene_text`](Self::scene_text) describes.
    ///
    /// # Errors
    /// If a scene may not have these numbers.
    pub fn scene(self, tick_hz: impl Into<TickRate>) -> Result<Scene, SceneErrors> {
        Scene::parse("my-spring", &self.scene_text(tick_hz))
    }
}

/// Says how far a mass goes beyond its new rest, as a part of the way.
pub(super) fn overshoot_in_words(part: f64) -> String {
    match 100.0 * part {
        percent if percent < 0.05 => "no overshoot".into(),
        percent => format!("overshoots {} %", significant(percent, 2)),
    }
}

/// Returns the hint at the next thing to try under the recommended method.
fn hint(best: LaneSpec, lanes: &[LaneSpec]) -> String {
    let (name, first) = (best.name_with_substeps(lanes), lanes[0].method.name);
    match best == lanes[0] {
        true => format!("Even {name} looks right here. Press `C` to race all methods."),
        false => format!("{name} looks right at little cost. Press `1` for {first}."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{CRITERIA, recommended};

    #[test]
    fn overshoot_and_settling_are_those_of_a_fine_simulation() {
        for ratio in [0.02, 0.1, 0.37, 0.7, 0.779, 0.95, 1.0, 1.0001, 1.3, 4.0] {
            let spring = MySpring::of_frequency(2.0, 1.7, ratio);
            let MySpring { mass_kg: m, stiffness_n_per_m: k, damping_n_s_per_m: c, .. } = spring;
            let settles_s = spring.settles_s().expect("it is damped");
            let (h, mut x, mut v, mut least, mut last_far_s) = (1e-5, 1.0_f64, 0.0, 1.0_f64, 0.0);
            for tick in 0..(3.0 * settles_s / h) as u64 {
                let a = |x: f64, v: f64| -(k * x + c * v) / m;
                let middle = v + h / 2.0 * a(x, v);
                let next = x + h * middle;
                v += h * a(x + h / 2.0 * v, middle);
                x = next;
                least = least.min(x);
                if x.abs() > SETTLED {
                    last_far_s = h * (tick + 1) as f64;
                }
            }
            assert!((spring.overshoot() - (-least).max(0.0)).abs() < 1e-6, "{ratio}: {least}");
            assert!((settles_s - last_far_s).abs() < 1e-3, "{ratio}: {settles_s} {last_far_s}");
        }
        let stiff = MySpring::of_frequency(1.0, 1.0, 1e9);
        let creeps_s = libm::log(1.0 / SETTLED) * 2e9 / TAU;
        let part = stiff.settles_s().expect("it is damped") / creeps_s;
        assert!((part - 1.0).abs() < 1e-9, "{part}");
        let undamped = MySpring::of_frequency(1.0, 1.0, 0.0);
        assert_eq!((undamped.overshoot(), undamped.settles_s()), (1.0, None));
        assert_eq!(undamped.response_in_words(), "overshoots 100 %, never settles");
    }

    #[test]
    fn stiffness_and_frequency_describe_the_same_spring() {
        let spring = MySpring::default();
        assert!((spring.frequency_hz() - 75f64.sqrt() / TAU).abs() < 1e-15);
        assert!((spring.damping_ratio() - 4.0 / (2.0 * 10_800f64.sqrt())).abs() < 1e-15);
        let same = MySpring::of_frequency(12.0, spring.frequency_hz(), spring.damping_ratio());
        assert!((same.stiffness_n_per_m - 900.0).abs() < 1e-9, "{same:?}");
        assert!((same.damping_n_s_per_m - 4.0).abs() < 1e-12, "{same:?}");
    }

    #[test]
    fn the_scene_of_a_spring_has_its_numbers_and_lasts_some_swings() {
        let slow = MySpring::of_frequency(2.0, 0.1, 0.25);
        for (spring, seconds) in [(slow, 100.0), (MySpring::of_frequency(1e-3, 40.0, 0.0), 20.0)] {
            let scene = spring.scene(50).unwrap();
            assert_eq!((scene.name.as_str(), scene.tick_hz), ("my-spring", 50.into()));
            assert!((scene.seconds - seconds).abs() < 1e-9, "{} s", scene.seconds);
            let [body] = &scene.bodies[..] else { panic!("one body") };
            let value = |key| body.values[body.kind.parameter(key).unwrap().0];
            let MySpring { mass_kg, stiffness_n_per_m, damping_n_s_per_m, .. } = spring;
            assert_eq!(value("mass_kg"), mass_kg);
            assert_eq!(value("stiffness_n_per_m"), stiffness_n_per_m);
            assert_eq!(value("damping_n_s_per_m"), damping_n_s_per_m);
        }
    }

    #[test]
    fn the_start_of_a_hanging_spring_is_relative_to_its_rest() {
        let hung =
            MySpring { x0_m: 0.5, v0_m_per_s: -2.0, gravity_m_per_s2: 9.0, ..MySpring::default() };
        // The sag is 12 kg · 9 m/s² / 900 N/m.
        assert!((hung.sag_m() - 0.12).abs() < 1e-15);
        let scene = hung.scene(60).unwrap();
        let body = &scene.bodies[0];
        let value = |key| body.values[body.kind.parameter(key).unwrap().0];
        assert!((value("x0_m") - 0.38).abs() < 1e-12, "{}", value("x0_m"));
        assert_eq!(value("v0_m_per_s"), -2.0);
        assert!(
            scene.about.contains("0.12 m") && scene.about.contains("−2 m/s"),
            "{}",
            scene.about
        );
        let at_rest = MySpring { x0_m: 0.12, v0_m_per_s: 0.0, ..hung };
        assert!(hung.check().is_ok() && at_rest.check().is_err());
        let lost = MySpring { x0_m: f64::NAN, ..hung };
        assert!(lost.check().is_err());
    }

    #[test]
    fn my_spring_opens_with_the_best_method_and_explicit_euler_one_key_away() {
        for (spring, tick_hz) in
            [(MySpring::default(), 30), (MySpring::of_frequency(1.0, 4.0, 0.0), 60)]
        {
            let scene = spring.advised_scene(tick_hz).unwrap();
            assert_eq!(scene.lanes[0].method.id, "explicit-euler");
            let adviser = Adviser::new(&scene, tick_hz);
            // A more expensive method cannot be the recommended one.
            let methods = scene.methods_for_games().filter(|it| it.evaluations == Some(1));
            let mut all: Vec<_> = methods.map(|it| adviser.judged(LaneSpec::plain(it))).collect();
            adviser.search_until_decided(&mut all);
            let looks_right = CRITERIA.iter().position(|it| *it == Criterion::LooksRight).unwrap();
            let best = recommended(&all, looks_right);
            let best = &all[best.expect("some look right")];
            let lane = scene.lanes.iter().find(|lane| Some(lane.method) == scene.opening_method);
            let told = lane.map(|lane| (lane.method.id, lane.substeps));
            let met = best.met[looks_right].met().unwrap();
            assert_eq!(told, Some((best.spec.method.id, met.substeps)), "at {tick_hz} Hz");
        }
    }

    #[test]
    fn a_recommended_method_shares_no_colour_with_the_lanes_of_my_spring() {
        use crate::look::palette::Theme;
        let scene = MySpring::default().scene(60).unwrap();
        for best in scene.methods_for_games() {
            let mut lanes = scene.lanes.clone();
            if lanes.iter().all(|lane| lane.method != best) {
                lanes.insert(1, LaneSpec::plain(best));
            }
            let colours = lanes.iter().map(|lane| Theme::Dark.lane_style(&lanes, lane).0);
            let colours: Vec<_> = colours.collect();
            let of_best = lanes.iter().position(|lane| lane.method == best).unwrap();
            let shared = colours.iter().filter(|colour| **colour == colours[of_best]).count();
            assert_eq!(shared, 1, "{}: {colours:?}", best.id);
        }
    }
}
