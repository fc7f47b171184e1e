//! Writes numbers for people, with a few significant digits, a true minus sign, and powers of ten for very large or
//! small values.

/// Writes `value` with `digits` significant digits. Values from 10⁵ up and below 10⁻³ get a power of ten.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "-".into();
    }
    let scientific = format!("{:.*e}", digits.saturating_sub(1), value.abs());
    let (mantissa, exponent) = scientific.split_once('e').expect("`{:e}` writes an exponent");
    let exponent: i32 = exponent.parse().expect("`{:e}` writes a whole exponent");
    let magnitude = if value == 0.0 {
        "0".into()
    } else if (-3..5).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        format!("{:.decimals$}", value.abs())
    } else {
        format!("{mantissa}·10{}", superscript(exponent))
    };
    if value < 0.0 { format!("\u{2212}{magnitude}") } else { magnitude }
}

/// Writes a number without trailing zeros, for the marks of an axis.
pub fn round(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (number, power) = text.split_at(text.find('·').unwrap_or(text.len()));
    if number.contains('.') {
        format!("{}{power}", number.trim_end_matches('0').trim_end_matches('.'))
    } else {
        text
    }
}

/// Returns the factor that enlarges a distance to fill `room`, which is 1, 2 or 5 times a power of ten. Returns `None`
/// if the distance already fills more than half of `room`, or is only a rounding error.
pub fn enlargement(distance: f64, room: f64) -> Option<f64> {
    /// A distance that is invisible at this magnification is a rounding error.
    const MAX: f64 = 1e10;
    let most = room / distance;
    let decade = libm::pow(10.0, libm::floor(libm::log10(most)));
    let times = [5.0, 2.0, 1.0].into_iter().map(|n| n * decade).find(|times| *times <= most)?;
    (2.0..=MAX).contains(&times).then_some(times)
}

/// Writes a number of things, such as `1 row` and `2 rows`.
pub fn counted(number: impl TryInto<u64>, thing: &str) -> String {
    let number = number.try_into().unwrap_or(u64::MAX);
    format!("{number} {thing}{}", if number == 1 { "" } else { "s" })
}

/// Writes a whole number with its thousands separated by spaces that do not break lines.
pub fn grouped(number: u64) -> String {
    match number {
        ..1000 => number.to_string(),
        _ => format!("{}\u{a0}{:03}", grouped(number / 1000), number % 1000),
    }
}

/// Writes a whole number in raised figures.
pub fn superscript(exponent: i32) -> String {
    let raise = |c: char| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => char::from_u32('⁰' as u32 + (digit as u32 - '0' as u32)).unwrap_or(digit),
    };
    exponent.to_string().chars().map(raise).collect()
}

/// Writes a duration to three digits, in the unit that fits its length.
pub fn duration(seconds: f64) -> String {
    in_unit(seconds, |value| round(value, 3))
}

/// Writes a duration in the unit that fits its length; `written` formats its number.
pub fn in_unit(seconds: f64, written: impl Fn(f64) -> String) -> String {
    const MINUTE: f64 = 60.0;
    const HOUR: f64 = 60.0 * MINUTE;
    const DAY: f64 = 24.0 * HOUR;
    // Seconds up to a thousand and hours up to two days, so that similar durations have one unit.
    let (unit, name) = match seconds {
        s if s < 999.5 => (1.0, "s"),
        s if s < HOUR => (MINUTE, "min"),
        s if s < 2.0 * DAY => (HOUR, "h"),
        s if s < 999.5 * DAY => (DAY, "days"),
        _ => (365.0 * DAY, "years"),
    };
    format!("{} {name}", written(seconds / unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_enlargement_is_round_and_fills_the_room() {
        for (distance, times) in
            [(0.02, Some(1000.0)), (0.004, Some(5000.0)), (8.0, Some(2.0)), (11.0, None)]
        {
            assert_eq!(enlargement(distance, 20.0), times, "{distance}");
        }
        assert_eq!((enlargement(0.0, 20.0), enlargement(1e-12, 20.0)), (None, None));
        assert_eq!((enlargement(f64::NAN, 20.0), enlargement(f64::INFINITY, 20.0)), (None, None));
    }

    #[test]
    fn thousands_are_separated() {
        let texts = [7, 1000, 10_020, 1_000_000].map(grouped);
        assert_eq!(texts, ["7", "1\u{a0}000", "10\u{a0}020", "1\u{a0}000\u{a0}000"]);
    }

    #[test]
    fn numbers_keep_their_significant_digits() {
        for (value, shown) in [
            (0.0, "0"),
            (9.733158334, "9.733"),
            (-0.016666, "\u{2212}0.01667"),
            (123.456, "123.5"),
            (99_999.6, "1.000·10⁵"),
            (123_456.0, "1.235·10⁵"),
            (0.0001234, "1.234·10⁻⁴"),
            (-3.7e38, "\u{2212}3.700·10³⁸"),
            (f64::NAN, "-"),
            (f64::INFINITY, "-"),
        ] {
            assert_eq!(significant(value, 4), shown);
        }
    }

    #[test]
    fn trailing_zeros_are_dropped() {
        for (value, digits, shown) in [
            (20.0, 4, "20"),
            (0.5, 4, "0.5"),
            (-2.5, 4, "\u{2212}2.5"),
            (0.0, 4, "0"),
            (2e6, 4, "2·10⁶"),
            (-2.5e25, 6, "\u{2212}2.5·10²⁵"),
        ] {
            assert_eq!(round(value, digits), shown);
        }
    }

    #[test]
    fn durations_have_three_digits_and_a_fitting_unit() {
        for (seconds, shown) in [
            (0.29, "0.29 s"),
            (2.1234, "2.12 s"),
            (20.0, "20 s"),
            (769.3, "769 s"),
            (1671.0, "27.9 min"),
            (13.7 * 3600.0, "13.7 h"),
            (14.6 * 86_400.0, "14.6 days"),
            (5e8, "15.9 years"),
        ] {
            assert_eq!(duration(seconds), shown);
        }
    }
}
