//! How the springs of user interfaces are told a motion, and what the frame rate makes of it.
//!
//! Each takes the distance to the target for the stretch, on a mass of 1 where it has none of its own.

use std::f64::consts::TAU;
use std::fmt::Write;

use nalgebra::Matrix2;

use super::follow::map_of_frame;
use super::seen::{is_stable, map_of_step, seen};
use super::{REACHED, Reach, Wish};
use crate::lab::bisection::bisect;
use crate::lab::identify::Effective;
use crate::sim::bodies::Spring;
use crate::sim::integrators::{in_code, method};
use crate::sim::number::significant;
use crate::sim::{Body, State};

/// A number that a library takes.
#[derive(Debug)]
pub struct Key {
    /// As the library spells it.
    pub name: &'static str,
    /// What it is where it is not given.
    pub usual: f64,
    /// The least and the most that it may be.
    pub range: [f64; 2],
    /// The range in words.
    pub wanted: &'static str,
}

/// The values of the keys of a dialect; where it has fewer, the others are 0.
type Values = [f64; 3];

/// How a library comes from frame to frame.
#[derive(Clone, Copy, Debug)]
enum Steps {
    /// By the closed form.
    Exact,
    /// Along straight lines between points of the closed form.
    Sampled,
    /// By semi-implicit Euler once a frame.
    PerFrame,
    /// By semi-implicit Euler in steps of 1 ms, whose count is rounded up, but no more than 64 a frame.
    Milliseconds,
    /// By the follower `smooth-damp` once a frame.
    SmoothDamp,
}

/// How a library is told a spring.
#[derive(Debug)]
pub struct Dialect {
    /// Its id on the command line.
    pub id: &'static str,
    /// Its name.
    pub name: &'static str,
    /// The numbers that it takes, up to three.
    pub keys: &'static [Key],
    /// The file or page that says how it reads them and how it steps.
    pub source: &'static str,
    /// What they mean; `None` if they do not tell the motion.
    read: Option<fn(Values) -> Wish>,
    /// Those that come nearest to a motion.
    write: fn(&Wish) -> Values,
    steps: Steps,
    /// A line of code, with the names of keys in `<>` where their values stand.
    code: &'static str,
}

/// What a library is told for a wish, and what is seen then.
#[derive(Clone, Debug, PartialEq)]
pub struct DialectPort {
    /// Whether it shows the wish: unreachable is what it damps more, and what explodes.
    pub reach: Reach,
    /// The values of its keys, in their order.
    pub values: Vec<f64>,
    /// The frames per second below which it explodes; `None` if the frame rate does not decide that.
    pub explodes_below_hz: Option<f64>,
    /// Whether it does not explode at the frame rate.
    pub is_stable: bool,
    /// What is seen at the frame rate; `None` if nothing swings, or decays without changing sides at each step.
    pub seen: Option<Effective>,
    /// How far what is shown is off at most, as a part of the way, where it is drawn through points.
    pub error: Option<f64>,
    /// The line of code.
    pub code: String,
}

const fn key(name: &'static str, usual: f64) -> Key {
    Key { name, usual, range: [f64::MIN_POSITIVE, f64::MAX], wanted: "above 0" }
}

const fn ratio(name: &'static str, usual: f64) -> Key {
    Key { name, usual, range: [0.0, f64::MAX], wanted: "0 or more" }
}

const fn bounce(usual: f64) -> Key {
    let range = [f64::EPSILON - 1.0, 1.0];
    Key { name: "bounce", usual, range, wanted: "above −1 and at most 1" }
}

const PHYSICAL: &[Key] = &[key("mass", 1.0), key("stiffness", 100.0), ratio("damping", 10.0)];

/// A spring with a mass, by its equation of motion.
const EQUATION: Dialect = Dialect {
    id: "",
    name: "",
    keys: PHYSICAL,
    source: "",
    read: Some(|[mass_kg, stiffness, damping]| {
        let ratio = damping / libm::sqrt(stiffness * mass_kg) / 2.0;
        Wish { mass_kg, ..wish(libm::sqrt(stiffness / mass_kg), ratio) }
    }),
    write: |wish| {
        let [stiffness, damping] = wish.joint().map(|per_kg| per_kg * wish.mass_kg);
        [wish.mass_kg, stiffness, damping]
    },
    steps: Steps::Exact,
    code: "",
};

