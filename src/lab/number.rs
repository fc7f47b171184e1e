//! Numbers for people: a few significant digits, a true minus sign, powers of ten where they help.

/// `value` with `digits` significant digits; from 10⁵ up and below 10⁻³ as a power of ten.
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

/// A number without trailing zeros, for the marks of an axis.
pub fn round(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    if text.contains('.') && !text.contains('·') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.replace(".000·", "·")
    }
}

/// A whole number in raised figures.
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

#[cfg(test)]
mod tests {
    use super::*;

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
    fn round_numbers_lose_their_noughts() {
        for (value, shown) in
            [(20.0, "20"), (0.5, "0.5"), (-2.5, "\u{2212}2.5"), (0.0, "0"), (2e6, "2·10⁶")]
        {
            assert_eq!(round(value, 4), shown);
        }
    }
}
