//! Analyses the lines with which a game moves a value once a frame, at every frame rate.
//!
//! A linear rule of up to two carried numbers is a map. The map's eigenvalues give the visible motion, and its powers,
//! whole or not, the motion at any frame rate. For a rule that is not linear, this holds for small motions about its
//! rest.

use std::sync::Arc;

use nalgebra::{Matrix2, Vector2};

use super::port::seen::{spectral_radius, spring_of_map};
use super::port::{Approach, Wish};
use crate::identify::Effective;
use crate::sim::law::{ExpressionFault, Frame, Powers, StepText, remembers_place};
use crate::sim::numerics::bisect;

pub use any_rate::RuleCode;
pub use bounce::{BouncesSeen, RuleBounce};
pub use pieces::{Course, Piece};
pub use rounded::{ROUNDED_START, ROUNDED_TARGET};
pub use scene::rule_scene;

mod any_rate;
mod bounce;
mod driven;
mod jitter;
mod label;
mod once;
mod pieces;
mod rounded;
mod scene;

/// Frame rates at which a rule is shown, besides the author's rate.
const FRAME_RATES: [f64; 7] = [30.0, 50.0, 60.0, 120.0, 144.0, 165.0, 240.0];
/// Lowest frame rate in the search for ringing and growth, highest rate in the search for each, and ratio of successive
/// rates.
const SLOWEST: f64 = 0.1;
const FASTEST_RINGING: f64 = 1e4;
const FASTEST_GROWTH: f64 = 1e5;
const RATIO: f64 = 1.02;
const HALVINGS: u32 = 60;
/// Fraction of the way, of a speed or of a swing, below which nothing is visible, unless a rule has another.
const OVER: f64 = 0.01;
/// A rule grows if an eigenvalue exceeds 1 by `GROWTH`. If `MORE_GROWTH` moves the frame rate at which growth begins,
/// no frame rate decides the growth.
const GROWTH: f64 = 1e-12;
const MORE_GROWTH: f64 = 1e-11;
const SAME_RATE: f64 = 1e-3;
/// Distance from the rest at which a rule that is not linear is tried, and its largest deviation from a linear rule, as
/// a fraction of that distance.
const SMALL: f64 = 1e-6;
const SMOOTH: f64 = 1e-3;
/// Number of parts of a swing, or of a decay, in the search for the last visible moment.
const PARTS: u32 = 64;
/// Units of the length of a frame, with the number of each in a second.
pub const UNITS: [(&str, f64); 3] = [("s", 1.0), ("ms", 1e3), ("us", 1e6)];
/// A rule that takes longer to halve than this number of seconds may have another unit of time.
const SLOW_S: f64 = 30.0;
/// The shortest time to halve that a hint proposes, in seconds.
const QUICK_S: f64 = 1e-3;
/// Length of the run that shows whether a rule without a map grows, in seconds, and its maximum in frames.
const WATCHED_S: f64 = 20.0;
const MAX_WATCHED: f64 = 20_000.0;

/// The lines that move a value once a frame, and the frame rate for which they were written.
#[derive(Debug)]
pub struct Rule {
    text: Arc<StepText>,
    fps: f64,
    /// Indices of the carried numbers that decide the motion. The visible number comes first.
    state: Vec<usize>,
    is_linear: bool,
    /// Whether the value stays wherever it is, as under friction, but not on a spring.
    stays: bool,
    /// Whether rounding makes each step, so that no map does.
    is_rounded: bool,
    /// The modes of the switches in a piece of a rule; empty for the whole rule.
    modes: Vec<i64>,
    /// Units of the length of a frame in a second.
    units: f64,
    within: f64,
}

/// The visible motion of a rule at a frame rate.
#[derive(Clone, Debug, PartialEq)]
pub struct VisibleMotion {
    /// Frames per second.
    pub fps: f64,
    /// Frequency of the swing in hertz; `None` if the motion does not swing.
    pub hz: Option<f64>,
    /// The damped spring with the same motion; `None` if there is none.
    pub spring: Option<Effective>,
    /// Distance by which the motion first passes the target, as a fraction of the way.
    pub overshoot: Option<f64>,
    /// Time until less than a hundredth of the way, or of the speed, is left, in seconds.
    pub settles_s: Option<f64>,
    /// Time in which the distance, or the speed, halves in the long run, in seconds.
    pub halves_s: Option<f64>,
    /// Whether the motion grows.
    pub grows: bool,
    /// The speed at which the rule gains no more; `None` if there is none. It is one of `x` a second if the rule moves
    /// `x` by `v` times the frame length, and else is in the units of `v`.
    pub top_speed: Option<f64>,
    /// The speed that the first frame from rest gains, for a second of such frames; `None` if the rule does not drive
    /// itself.
    pub accelerates: Option<f64>,
    /// The height and the time in seconds of a jump that starts with [`Rule::jump_speed`].
    pub jump: Option<[f64; 2]>,
}

