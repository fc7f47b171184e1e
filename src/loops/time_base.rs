//! The unit of time of a game loop. A nanosecond, a tick and a refresh of the display are whole numbers of this unit.

use std::fmt;
use std::str::FromStr;

use crate::sim::TickRate;

/// Longest time in any unit. It is so short that a sum of a few such times does not overflow.
const LONGEST: i128 = i128::MAX / 4;

/// Nanoseconds in a second.
const SECOND_NS: i128 = 1_000_000_000;

/// Refresh rate of a display. It is a fraction, because 59.94 Hz is not a whole number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RefreshRate {
    numerator: u32,
    denominator: u32,
}

impl RefreshRate {
    /// Valid rates in Hz.
    pub const HZ: std::ops::RangeInclusive<f64> = 1.0..=1000.0;

    /// Creates a rate of `numerator / denominator` in Hz.
    ///
    /// # Panics
    /// If the rate is not in [`RefreshRate::HZ`].
    pub const fn new(numerator: u32, denominator: u32) -> Self {
        assert!(denominator > 0 && numerator >= denominator && numerator / 1000 <= denominator);
        Self { numerator, denominator }
    }

    /// Creates the rate with a refresh of `period_ns` nanoseconds, clamped to [`RefreshRate::HZ`].
    pub fn of_period(period_ns: i64) -> Self {
        let period_ns = period_ns.clamp(1_000_000, 1_000_000_000) as u32;
        Self::new(SECOND_NS as u32, period_ns)
    }

    /// Returns the rate in Hz.
    pub fn hz(self) -> f64 {
        f64::from(self.numerator) / f64::from(self.denominator)
    }

    /// Returns a time in milliseconds. If it is the start of a refresh in whole nanoseconds, returns the exact start.
    pub(super) fn exact_ms(self, ns: i64) -> f64 {
        let nearest = (ns as f64 * self.hz() / SECOND_NS as f64).round();
        if ns >= 0 && self.refresh_ns(nearest as u64) == ns {
            return nearest * 1000.0 * f64::from(self.denominator) / f64::from(self.numerator);
        }
        ns as f64 / 1e6
    }

    /// Returns the start of refresh `n` in nanoseconds from the first, rounded up to the time at which a clock in
    /// nanoseconds sees it.
    pub fn refresh_ns(self, n: u64) -> i64 {
        let seconds_ns = u128::from(n) * u128::from(self.denominator) * SECOND_NS.unsigned_abs();
        let ns = seconds_ns.div_ceil(self.numerator.into());
        i64::try_from(ns).unwrap_or(i64::MAX)
    }
}

impl fmt::Display for RefreshRate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hundredths = (self.hz() * 100.0).round() / 100.0;
        write!(f, "{hundredths}")
    }
}

impl FromStr for RefreshRate {
    type Err = String;

    /// Parses a decimal with at most six digits after the point, such as `59.94`.
    fn from_str(written: &str) -> Result<Self, String> {
        const MILLION: u32 = 1_000_000;
        let rate = written.parse::<f64>().ok().filter(|hz| Self::HZ.contains(hz));
        let Some(hz) = rate else {
            let (least, most) = (Self::HZ.start(), Self::HZ.end());
            return Err(format!("give a refresh rate from {least} to {most} Hz, such as 59.94"));
        };
        let millionths = (hz * f64::from(MILLION)).round() as u32;
        let common = greatest_common_divisor(millionths.into(), MILLION.into()) as u32;
        Ok(Self::new(millionths / common, MILLION / common))
    }
}

/// Returns the greatest common divisor of two numbers that are not negative.
pub(super) fn greatest_common_divisor(mut a: i128, mut b: i128) -> i128 {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// Unit of time of one loop, which is a nanosecond divided by the numerators of the tick rate and the refresh rate.
///
/// A nanosecond, a tick and a refresh are whole numbers of this unit, so that days of frames add up without rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeBase {
    tick_hz: TickRate,
    refresh: RefreshRate,
}

impl TimeBase {
    /// Creates the unit for a tick rate and a display.
    ///
    /// # Panics
    /// If the tick rate is 0.
    pub fn new(tick_hz: impl Into<TickRate>, refresh: RefreshRate) -> Self {
        let tick_hz = tick_hz.into();
        assert!(tick_hz > 0, "the caller checks the tick rate");
        Self { tick_hz, refresh }
    }

