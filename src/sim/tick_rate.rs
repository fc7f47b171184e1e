//! A tick rate as a ratio of integers, so that 66.667 Hz and a step of 0.015 s are as exact as 60 Hz.
//!
//! A rate and a display influence each other. Without drawing between ticks, 50 Hz on a display of 60 Hz repeats every
//! sixth picture. At equal rates the rounding of frame times decides between no tick, one and two. Drawing between
//! ticks hides both, and is a tick late.

use std::cmp::Ordering;
use std::fmt;
use std::str::FromStr;

/// The maximum number of digits after the point of a rate or a step. The last digit of a step is a nanosecond.
const MAX_DIGITS: usize = 9;

/// The largest term of a ratio read from text; all rates of [`MAX_DIGITS`] digits have smaller terms. An `f64`
/// represents this term exactly. The integers of the [`Clock`](super::Clock) have room for this term times the longest
/// frame at the highest speed.
const MAX_TERM: u64 = 100_000_000_000_000;

/// A number of ticks per second, as the ratio `ticks / seconds` in lowest terms.
///
/// Any whole number of hertz is a rate, even 0, at which no clock runs. A rate [read](FromStr) from text is in the
/// range of a clock.
///
/// ```
/// use regatta_sim::TickRate;
///
/// let source: TickRate = TickRate::of_step("0.015").expect("a step");
/// assert_eq!(source, "200/3".parse::<TickRate>().expect("a rate"));
/// assert_eq!((source.step_s(), source.seconds(200)), (0.015, 3.0));
/// assert_eq!(TickRate::from(60), "60.0".parse::<TickRate>().expect("a rate"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TickRate {
    ticks: u64,
    seconds: u64,
}

impl TickRate {
    /// The lowest rate of a clock, which is one tick in 100 seconds.
    pub const MIN: Self = Self { ticks: 1, seconds: 100 };
    /// The highest rate of a clock, which is 10 000 Hz.
    pub const MAX: Self = Self::whole(10_000);

    /// Returns the rate of a whole number of ticks per second.
    pub const fn whole(hz: u32) -> Self {
        Self { ticks: hz as u64, seconds: 1 }
    }

    /// Reads the length of a tick in seconds, which is a decimal or a ratio of two decimals, such as `0.015` or
    /// `1/66.667`. It may end with `s` or `ms`.
    ///
    /// # Errors
    /// An error message that explains how to write the length.
    pub fn of_step(written: &str) -> Result<Self, String> {
        let (number, per_second) = match written.strip_suffix('s') {
            Some(number) => number.strip_suffix('m').map_or((number, 1), |number| (number, 1000)),
            None => (written, 1),
        };
        let step = ratio(number.trim_end());
        let rate = step.and_then(|[s, parts]| Self::checked(parts * per_second, s));
        rate.ok_or_else(|| {
            let [least, most] = [Self::MAX, Self::MIN].map(Self::step_s);
            format!(
                "give a step from {least} to {most} s, with at most {MAX_DIGITS} digits after the point, such as 0.015 or 1/66.667"
            )
        })
    }

    /// Returns the ratio in lowest terms.
    fn reduced(ticks: u128, seconds: u128) -> Self {
        let (mut common, mut rest) = (ticks, seconds);
        while rest > 0 {
            (common, rest) = (rest, common % rest);
        }
        let term = |whole: u128| u64::try_from(whole / common.max(1)).unwrap_or(u64::MAX);
        Self { ticks: term(ticks), seconds: term(seconds) }
    }

    /// Returns the rate of this ratio; `None` if no clock runs at it.
    fn checked(ticks: u128, seconds: u128) -> Option<Self> {
        let rate = Self::reduced(ticks, seconds);
        (rate.ticks.max(rate.seconds) <= MAX_TERM && rate.is_in_range()).then_some(rate)
    }

    /// Whether a clock runs at this rate.
    pub fn is_in_range(self) -> bool {
        self.seconds > 0 && (Self::MIN..=Self::MAX).contains(&self)
    }

    /// Returns this rate times `times / parts`. The result need not be in the range of a clock.
    pub fn scaled(self, times: u32, parts: u32) -> Self {
        Self::reduced(
            u128::from(self.ticks) * u128::from(times),
            u128::from(self.seconds) * u128::from(parts),
        )
    }

    /// Returns the rate in lowest terms, as a number of ticks and the whole seconds that they take.
    pub fn ratio(self) -> [u64; 2] {
        [self.ticks, self.seconds]
    }

    /// Returns the rate in Hz, if it is whole.
    pub fn whole_hz(self) -> Option<u32> {
        u32::try_from(self.ticks).ok().filter(|_| self.seconds == 1)
    }

    /// Returns the rate in Hz, to the nearest `f64`.
    pub fn hz(self) -> f64 {
        self.ticks as f64 / self.seconds as f64
    }

