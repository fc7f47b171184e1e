//! The end of a motion: the rule by which a library takes it for at rest, and the distance left at that time.

use super::{HALVINGS, StepMap, Steps, UiSpring, Values, left_at, part_left};
use crate::port::Wish;
use crate::sim::integrators::{QtSpring, ReactSpring};
use crate::sim::numerics::bisect;
use nalgebra::Vector2;

/// The rule by which a library ends a motion over a way of 1.
#[derive(Clone, Copy, Debug)]
pub(super) enum Rest {
    /// The library has no rule, or does not publish it.
    Never,
    /// The motion ends at the first frame or step that satisfies this.
    When(fn(&Frame) -> bool),
    /// The motion ends at the first frame from this time on, in seconds.
    After(fn(&Wish, Values) -> f64),
}

/// A frame, or a step of a library that makes several in a frame.
pub(super) struct Frame {
    /// Fraction of the way left, here and at the frame before.
    left: f64,
    before: f64,
    /// Speed, as fractions of the way per second.
    speed: f64,
    /// Angular frequency of the motion, in rad/s.
    pub(super) omega: f64,
}

impl Frame {
    /// Whether the distance and the speed are at most these.
    pub(super) fn is_within(&self, left: f64, speed: f64) -> bool {
        self.left.abs() <= left && self.speed.abs() <= speed
    }

    /// Whether the distance before the frame and the move in it are below this.
    pub(super) fn is_slow(&self, precision: f64) -> bool {
        self.before.abs() < precision && (self.before - self.left).abs() < precision
    }

    /// Whether the energy is at most this part of that at the start.
    pub(super) fn has_energy(&self, part: f64) -> bool {
        let speed = self.speed / self.omega;
        self.left * self.left + speed * speed <= part
    }
}

/// The end of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// Time of the frame that shows the target, in seconds after the start.
    pub at_s: f64,
    /// Fraction of the way that the motion still has left at that time.
    pub left: f64,
}

/// Fractions of the way within which a settled motion stays.
pub const SETTLED: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// Returns the time in seconds from which on a motion from rest has at most this fraction of the way left; infinite
/// without damping.
pub fn settled_s(wish: &Wish, part: f64) -> f64 {
    settled_angle(wish.damping_ratio, part) / wish.omega()
}

/// Returns the angle ω t from which on at most this fraction of the way is left.
pub(super) fn settled_angle(ratio: f64, part: f64) -> f64 {
    if ratio <= 0.0 {
        return f64::INFINITY;
    }
    let is_out = |angle: f64| part_left(ratio, angle).abs() > part;
    if ratio >= 1.0 {
        // The slow part of the motion decays by 1 / (2 ζ) or faster.
        return bisect([0.0, 2.0 * ratio * (2.0 - libm::log(part))], HALVINGS, is_out)[1];
    }
    let half_turn = std::f64::consts::PI / libm::sqrt(1.0 - ratio * ratio);
    // The farthest point of a half turn is at its start.
    let last = libm::floor(-libm::log(part) / ratio / half_turn) * half_turn;
    bisect([last, last + half_turn], HALVINGS, is_out)[1]
}

/// Returns the time in seconds at which the envelope of a swing is at this part, or at which a motion without a swing
/// is.
pub(super) fn envelope_s(wish: &Wish, part: f64) -> f64 {
    let ratio = wish.damping_ratio;
    match ratio < 1.0 {
        true => -libm::log(part * libm::sqrt(1.0 - ratio * ratio)) / ratio / wish.omega(),
        false => settled_s(wish, part),
    }
}

/// Step of the slope in libadwaita's search for the end of an overdamped motion, in seconds, and its iterations.
const SLOPE_S: f64 = 1e-3;
const ITERATIONS: usize = 1000;

/// Returns the duration in seconds that libadwaita estimates: the time at which exp(-ζ ω t) is `epsilon` or, above
/// critical damping, the first of Newton's steps towards the target that is as near.
pub(super) fn adwaita_s(wish: &Wish, epsilon: f64) -> f64 {
    let (omega, ratio) = (wish.omega(), wish.damping_ratio);
    let first = -libm::log(epsilon) / ratio / omega;
    if (ratio - 1.0) * omega <= f64::from(f32::EPSILON) {
        return first;
    }
    let left = |t: f64| part_left(ratio, omega * t);
    let newton = |t: &f64| Some(t - left(*t) * SLOPE_S / (left(t + SLOPE_S) - left(*t)));
    let steps = std::iter::successors(newton(&first), newton).take(ITERATIONS);
    steps.into_iter().find(|t| left(*t).abs() <= epsilon).unwrap_or(0.0)
}

