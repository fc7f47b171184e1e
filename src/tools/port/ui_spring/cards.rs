//! One card for each user-interface spring, with the meaning of its numbers in its library.

use std::f64::consts::TAU;

use super::{Departure, HALVINGS, Key, Steps, Switch, UiSpring, Values, part_left};
use crate::sim::numerics::bisect;
use crate::tools::port::{REACHED, Wish};

const fn key(name: &'static str, usual: f64) -> Key {
    let range = [f64::MIN_POSITIVE, f64::MAX];
    Key { name, usual, range, wanted: "above 0", switch: None }
}

const fn ratio(name: &'static str, usual: f64) -> Key {
    Key { name, usual, range: [0.0, f64::MAX], wanted: "0 or more", switch: None }
}

const fn bounce(usual: f64) -> Key {
    let range = [f64::EPSILON - 1.0, 1.0];
    Key { name: "bounce", usual, range, wanted: "above −1 and at most 1", switch: None }
}

/// Returns a duration in seconds that the library takes as whole milliseconds.
const fn milliseconds(name: &'static str, usual: f64) -> Key {
    Key { range: [1e-3, f64::MAX], wanted: "0.001 or more", ..key(name, usual) }
}

const MASS: Key = key("mass", 1.0);
const STIFFNESS: Key = key("stiffness", 100.0);
const DAMPING: Key = ratio("damping", 10.0);

/// A spring with a mass, given by its equation of motion.
const EQUATION: UiSpring = UiSpring {
    id: "",
    name: "",
    keys: &[MASS, STIFFNESS, DAMPING],
    source: "",
    version: "",
    evidence: "",
    read: Some(|[mass_kg, stiffness, damping, _]| {
        let ratio = damping / libm::sqrt(stiffness * mass_kg) / 2.0;
        Wish { mass_kg, ..wish(libm::sqrt(stiffness / mass_kg), ratio) }
    }),
    write: |wish| {
        let [stiffness, damping] = wish.joint().map(|per_kg| per_kg * wish.mass_kg);
        [wish.mass_kg, stiffness, damping, 0.0]
    },
    steps: Steps::Exact,
    departure: |_| None,
    code: "",
};

/// A spring given by its damping ratio and its stiffness, which is the square of ω.
const RATIO: UiSpring = UiSpring {
    read: Some(|[ratio, stiffness, ..]| wish(libm::sqrt(stiffness), ratio)),
    write: |wish| [wish.damping_ratio, wish.omega() * wish.omega(), 0.0, 0.0],
    keys: &[ratio("dampingRatio", 1.0), key("stiffness", 1500.0)],
    steps: Steps::WholeMilliseconds,
    ..EQUATION
};

/// A spring given by its period and its bounce, which is 1 - ζ, or 1/ζ - 1 above critical damping.
const BOUNCE: UiSpring = UiSpring {
    read: Some(|[duration, bounce, ..]| {
        wish(TAU / duration, if bounce < 0.0 { 1.0 / (1.0 + bounce) } else { 1.0 - bounce })
    }),
    write: |wish| {
        let ratio = wish.damping_ratio;
        let bounce = if ratio > 1.0 { 1.0 / ratio - 1.0 } else { 1.0 - ratio };
        [1.0 / wish.frequency_hz, bounce, 0.0, 0.0]
    },
    keys: &[key("duration", 0.5), bounce(0.0)],
    ..EQUATION
};

