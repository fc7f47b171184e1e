//! Converts the durations of frames into whole ticks, exactly. This is the heart of every loop with a fixed timestep.
//!
//! Owed time is an integer in nanoseconds × ticks × percent, because a rate is a ratio of ticks to seconds. In this
//! unit a tick is a whole number at any [`TickRate`] and at any whole percentage of real time, so that nothing is
//! rounded. However a day is cut into frames, it has 5 184 000 ticks at 60 Hz, and 5 178 816 ticks at 59.94 Hz.

use std::fmt;
use std::time::Duration;

use super::tick_rate::TickRate;

#[cfg(feature = "serde")]
mod saved;

/// A second in nanoseconds × percent.
const SECOND: i128 = 1_000_000_000 * 100;
/// The largest `f64` below 1.
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// Converts real time into ticks.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(try_from = "saved::SavedClock", into = "saved::SavedClock"))]
pub struct Clock {
    tick_hz: TickRate,
    speed_percent: u32,
    max_frame_ms: u32,
    /// The owed time, less than one tick.
    accumulator: Accumulator,
}

/// The error about a tick rate in Hz outside [`Clock::TICK_HZ`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TickRateError(pub TickRate);

impl fmt::Display for TickRateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (least, most) = Clock::TICK_HZ.into_inner();
        write!(f, "a clock runs at {least} to {most} Hz; {} Hz is outside", self.0)
    }
}

impl std::error::Error for TickRateError {}

/// The default clock runs at 60 Hz.
impl Default for Clock {
    fn default() -> Self {
        Self::new(60)
    }
}

impl Clock {
    /// The tick rates at which a clock can run, in Hz.
    pub const TICK_HZ: std::ops::RangeInclusive<TickRate> = TickRate::MIN..=TickRate::MAX;
    /// The speeds at which a clock can run, in percent of real time.
    pub const SPEED_PERCENT: std::ops::RangeInclusive<u32> = 1..=10_000;

    /// Returns a clock at full speed that owes nothing.
    ///
    /// # Panics
    /// If the rate is not in [`Clock::TICK_HZ`]; [`Clock::try_new`] returns an error instead.
    #[track_caller]
    pub fn new(tick_hz: impl Into<TickRate>) -> Self {
        // A closure would panic at its own line, rather than at the line of the caller.
        match Self::try_new(tick_hz) {
            Ok(clock) => clock,
            Err(error) => panic!("{error}"),
        }
    }

    /// Returns a clock at full speed that owes nothing, at a rate from a file or a person.
    ///
    /// # Errors
    /// If the rate is not in [`Clock::TICK_HZ`].
    pub fn try_new(tick_hz: impl Into<TickRate>) -> Result<Self, TickRateError> {
        let tick_hz = tick_hz.into();
        if !tick_hz.is_in_range() {
            return Err(TickRateError(tick_hz));
        }
        let (max_frame_ms, accumulator) = (MAX_FRAME_MS, Accumulator::default());
        Ok(Self { tick_hz, speed_percent: 100, max_frame_ms, accumulator })
    }

    /// Returns the tick rate.
    pub fn tick_hz(&self) -> TickRate {
        self.tick_hz
    }

    /// Returns the length of a tick, in seconds.
    pub fn dt_s(&self) -> f64 {
        self.tick_hz.step_s()
    }

    /// Returns the length of a tick in nanoseconds × ticks × percent.
    fn tick(&self) -> i128 {
        SECOND * i128::from(self.tick_hz.ratio()[1])
    }

    /// Returns the owed time per nanosecond of real time.
    fn pace(&self) -> i128 {
        i128::from(self.tick_hz.ratio()[0]) * i128::from(self.speed_percent)
    }

    /// Returns the speed in percent of real time.
    pub fn speed_percent(&self) -> u32 {
        self.speed_percent
    }

    /// Changes the tick rate. The owed fraction of a tick stays the same, so that nothing drawn jumps.
    ///
    /// # Panics
    /// The same as for [`Clock::new`].
    #[track_caller]
    pub fn set_tick_hz(&mut self, tick_hz: impl Into<TickRate>) {
        let before = self.tick_hz.ratio()[1].into();
        self.tick_hz = Self::new(tick_hz).tick_hz;
        self.accumulator.scale(self.tick_hz.ratio()[1].into(), before);
    }

    /// Changes the speed, clamped to [`Clock::SPEED_PERCENT`]. The speed is never 0: a game that pauses does not call
    /// [`Clock::advance`].
    pub fn set_speed_percent(&mut self, percent: u32) {
        self.speed_percent =
            percent.clamp(*Self::SPEED_PERCENT.start(), *Self::SPEED_PERCENT.end());
    }

