//! What the lines with which a game moves a value once a frame do at every frame rate.
//!
//! A linear rule of up to two carried numbers is a map of them: its eigenvalues are what a player sees, and its powers,
//! also between whole ones, are the motion at any frame rate. Of a rule that is not linear the same is told of small
//! motions about its rest.

use std::sync::Arc;

use nalgebra::{Matrix2, Vector2};

use super::port::seen::{seen, spectral_radius};
use super::port::{Approach, Wish};
use crate::sim::law::{ExpressionFault, Frame, Powers, Remedy, StepText, remembers_place};
use crate::sim::numerics::bisect;
use crate::tools::identify::Effective;

pub use any_rate::RuleCode;
pub use scene::rule_scene;

mod any_rate;
mod scene;

/// The frame rates at which a rule is shown, beside its author's.
const FRAME_RATES: [f64; 7] = [30.0, 50.0, 60.0, 120.0, 144.0, 165.0, 240.0];
/// The least frame rate at which ringing and growth are sought, the largest of each, and the ratio of rates between.
const SLOWEST: f64 = 0.1;
const FASTEST_RINGING: f64 = 1e4;
const FASTEST_GROWTH: f64 = 1e5;
const RATIO: f64 = 1.02;
const HALVINGS: u32 = 60;
/// A part of the way, of a speed or of a swing, below which nothing is seen.
const OVER: f64 = 0.01;
/// By how much an eigenvalue must be above 1 to grow, and for a second look: where that moves the frame rate at which growth
/// begins, it begins at none.
const GROWTH: f64 = 1e-12;
const MORE_GROWTH: f64 = 1e-11;
const SAME_RATE: f64 = 1e-3;
/// How far from its rest a rule that is not linear is tried, and how much of that it may be off a linear one.
const SMALL: f64 = 1e-6;
const SMOOTH: f64 = 1e-3;
/// Parts of a swing, or of a decay, in which the last time that something is seen is sought.
const PARTS: u32 = 64;
/// The frames and seconds for which the growth of a rule without a map is watched.
const WATCHED_S: f64 = 20.0;
const MAX_WATCHED: f64 = 20_000.0;

/// The lines that move a value once a frame, and the rate of frames for which they were written.
#[derive(Debug)]
pub struct Rule {
    text: Arc<StepText>,
    fps: f64,
    /// The carried numbers that decide the motion, the one that is seen first.
    state: Vec<usize>,
    is_linear: bool,
    /// Whether it stays wherever it is: then it is a friction, and no spring.
    stays: bool,
}

/// What a player sees of a rule at a frame rate.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenRule {
    /// Frames per second.
    pub fps: f64,
    /// The frequency of the swing in hertz; `None` if it does not swing.
    pub hz: Option<f64>,
    /// The damped spring that it looks like; `None` if it looks like none.
    pub spring: Option<Effective>,
    /// How far it passes the target first, as a part of the way.
    pub overshoot: Option<f64>,
    /// The time after which less than a hundredth of the way, or of the speed, is left, in seconds.
    pub settles_s: Option<f64>,
    /// The time in which the distance, or the speed, halves in the long run, in seconds.
    pub halves_s: Option<f64>,
    /// Whether it grows.
    pub grows: bool,
}

/// How a rule moves its value in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Motion {
    /// It keeps this part of its distance to the target, or of its speed.
    Approach { kept: f64 },
    /// It stays where it is, and keeps this part of its speed.
    Coast { kept: f64 },
    /// A map of two numbers.
    Swing(Matrix2<f64>),
}

impl Rule {
    /// Reads the lines of a rule that was written for this many frames per second.
    ///
    /// # Errors
    /// The first fault of the text.
    pub fn read(text: &str, fps: f64) -> Result<Self, ExpressionFault> {
        let text = StepText::read(text)?;
        if let Some(span) = text.acceleration_at() {
            return Err(ExpressionFault {
                span,
                what: "a rule is the whole motion, and calls no acceleration".into(),
                remedy: Remedy::Words(
                    "give lines that call one in a file, as a method: `--method my.step`, `regatta show my.step`".into(),
                ),
            });
        }
        // What is seen is the place, or of a rule that changes none the velocity.
        let seen = usize::from(text.keeps(0));
        Ok(Self::with_state(Arc::new(text), fps, vec![seen]))
    }