/// The springs of user interfaces.
pub static UI_SPRINGS: &[UiSpring] = &[
    UiSpring {
        id: "swiftui",
        name: "SwiftUI, duration and bounce",
        source: "developer.apple.com/documentation/swiftui/spring; its numbers as Flutter's withDurationAndBounce has them",
        version: "iOS 17",
        evidence: "its documentation read",
        code: ".spring(duration: <duration>, bounce: <bounce>)",
        ..BOUNCE
    },
    UiSpring {
        id: "swiftui-response",
        name: "SwiftUI, response and damping fraction",
        keys: &[key("response", 0.5), ratio("dampingFraction", 0.825)],
        source: "developer.apple.com/documentation/swiftui/animation/spring(response:dampingfraction:blendduration:)",
        version: "iOS 13",
        evidence: "its documentation read",
        read: Some(|[response, fraction, ..]| wish(TAU / response, fraction)),
        write: |wish| [1.0 / wish.frequency_hz, wish.damping_ratio, 0.0, 0.0],
        code: ".spring(response: <response>, dampingFraction: <dampingFraction>)",
        ..EQUATION
    },
    UiSpring {
        id: "core-animation",
        name: "Core Animation and UIKit",
        keys: &[
            MASS,
            STIFFNESS,
            DAMPING,
            Key {
                range: [0.0, 1.0],
                wanted: "true or false",
                switch: Some(Switch {
                    code: "spring.allowsOverdamping = true",
                    note: "allowsOverdamping is of iOS 17 and macOS 14; before, and without it, it is critically damped",
                }),
                ..ratio("allowsOverdamping", 0.0)
            },
        ],
        source: "developer.apple.com/documentation/quartzcore/caspringanimation; UISpringTimingParameters has the first three",
        version: "iOS 17",
        evidence: "its documentation read",
        read: Some(|[mass_kg, stiffness, damping, allows_overdamping]| {
            let critical = 2.0 * libm::sqrt(stiffness * mass_kg);
            let damping = if allows_overdamping == 1.0 { damping } else { damping.min(critical) };
            let ratio = damping / critical;
            Wish { mass_kg, ..wish(libm::sqrt(stiffness / mass_kg), ratio) }
        }),
        write: |wish| {
            let [mass_kg, stiffness, damping, _] = (EQUATION.write)(wish);
            [mass_kg, stiffness, damping, f64::from(wish.damping_ratio > 1.0 + REACHED)]
        },
        code: "spring.mass = <mass>; spring.stiffness = <stiffness>; spring.damping = <damping>",
        ..EQUATION
    },
    UiSpring {
        id: "css",
        name: "CSS linear()",
        keys: &[key("duration", 0.5), key("points", 50.0)],
        source: "drafts.csswg.org/css-easing-2/#the-linear-easing-function",
        version: "CSS Easing 2",
        evidence: "its text read",
        read: None,
        write: sampling,
        steps: Steps::Sampled,
        code: "transition: translate <duration>s linear(<curve>)",
        ..EQUATION
    },
    UiSpring {
        id: "compose",
        name: "Jetpack Compose",
        source: "androidx, compose/animation/animation-core: SpringSimulation.kt, FloatAnimationSpec.kt",
        version: "androidx 7a915f4",
        evidence: "its source read",
        code: "spring(dampingRatio = <dampingRatio>f, stiffness = <stiffness>f)",
        ..RATIO
    },
    UiSpring {
        id: "android",
        name: "Android SpringForce",
        keys: &[ratio("dampingRatio", 0.5), key("stiffness", 1500.0)],
        source: "androidx, dynamicanimation/dynamicanimation: SpringForce.java, AnimationHandler.java",
        version: "androidx fd79a56",
        evidence: "its source read",
        code: "new SpringForce(target).setDampingRatio(<dampingRatio>f).setStiffness(<stiffness>f)",
        ..RATIO
    },
    UiSpring {
        id: "flutter",
        name: "Flutter",
        source: "flutter, packages/flutter/lib/src/physics/spring_simulation.dart",
        version: "flutter 04fbdcf",
        evidence: "its source read",
        code: "SpringDescription(mass: <mass>, stiffness: <stiffness>, damping: <damping>)",
        ..EQUATION
    },
    UiSpring {
        id: "flutter-duration",
        name: "Flutter, duration and bounce",
        keys: &[milliseconds("duration", 0.5), bounce(0.0)],
        source: "flutter, packages/flutter/lib/src/physics/spring_simulation.dart; the duration in whole milliseconds",
        version: "flutter 04fbdcf",
        evidence: "its source read",
        read: Some(|values| BOUNCE.read.expect("it is read")(cut_to_milliseconds(values))),
        write: |wish| to_milliseconds((BOUNCE.write)(wish)),
        code: "SpringDescription.withDurationAndBounce(duration: Duration(milliseconds: <ms>), bounce: <bounce>)",
        ..BOUNCE
    },
    UiSpring {
        id: "react-spring",
        name: "react-spring",
        keys: &[key("mass", 1.0), key("tension", 170.0), ratio("friction", 26.0)],
        source: "react-spring, packages/core/src: SpringValue.ts, constants.ts; packages/rafz/src/index.ts",
        version: "10.1.2",
        evidence: "run",
        steps: Steps::Milliseconds,
        code: "config: { mass: <mass>, tension: <tension>, friction: <friction> }",
        ..EQUATION
    },
    UiSpring {
        id: "motion",
        name: "Motion",
        source: "motion, packages/motion-dom/src/animation/generators/spring.ts",
        version: "14.14.0",
        evidence: "run",
        departure: motion_cut,
        code: "transition: { type: \"spring\", mass: <mass>, stiffness: <stiffness>, damping: <damping> }",
        ..EQUATION
    },
    UiSpring {
        id: "motion-duration",
        name: "Motion, duration and bounce",
        keys: &[
            Key { range: [0.01, 10.0], wanted: "0.01 to 10", ..key("duration", 0.8) },
            Key { range: [-1.0, 1.0], wanted: "−1 to 1", ..bounce(0.3) },
        ],
        source: "motion, packages/motion-dom/src/animation/generators/spring.ts",
        version: "14.14.0",
        evidence: "run",
        read: Some(|[duration, bounce, ..]| {
            let ratio = match bounce < 0.0 {
                true => 1.0 / (1.0 + bounce).max(MOTION_LEAST),
                false => (1.0 - bounce).max(MOTION_LEAST),
            };
            wish(motion_omega(ratio, duration), ratio)
        }),
        write: |wish| {
            let ratio = wish.damping_ratio.clamp(MOTION_LEAST, 1.0 / MOTION_LEAST);
            let duration = motion_angle(ratio) / wish.omega();
            let bounce = if ratio > 1.0 { 1.0 / ratio - 1.0 } else { 1.0 - ratio };
            [duration.clamp(0.01, 10.0), bounce, 0.0, 0.0]
        },
        code: "transition: { type: \"spring\", duration: <duration>, bounce: <bounce> }",
        ..EQUATION
    },
    UiSpring {
        id: "slint",
        name: "Slint",
        keys: &[
            milliseconds("duration", 0.5),
            Key { range: [-1.0, 1.0], wanted: "−1 to 1", ..bounce(0.0) },
        ],
        source: "slint, internal/core: animations/simulations/spring.rs, animations.rs, properties/properties_animations.rs",
        version: "1.18.1",
        evidence: "its line compiled, its source read",
        read: Some(|values| {
            let [duration, bounce, ..] = cut_to_milliseconds(values);
            wish(TAU / duration, 1.0 - bounce)
        }),
        write: |wish| {
            let bounce = 1.0 - wish.damping_ratio.min(2.0);
            to_milliseconds([1.0 / wish.frequency_hz, bounce, 0.0, 0.0])
        },
        steps: Steps::WholeMilliseconds,
        departure: slint_departure,
        code: "animate x { easing: spring(<bounce:decimal>); duration: <ms>ms; }",
    },
    UiSpring {
        id: "gpui",
        name: "gpui",
        source: "zed, crates/gpui/src/spring.rs",
        version: "zed 7d54ea7",
        evidence: "its source read",
        code: "SpringConfig::new(<stiffness>, <damping>, <mass>)",
        ..EQUATION
    },
    UiSpring {
        id: "unity-smooth-damp",
        name: "Unity SmoothDamp",
        keys: &[key("smoothTime", 0.3)],
        source: "UnityCsReference, Runtime/Export/Math/Mathf.cs",
        version: "2020.2",
        evidence: "its source read",
        read: Some(|[smooth_time, ..]| wish(2.0 / smooth_time, 1.0)),
        write: |wish| [2.0 / wish.omega(), 0.0, 0.0, 0.0],
        steps: Steps::SmoothDamp,
        code: "x = Mathf.SmoothDamp(x, target, ref velocity, <smoothTime>f);",
        ..EQUATION
    },
    UiSpring {
        id: "per-frame",
        name: "two lines of your own, once a frame",
        source: "semi-implicit Euler with the force of the start of the frame",
        steps: Steps::PerFrame,
        code: "v += (<stiffness> * (target - x) - <damping> * v) / <mass> * dt; x += v * dt;",
        ..EQUATION
    },
];