/// A spring by its damping ratio and its stiffness, which is the square of ω.
const RATIO: Dialect = Dialect {
    read: Some(|[ratio, stiffness, _]| wish(libm::sqrt(stiffness), ratio)),
    write: |wish| [wish.damping_ratio, wish.omega() * wish.omega(), 0.0],
    keys: &[ratio("dampingRatio", 1.0), key("stiffness", 1500.0)],
    ..EQUATION
};

/// A spring by its period and its bounce: 1 less the damping ratio, or beyond 1 the reciprocal of that less 1.
const BOUNCE: Dialect = Dialect {
    read: Some(|[duration, bounce, _]| {
        wish(TAU / duration, if bounce < 0.0 { 1.0 / (1.0 + bounce) } else { 1.0 - bounce })
    }),
    write: |wish| {
        let ratio = wish.damping_ratio;
        [1.0 / wish.frequency_hz, if ratio > 1.0 { 1.0 / ratio - 1.0 } else { 1.0 - ratio }, 0.0]
    },
    keys: &[key("duration", 0.5), bounce(0.0)],
    ..EQUATION
};

/// The springs of user interfaces.
pub static DIALECTS: &[Dialect] = &[
    Dialect {
        id: "swiftui",
        name: "SwiftUI, duration and bounce",
        source: "developer.apple.com/documentation/swiftui/spring; its numbers as Flutter's withDurationAndBounce has them",
        code: ".spring(duration: <duration>, bounce: <bounce>)",
        ..BOUNCE
    },
    Dialect {
        id: "swiftui-response",
        name: "SwiftUI, response and damping fraction",
        keys: &[key("response", 0.5), ratio("dampingFraction", 0.825)],
        source: "developer.apple.com/documentation/swiftui/animation/spring(response:dampingfraction:blendduration:)",
        read: Some(|[response, fraction, _]| wish(TAU / response, fraction)),
        write: |wish| [1.0 / wish.frequency_hz, wish.damping_ratio, 0.0],
        code: ".spring(response: <response>, dampingFraction: <dampingFraction>)",
        ..EQUATION
    },
    Dialect {
        id: "core-animation",
        name: "Core Animation and UIKit",
        source: "developer.apple.com/documentation/quartzcore/caspringanimation; UISpringTimingParameters has the same three",
        code: "spring.mass = <mass>; spring.stiffness = <stiffness>; spring.damping = <damping>",
        ..EQUATION
    },
    Dialect {
        id: "css",
        name: "CSS linear()",
        keys: &[key("duration", 0.5), key("points", 50.0)],
        source: "drafts.csswg.org/css-easing-2/#the-linear-easing-function",
        read: None,
        write: sampling,
        steps: Steps::Sampled,
        code: "transition: translate <duration>s linear(<curve>)",
    },
    Dialect {
        id: "compose",
        name: "Jetpack Compose",
        source: "androidx, compose/animation/animation-core: SpringSimulation.kt, AnimationSpec.kt",
        code: "spring(dampingRatio = <dampingRatio>f, stiffness = <stiffness>f)",
        ..RATIO
    },
    Dialect {
        id: "android",
        name: "Android SpringForce",
        keys: &[ratio("dampingRatio", 0.5), key("stiffness", 1500.0)],
        source: "androidx, dynamicanimation/dynamicanimation: SpringForce.java",
        code: "new SpringForce(target).setDampingRatio(<dampingRatio>f).setStiffness(<stiffness>f)",
        ..RATIO
    },
    Dialect {
        id: "flutter",
        name: "Flutter",
        source: "flutter, packages/flutter/lib/src/physics/spring_simulation.dart",
        code: "SpringDescription(mass: <mass>, stiffness: <stiffness>, damping: <damping>)",
        ..EQUATION
    },
    Dialect {
        id: "flutter-duration",
        name: "Flutter, duration and bounce",
        source: "flutter, packages/flutter/lib/src/physics/spring_simulation.dart; the duration in whole milliseconds",
        write: |wish| whole_milliseconds((BOUNCE.write)(wish)),
        code: "SpringDescription.withDurationAndBounce(duration: Duration(milliseconds: <ms>), bounce: <bounce>)",
        ..BOUNCE
    },
    Dialect {
        id: "react-spring",
        name: "react-spring",
        keys: &[key("mass", 1.0), key("tension", 170.0), ratio("friction", 26.0)],
        source: "react-spring 9, packages/core/src: SpringValue.ts, constants.ts; packages/rafz/src/index.ts",
        steps: Steps::Milliseconds,
        code: "config: { mass: <mass>, tension: <tension>, friction: <friction> }",
        ..EQUATION
    },
    Dialect {
        id: "motion",
        name: "Motion",
        source: "motion, packages/motion-dom/src/animation/generators/spring.ts",
        code: "transition: { type: \"spring\", mass: <mass>, stiffness: <stiffness>, damping: <damping> }",
        ..EQUATION
    },
    Dialect {
        id: "motion-duration",
        name: "Motion, duration and bounce",
        keys: &[
            Key { range: [0.01, 10.0], wanted: "0.01 to 10", ..key("duration", 0.8) },
            Key { range: [0.0, 1.0], wanted: "0 to 1", ..bounce(0.3) },
        ],
        source: "motion, packages/motion-dom/src/animation/generators/spring.ts",
        read: Some(|[duration, bounce, _]| {
            let ratio = (1.0 - bounce).max(MOTION_MIN_RATIO);
            wish(motion_omega(ratio, duration), ratio)
        }),
        write: |wish| {
            let ratio = wish.damping_ratio.clamp(MOTION_MIN_RATIO, 1.0);
            let duration = motion_angle(ratio) / wish.omega();
            [duration.clamp(0.01, 10.0), 1.0 - ratio, 0.0]
        },
        code: "transition: { type: \"spring\", duration: <duration>, bounce: <bounce> }",
        ..EQUATION
    },
    Dialect {
        id: "slint",
        name: "Slint",
        source: "slint, internal/core/animations/simulations/spring.rs and its use in properties",
        code: "animate x { easing: spring; mass: <mass>; stiffness: <stiffness>; damping: <damping>; }",
        ..EQUATION
    },
    Dialect {
        id: "slint-duration",
        name: "Slint, duration and bounce",
        keys: &[key("duration", 0.5), Key { range: [-1.0, 1.0], wanted: "−1 to 1", ..bounce(0.0) }],
        source: "slint, internal/core/animations/simulations/spring.rs; the duration in whole milliseconds",
        read: Some(|[duration, bounce, _]| wish(TAU / duration, 1.0 - bounce)),
        write: |wish| {
            let bounce = 1.0 - wish.damping_ratio.min(2.0);
            whole_milliseconds([1.0 / wish.frequency_hz, bounce, 0.0])
        },
        code: "animate x { easing: spring; duration: <ms>ms; bounce: <bounce>; }",
        ..EQUATION
    },
    Dialect {
        id: "gpui",
        name: "gpui",
        source: "zed, crates/gpui/src/spring.rs",
        code: "SpringConfig::new(<stiffness>, <damping>, <mass>)",
        ..EQUATION
    },
    Dialect {
        id: "unity-smooth-damp",
        name: "Unity SmoothDamp",
        keys: &[key("smoothTime", 0.3)],
        source: "UnityCsReference, Runtime/Export/Math/Mathf.cs",
        read: Some(|[smooth_time, ..]| wish(2.0 / smooth_time, 1.0)),
        write: |wish| [2.0 / wish.omega(), 0.0, 0.0],
        steps: Steps::SmoothDamp,
        code: "x = Mathf.SmoothDamp(x, target, ref velocity, <smoothTime>f);",
    },
    Dialect {
        id: "per-frame",
        name: "two lines of your own, once a frame",
        source: "semi-implicit Euler with the force of the start of the frame",
        steps: Steps::PerFrame,
        code: "v += (<stiffness> * (target - x) - <damping> * v) / <mass> * dt; x += v * dt;",
        ..EQUATION
    },
];