    /// Returns the length of a tick in seconds, to the nearest `f64`.
    pub fn step_s(self) -> f64 {
        self.seconds as f64 / self.ticks as f64
    }

    /// Returns the duration of this many ticks, in seconds.
    pub fn seconds(self, ticks: u64) -> f64 {
        self.seconds_of(ticks as f64)
    }

    /// Returns the duration of this many ticks, including fractions, in seconds.
    pub fn seconds_of(self, ticks: f64) -> f64 {
        ticks * self.seconds as f64 / self.ticks as f64
    }

    /// Returns the rate in Hz as a decimal; `None` if it needs more than nine digits after the point.
    pub fn decimal_hz(self) -> Option<String> {
        decimal(self.ticks, self.seconds)
    }

    /// Returns the length of a tick in seconds as a decimal; `None` if it needs more than nine digits after the point.
    pub fn decimal_step_s(self) -> Option<String> {
        decimal(self.seconds, self.ticks)
    }
}

impl From<u32> for TickRate {
    fn from(hz: u32) -> Self {
        Self::whole(hz)
    }
}

/// Converts the rate to hertz.
impl From<TickRate> for f64 {
    fn from(rate: TickRate) -> Self {
        rate.hz()
    }
}

impl Ord for TickRate {
    fn cmp(&self, other: &Self) -> Ordering {
        let cross = |a: &Self, b: &Self| u128::from(a.ticks) * u128::from(b.seconds);
        cross(self, other).cmp(&cross(other, self))
    }
}

impl PartialOrd for TickRate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq<u32> for TickRate {
    fn eq(&self, hz: &u32) -> bool {
        *self == Self::whole(*hz)
    }
}

impl PartialOrd<u32> for TickRate {
    fn partial_cmp(&self, hz: &u32) -> Option<Ordering> {
        self.partial_cmp(&Self::whole(*hz))
    }
}

/// Writes a text that reads back as the same rate: `66.667`, or `1/0.015` if only the step is a decimal, or
/// `60000/1001`. With a precision, as in `{:.3}`, writes the nearest decimal with at most that many digits after the
/// point, for people.
impl fmt::Display for TickRate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(digits) = f.precision() {
            let rounded = format!("{:.digits$}", self.hz());
            let shortest = rounded.trim_end_matches('0').trim_end_matches('.');
            return f.write_str(if rounded.contains('.') { shortest } else { &rounded });
        }
        match (self.decimal_hz(), self.decimal_step_s()) {
            (Some(hz), _) => f.write_str(&hz),
            (None, Some(step_s)) => write!(f, "1/{step_s}"),
            (None, None) => write!(f, "{}/{}", self.ticks, self.seconds),
        }
    }
}

impl FromStr for TickRate {
    type Err = String;

    /// Reads a rate in Hz, which is a decimal or a ratio of two decimals, such as `59.94` or `60000/1001`.
    fn from_str(written: &str) -> Result<Self, String> {
        let rate = ratio(written).and_then(|[ticks, seconds]| Self::checked(ticks, seconds));
        rate.ok_or_else(|| {
            format!(
                "give a rate from {} to {} Hz, with at most {MAX_DIGITS} digits after the point, such as 66.667",
                Self::MIN,
                Self::MAX
            )
        })
    }
}

/// Reads a number from a file. Its shortest decimal is the text in the file.
impl TryFrom<f64> for TickRate {
    type Error = String;

    fn try_from(hz: f64) -> Result<Self, String> {
        hz.to_string().parse()
    }
}

/// Writes a number in Hz, which is an integer if the rate is whole.
#[cfg(feature = "serde")]
impl serde::Serialize for TickRate {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.whole_hz() {
            Some(hz) => serializer.serialize_u32(hz),
            None => serializer.serialize_f64(self.hz()),
        }
    }
}

/// Reads a decimal, or a ratio of two decimals, as a ratio of integers.
fn ratio(written: &str) -> Option<[u128; 2]> {
    let (above, below) = written.split_once('/').unwrap_or((written, "1"));
    let [[a, a_parts], [b, b_parts]] = [integers(above)?, integers(below)?];
    Some([a * b_parts, b * a_parts])
}

/// Reads a decimal as a ratio of integers below 2⁶⁴.
fn integers(decimal: &str) -> Option<[u128; 2]> {
    let (whole, part) = decimal.split_once('.').unwrap_or((decimal, ""));
    let digits = format!("{whole}{part}");
    let is_decimal = digits.bytes().all(|byte| byte.is_ascii_digit()) && part.len() <= MAX_DIGITS;
    let value = digits.parse::<u64>().ok().filter(|_| is_decimal)?;
    Some([value.into(), 10_u128.pow(part.len() as u32)])
}