/// Smallest damping ratio that Motion derives from a bounce. Its reciprocal is the largest one.
const MOTION_LEAST: f64 = 0.05;
/// Number of Newton steps with which Motion finds a frequency.
const MOTION_STEPS: u32 = 11;
/// Angle ω √(ζ² − 1) t at which Motion cuts a spring with a mass, and the ω √(ζ² − 1) in rad/s from which on it does
/// so.
const MOTION_CUT: f64 = 300.0;
const MOTION_CUT_FROM: f64 = 1000.0;
/// Smallest damping ratio of Slint after the duration, and the excess over 1 that Slint leaves alone.
const SLINT_LEAST: f64 = 0.13;
const SLINT_CRITICAL: f64 = 1e-3;
/// A motion is over once the fraction of the way that is left is at most this.
const OVER: f64 = 1e-3;
/// Error that points should stay below, as a fraction of the way, and maximum number of points.
const SAMPLED: f64 = 5e-3;
const MAX_POINTS: f64 = 100.0;

fn wish(omega: f64, damping_ratio: f64) -> Wish {
    Wish { frequency_hz: omega / TAU, damping_ratio, mass_kg: 1.0 }
}

/// Rounds the duration to milliseconds, as code gives it.
fn to_milliseconds([seconds, rest @ ..]: Values) -> Values {
    let [second, third, fourth] = rest;
    [(1e3 * seconds).round().max(1.0) / 1e3, second, third, fourth]
}

