//! The conversions between the numbers of a library and a motion.

use std::f64::consts::TAU;

use super::ends::{envelope_s, settled_angle};
use super::{Departure, Values, part_left};
use crate::port::Wish;
use crate::sim::integrators::{QtSpring, Reanimated};

/// Smallest damping ratio that Motion derives from a bounce. Its reciprocal is the largest one.
pub(super) const MOTION_LEAST: f64 = 0.05;
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

/// Distance that Compose takes for the end, as a fraction of the way.
pub(super) const COMPOSE_REST: f64 = 0.01;
/// Distance that Android takes for the end of an alpha, as a fraction of the way.
pub(super) const ANDROID_REST: f64 = 0.75 / 256.0;
/// Real duration of Reanimated's springs, in units of the given one.
pub(super) const REANIMATED_LONGER: f64 = 1.5;
/// Mass and largest stiffness in Reanimated's search for a duration, and its iterations.
const REANIMATED_MASS: f64 = 4.0;
const REANIMATED_STIFFEST: f64 = 8e3;
const REANIMATED_STEPS: u32 = 100;
/// Largest stiffness and damping of anime.js.
pub(super) const ANIME_MOST: f64 = 1e4;

pub(super) fn equation([mass_kg, stiffness, damping, _]: Values) -> Wish {
    Wish::of_joint([stiffness / mass_kg, damping / mass_kg], mass_kg)
}

pub(super) fn at_most_critical(wish: Wish) -> Wish {
    Wish { damping_ratio: wish.damping_ratio.min(1.0), ..wish }
}

pub(super) fn qt([spring, damping, mass, _]: Values) -> Wish {
    equation([mass, spring / QtSpring::STEP_S, damping / QtSpring::STEP_S, 0.0])
}

/// Returns the motion of React Native's tension and friction.
pub(super) fn origami([tension, friction, ..]: Values) -> Wish {
    equation([1.0, (tension - 30.0) * 3.62 + 194.0, (friction - 8.0) * 3.0 + 25.0, 0.0])
}

/// Returns React Native's tension and friction for a motion.
pub(super) fn to_origami(wish: &Wish) -> Values {
    let [stiffness, damping] = wish.joint();
    [(stiffness - 194.0) / 3.62 + 30.0, (damping - 25.0) / 3.0 + 8.0, 0.0, 0.0]
}

/// Returns the friction with which React Native does not bounce.
pub(super) fn friction_without_bounce(tension: f64) -> f64 {
    let [third, second, first, none] = match tension {
        x if x <= 18.0 => [7e-4, -0.031, 0.64, 1.28],
        x if x <= 44.0 => [4.4e-5, -0.006, 0.36, 2.0],
        _ => [4.5e-7, -3.32e-4, 0.1078, 5.84],
    };
    ((third * tension + second) * tension + first) * tension + none
}

/// Returns the motion of React Native's speed and bounciness.
pub(super) fn bouncy([speed, bounciness, ..]: Values) -> Wish {
    let (tension, part) = (0.5 + speed / 34.0 * 199.5, bounciness / 42.5);
    let least = friction_without_bounce(tension);
    origami([tension, least + (0.01 - least) * part * (2.0 - part), 0.0, 0.0])
}

/// Returns the motion that Reanimated finds for a duration and a damping ratio, by its bisection of the stiffness.
pub(super) fn reanimated(values: Values) -> Wish {
    let [duration, ratio, ..] = cut_to_milliseconds(values);
    let omega = |stiffness: f64| libm::sqrt(stiffness / REANIMATED_MASS);
    let energy = |stiffness: f64| {
        let y = ratio * omega(stiffness) * REANIMATED_LONGER * duration;
        libm::exp(-2.0 * y) * ((1.0 + y) * (1.0 + y) + ratio * ratio * y * y) - Reanimated::REST
    };
    let (mut low, mut high) = (f64::EPSILON, REANIMATED_STIFFEST);
    let mut stiffness = (low + high) / 2.0;
    for _ in 0..REANIMATED_STEPS {
        if energy(stiffness).abs() <= 1e-3 * Reanimated::REST {
            break;
        }
        *(if energy(stiffness) > 0.0 { &mut low } else { &mut high }) = stiffness;
        stiffness = (low + high) / 2.0;
    }
    Wish { mass_kg: REANIMATED_MASS, ..wish(omega(stiffness), ratio) }
}

pub(super) fn wish(omega: f64, damping_ratio: f64) -> Wish {
    Wish { frequency_hz: omega / TAU, damping_ratio, mass_kg: 1.0 }
}

/// Rounds the duration to milliseconds, as code gives it.
pub(super) fn to_milliseconds([seconds, rest @ ..]: Values) -> Values {
    let [second, third, fourth] = rest;
    [(1e3 * seconds).round().max(1.0) / 1e3, second, third, fourth]
}

/// Cuts the duration to milliseconds, as the library reads it.
pub(super) fn cut_to_milliseconds([seconds, rest @ ..]: Values) -> Values {
    let [second, third, fourth] = rest;
    // The addition restores a whole number that rounding has lowered.
    [libm::floor(1e3 * seconds + 1e-6) / 1e3, second, third, fourth]
}

/// Returns the angle ω t at which Motion considers a spring settled. Below critical damping, ζ / √(1 − ζ²) exp(−ζ ω t)
/// is [`OVER`] at this angle.
pub(super) fn motion_angle(ratio: f64) -> f64 {
    match ratio < 1.0 {
        true => -libm::log(OVER * libm::sqrt(1.0 - ratio * ratio) / ratio) / ratio,
        false => motion_overdamped_angle(ratio, settled_angle(1.0, OVER)),
    }
}

/// Returns the angular frequency that Motion finds for a duration. Near critical damping, Motion's few Newton steps do
/// not suffice.
pub(super) fn motion_omega(ratio: f64, duration: f64) -> f64 {
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
pub(super) fn motion_cut(told: &Wish) -> Option<Departure> {
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
pub(super) fn slint_departure(told: &Wish) -> Option<Departure> {
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
pub(super) fn sampling(wish: &Wish) -> Values {
    let angle = envelope_s(wish, OVER) * wish.omega();
    // The error of a straight line is an eighth of the curvature, which is at most 1, times the square of the line's
    // length.
    let points = libm::ceil(angle / libm::sqrt(8.0 * SAMPLED)) + 1.0;
    [angle / wish.omega(), points.clamp(2.0, MAX_POINTS), 0.0, 0.0]
}
