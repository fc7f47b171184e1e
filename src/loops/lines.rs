//! A loop that is lines, which run once a frame.

use std::sync::Arc;

use super::policy::{FrameLimits, Steps};
use super::time_base::{TimeBase, greatest_common_divisor};
use crate::sim::law::{FrameInput, LoopText, StepRegisters};

/// Time of the clock before the first frame, and so the length of a second in milliseconds.
const START_MS: f64 = 1000.0;
/// Most ticks of a frame, which ends a loop that never catches up.
const MAX_TICKS: f64 = 1e5;
/// A frame that no limit cuts, in milliseconds.
const NO_LIMIT_MS: f64 = 1e12;
/// Longest time that lines may name, in nanoseconds: thirty years.
const MOST_NS: i64 = 1_000_000_000_000_000_000;
const MILLISECOND_NS: i64 = 1_000_000;
const SECOND_NS: i64 = 1_000_000_000;
/// Most units of a nanosecond in lines of whole numbers: a frame of 45 s is exact.
const MAX_UNITS: i128 = 200_000;

/// The lines of a loop at work. Times of the lines are in milliseconds, which are never rounded to nanoseconds, or
/// whole numbers of a unit.
#[derive(Clone)]
pub(super) struct Lines {
    text: Arc<LoopText>,
    registers: StepRegisters,
    base: TimeBase,
    /// The unit of whole numbers, in the unit of the base.
    unit: Option<i128>,
    input: FrameInput,
    has_fixed_tick: bool,
    /// Time since the last tick, for drawing.
    owed: i128,
    tick: i128,
    /// Time given, simulated and dropped so far.
    passed: i128,
    simulated: i128,
    dropped: i128,
}

impl Lines {
    /// Prepares the lines before the first frame. The limits apply to lines of whole numbers.
    pub(super) fn new(text: Arc<LoopText>, base: TimeBase, limits: FrameLimits) -> Self {
        let second = base.nanoseconds(SECOND_NS);
        let unit = text.is_whole().then(|| unit(&text, base));
        let time = |time: i128| match unit {
            Some(unit) => (time / unit) as f64,
            None => base.milliseconds(time),
        };
        let (tick, second) = match unit {
            Some(_) => (time(base.tick()), time(second)),
            None => (1000.0 / f64::from(base.tick_hz()), START_MS),
        };
        let cost = limits.cost_ms.map_or(0.0, f64::from) * second / START_MS;
        let refresh = time(base.refresh());
        let input =
            FrameInput { dt: 0.0, tick, refresh, second, cost, now: second, is_first: true };
        let mut registers = text.registers();
        // A limit on ticks, or on frames before they are counted, takes the place of that on the longest frame.
        let FrameLimits { max_ticks, max_frame_ms, long_frame, .. } = limits;
        let longest_ms = match (max_ticks, max_frame_ms, long_frame) {
            (Some(_), ..) | (None, None, Some(_)) => Some(NO_LIMIT_MS),
            (None, longest_ms, _) => longest_ms.map(f64::from),
        };
        let constants = [("max_ticks", max_ticks.map(f64::from)), ("max_frame_ms", longest_ms)];
        for (name, value) in constants.into_iter().filter(|_| unit.is_some()) {
            if let Some(value) = value {
                text.set_constant(&mut registers, name, value);
            }
        }
        Self {
            has_fixed_tick: text.has_fixed_tick(),
            text,
            registers,
            base,
            unit,
            input,
            owed: 0,
            tick: base.tick(),
            passed: 0,
            simulated: 0,
            dropped: 0,
        }
    }

    /// Converts a time of the lines to the unit of the base.
    fn time(&self, time: f64) -> i128 {
        match self.unit {
            Some(unit) => self.within(time.round(), unit),
            None => self.within((time * self.base.nanoseconds(MILLISECOND_NS) as f64).round(), 1),
        }
    }

    /// Converts a whole number of units, and limits the time, so that no sum of times overflows.
    fn within(&self, whole: f64, unit: i128) -> i128 {
        let most = self.base.nanoseconds(MOST_NS) / unit;
        (whole as i128).clamp(-most, most) * unit
    }

    /// Decides on the steps of a frame, whose duration is also given in milliseconds as a game reads it.
    pub(super) fn frame(&mut self, duration: i128, ms: f64) -> Steps {
        self.input.dt = self.unit.map_or(ms, |unit| (duration / unit) as f64);
        self.input.now += self.input.dt;
        self.passed += duration;
        let output = self.text.frame(&mut self.registers, self.input);
        self.input.is_first = false;
        // Lines that fail make no tick.
        let count = output.ticks.clamp(0.0, MAX_TICKS) as u32;
        let span = match output.tick == self.input.tick && self.has_fixed_tick {
            true => i128::from(count) * self.base.tick(),
            false if count > 0 && output.stepped.is_finite() => self.time(output.stepped),
            false => 0,
        };
        if output.tick > 0.0 && (self.unit.is_none() || self.has_fixed_tick) {
            self.tick = self.time(output.tick);
        }
        self.simulated += span;
        let given_up = output.dropped.map(|dropped| self.time(dropped));
        let dropped = match (self.unit, output.owed) {
            (None, Some(owed)) => {
                Some(self.passed - self.simulated - self.dropped - self.time(owed))
            }
            _ => given_up,
        };
        let dropped = dropped.unwrap_or_default().max(0);
        // Below the rounding of a double nothing is dropped.
        let is_rounding = self.unit.is_none() && dropped < self.base.nanoseconds(1);
        let dropped = if is_rounding { 0 } else { dropped };
        self.dropped += dropped;
        self.owed = match (self.unit, output.owed) {
            (Some(_), Some(owed)) => self.time(owed),
            _ if self.text.shows() => self.within(output.shown * self.tick as f64, 1),
            _ => 0,
        };
        let returned = output.returned.map(|returned| returned.clamp(0.0, MAX_TICKS) as u32);
        Steps { count, span, dropped, returned }
    }

    /// Returns the length of a tick.
    pub(super) fn tick(&self) -> i128 {
        self.tick
    }

    /// Returns the time since the last tick, for drawing between ticks; 0 for a loop without ticks.
    pub(super) fn owed(&self) -> i128 {
        self.owed
    }
}

/// Returns the finest unit in which the times of whole lines are exact, in the unit of the base.
fn unit(text: &LoopText, base: TimeBase) -> i128 {
    let refresh = if text.reads_refresh() { base.refresh() } else { 0 };
    let nanosecond = base.nanoseconds(1);
    let of_ticks = greatest_common_divisor(nanosecond, base.tick());
    let common = greatest_common_divisor(of_ticks, refresh);
    let mut unit = 1;
    while nanosecond / unit > MAX_UNITS {
        let rest = common / unit;
        match (2..1000).find(|factor| rest % factor == 0) {
            Some(factor) => unit *= factor,
            None => return common,
        }
    }
    unit
}
