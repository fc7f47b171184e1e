//! One card for each user-interface spring, with the meaning of its numbers in its library.

use std::f64::consts::TAU;

use super::ends::{Rest, adwaita_s, anime_s, envelope_s};
use super::numbers::{
    ANDROID_REST, ANIME_MOST, COMPOSE_REST, MOTION_LEAST, REANIMATED_LONGER, at_most_critical,
    bouncy, cut_to_milliseconds, equation, friction_without_bounce, motion_angle, motion_cut,
    motion_omega, origami, qt, reanimated, sampling, slint_departure, to_milliseconds, to_origami,
    wish,
};
use super::{HALVINGS, KICK_S, Key, Steps, Switch, UiSpring};
use crate::port::{REACHED, Wish};
use crate::sim::integrators::{QtSpring, ReactSpring, Reanimated};
use crate::sim::numerics::bisect;

const fn key(name: &'static str, usual: f64) -> Key {
    ranged(name, usual, [f64::MIN_POSITIVE, f64::MAX], "above 0")
}

const fn ranged(name: &'static str, usual: f64, range: [f64; 2], wanted: &'static str) -> Key {
    Key { name, usual, range, wanted, switch: None }
}

const fn ratio(name: &'static str, usual: f64) -> Key {
    ranged(name, usual, [0.0, f64::MAX], "0 or more")
}

const fn bounce(usual: f64) -> Key {
    ranged("bounce", usual, [f64::EPSILON - 1.0, 1.0], "above −1 and at most 1")
}

/// Returns a duration in seconds that the library takes as whole milliseconds.
const fn milliseconds(name: &'static str, usual: f64) -> Key {
    ranged(name, usual, [1e-3, f64::MAX], "0.001 or more")
}

const ALLOWS_OVERDAMPING: Key = ranged("allowsOverdamping", 0.0, [0.0, 1.0], "true or false");
/// Flutter leaves the distance at the end.
const FLUTTER_REST: Rest = Rest::When(|frame| frame.is_within(1e-3, 1e-3));
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
    read: Some(equation),
    limited: None,
    write: |wish| {
        let [stiffness, damping] = wish.joint().map(|per_kg| per_kg * wish.mass_kg);
        [wish.mass_kg, stiffness, damping, 0.0]
    },
    steps: Steps::Exact,
    departure: |_| None,
    rest: Rest::Never,
    code: "",
};

/// A spring that is critically damped at most, with a switch against it.
const OVERDAMPING: UiSpring = UiSpring {
    limited: Some(|values| match values[3] == 1.0 {
        true => equation(values),
        false => at_most_critical(equation(values)),
    }),
    write: |wish| {
        let [mass_kg, stiffness, damping, _] = (EQUATION.write)(wish);
        [mass_kg, stiffness, damping, f64::from(wish.damping_ratio > 1.0 + REACHED)]
    },
    ..EQUATION
};

/// A spring with a mass that is critically damped at most.
const CRITICAL: UiSpring = UiSpring {
    keys: &[MASS, STIFFNESS, key("damping", 10.0)],
    limited: Some(|values| at_most_critical(equation(values))),
    ..EQUATION
};