/// Cuts the duration to milliseconds, as the library reads it.
fn cut_to_milliseconds([seconds, rest @ ..]: Values) -> Values {
    let [second, third, fourth] = rest;
    // The addition restores a whole number that rounding has lowered.
    [libm::floor(1e3 * seconds + 1e-6) / 1e3, second, third, fourth]
}

/// Returns the angle ω t at which a spring with a damping ratio of 1 or more has [`OVER`] of its way left.
fn angle_of(ratio: f64) -> f64 {
    bisect([0.0, 40.0 * ratio], HALVINGS, |angle| part_left(ratio, angle) > OVER)[0]
}

/// Returns the angle ω t at which Motion considers a spring settled. Below critical damping, ζ / √(1 − ζ²) exp(−ζ ω t)
/// is [`OVER`] at this angle.
fn motion_angle(ratio: f64) -> f64 {
    match ratio < 1.0 {
        true => -libm::log(OVER * libm::sqrt(1.0 - ratio * ratio) / ratio) / ratio,
        false => motion_overdamped_angle(ratio, angle_of(1.0)),
    }
}

/// Returns the angular frequency that Motion finds for a duration. Near critical damping, Motion's few Newton steps do
/// not suffice.
fn motion_omega(ratio: f64, duration: f64) -> f64 {
    if ratio >= 1.0 {
        return motion_angle(ratio) / duration;
    }
    let scale = ratio / libm::sqrt(1.0 - ratio * ratio);
    (0..MOTION_STEPS).fold(5.0 / duration, |omega, _| {
        let left = scale * libm::exp(-ratio * omega * duration);
        omega - (OVER - left) / (ratio * duration * left)
    })
}

/// Returns the angle ω t at which a spring with a damping ratio above 1 has as much left as a critically damped spring
/// at `critical`.
fn motion_overdamped_angle(ratio: f64, critical: f64) -> f64 {
    if ratio <= 1.0 {
        return critical;
    }
    let apart = libm::sqrt(ratio * ratio - 1.0);
    let (slow, fast) = (ratio - apart, ratio + apart);
    let target = 2.0 * apart * libm::exp(-critical) * (1.0 + critical);
    (0..MOTION_STEPS).fold(critical, |angle, _| {
        let [of_slow, of_fast] = [slow, fast].map(|rate| libm::exp(-rate * angle));
        angle - (fast * of_slow - slow * of_fast - target) / (of_fast - of_slow)
    })
}

/// Returns the point at which Motion makes a stiff, heavily damped spring jump to its end.
fn motion_cut(told: &Wish) -> Option<Departure> {
    let ratio = told.damping_ratio;
    let apart = libm::sqrt((ratio * ratio - 1.0).max(0.0));
    let left = part_left(ratio, MOTION_CUT / apart);
    (apart * told.omega() >= MOTION_CUT_FROM && left > OVER).then(|| Departure {
        at_s: MOTION_CUT / apart / told.omega(),
        left,
        damping_ratio: None,
    })
}

/// Returns the point at which Slint changes a spring that does not rest after its duration, the period.
fn slint_departure(told: &Wish) -> Option<Departure> {
    let ratio = told.damping_ratio;
    let later = if ratio >= 1.0 + SLINT_CRITICAL { 1.0 } else { ratio.max(SLINT_LEAST) };
    let departure = Departure {
        at_s: 1.0 / told.frequency_hz,
        left: part_left(ratio, TAU).abs(),
        damping_ratio: Some(later),
    };
    (later != ratio).then_some(departure)
}

/// Returns the duration in seconds after which less than [`OVER`] is left, and the number of points that is enough for
/// [`SAMPLED`].
fn sampling(wish: &Wish) -> Values {
    let ratio = wish.damping_ratio;
    let angle = match ratio < 1.0 {
        true => -libm::log(OVER * libm::sqrt(1.0 - ratio * ratio)) / ratio,
        false => angle_of(ratio),
    };
    // The error of a straight line is an eighth of the curvature, which is at most 1, times the square of the line's
    // length.
    let points = libm::ceil(angle / libm::sqrt(8.0 * SAMPLED)) + 1.0;
    [angle / wish.omega(), points.clamp(2.0, MAX_POINTS), 0.0, 0.0]
}