    /// The rule as a map of these carried numbers and those that they depend on.
    fn with_state(text: Arc<StepText>, fps: f64, state: Vec<usize>) -> Self {
        let (state, is_linear) = (text.with_causes(state), text.is_linear());
        let mut rule = Self { text, fps, state, is_linear, stays: false };
        rule.stays = rule.state.len() == 2 && rule.frame(fps).is_some_and(|it| it.keeps_place());
        rule
    }

    /// The rule as a map of all that a game reads of it: `x` and `v`, as far as its lines change them.
    fn whole(&self) -> Self {
        let changed = (0..2).filter(|index| !self.text.keeps(*index));
        let mut state = self.state.clone();
        for index in changed {
            if !state.contains(&index) {
                state.push(index);
            }
        }
        Self::with_state(Arc::clone(&self.text), self.fps, state)
    }

    /// Frames per second of its author.
    pub fn fps(&self) -> f64 {
        self.fps
    }

    /// Whether a frame is an affine function of the numbers that it carries.
    pub fn is_linear(&self) -> bool {
        self.is_linear
    }

    /// Whether it depends on the length of a frame.
    pub fn takes_step(&self) -> bool {
        self.text.takes_step()
    }

    /// The names of the numbers that decide the motion.
    pub fn state(&self) -> impl Iterator<Item = &str> {
        self.state.iter().map(|index| &*self.text.carried()[*index].name)
    }

    /// What a frame makes of its numbers; `None` if they are more than two, or if it is no map of them, not even of small
    /// motions about a rest at 0.
    fn frame(&self, fps: f64) -> Option<Frame> {
        let frame = self.text.frame(&self.state, 1.0 / fps)?;
        (self.is_linear || self.is_smooth(&frame, fps)).then_some(frame)
    }