/// The kind of motion that a rule makes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Motion {
    /// The value keeps this fraction of its distance to the target, or of its speed, in a frame.
    Approach { kept: f64 },
    /// The value stays where it is, and keeps this fraction of its speed in a frame.
    Coast { kept: f64 },
    /// A frame maps two numbers by this matrix.
    Swing(Matrix2<f64>),
}

impl VisibleMotion {
    /// Returns no motion.
    fn none(fps: f64) -> Self {
        Self {
            fps,
            hz: None,
            spring: None,
            overshoot: None,
            settles_s: None,
            halves_s: None,
            grows: false,
            top_speed: None,
            accelerates: None,
            jump: None,
        }
    }
}

impl Rule {
    /// Reads the lines of a rule written for this many frames per second.
    ///
    /// # Errors
    /// Fails with the first fault of the text.
    pub fn read(text: &str, fps: f64) -> Result<Self, ExpressionFault> {
        let remedy = "give lines that call one in a file, as a method: `--method my.step`, `regatta show my.step`";
        let text = StepText::read_rule(text, remedy)?;
        // The visible number is the place or, if the rule changes no place, the velocity.
        let seen = usize::from(text.leaves_unchanged(0));
        Ok(Self::with_state(Arc::new(text), fps, vec![seen]))
    }

    /// Creates the rule as a map of these carried numbers and of those on which they depend.
    fn with_state(text: Arc<StepText>, fps: f64, state: Vec<usize>) -> Self {
        let (state, is_linear) = (text.with_causes(state), text.is_linear());
        let is_rounded = rounded::rounding(&text, &state, 1.0 / fps).is_some();
        let (modes, units, within) = (Vec::new(), 1.0, OVER);
        Self { text, fps, state, is_linear, stays: false, is_rounded, modes, units, within }
            .settled()
    }

    fn settled(mut self) -> Self {
        let frame = self.frame(self.fps).filter(|_| self.state.len() == 2);
        self.stays = frame.is_some_and(|it| it.keeps_place());
        self
    }

    /// Returns the rule whose frame length has this many units in a second.
    #[must_use]
    pub fn in_units(self, units: f64) -> Self {
        Self { units, ..self }.settled()
    }

    /// Returns the units of the length of a frame in a second.
    pub fn units(&self) -> f64 {
        self.units
    }

    /// Returns the rule that has settled within this fraction of the way, between 0 and 1.
    #[must_use]
    pub fn within(self, within: f64) -> Self {
        Self { within, ..self }
    }

    /// Returns the fraction of the way within which the rule has settled.
    pub fn settles_within(&self) -> f64 {
        self.within
    }

    fn step_length(&self, fps: f64) -> f64 {
        if self.units == 1.0 { 1.0 / fps } else { self.units / fps }
    }

    /// Returns the unit of [`UNITS`] in which a rule moves that takes more than half a minute to halve in seconds, and
    /// the time to halve then.
    pub fn other_unit(&self) -> Option<(&'static str, f64)> {
        let time = |rule: &Self| {
            let motions = rule.motions();
            let times = motions.iter().filter_map(|seen| seen.halves_s.or(seen.settles_s));
            times.reduce(f64::min)
        };
        if !self.takes_step() || self.units != 1.0 || time(self).is_none_or(|time| time < SLOW_S) {
            return None;
        }
        UNITS[1..].iter().find_map(|(unit, units)| {
            let text = Arc::clone(&self.text);
            let other = Self::with_state(text, self.fps, self.state.clone()).in_units(*units);
            let seen = other.motion_at(self.fps);
            let halves = seen.halves_s.or(seen.settles_s)?;
            (QUICK_S..SLOW_S).contains(&halves).then_some((*unit, halves))
        })
    }