/// Step in which anime.js looks for the end, in seconds, the distance that counts as rest, and the steps of rest.
const ANIME_STEP_S: f64 = 0.02;
const ANIME_REST: f64 = 5e-4;
const ANIME_STEPS: usize = 11;
/// Largest number of such steps.
const ANIME_LONGEST: usize = 3000;

/// Returns the duration in seconds that anime.js finds.
pub(super) fn anime_s(wish: &Wish, _: Values) -> f64 {
    let mut resting = 0;
    let is_over = |step: &usize| {
        let left = part_left(wish.damping_ratio, wish.omega() * ANIME_STEP_S * *step as f64);
        resting = if left.abs() < ANIME_REST { resting + 1 } else { 0 };
        resting == ANIME_STEPS
    };
    let step = (0..ANIME_LONGEST).find(is_over).unwrap_or(ANIME_LONGEST);
    ANIME_STEP_S * step as f64
}

/// Longest run in seconds, and maximum number of its frames.
const LONGEST_S: f64 = 60.0;
const MAX_FRAMES: f64 = 20_000.0;
/// Tolerance of a frame's time, in seconds, against rounding.
const ROUNDING_S: f64 = 1e-9;

impl UiSpring {
    /// Returns the fraction of the way left at each frame of a run from rest with these values, and the end.
    ///
    /// # Errors
    /// As [`UiSpring::read`].
    pub fn run(&self, values: &[f64], frame_hz: f64) -> Result<(Vec<f64>, Option<End>), String> {
        Ok(self.frames(&self.read(values)?, super::all_values(values), frame_hz))
    }

    /// Returns the end of this motion, if the library's rule ends it.
    pub(super) fn end(&self, motion: &Wish, values: Values, frame_hz: f64) -> Option<End> {
        match ((self.departure)(motion), self.rest) {
            (_, Rest::Never) => None,
            (None, _) => self.frames(motion, values, frame_hz).1,
            // The motion leaves the closed form, and jumps to its end.
            (Some(cut), _) if cut.damping_ratio.is_none() => {
                Some(End { at_s: cut.at_s, left: cut.left })
            }
            _ => None,
        }
    }

    fn frames(&self, motion: &Wish, values: Values, frame_hz: f64) -> (Vec<f64>, Option<End>) {
        let (omega, ratio) = (motion.omega(), motion.damping_ratio);
        let map = self.map(motion, frame_hz);
        let after_s = match self.rest {
            Rest::After(seconds) => seconds(motion, values) - ROUNDING_S,
            _ => f64::INFINITY,
        };
        let whole = |seconds: f64, step_s: f64| libm::floor(seconds / step_s + ROUNDING_S) as u32;
        let (mut state, mut shown) = (Vector2::new(1.0, 0.0), vec![1.0]);
        for number in 1..=(LONGEST_S * frame_hz).min(MAX_FRAMES) as u32 {
            let [last_s, at_s] = [number - 1, number].map(|n| f64::from(n) / frame_hz);
            let steps = match self.steps {
                Steps::Milliseconds if number == 1 => ReactSpring::FIRST_STEPS,
                Steps::Milliseconds => ReactSpring::steps(1.0 / frame_hz),
                Steps::Sixteen => QtSpring::steps(at_s) - QtSpring::steps(last_s),
                _ => 1.0,
            };
            for _ in 0..steps as u32 {
                let last = state;
                state = match (&map, self.steps) {
                    (Some(StepMap { map, .. }), _) => map * state,
                    (None, steps) => {
                        let is_whole = matches!(steps, Steps::WholeMilliseconds);
                        let t = if is_whole { f64::from(whole(at_s, 1e-3)) * 1e-3 } else { at_s };
                        let [left, slope] = left_at(ratio, omega * t);
                        Vector2::new(left, slope * omega)
                    }
                };
                // react-spring looks before its step.
                let seen = if matches!(self.steps, Steps::Milliseconds) { last } else { state };
                let frame = Frame { left: seen.x, before: last.x, speed: seen.y, omega };
                let is_over = match self.rest {
                    Rest::When(rests) => rests(&frame),
                    _ => at_s >= after_s,
                };
                if is_over {
                    shown.push(0.0);
                    // The last line between points ends at the target.
                    let left = if matches!(self.steps, Steps::Sampled) { 0.0 } else { seen.x };
                    return (shown, Some(End { at_s, left }));
                }
            }
            shown.push(state.x);
        }
        (shown, None)
    }
}