/// The least damping ratio that Motion takes from a bounce.
const MOTION_MIN_RATIO: f64 = 0.05;
/// What is left of the way where it is over.
const OVER: f64 = 1e-3;
/// The error that points are to stay below as a part of the way, and the most points.
const SAMPLED: f64 = 5e-3;
const MAX_POINTS: f64 = 100.0;
/// In how many places the error is looked for.
const PLACES: u32 = 20_000;
/// Points that miss more of the way than this show another motion.
const ASTRAY: f64 = 0.1;
/// Frames per second between which an explosion is sought.
const RATES: [f64; 2] = [1e-6, 1e12];
const HALVINGS: u32 = 60;
/// The step of react-spring in seconds, and the most of them in a frame.
const STEP_S: f64 = 1e-3;
const MAX_STEPS: f64 = 64.0;

fn wish(omega: f64, damping_ratio: f64) -> Wish {
    Wish { frequency_hz: omega / TAU, damping_ratio, mass_kg: 1.0 }
}

fn whole_milliseconds([seconds, second, third]: Values) -> Values {
    [(1e3 * seconds).round().max(1.0) / 1e3, second, third]
}

/// The part of the way that is left at this angle, the time times ω, to a spring of this damping ratio that began at rest.
fn left(damping_ratio: f64, angle: f64) -> f64 {
    let spring =
        Spring { mass: 1.0, stiffness: 1.0, damping: 2.0 * damping_ratio, ..Spring::default() };
    let left = spring.exact(angle, &State { q: 1.0, v: 0.0 });
    left.expect("a spring has a closed form").q
}