    /// Changes the longest real time in milliseconds with which one frame catches up. It is [`MAX_FRAME_MS`] at first.
    pub fn set_max_frame_ms(&mut self, milliseconds: u32) {
        self.max_frame_ms = milliseconds;
    }

    /// Returns the maximum number of ticks per frame, which is the ticks in the longest frame, and at least one.
    pub fn max_ticks(&self) -> u32 {
        max_ticks(self.tick_hz, self.speed_percent, self.max_frame_ms)
    }

    /// Adds a frame and returns the ticks due. A frame longer than 292 years counts as one of these.
    pub fn advance_by(&mut self, frame: Duration) -> Due {
        self.advance(i64::try_from(frame.as_nanos()).unwrap_or(i64::MAX))
    }

    /// Adds a frame of `frame_ns` nanoseconds and returns the ticks due. A negative duration counts as 0.
    pub fn advance(&mut self, frame_ns: i64) -> Due {
        let time = i128::from(frame_ns.max(0)) * self.pace();
        self.accumulator.advance(time, self.tick(), self.max_ticks())
    }

    /// Returns the fraction of the next tick that has passed in real time, in [0, 1).
    pub fn alpha(&self) -> f64 {
        (self.accumulator.owed() as f64 / self.tick() as f64).min(BELOW_ONE)
    }

    /// Returns [`Clock::alpha`] as a numerator and a denominator. The denominator is the same for all whole rates. The
    /// fraction is exact if the rate has at most seven digits after the point, and otherwise off by less than 2⁻⁶².
    pub fn alpha_fraction(&self) -> (u64, u64) {
        let unit = (self.tick() >> 63) + 1;
        ((self.accumulator.owed() / unit) as u64, (self.tick() / unit) as u64)
    }

    /// Returns the shortest frame in nanoseconds after which `ticks` ticks are due.
    pub fn ns_until(&self, ticks: u64) -> u64 {
        let due = i128::from(ticks) * self.tick() - self.accumulator.owed();
        u64::try_from(due.unsigned_abs().div_ceil(self.pace().unsigned_abs())).unwrap_or(u64::MAX)
    }

    /// Sets the owed time to just below a tick, so that the next frame makes a tick.
    pub fn fill(&mut self) {
        self.accumulator.fill(self.tick());
    }

    /// Sets the owed time to 0.
    pub fn restart(&mut self) {
        self.accumulator.clear();
    }
}

/// The longest real time that one frame catches up with, in milliseconds, which is 15 ticks at 60 Hz. With a longer
/// time, a slow machine would fall further behind with each frame. With a shorter time, a hitch would show as slow
/// motion.
pub const MAX_FRAME_MS: u32 = 250;

/// The ticks that a frame has to simulate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Due {
    /// Ticks to step in this frame.
    pub ticks: u32,
    /// Ticks dropped because the frame exceeded the cap, so that the simulation falls behind real time.
    pub dropped: u64,
}

/// Owed time, less than a tick.
///
/// The owed time is an integer in a unit that the caller chooses. A tick must be a whole number of these units, so that
/// nothing is ever rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Accumulator {
    owed: i128,
}

impl Accumulator {
    /// Returns the time since the last tick was due.
    pub fn owed(&self) -> i128 {
        self.owed
    }

    /// Adds `time`, which must not be negative, and removes the ticks of length `tick` that are due. Ticks beyond
    /// `most` are dropped.
    pub fn advance(&mut self, time: i128, tick: i128, most: u32) -> Due {
        self.owed += time;
        let whole = u64::try_from(self.owed / tick).expect("a frame is at most 2^63 ns");
        self.owed %= tick;
        let ticks = u64::from(most).min(whole);
        Due { ticks: ticks as u32, dropped: whole - ticks }
    }

    /// Sets the owed time to one unit below a tick of length `tick`.
    pub fn fill(&mut self, tick: i128) {
        self.owed = tick - 1;
    }

    /// Changes the unit, so that `parts` present units become `whole` new ones. Drops fractions of a unit.
    fn scale(&mut self, whole: i128, parts: i128) {
        self.owed = self.owed / parts * whole + self.owed % parts * whole / parts;
    }

    /// Sets the owed time to 0.
    pub fn clear(&mut self) {
        self.owed = 0;
    }
}