    /// Whether small motions about a rest at 0 are those of this frame.
    fn is_smooth(&self, frame: &Frame, fps: f64) -> bool {
        let near = |[first, second]: [f64; 2]| {
            let at = Vector2::new(first, second) * SMALL;
            let mut registers = self.text.registers();
            let all = self.state.iter().zip(&at);
            all.for_each(|(index, value)| self.text.set(&mut registers, *index, *value));
            self.text.step(&mut registers, 1.0 / fps, 0.0);
            let after = self.state.iter().map(|index| self.text.value(&registers, *index));
            let expected = frame.map * at;
            after.zip(&expected).all(|(after, expected)| (after - expected).abs() <= SMOOTH * SMALL)
        };
        let starts = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0], [1.0, -1.0]];
        frame.offset == Vector2::zeros() && starts.into_iter().all(near)
    }

    fn motion(&self, fps: f64) -> Option<Motion> {
        let Frame { map, .. } = self.frame(fps)?;
        Some(match self.state.len() {
            1 => Motion::Approach { kept: map.m11 },
            _ if self.stays => Motion::Coast { kept: map.trace() - 1.0 },
            _ => Motion::Swing(map),
        })
    }

    /// What a player sees at the author's frame rate and at the usual ones, in their order.
    pub fn seen(&self) -> Vec<SeenRule> {
        let mut rates: Vec<f64> = FRAME_RATES.into_iter().chain([self.fps]).collect();
        rates.sort_by(f64::total_cmp);
        rates.dedup();
        rates.into_iter().map(|fps| self.seen_at(fps)).collect()
    }

    /// What a player sees at this many frames per second.
    pub fn seen_at(&self, fps: f64) -> SeenRule {
        let nothing = SeenRule {
            fps,
            hz: None,
            spring: None,
            overshoot: None,
            settles_s: None,
            halves_s: None,
            grows: false,
        };
        let Some(motion) = self.motion(fps) else {
            return SeenRule { grows: self.grows_when_watched(fps), ..nothing };
        };
        let grows = motion.grows(GROWTH);
        let flips = motion.flips().then_some(fps / 2.0);
        let settles_s = (motion.radius() < 1.0).then(|| motion.frames_to_settle().max(1.0) / fps);
        match motion {
            Motion::Approach { kept } | Motion::Coast { kept } => SeenRule {
                hz: flips,
                overshoot: (kept < 0.0 && !self.stays).then_some(-kept),
                halves_s: (kept > 0.0 && kept < 1.0)
                    .then(|| -std::f64::consts::LN_2 / libm::log(kept) / fps),
                settles_s,
                grows,
                ..nothing
            },
            Motion::Swing(map) => {
                let spring = seen(map.trace(), map.determinant(), 1.0 / fps);
                let hz = spring.and_then(|spring| spring.frequency_hz()).or(flips);
                SeenRule { hz, spring, overshoot: overshoot(&map), settles_s, grows, ..nothing }
            }
        }
    }

    /// The frame rate below which it begins to ring: to swing, or to pass its target. `None` if the frame rate does not
    /// decide that.
    pub fn rings_below_fps(&self) -> Option<f64> {
        self.begins_below(FASTEST_RINGING, Motion::rings)
    }

    /// The frame rate below which it grows. `None` if the frame rate does not decide that.
    pub fn explodes_below_fps(&self) -> Option<f64> {
        let above = |least| self.begins_below(FASTEST_GROWTH, |motion| motion.grows(least));
        // What grows less and less, and at every rate, passes each bound somewhere.
        let (found, next) = (above(GROWTH)?, above(MORE_GROWTH)?);
        ((next / found - 1.0).abs() < SAME_RATE).then_some(found)
    }

    /// Whether it grows at the author's frame rate.
    pub fn grows(&self) -> bool {
        self.seen_at(self.fps).grows
    }

    /// The rate below which something begins that does not hold at `fastest`.
    fn begins_below(&self, fastest: f64, holds: impl Fn(&Motion) -> bool) -> Option<f64> {
        let holds_at = |fps: f64| self.motion(fps).is_some_and(|motion| holds(&motion));
        if !self.takes_step() || holds_at(fastest) {
            return None;
        }
        let mut fps = fastest;
        while fps > SLOWEST {
            if holds_at(fps / RATIO) {
                let logs = [fps / RATIO, fps].map(libm::log);
                let [_, high] = bisect(logs, HALVINGS, |log| holds_at(libm::exp(log)));
                // Where a motion that does not grow begins to is known to fewer digits than there are.
                return format!("{:.7e}", libm::exp(high)).parse().ok();
            }
            fps /= RATIO;
        }
        None
    }

    /// The spring that it is at the author's frame rate, with a mass of 1 kg; `None` if it is none.
    pub fn spring(&self) -> Option<Wish> {
        Some(Wish::of(self.seen_at(self.fps).spring?, 1.0))
    }

    /// How fast it approaches its target, if that is all it does.
    pub fn approach(&self) -> Option<Approach> {
        let half_life_s = self.seen_at(self.fps).halves_s?;
        self.text.takes_target().then_some(Approach { half_life_s })
    }

    /// How many seconds of its speed a body coasts at the author's frame rate if friction alone slows it. Of a rule that
    /// changes no place: where it moves after the friction of a frame, and where it moves before.
    pub fn coasts_s(&self) -> Option<Vec<f64>> {
        let frame = self.frame(self.fps)?;
        let is_still = frame.by_target == Vector2::zeros() && frame.offset == Vector2::zeros();
        let motion = self.motion(self.fps).filter(|motion| is_still && motion.radius() < 1.0)?;
        match motion {
            Motion::Coast { kept } if frame.map.m21 == 0.0 && self.takes_step() => {
                Some(vec![frame.map.m12 / (1.0 - kept)])
            }
            Motion::Coast { kept } if frame.map.m21 == 0.0 => {
                Some(vec![frame.map.m12 / (1.0 - kept) / self.fps])
            }
            Motion::Approach { kept } if self.state == [1] => {
                Some([kept, 1.0].map(|moved| moved / (1.0 - kept) / self.fps).to_vec())
            }
            _ => None,
        }
    }

    /// Whether a run from 1 ends far from where it was: for what has no map.
    fn grows_when_watched(&self, fps: f64) -> bool {
        let mut registers = self.text.registers();
        let first = self.state[0];
        self.text.set(&mut registers, first, 1.0);
        let frames = (WATCHED_S * fps).min(MAX_WATCHED) as u32;
        let mut farthest = [0.0_f64; 2];
        for frame in 0..frames {
            self.text.step(&mut registers, 1.0 / fps, 0.0);
            let value = self.text.value(&registers, first).abs();
            if !value.is_finite() {
                return true;
            }
            let half = &mut farthest[usize::from(2 * frame >= frames)];
            *half = half.max(value);
        }
        farthest[1] > 10.0 * farthest[0].max(1.0)
    }
}