/// The angle at which a spring of a damping ratio of 1 or more has [`OVER`] of its way left.
fn angle_of(ratio: f64) -> f64 {
    bisect([0.0, 40.0 * ratio], HALVINGS, |angle| left(ratio, angle) > OVER)[0]
}

/// ω times the duration by which Motion has a spring swing out: where ζ / √(1 − ζ²) exp(−ζ ω t) is what is left.
fn motion_angle(ratio: f64) -> f64 {
    match ratio < 1.0 {
        true => -libm::log(OVER * libm::sqrt(1.0 - ratio * ratio) / ratio) / ratio,
        false => angle_of(1.0),
    }
}

/// What Motion finds of that: by 11 steps of Newton's method, which are too few close to critical damping.
fn motion_omega(ratio: f64, duration: f64) -> f64 {
    if ratio >= 1.0 {
        return motion_angle(ratio) / duration;
    }
    let scale = ratio / libm::sqrt(1.0 - ratio * ratio);
    (0..11).fold(5.0 / duration, |omega, _| {
        let left = scale * libm::exp(-ratio * omega * duration);
        omega - (OVER - left) / (ratio * duration * left)
    })
}

/// The seconds after which less than [`OVER`] is left, and how many points are enough.
fn sampling(wish: &Wish) -> Values {
    let ratio = wish.damping_ratio;
    let angle = match ratio < 1.0 {
        true => -libm::log(OVER * libm::sqrt(1.0 - ratio * ratio)) / ratio,
        false => angle_of(ratio),
    };
    // A straight line is off by an eighth of the curvature, 1 at most, times the square of its length.
    let points = libm::ceil(angle / libm::sqrt(8.0 * SAMPLED)) + 1.0;
    [angle / wish.omega(), points.clamp(2.0, MAX_POINTS), 0.0]
}