/// Returns the maximum number of ticks in a frame, which is the ticks in `longest_ms` milliseconds, and at least one.
fn max_ticks(tick_hz: TickRate, speed_percent: u32, longest_ms: u32) -> u32 {
    let [ticks, seconds] = tick_hz.ratio().map(u128::from);
    let ticks = ticks * u128::from(speed_percent) * u128::from(longest_ms);
    let most = ticks.div_ceil(seconds * 100 * 1000);
    u32::try_from(most.max(1)).expect("at most 10 000 Hz at a hundredfold speed")
}

#[cfg(test)]
mod tests {
    use super::*;

    const DAY_NS: i64 = 86_400 * 1_000_000_000;

    fn run(clock: &mut Clock, frames: impl Iterator<Item = i64>) -> (u64, u64) {
        frames.fold((0, 0), |(ticks, dropped), frame| {
            let due = clock.advance(frame);
            assert!((0.0..1.0).contains(&clock.alpha()));
            (ticks + u64::from(due.ticks), dropped + due.dropped)
        })
    }

    #[test]
    fn a_day_at_60_hz_is_5_184_000_ticks_at_any_frame_rate() {
        for fps in [24, 60, 144, 240] {
            let frames = 86_400 * fps;
            let at = |frame: i64| (i128::from(frame) * 1_000_000_000 / i128::from(fps)) as i64;
            let mut clock = Clock::new(60);
            let total = run(&mut clock, (0..frames).map(|i| at(i + 1) - at(i)));
            assert_eq!(total, (5_184_000, 0), "at {fps} frames a second");
            assert_eq!(clock.alpha(), 0.0);
        }
    }

    #[test]
    fn the_longest_frame_and_its_unit_are_the_games_choice() {
        let mut clock = Clock::new(60);
        assert_eq!(clock.advance(1_000_000_000), Due { ticks: 15, dropped: 45 });
        clock.set_max_frame_ms(500);
        assert_eq!(clock.advance_by(Duration::from_secs(1)), Due { ticks: 30, dropped: 30 });
        clock.set_max_frame_ms(0);
        assert_eq!(clock.advance_by(Duration::from_millis(100)), Due { ticks: 1, dropped: 5 });
        assert!(clock.advance_by(Duration::MAX).dropped > 1 << 38);
    }

    #[test]
    fn a_day_at_a_fractional_rate_has_exactly_its_ticks() {
        let steps = ["0.015", "0.003", "1.7"].map(|step| TickRate::of_step(step).unwrap());
        let rates = ["59.94", "66.667", "60000/1001", "0.123456789"].map(|hz| hz.parse().unwrap());
        for rate in rates.into_iter().chain(steps) {
            let [ticks, seconds] = rate.ratio();
            let due =
                |ns: i64| ns as u128 * u128::from(ticks) / (u128::from(seconds) * 1_000_000_000);
            let mut clock = Clock::new(rate);
            let (mut passed, mut made) = (0, 0);
            // The frames last 100 to 160 ms.
            for frame in (0..).map(|i| 100_000_007 + i % 7 * 10_000_019) {
                let frame = DAY_NS.min(passed + frame) - passed;
                passed += frame;
                let Due { ticks, dropped } = clock.advance(frame);
                made += u128::from(ticks);
                assert_eq!((made, dropped), (due(passed), 0), "{rate} Hz after {passed} ns");
                if passed == DAY_NS {
                    break;
                }
            }
        }
        for (hz, ticks) in [("59.94", 5_178_816), ("66.667", 5_760_028)] {
            let mut clock = Clock::new(hz.parse::<TickRate>().unwrap());
            let frames = std::iter::repeat_n(100_000_000, 864_000);
            assert_eq!(run(&mut clock, frames), (ticks, 0), "{hz} Hz");
            assert!(clock.alpha() < 0.9, "{hz} Hz");
        }
    }

    #[test]
    fn the_highest_rate_at_the_highest_speed_takes_the_longest_frame() {
        let mut clock = Clock::new("9999.999999999".parse::<TickRate>().unwrap());
        clock.set_speed_percent(10_000);
        clock.fill();
        let due = clock.advance(i64::MAX);
        // The frame lasts 9.2 · 10⁹ s, at a million ticks a second.
        let wanted = i64::MAX as u128 * 9_999_999_999_999 / 10_u128.pow(16);
        assert!((u128::from(due.dropped) + 250_000).abs_diff(wanted) <= 1, "{due:?}, {wanted}");
    }

    #[test]
    fn a_change_between_fractional_rates_keeps_the_pending_time() {
        let mut clock = Clock::new(TickRate::of_step("0.015").unwrap());
        clock.advance(10_000_000);
        for rate in ["59.94", "0.123456789", "333.333333333", "1/0.015"] {
            clock.set_tick_hz(rate.parse::<TickRate>().unwrap());
            assert!((clock.alpha() - 2.0 / 3.0).abs() < 1e-11, "{rate} Hz: {}", clock.alpha());
        }
    }