    /// Returns the tick rate.
    pub fn tick_hz(&self) -> TickRate {
        self.tick_hz
    }
    /// Returns the length of a tick.
    pub fn tick(&self) -> i128 {
        SECOND_NS * self.tick_terms()[1] * i128::from(self.refresh.numerator)
    }
    /// Returns the time between two refreshes of the display.
    pub fn refresh(&self) -> i128 {
        SECOND_NS * i128::from(self.refresh.denominator) * self.tick_terms()[0]
    }
    /// Converts nanoseconds to this unit. With a tick rate of nine decimals, times are limited to 49 days.
    pub fn nanoseconds(&self, ns: i64) -> i128 {
        let ticks = i128::from(ns) * self.tick_terms()[0];
        ticks.saturating_mul(self.refresh.numerator.into()).clamp(-LONGEST, LONGEST)
    }

    /// Returns a number of ticks that last a whole number of seconds, and that number of seconds.
    fn tick_terms(&self) -> [i128; 2] {
        self.tick_hz.ratio().map(i128::from)
    }

    /// Converts a time to seconds. For n whole ticks, the result is to the bit n divided by the tick rate.
    pub fn seconds(&self, time: i128) -> f64 {
        let tick = self.tick();
        let part = time.rem_euclid(tick) as f64 / tick as f64;
        self.tick_hz.seconds_of(time.div_euclid(tick) as f64 + part)
    }

    /// Converts a time to milliseconds.
    pub fn milliseconds(&self, time: i128) -> f64 {
        let millisecond = self.nanoseconds(1_000_000);
        let part = time.rem_euclid(millisecond) as f64 / millisecond as f64;
        time.div_euclid(millisecond) as f64 + part
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nanoseconds_ticks_and_refreshes_are_whole_units_without_overflow() {
        for rate in ["1", "59.94", "60", "74.973", "144", "239.76", "1000"] {
            let refresh: RefreshRate = rate.parse().unwrap();
            assert_eq!(
                refresh.to_string().parse::<f64>().unwrap(),
                (refresh.hz() * 100.0).round() / 100.0
            );
            for tick_hz in ["1", "7", "60", "10000", "59.94", "66.667", "1/0.015", "9999.999999999"]
            {
                let tick_hz: TickRate = tick_hz.parse().unwrap();
                let base = TimeBase::new(tick_hz, refresh);
                let [ticks, seconds] = tick_hz.ratio();
                let second = base.nanoseconds(1_000_000_000);
                assert_eq!(base.tick() * i128::from(ticks), second * i128::from(seconds));
                let day = 86_400 * second;
                assert_eq!(day, base.nanoseconds(86_400_000_000_000));
                assert_eq!(base.seconds(day), 86_400.0);
                assert_eq!(base.milliseconds(day), 86_400_000.0);
                let seconds = base.seconds(base.refresh());
                assert!((seconds * refresh.hz() - 1.0).abs() < 1e-14, "{rate} Hz: {seconds} s");
            }
        }
    }

    #[test]
    fn whole_ticks_equal_the_seconds_of_a_race_to_the_bit() {
        let base = TimeBase::new(49, RefreshRate::of_period(16_683_333));
        for n in 0..1000 {
            assert_eq!(base.seconds(n * base.tick()), n as f64 / 49.0);
        }
        assert_eq!(base.seconds(base.tick()), 1.0 / 49.0);
    }

    #[test]
    fn a_time_of_centuries_is_clamped_at_fine_units() {
        let refresh = RefreshRate::of_period(16_683_333);
        let whole = TimeBase::new(10_000, refresh);
        assert_eq!(whole.nanoseconds(i64::MAX) / whole.nanoseconds(1), i64::MAX.into());
        let fine = TimeBase::new("9999.999999999".parse::<TickRate>().unwrap(), refresh);
        let days = fine.nanoseconds(i64::MAX) / fine.nanoseconds(86_400_000_000_000);
        assert_eq!(days, 49);
    }

    #[test]
    fn the_nanosecond_of_a_refresh_is_never_before_it() {
        let rate = RefreshRate::new(60, 1);
        let base = TimeBase::new(60, rate);
        for n in 0..1000 {
            let late = base.nanoseconds(rate.refresh_ns(n)) - i128::from(n) * base.refresh();
            assert!((0..base.nanoseconds(1)).contains(&late), "refresh {n}: {late}");
        }
    }

    #[test]
    fn a_refresh_rate_is_read_exactly_or_refused() {
        assert_eq!("59.94".parse(), Ok(RefreshRate::new(2997, 50)));
        for bad in ["", "0", "-60", "0.5", "1000.1", "nan", "inf", "60 Hz"] {
            let error = bad.parse::<RefreshRate>().unwrap_err();
            assert_eq!(error, "give a refresh rate from 1 to 1000 Hz, such as 59.94", "{bad}");
        }
    }
}