    /// Returns the rule as a map of all numbers that a game reads, including `x` and `v` if the rule's lines change
    /// these.
    fn whole(&self) -> Self {
        let changed = (0..2).filter(|index| !self.text.leaves_unchanged(*index));
        let mut state = self.state.clone();
        for index in changed {
            if !state.contains(&index) {
                state.push(index);
            }
        }
        let rule = Self::with_state(Arc::clone(&self.text), self.fps, state);
        Self { units: self.units, within: self.within, ..rule }.settled()
    }

    /// Returns the frames per second for which the rule was written.
    pub fn fps(&self) -> f64 {
        self.fps
    }

    /// Whether a frame is an affine function of the carried numbers.
    pub fn is_linear(&self) -> bool {
        self.is_linear
    }

    /// Whether the rule depends on the length of a frame.
    pub fn takes_step(&self) -> bool {
        self.text.takes_step()
    }

    /// Returns the names of the numbers that the lines move too, on which those of the rule do not depend.
    pub fn beside(&self) -> Vec<&str> {
        let (text, h) = (&self.text, self.step_length(self.fps));
        let mut registers = text.registers();
        let mut after = |index: usize, value: f64| {
            (0..text.carried().len()).for_each(|other| text.set(&mut registers, other, 1.0));
            text.set(&mut registers, index, value);
            text.step(&mut registers, h, 0.0);
            text.value(&registers, index)
        };
        let carried = text.carried().iter().enumerate();
        let moved = carried.filter(|(index, _)| !self.state.contains(index));
        let moved = moved.filter(|(index, _)| {
            !text.leaves_unchanged(*index) && after(*index, 1.0) != after(*index, 2.0)
        });
        moved.map(|(_, carried)| &*carried.name).collect()
    }

    /// Returns the component of vectors that the rule moves, and the other one whose lines are left out.
    pub fn left_out(&self) -> Option<[char; 2]> {
        self.text.left_out()
    }

    /// Returns the names of the numbers that decide the motion.
    pub fn state(&self) -> impl Iterator<Item = &str> {
        self.state.iter().map(|index| &*self.text.carried()[*index].name)
    }

    /// Returns a frame as a map; `None` for more than two numbers, or if not even small motions about a rest at 0 are
    /// linear.
    fn frame(&self, fps: f64) -> Option<Frame> {
        let h = self.step_length(fps);
        let near = (self.modes.is_empty() && !self.is_linear).then(|| self.text.modes_apart(h));
        let modes = near.as_ref().unwrap_or(&self.modes);
        let frame = Frame::of(&self.text, modes, &self.state, h).filter(|_| !self.is_rounded)?;
        (self.is_linear || self.is_smooth(&frame, fps)).then_some(frame)
    }