/// Returns `above / below` as the shortest decimal; `None` if it needs more than [`MAX_DIGITS`] digits after the point.
fn decimal(above: u64, below: u64) -> Option<String> {
    let scaled = |digits: &usize| u128::from(above) * 10_u128.pow(*digits as u32);
    let is_whole = |digits: &usize| scaled(digits).checked_rem(below.into()) == Some(0);
    let digits = (0..=MAX_DIGITS).find(is_whole)?;
    let parts = 10_u128.pow(digits as u32);
    let value = scaled(&digits) / u128::from(below);
    Some(match digits {
        0 => value.to_string(),
        _ => format!("{}.{:0digits$}", value / parts, value % parts),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rate(written: &str) -> TickRate {
        written.parse().unwrap_or_else(|remedy| panic!("{written}: {remedy}"))
    }

    #[test]
    fn a_rate_is_the_exact_ratio_of_its_digits() {
        for (written, ratio) in [
            ("60", [60, 1]),
            ("60.0", [60, 1]),
            ("060.", [60, 1]),
            (".5", [1, 2]),
            ("66.667", [66_667, 1000]),
            ("59.94", [2997, 50]),
            ("333.333333333", [333_333_333_333, 1_000_000_000]),
            ("60000/1001", [60_000, 1001]),
            ("1/0.015", [200, 3]),
            ("0.01", [1, 100]),
            ("10000", [10_000, 1]),
        ] {
            assert_eq!(rate(written).ratio(), ratio, "{written}");
        }
    }

    #[test]
    fn a_step_is_the_inverse_of_a_rate() {
        for (written, same) in [
            ("0.015", "200/3"),
            ("0.015s", "200/3"),
            ("15 ms", "200/3"),
            ("16.666667ms", "1000/16.666667"),
            ("1/66.667", "66.667"),
            ("0.003", "1000/3"),
            ("2.5", "0.4"),
            ("100", "0.01"),
            ("0.0001", "10000"),
        ] {
            assert_eq!(TickRate::of_step(written), Ok(rate(same)), "{written}");
        }
    }

    #[test]
    fn an_invalid_rate_or_step_is_refused_with_the_range() {
        for bad in [
            "",
            ".",
            "0",
            "-60",
            "+60",
            "nan",
            "inf",
            "1e400",
            "6e1",
            "60 Hz",
            "1/0",
            "0/1",
            "1/2/3",
            "66.6666666667",
            "0.009",
            "10000.1",
            "1e9",
            "99999999999999999999",
            "60,5",
            "½",
        ] {
            let remedy = bad.parse::<TickRate>().expect_err(bad);
            assert_eq!(
                remedy,
                "give a rate from 0.01 to 10000 Hz, with at most 9 digits after the point, such as 66.667"
            );
            assert!(TickRate::of_step(bad).is_err() || bad == "0.009", "{bad}");
        }
        assert_eq!(
            TickRate::of_step("101").expect_err("too long"),
            "give a step from 0.0001 to 100 s, with at most 9 digits after the point, such as 0.015 or 1/66.667"
        );
    }

    #[test]
    fn a_rate_survives_reading_and_writing() {
        for written in ["60", "66.667", "59.94", "0.01", "1/0.015", "1/0.003", "60000/1001", "0.4"]
        {
            assert_eq!(rate(written).to_string(), written);
        }
        let short = ["60", "66.667", "1/0.015", "1/0.003", "0.01", "333.333333333"];
        let short = short.map(|written| format!("{:.3}", rate(written)));
        assert_eq!(short, ["60", "66.667", "66.667", "333.333", "0.01", "333.333"]);
    }

    #[test]
    fn a_whole_rate_has_the_bits_of_its_integer() {
        for hz in [1, 7, 49, 60, 997, 10_000] {
            let rate = TickRate::from(hz);
            assert_eq!((rate.whole_hz(), rate.hz()), (Some(hz), f64::from(hz)));
            assert_eq!(rate.step_s(), 1.0 / f64::from(hz));
            for ticks in [0, 1, 59, 123_456_789, 315_360_000_000] {
                assert_eq!(rate.seconds(ticks), ticks as f64 / f64::from(hz));
            }
            assert!(rate == hz && rate < hz + 1 && rate > hz - 1);
        }
    }

    #[test]
    fn rates_are_in_order_and_scale_exactly() {
        let rates = ["0.01", "0.4", "59.94", "60000/1001", "60", "1/0.015", "66.667"].map(rate);
        assert!(rates.is_sorted_by(|a, b| a < b));
        assert_eq!(rate("66.667").scaled(8, 1), rate("533.336"));
        assert_eq!(rate("66.667").scaled(1, 4), rate("16.66675"));
        assert_eq!(rate("9000").scaled(3, 2), 13_500);
        assert!(!TickRate::from(0).is_in_range() && !TickRate::from(10_001).is_in_range());
    }
}