/// The points of a way, written as in a style sheet, and how far the lines between them are off.
fn curve(wish: &Wish, [duration, points, _]: Values) -> (String, f64) {
    let pieces = points as u32 - 1;
    let at = |place: f64| 1.0 - left(wish.damping_ratio, wish.omega() * duration * place);
    let point = |i: u32| match i == pieces {
        true => 1.0,
        false => (1e4 * at(f64::from(i) / f64::from(pieces))).round() / 1e4,
    };
    let (mut written, mut error) = ("0".to_owned(), 0.0_f64);
    let parts = PLACES / pieces;
    for i in 0..pieces {
        let [from, to] = [point(i), point(i + 1)];
        write!(written, ", {to}").expect("a text takes all");
        for part in 0..=parts {
            let part = f64::from(part) / f64::from(parts);
            let exact = at((f64::from(i) + part) / f64::from(pieces));
            error = error.max((from + (to - from) * part - exact).abs());
        }
    }
    (written, error)
}

impl Dialect {
    /// The dialect with this id.
    pub fn of_id(id: &str) -> Option<&'static Self> {
        DIALECTS.iter().find(|dialect| dialect.id == id)
    }

    /// Whether a motion can be read from it.
    pub fn is_read(&self) -> bool {
        self.read.is_some()
    }

    /// Whether it takes a mass.
    pub fn has_mass(&self) -> bool {
        self.keys.iter().any(|key| key.name == "mass")
    }

    /// The motion that these values of its keys tell.
    ///
    /// # Errors
    /// If they tell none, or the first value that is out of its range, in words.
    pub fn read(&self, values: &[f64]) -> Result<Wish, String> {
        let read = self.read.ok_or_else(|| {
            format!("{} is points of a motion, from which it cannot be told", self.name)
        })?;
        for (Key { name, range: [least, most], wanted, .. }, value) in self.keys.iter().zip(values)
        {
            if !(least..=most).contains(&value) {
                return Err(format!("{name} is {value}; it must be {wanted}"));
            }
        }
        let mut all = Values::default();
        all.iter_mut().zip(values).for_each(|(to, from)| *to = *from);
        Ok(read(all))
    }

    /// How it steps: `exact`, or a method's id.
    pub fn steps(&self) -> &'static str {
        match self.steps {
            Steps::Exact | Steps::Sampled => "exact",
            Steps::PerFrame | Steps::Milliseconds => "semi-implicit-euler",
            Steps::SmoothDamp => "smooth-damp",
        }
    }

    /// What it is told for a wish, whose numbers must [have a meaning](Wish::check_numbers), and what is seen at this many
    /// frames per second.
    pub fn port(&self, wish: &Wish, frame_hz: f64) -> DialectPort {
        let values = (self.write)(wish);
        let is_told = values.iter().all(|value| value.is_finite());
        let told = self.read.map_or(*wish, |read| read(values));
        let (points, error) = match self.steps {
            Steps::Sampled if is_told => curve(wish, values),
            _ => Default::default(),
        };
        let map = self.map(&told, frame_hz);
        let is_stable = map.as_ref().is_none_or(StepMap::is_stable);
        let seen = map.map_or(Some(told.seen()), |map| map.seen());
        let seen = seen.filter(|_| is_told && error <= ASTRAY);
        let missed = seen.and_then(|seen| {
            let ratio = seen.damping_ratio()? - wish.damping_ratio;
            Some([(seen.undamped_hz() / wish.frequency_hz - 1.0).abs(), ratio])
        });
        let near = REACHED * (1.0 + wish.damping_ratio);
        let reach = match missed {
            _ if !is_told => Reach::Unreachable,
            _ if error > ASTRAY => Reach::Unreachable,
            _ if error > 0.0 => Reach::Nearest,
            None if is_stable => Reach::Nearest,
            Some([of_hz, ratio]) if of_hz <= REACHED && ratio.abs() <= near => Reach::Reached,
            Some(_) if told.damping_ratio <= wish.damping_ratio + near => Reach::Nearest,
            _ => Reach::Unreachable,
        };
        let mut code = self.code.replace("<ms>", &(1e3 * values[0]).round().to_string());
        code = code.replace("<curve>", &points);
        for (key, value) in self.keys.iter().zip(values) {
            code = code.replace(&format!("<{}>", key.name), &in_code(value));
        }
        DialectPort {
            reach,
            values: values[..self.keys.len()].to_vec(),
            explodes_below_hz: self.explodes_below_hz(&told),
            is_stable,
            seen,
            error: (error > 0.0).then_some(error),
            code: if is_told { code } else { String::new() },
        }
    }

    /// The map of a step of a motion that it is told; `None` of a closed form.
    fn map(&self, told: &Wish, frame_hz: f64) -> Option<StepMap> {
        let (step_s, pace) = match self.steps {
            Steps::Exact | Steps::Sampled => return None,
            Steps::PerFrame | Steps::SmoothDamp => (1.0 / frame_hz, 1.0),
            Steps::Milliseconds => (STEP_S, pace(frame_hz)),
        };
        let method = method(self.steps()).expect("a method of the table");
        let map = match self.steps {
            Steps::SmoothDamp => map_of_frame(method, told.omega(), frame_hz),
            _ => map_of_step(method, told.joint(), step_s),
        };
        // A map beyond all numbers is of a motion that is.
        let map = map.unwrap_or(Matrix2::from_element(f64::INFINITY));
        Some(StepMap { map, step_s, pace })
    }

    /// The frames per second below which a motion that it is told explodes.
    fn explodes_below_hz(&self, told: &Wish) -> Option<f64> {
        let Steps::PerFrame = self.steps else { return None };
        let explodes = |log| self.map(told, libm::exp(log)).is_some_and(|map| !map.is_stable());
        let [_, high] = bisect(RATES.map(libm::log), HALVINGS, explodes);
        Some(libm::exp(high))
    }

    /// What the frame rate does to what it was told, in words.
    pub fn at_frame_rates(&self, port: &DialectPort, frame_hz: f64) -> String {
        let percent = |part: f64| significant(100.0 * part.abs(), 2);
        match self.steps {
            Steps::Exact => "the closed form: the same at every frame rate".into(),
            Steps::Sampled => match port.error {
                Some(error) => format!("off by {} % of the way at most", percent(error)),
                None => "without damping it never ends, and has no last point".into(),
            },
            Steps::Milliseconds if !port.is_stable => {
                "semi-implicit Euler by 1 ms: explodes at every frame rate".into()
            }
            Steps::Milliseconds => {
                let off = pace(frame_hz) - 1.0;
                let way = if off < 0.0 { "slow" } else { "fast" };
                format!(
                    "semi-implicit Euler by 1 ms, rounded up: {} % {way} at {frame_hz} frames per second; lags below {} of them",
                    percent(off),
                    1.0 / (MAX_STEPS * STEP_S),
                )
            }
            Steps::SmoothDamp => "a rational function for the exponential: never explodes".into(),
            Steps::PerFrame => {
                let below = port.explodes_below_hz.map_or("any".into(), |hz| significant(hz, 3));
                let turns = match port.seen.is_none() && port.is_stable {
                    true => "; changes sides at every frame",
                    false => "",
                };
                format!(
                    "semi-implicit Euler once a frame: explodes below {below} frames per second{turns}"
                )
            }
        }
    }
}

/// What a step makes of distance and velocity.
struct StepMap {
    map: Matrix2<f64>,
    /// The seconds that the step is told.
    step_s: f64,
    /// How many of them pass in a second.
    pace: f64,
}

impl StepMap {
    /// Whether no motion of it grows.
    fn is_stable(&self) -> bool {
        is_stable(self.map.trace(), self.map.determinant())
    }

    /// The damped spring that it looks like.
    fn seen(&self) -> Option<Effective> {
        let Self { map, step_s, pace } = self;
        let Effective { omega, decay } = seen(map.trace(), map.determinant(), *step_s)?;
        Some(Effective { omega: pace * omega, decay: pace * decay })
    }
}

/// How fast the clock of react-spring runs, whose frames are rounded up to steps.
fn pace(frame_hz: f64) -> f64 {
    libm::ceil(1.0 / STEP_S / frame_hz).min(MAX_STEPS) * STEP_S * frame_hz
}
