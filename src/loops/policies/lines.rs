//! A loop that is lines, which run once a frame.

use crate::loops::policy::{FrameLimits, Policy, Steps};
use crate::loops::time_base::TimeBase;
use crate::sim::law::{FrameInput, LoopText, StepRegisters};

/// Time of the clock before the first frame, in milliseconds.
const START_MS: f64 = 1000.0;
/// Most ticks of a frame, which ends a loop that never catches up.
const MAX_TICKS: f64 = 1e5;
const MILLISECOND_NS: i64 = 1_000_000;

/// The lines of a loop at work. Times of the lines are in milliseconds, and are never rounded to nanoseconds.
#[derive(Clone)]
pub(in crate::loops) struct Lines {
    text: &'static LoopText,
    registers: StepRegisters,
    base: TimeBase,
    now_ms: f64,
    cost_ms: f64,
    has_begun: bool,
    /// Part of a tick to draw beyond the last tick but one.
    shown: f64,
    tick: i128,
    /// Time given, simulated and dropped so far.
    passed: i128,
    simulated: i128,
    dropped: i128,
}

impl Lines {
    /// Prepares the lines before the first frame. `cost_ms` is the cost of a tick.
    pub(in crate::loops) fn new(
        text: &'static LoopText,
        base: TimeBase,
        FrameLimits { cost_ms, .. }: FrameLimits,
    ) -> Self {
        Self {
            text,
            registers: text.registers(),
            base,
            now_ms: START_MS,
            cost_ms: cost_ms.map_or(0.0, f64::from),
            has_begun: false,
            shown: 0.0,
            tick: base.tick(),
            passed: 0,
            simulated: 0,
            dropped: 0,
        }
    }

    /// Converts milliseconds to the unit of the base.
    fn time(&self, ms: f64) -> i128 {
        (ms * self.base.nanoseconds(MILLISECOND_NS) as f64).round() as i128
    }
}

impl Policy for Lines {
    fn frame(&mut self, duration: i128) -> Steps {
        self.frame_in_ms(duration, self.base.milliseconds(duration))
    }

    fn frame_in_ms(&mut self, duration: i128, ms: f64) -> Steps {
        self.now_ms += ms;
        self.passed += duration;
        let tick_ms = 1000.0 / f64::from(self.base.tick_hz());
        let input = FrameInput {
            dt: ms,
            tick: tick_ms,
            refresh: self.base.milliseconds(self.base.refresh()),
            cost: self.cost_ms,
            now: self.now_ms,
            is_first: !std::mem::replace(&mut self.has_begun, true),
        };
        let output = self.text.frame(&mut self.registers, input);
        // Lines that fail make no tick.
        let count = output.ticks.clamp(0.0, MAX_TICKS) as u32;
        let span = match output.tick == tick_ms && self.text.has_fixed_tick() {
            true => i128::from(count) * self.base.tick(),
            false if count > 0 && output.stepped.is_finite() => self.time(output.stepped),
            false => 0,
        };
        if output.tick > 0.0 {
            self.tick = self.time(output.tick);
        }
        self.shown = output.shown;
        self.simulated += span;
        let owed =
            output.owed.map(|owed| self.passed - self.simulated - self.dropped - self.time(owed));
        let dropped = owed.or(output.dropped.map(|dropped| self.time(dropped)));
        let dropped = dropped.unwrap_or_default().max(0);
        // Below the rounding of a double nothing is dropped.
        let dropped = if dropped < self.base.nanoseconds(1) { 0 } else { dropped };
        self.dropped += dropped;
        let returned = output.returned.map(|returned| returned.clamp(0.0, MAX_TICKS) as u32);
        Steps { count, span, dropped, returned }
    }

    fn owed(&self) -> i128 {
        if self.text.shows() { (self.shown * self.tick as f64) as i128 } else { 0 }
    }

    fn tick(&self) -> Option<i128> {
        Some(self.tick)
    }

    fn boxed_clone(&self) -> Box<dyn Policy> {
        Box::new(self.clone())
    }
}