    /// Whether small motions about a rest at 0 follow this frame.
    fn is_smooth(&self, frame: &Frame, fps: f64) -> bool {
        let near = |[first, second]: [f64; 2]| {
            let at = Vector2::new(first, second) * SMALL;
            let mut registers = self.text.registers();
            let all = self.state.iter().zip(&at);
            all.for_each(|(index, value)| self.text.set(&mut registers, *index, *value));
            self.text.step(&mut registers, self.step_length(fps), 0.0);
            let after = self.state.iter().map(|index| self.text.value(&registers, *index));
            let expected = frame.map * at;
            after.zip(&expected).all(|(after, expected)| (after - expected).abs() <= SMOOTH * SMALL)
        };
        // Beside 0, which a comparison by `==` may tell from all other numbers.
        let [one, beside] = [1.0, 1e-3];
        let starts =
            [[one, beside], [-one, beside], [beside, one], [beside, -one], [one, one], [one, -one]];
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

    /// Returns the visible motion at the usual frame rates and at the author's, with the lowest rate first.
    pub fn motions(&self) -> Vec<VisibleMotion> {
        self.rates().into_iter().map(|fps| self.motion_at(fps)).collect()
    }

    /// Returns the usual frame rates and the author's, with the lowest first.
    fn rates(&self) -> Vec<f64> {
        let mut rates: Vec<f64> = FRAME_RATES.into_iter().chain([self.fps]).collect();
        rates.sort_by(f64::total_cmp);
        rates.dedup();
        rates
    }

    /// Returns the visible motion at this many frames per second.
    pub fn motion_at(&self, fps: f64) -> VisibleMotion {
        let [top_speed, accelerates] = self.driven(fps);
        let jump = accelerates.filter(|_| top_speed.is_none()).and_then(|_| self.jump(fps));
        let nothing = VisibleMotion { top_speed, accelerates, jump, ..VisibleMotion::none(fps) };
        let Some(motion) = self.motion(fps) else {
            return VisibleMotion { grows: self.grows_when_watched(fps), ..nothing };
        };
        let grows = motion.grows(GROWTH);
        let flips = motion.flips().then_some(fps / 2.0);
        let settles_s =
            (motion.radius() < 1.0).then(|| motion.frames_to_settle(self.within).max(1.0) / fps);
        match motion {
            Motion::Approach { kept } | Motion::Coast { kept } => VisibleMotion {
                hz: flips,
                overshoot: (kept < 0.0 && !self.stays).then_some(-kept),
                halves_s: (kept > 0.0 && kept < 1.0)
                    .then(|| -std::f64::consts::LN_2 / libm::log(kept) / fps),
                settles_s,
                grows,
                ..nothing
            },
            Motion::Swing(map) => {
                let spring = spring_of_map(map.trace(), map.determinant(), 1.0 / fps);
                let hz = spring.and_then(|spring| spring.frequency_hz()).or(flips);
                VisibleMotion {
                    hz,
                    spring,
                    overshoot: overshoot(&map),
                    settles_s,
                    grows,
                    ..nothing
                }
            }
        }
    }

    /// Returns the frame rate below which the rule begins to ring, that is to swing or to pass its target. `None` if
    /// the frame rate does not decide that.
    pub fn rings_below_fps(&self) -> Option<f64> {
        self.begins_below(FASTEST_RINGING, Motion::rings)
    }

    /// Returns the frame rate below which the rule grows; `None` if the frame rate does not decide that.
    pub fn explodes_below_fps(&self) -> Option<f64> {
        let above = |least| self.begins_below(FASTEST_GROWTH, |motion| motion.grows(least));
        // A rule that grows at every rate, but ever less, passes each limit somewhere.
        let (found, next) = (above(GROWTH)?, above(MORE_GROWTH)?);
        ((next / found - 1.0).abs() < SAME_RATE).then_some(found)
    }

    /// Whether the rule grows at the author's frame rate.
    pub fn grows(&self) -> bool {
        self.motion_at(self.fps).grows
    }

    /// Returns the frame rate below which a property begins to hold that does not hold at `fastest`.
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
                // Rounding limits the digits to which the onset of growth is known.
                return format!("{:.7e}", libm::exp(high)).parse().ok();
            }
            fps /= RATIO;
        }
        None
    }

    /// Returns the spring with the same motion at the author's frame rate, with a mass of 1 kg; `None` if there is
    /// none.
    pub fn spring(&self) -> Option<Wish> {
        Some(Wish::of(self.motion_at(self.fps).spring?, 1.0))
    }

    /// Returns the approach to the target, if the rule does nothing else.
    pub fn approach(&self) -> Option<Approach> {
        let half_life_s = self.motion_at(self.fps).halves_s?;
        self.text.takes_target().then_some(Approach { half_life_s })
    }

    /// Whether the velocity goes to the target, and not the place.
    pub fn approaches_by_v(&self) -> bool {
        self.state[0] == 1 || self.stays
    }

    /// Returns the distance that a body coasts under friction alone at the author's frame rate, in seconds of its
    /// speed. A rule that changes no place has two distances, one if the body moves after the friction of a frame, and
    /// one if it moves before.
    pub fn coasts_s(&self) -> Option<Vec<f64>> {
        let frame = self.frame(self.fps)?;
        let is_still = frame.by_target == Vector2::zeros() && frame.offset == Vector2::zeros();
        let motion = self.motion(self.fps).filter(|motion| is_still && motion.radius() < 1.0)?;
        match motion {
            Motion::Coast { kept } if frame.map.m21 == 0.0 && self.takes_step() => {
                Some(vec![frame.map.m12 / (1.0 - kept) / self.units])
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

    /// Whether a run from 1 goes far beyond its first half. This test is for rules without a map.
    fn grows_when_watched(&self, fps: f64) -> bool {
        let mut registers = self.text.registers();
        let first = self.state[0];
        self.text.set(&mut registers, first, 1.0);
        let frames = (WATCHED_S * fps).min(MAX_WATCHED) as u32;
        let mut farthest = [0.0_f64; 2];
        for frame in 0..frames {
            self.text.step(&mut registers, self.step_length(fps), 0.0);
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
    /// Returns the largest modulus of an eigenvalue, without the 1 of a coasting motion.
    fn radius(&self) -> f64 {
        match self {
            Motion::Approach { kept } | Motion::Coast { kept } => kept.abs(),
            Motion::Swing(map) => spectral_radius(map.trace(), map.determinant()),
        }
    }

    /// Whether the motion grows by more than `least` in a frame.
    fn grows(&self, least: f64) -> bool {
        self.radius() > 1.0 + least
    }

    /// Whether the motion ends up changing sides at every frame.
    fn flips(&self) -> bool {
        match self {
            Motion::Approach { kept } | Motion::Coast { kept } => *kept < 0.0,
            Motion::Swing(map) => {
                let half = map.trace() / 2.0;
                half * half >= map.determinant() && half < 0.0
            }
        }
    }

    /// Whether the motion swings or changes sides.
    fn rings(&self) -> bool {
        match self {
            Motion::Approach { kept } | Motion::Coast { kept } => *kept < 0.0,
            Motion::Swing(map) => {
                let (half, determinant) = (map.trace() / 2.0, map.determinant());
                // Such a small difference of a double eigenvalue is rounding.
                half * half - determinant < -4.0 * f64::EPSILON || determinant < 0.0 || half < 0.0
            }
        }
    }

    /// Returns the number of frames until less than `over` is left, not necessarily whole.
    fn frames_to_settle(&self, over: f64) -> f64 {
        let by_radius = -libm::log(over) / -libm::log(self.radius());
        let Motion::Swing(map) = self else { return by_radius };
        let Some(powers) = Powers::of(map.trace(), map.determinant()) else { return by_radius };
        let beside = odd_coefficient(map);
        let left = |frames: f64| {
            let [even, odd] = powers.at(frames);
            (even + beside * odd).abs()
        };
        // After `end` the amplitude is too small to be visible.
        let part = if powers.swings { std::f64::consts::PI / powers.apart } else { by_radius };
        let mut end = by_radius;
        for _ in 0..PARTS {
            let amplitude = match powers.swings {
                true => libm::hypot(1.0, beside / libm::sin(powers.apart)),
                false => 1.0 + beside.abs() * end,
            };
            end = by_radius * (1.0 + libm::log(amplitude) / -libm::log(over));
        }
        let step = part / f64::from(PARTS);
        let starts = (1..=4 * PARTS).map(|n| end - f64::from(n) * step);
        let last =
            starts.into_iter().take_while(|from| *from > 0.0).find(|from| left(*from) > over);
        let from = last.unwrap_or(0.0);
        bisect([from, from + step], HALVINGS, |frames| left(frames) > over)[1]
    }
}

/// Returns the coefficient of the odd power in a motion that starts at rest from 1. It is the first number after a
/// frame minus half the trace, over the root of the determinant. The second number also starts at 1 if it repeats the
/// first number of the frame before.
fn odd_coefficient(map: &Matrix2<f64>) -> f64 {
    let first = if remembers_place(map) { map.m11 + map.m12 } else { map.m11 };
    (first - map.trace() / 2.0) / libm::sqrt(map.determinant())
}

/// Returns the distance by which a motion that starts at rest from 1 first passes 0; `None` if it never does.
fn overshoot(map: &Matrix2<f64>) -> Option<f64> {
    let powers = Powers::of(map.trace(), map.determinant()).filter(|powers| powers.swings)?;
    let Powers { log_scale, apart, .. } = powers;
    let slope = odd_coefficient(map) / libm::sin(apart);
    let first = libm::atan2(log_scale + slope * apart, apart - slope * log_scale);
    let turns = (0..3).map(|n| (first + f64::from(n) * std::f64::consts::PI) / apart);
    let left = |frames: f64| {
        let [even, odd] = powers.at(frames);
        even + odd_coefficient(map) * odd
    };
    turns
        .into_iter()
        .filter(|frames| *frames > 0.0)
        .map(left)
        .find(|left| *left < 0.0)
        .map(|left| -left)
}