    #[test]
    fn every_rate_and_speed_divides_an_hour_exactly() {
        for tick_hz in [1, 2, 7, 49, 60, 997, 10_000] {
            for percent in [25, 50, 100, 400, 1600] {
                let mut clock = Clock::new(tick_hz);
                clock.set_speed_percent(percent);
                let frame = 8_333_333;
                let whole = 3_600_000_000_000 / frame;
                let rest = 3_600_000_000_000 - whole * frame;
                let frames = std::iter::repeat_n(frame, whole as usize).chain([rest]);
                let ticks = 3600 * u64::from(tick_hz) * u64::from(percent) / 100;
                assert_eq!(run(&mut clock, frames), (ticks, 0), "{tick_hz} Hz at {percent} %");
            }
        }
    }

    #[test]
    fn a_frame_of_no_time_or_less_owes_nothing() {
        let mut clock = Clock::new(60);
        assert_eq!(clock.advance(0), Due::default());
        assert_eq!(clock.advance(-5), Due::default());
        assert_eq!(clock.advance(i64::MIN), Due::default());
        assert_eq!(clock.alpha(), 0.0);
    }

    #[test]
    fn a_long_frame_is_capped_and_the_rest_is_reported() {
        let mut clock = Clock::new(60);
        assert_eq!(clock.advance(10_000_000_000), Due { ticks: 15, dropped: 585 });
        let due = clock.advance(i64::MAX);
        assert_eq!(due.ticks, 15);
        assert_eq!(due.dropped + 15, i64::MAX as u64 / 1_000_000_000 * 60 + 51);
        let mut day = Clock::new(10_000);
        day.set_speed_percent(1600);
        assert_eq!(day.advance(DAY_NS).ticks, 40_000);
    }

    #[test]
    fn a_slow_tick_still_comes_on_time() {
        let mut clock = Clock::new(1);
        let total = run(&mut clock, std::iter::repeat_n(100_000_000, 30));
        assert_eq!(total, (3, 0));
    }

    #[test]
    fn a_clock_knows_its_tick_length_and_clocks_with_equal_debt_are_equal() {
        assert_eq!(
            [60, 120, 7].map(|hz| Clock::new(hz).dt_s()),
            [1.0 / 60.0, 1.0 / 120.0, 1.0 / 7.0]
        );
        let mut clock = Clock::default();
        assert_eq!(clock, Clock::new(60));
        clock.advance(1_000_000);
        assert_ne!(clock, Clock::new(60));
    }

    #[test]
    fn alpha_is_an_exact_fraction() {
        let mut clock = Clock::new(60);
        clock.advance(1_000_000_000 / 64);
        let (numerator, denominator) = clock.alpha_fraction();
        assert_eq!(64 * numerator, 60 * denominator);
        assert_eq!(clock.alpha(), numerator as f64 / denominator as f64);
        clock.advance(1_000_000_000 / 60);
        assert_eq!(clock.alpha_fraction().1, denominator);
    }

    #[test]
    fn a_clock_that_restarts_owes_nothing_and_keeps_rate_and_speed() {
        let mut clock = Clock::new(10);
        clock.set_tick_hz(20);
        clock.set_speed_percent(50);
        clock.advance(1_099_000_000);
        assert!(clock.alpha() > 0.9);
        clock.restart();
        assert_eq!((clock.alpha(), clock.tick_hz(), clock.speed_percent()), (0.0, 20.into(), 50));
        assert_eq!(clock.advance(99_999_999).ticks, 0);
        assert_eq!(clock.advance(1).ticks, 1);
    }

    #[test]
    fn a_full_clock_ticks_in_the_next_frame_without_losing_time() {
        let mut clock = Clock::new(60);
        clock.fill();
        assert!(clock.alpha() < 1.0 && clock.alpha() > 1.0 - 1e-10);
        assert_eq!(clock.advance(0).ticks, 0);
        assert_eq!(clock.advance(16_000_000).ticks, 1);
        assert!((clock.alpha() - 0.96).abs() < 1e-9);
    }

    #[test]
    fn a_change_of_rate_keeps_the_pending_part_of_a_tick() {
        let mut clock = Clock::new(2);
        clock.advance(400_000_000);
        let alpha = clock.alpha();
        assert!((0.79..0.81).contains(&alpha));
        clock.set_tick_hz(1000);
        assert_eq!(clock.alpha(), alpha);
        assert_eq!(clock.advance(0).ticks, 0);
    }
}