/// A spring of React Native's Animated.
const REACT_NATIVE: UiSpring = UiSpring {
    source: "react-native, packages/react-native/Libraries/Animated: SpringConfig.js, animations/SpringAnimation.js",
    version: "react-native 4bda59e",
    evidence: "its source read",
    rest: Rest::When(|frame| frame.is_within(1e-3, 1e-3)),
    ..CRITICAL
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

/// A spring of Reanimated.
const REANIMATED: UiSpring = UiSpring {
    source: "react-native-reanimated, packages/react-native-reanimated/src/animation/spring: spring.ts, springUtils.ts",
    version: "4.8.0",
    evidence: "run",
    rest: Rest::When(|frame| frame.has_energy(Reanimated::REST)),
    ..CRITICAL
};

/// A spring whose velocity is per 1/60 s, and changes once a frame.
const SVELTE: UiSpring = UiSpring {
    keys: &[key("stiffness", 0.15), ratio("damping", 0.8)],
    evidence: "run",
    read: Some(|[stiffness, damping, ..]| {
        Wish::of_joint([stiffness / KICK_S / KICK_S, damping / KICK_S], 1.0)
    }),
    write: |wish| {
        let [stiffness, damping] = wish.joint();
        [stiffness * KICK_S * KICK_S, damping * KICK_S, 0.0, 0.0]
    },
    steps: Steps::Kick(f64::INFINITY),
    rest: Rest::When(|frame| frame.is_slow(0.01)),
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
                switch: Some(Switch {
                    code: "spring.allowsOverdamping = true",
                    note: "allowsOverdamping is of iOS 17 and macOS 14; before, and without it, it is critically damped",
                }),
                ..ALLOWS_OVERDAMPING
            },
        ],
        source: "developer.apple.com/documentation/quartzcore/caspringanimation; UISpringTimingParameters has the first three",
        version: "iOS 17",
        evidence: "its documentation read",
        code: "spring.mass = <mass>; spring.stiffness = <stiffness>; spring.damping = <damping>",
        ..OVERDAMPING
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
        rest: Rest::After(|_, [duration, ..]| duration),
        code: "transition: translate <duration>s linear(<curve>)",
        ..EQUATION
    },
    UiSpring {
        id: "compose",
        name: "Jetpack Compose",
        source: "androidx, compose/animation/animation-core: SpringSimulation.kt, FloatAnimationSpec.kt",
        version: "androidx 7a915f4",
        evidence: "its source read",
        rest: Rest::After(|motion, _| libm::floor(1e3 * envelope_s(motion, COMPOSE_REST)) / 1e3),
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
        rest: Rest::When(|frame| frame.is_within(ANDROID_REST, 62.5 * ANDROID_REST)),
        code: "new SpringForce(target).setDampingRatio(<dampingRatio>f).setStiffness(<stiffness>f)",
        ..RATIO
    },
    UiSpring {
        id: "flutter",
        name: "Flutter",
        source: "flutter, packages/flutter/lib/src/physics/spring_simulation.dart",
        version: "flutter 04fbdcf",
        evidence: "its source read",
        rest: FLUTTER_REST,
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
        rest: FLUTTER_REST,
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
        rest: Rest::When(|frame| frame.is_within(ReactSpring::REST, 100.0 * ReactSpring::REST)),
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
        rest: Rest::When(|frame| frame.is_within(5e-3, 0.01)),
        code: "transition: { type: \"spring\", mass: <mass>, stiffness: <stiffness>, damping: <damping> }",
        ..EQUATION
    },
    UiSpring {
        id: "motion-duration",
        name: "Motion, duration and bounce",
        keys: &[
            ranged("duration", 0.8, [0.01, 10.0], "0.01 to 10"),
            ranged("bounce", 0.3, [-1.0, 1.0], "−1 to 1"),
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
        rest: Rest::After(|_, [duration, ..]| duration),
        code: "transition: { type: \"spring\", duration: <duration>, bounce: <bounce> }",
        ..EQUATION
    },
    UiSpring {
        id: "slint",
        name: "Slint",
        keys: &[milliseconds("duration", 0.5), ranged("bounce", 0.0, [-1.0, 1.0], "−1 to 1")],
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
        rest: Rest::When(|frame| frame.is_within(1e-3, 0.05)),
        code: "animate x { easing: spring(<bounce:decimal>); duration: <ms>ms; }",
        ..EQUATION
    },
    UiSpring {
        id: "gpui",
        name: "gpui",
        source: "zed, crates/gpui/src/spring.rs",
        version: "zed 7d54ea7",
        evidence: "its source read",
        rest: Rest::When(|frame| frame.is_within(1e-3, 1e-3 * frame.omega)),
        code: "SpringConfig::new(<stiffness>, <damping>, <mass>)",
        ..EQUATION
    },
    UiSpring {
        id: "popmotion",
        name: "Popmotion",
        source: "popmotion, packages/popmotion/src/animations/generators/spring.ts",
        version: "11.0.5",
        evidence: "run",
        rest: Rest::When(|frame| frame.is_within(0.01, 2.0)),
        code: "animate({ type: \"spring\", mass: <mass>, stiffness: <stiffness>, damping: <damping> })",
        ..EQUATION
    },
    UiSpring {
        id: "react-native",
        name: "React Native, tension and friction",
        keys: &[
            ranged("tension", 40.0, [-194.0 / 3.62 + 30.0 + 1e-9, f64::MAX], "above −23.59"),
            ranged("friction", 7.0, [-1.0 / 3.0 + 1e-9, f64::MAX], "above −0.3333"),
        ],
        read: Some(origami),
        limited: Some(|values| at_most_critical(origami(values))),
        write: to_origami,
        code: "Animated.spring(x, { toValue, tension: <tension>, friction: <friction> })",
        ..REACT_NATIVE
    },
    UiSpring {
        id: "react-native-bounciness",
        name: "React Native, speed and bounciness",
        keys: &[
            ranged("speed", 12.0, [-4.1, f64::MAX], "−4.1 or more"),
            ranged("bounciness", 8.0, [-1e6, 42.5], "at most 42.5"),
        ],
        read: Some(bouncy),
        limited: Some(|values| at_most_critical(bouncy(values))),
        write: |wish| {
            let [tension, friction, ..] = to_origami(wish);
            let least = friction_without_bounce(tension);
            let part = 1.0 - libm::sqrt(1.0 - (friction - least) / (0.01 - least));
            [34.0 * (tension - 0.5) / 199.5, 42.5 * part, 0.0, 0.0]
        },
        code: "Animated.spring(x, { toValue, speed: <speed>, bounciness: <bounciness> })",
        ..REACT_NATIVE
    },
    UiSpring {
        id: "react-native-stiffness",
        name: "React Native, stiffness and damping",
        code: "Animated.spring(x, { toValue, mass: <mass>, stiffness: <stiffness>, damping: <damping> })",
        ..REACT_NATIVE
    },
    UiSpring {
        id: "reanimated",
        name: "Reanimated",
        keys: &[key("mass", 4.0), key("stiffness", 900.0), key("damping", 120.0)],
        code: "withSpring(target, { mass: <mass>, stiffness: <stiffness>, damping: <damping> })",
        ..REANIMATED
    },
    UiSpring {
        id: "reanimated-duration",
        name: "Reanimated, duration and damping ratio",
        keys: &[milliseconds("duration", 0.55), key("dampingRatio", 1.0)],
        read: Some(reanimated),
        limited: Some(|values| at_most_critical(reanimated(values))),
        write: |wish| {
            let ratio = wish.damping_ratio.min(1.0);
            let energy =
                |y: f64| libm::exp(-2.0 * y) * ((1.0 + y) * (1.0 + y) + ratio * ratio * y * y);
            let y = bisect([0.0, 100.0], HALVINGS, |y| energy(y) > Reanimated::REST)[1];
            let duration = y / ratio / wish.omega() / REANIMATED_LONGER;
            to_milliseconds([duration, ratio, 0.0, 0.0])
        },
        code: "withSpring(target, { duration: <ms>, dampingRatio: <dampingRatio> })",
        ..REANIMATED
    },
    UiSpring {
        id: "remotion",
        name: "Remotion",
        source: "remotion, packages/core/src/spring/spring-utils.ts",
        version: "remotion 1529843",
        evidence: "its source read",
        code: "spring({ frame, fps, config: { mass: <mass>, stiffness: <stiffness>, damping: <damping> } })",
        ..CRITICAL
    },
    UiSpring {
        id: "anime",
        name: "anime.js",
        source: "anime, src/easings/spring/index.js",
        version: "4.5.0",
        evidence: "run",
        limited: Some(|[mass_kg, stiffness, damping, _]| {
            equation([mass_kg.max(1.0), stiffness.min(ANIME_MOST), damping.min(ANIME_MOST), 0.0])
        }),
        write: |wish| (EQUATION.write)(&Wish { mass_kg: wish.mass_kg.max(1.0), ..*wish }),
        rest: Rest::After(anime_s),
        code: "ease: spring({ mass: <mass>, stiffness: <stiffness>, damping: <damping> })",
        ..EQUATION
    },
    UiSpring {
        id: "wobble",
        name: "wobble",
        keys: &[
            MASS,
            STIFFNESS,
            key("damping", 10.0),
            Key {
                switch: Some(Switch {
                    code: "spring.updateConfig({ allowsOverdamping: true })",
                    note: "without allowsOverdamping it is critically damped",
                }),
                ..ALLOWS_OVERDAMPING
            },
        ],
        source: "wobble, src/index.ts",
        version: "1.5.1",
        evidence: "run",
        rest: Rest::When(|frame| frame.is_within(1e-3, 1.0)),
        code: "new Spring({ mass: <mass>, stiffness: <stiffness>, damping: <damping> })",
        ..OVERDAMPING
    },
    UiSpring {
        id: "svelte",
        name: "Svelte Spring",
        source: "svelte, packages/svelte/src/motion/spring.js",
        version: "5.57.3",
        steps: Steps::Kick(1.0 / 30.0),
        code: "new Spring(0, { stiffness: <stiffness>, damping: <damping> })",
        ..SVELTE
    },
    UiSpring {
        id: "solid",
        name: "Solid spring",
        source: "solid-primitives, packages/spring/src/index.ts",
        version: "0.1.2",
        code: "createSpring(0, { stiffness: <stiffness>, damping: <damping> })",
        ..SVELTE
    },
    UiSpring {
        id: "libadwaita",
        name: "libadwaita",
        keys: &[ratio("damping_ratio", 1.0), MASS, STIFFNESS],
        source: "libadwaita, src/adw-spring-animation.c",
        version: "1.2.2",
        evidence: "run",
        read: Some(|[ratio, mass_kg, stiffness, _]| Wish {
            mass_kg,
            ..wish(libm::sqrt(stiffness / mass_kg), ratio)
        }),
        write: |wish| [wish.damping_ratio, wish.mass_kg, wish.joint()[0] * wish.mass_kg, 0.0],
        steps: Steps::WholeMilliseconds,
        rest: Rest::After(|motion, _| adwaita_s(motion, 1e-3)),
        code: "adw_spring_params_new(<damping_ratio>, <mass>, <stiffness>)",
        ..EQUATION
    },
    UiSpring {
        id: "niri",
        name: "niri",
        keys: &[
            ranged("damping-ratio", 1.0, [0.1, 10.0], "0.1 to 10"),
            ranged("stiffness", 800.0, [1.0, f64::MAX], "1 or more"),
            ranged("epsilon", 1e-4, [1e-5, 0.1], "0.00001 to 0.1"),
        ],
        source: "niri, src/animation/spring.rs",
        version: "niri 0486fc3",
        evidence: "its source read",
        write: |wish| {
            let stiffness = (wish.omega() * wish.omega()).round().max(1.0);
            [wish.damping_ratio.clamp(0.1, 10.0), stiffness, 1e-4, 0.0]
        },
        rest: Rest::After(|motion, [.., epsilon, _]| adwaita_s(motion, epsilon)),
        steps: Steps::Exact,
        code: "spring damping-ratio=<damping-ratio:decimal> stiffness=<stiffness:decimal> epsilon=<epsilon:decimal>",
        ..RATIO
    },
    UiSpring {
        id: "hyprland",
        name: "Hyprland",
        keys: &[MASS, key("stiffness", 250.0), ratio("dampening", 25.0)],
        source: "hyprutils, src/animation: Spring.cpp, AnimatedVariable.cpp",
        version: "hyprutils 0.14.0",
        evidence: "its source read",
        rest: Rest::When(|frame| frame.is_within(1e-3, 1e-3)),
        code: "hl.curve(\"NAME\", { type = \"spring\", mass = <mass>, stiffness = <stiffness>, dampening = <dampening> })",
        ..EQUATION
    },
    UiSpring {
        id: "qt",
        name: "Qt SpringAnimation",
        keys: &[key("spring", 2.0), ratio("damping", 0.0), MASS],
        source: "qtdeclarative, src/quick/util/qquickspringanimation.cpp",
        version: "6.12.0",
        evidence: "run",
        read: Some(qt),
        limited: Some(|[spring, damping, mass, _]| qt([spring, damping.min(1.0), mass, 0.0])),
        write: |wish| {
            let [spring, damping] =
                wish.joint().map(|per_kg| per_kg * wish.mass_kg * QtSpring::STEP_S);
            [spring, damping.min(1.0), wish.mass_kg, 0.0]
        },
        steps: Steps::Sixteen,
        rest: Rest::When(|frame| frame.is_within(QtSpring::REST, QtSpring::REST)),
        code: "SpringAnimation { spring: <spring>; damping: <damping>; mass: <mass> }",
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