impl Motion {
    /// The largest modulus of an eigenvalue of what moves.
    fn radius(&self) -> f64 {
        match self {
            Motion::Approach { kept } | Motion::Coast { kept } => kept.abs(),
            Motion::Swing(map) => spectral_radius(map.trace(), map.determinant()),
        }
    }

    /// Whether what moves grows, by more than this in a frame.
    fn grows(&self, least: f64) -> bool {
        self.radius() > 1.0 + least
    }

    /// Whether it ends up changing sides at every frame.
    fn flips(&self) -> bool {
        match self {
            Motion::Approach { kept } | Motion::Coast { kept } => *kept < 0.0,
            Motion::Swing(map) => {
                let half = map.trace() / 2.0;
                half * half >= map.determinant() && half < 0.0
            }
        }
    }

    /// Whether it swings or changes sides.
    fn rings(&self) -> bool {
        match self {
            Motion::Approach { kept } | Motion::Coast { kept } => *kept < 0.0,
            Motion::Swing(map) => {
                let (half, determinant) = (map.trace() / 2.0, map.determinant());
                // Of a double eigenvalue the difference is rounding.
                half * half - determinant < -4.0 * f64::EPSILON || determinant < 0.0 || half < 0.0
            }
        }
    }

    /// The frames after which less than [`OVER`] is left, also between whole ones.
    fn frames_to_settle(&self) -> f64 {
        let by_radius = -libm::log(OVER) / -libm::log(self.radius());
        let Motion::Swing(map) = self else { return by_radius };
        let Some(powers) = Powers::of(map.trace(), map.determinant()) else { return by_radius };
        let beside = beside(map);
        let left = |frames: f64| {
            let [even, odd] = powers.at(frames);
            (even + beside * odd).abs()
        };
        // Beyond the end nothing is seen: there the amplitude is below.
        let part = if powers.swings { std::f64::consts::PI / powers.apart } else { by_radius };
        let mut end = by_radius;
        for _ in 0..PARTS {
            let amplitude = match powers.swings {
                true => libm::hypot(1.0, beside / libm::sin(powers.apart)),
                false => 1.0 + beside.abs() * end,
            };
            end = by_radius * (1.0 + libm::log(amplitude) / -libm::log(OVER));
        }
        let step = part / f64::from(PARTS);
        let starts = (1..=4 * PARTS).map(|n| end - f64::from(n) * step);
        let last =
            starts.into_iter().take_while(|from| *from > 0.0).find(|from| left(*from) > OVER);
        let from = last.unwrap_or(0.0);
        bisect([from, from + step], HALVINGS, |frames| left(frames) > OVER)[1]
    }
}

/// How far the first of two numbers that start at rest from 1 is from half the trace after a frame, as a part of the root
/// of the determinant. The second rests at 1 too if it is the first of a frame before.
fn beside(map: &Matrix2<f64>) -> f64 {
    let first = if remembers_place(map) { map.m11 + map.m12 } else { map.m11 };
    (first - map.trace() / 2.0) / libm::sqrt(map.determinant())
}

/// How far a motion that starts at rest from 1 passes 0 first.
fn overshoot(map: &Matrix2<f64>) -> Option<f64> {
    let powers = Powers::of(map.trace(), map.determinant()).filter(|powers| powers.swings)?;
    let Powers { log_scale, apart, .. } = powers;
    let slope = beside(map) / libm::sin(apart);
    let first = libm::atan2(log_scale + slope * apart, apart - slope * log_scale);
    let turns = (0..3).map(|n| (first + f64::from(n) * std::f64::consts::PI) / apart);
    let left = |frames: f64| {
        let [even, odd] = powers.at(frames);
        even + beside(map) * odd
    };
    turns
        .into_iter()
        .filter(|frames| *frames > 0.0)
        .map(left)
        .find(|left| *left < 0.0)
        .map(|left| -left)
}
