//! Reads numbers from text, and measures the distance between two numbers.

pub(super) fn parsed(cell: &[u8]) -> Option<f64> {
    std::str::from_utf8(cell).ok()?.trim().parse().ok()
}

/// Texts that loggers write for a missing number, in upper or lower case.
const NO_NUMBER: [&str; 8] = ["", "-", "na", "n/a", "null", "none", "nil", "--"];

/// Whether this cell makes its column text, because it is neither a number nor a mark for a missing one. A hash may
/// look like a number with an exponent, but nobody writes zeros before a mantissa.
pub(super) fn is_text(cell: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(cell) else { return true };
    let text = text.trim();
    if parsed(cell).is_some() {
        let has_zeros =
            text.starts_with('0') && text[1..].starts_with(|c: char| c.is_ascii_digit());
        return has_zeros && text.contains(['e', 'E']);
    }
    // Older C libraries write `-nan(ind)` and `1.#QNAN`.
    let is_nan = text.contains('#') || text.contains("nan(");
    !is_nan && !NO_NUMBER.iter().any(|known| text.eq_ignore_ascii_case(known))
}

/// Whether two cells that parse to the same number may mean different numbers. This happens to whole numbers with more
/// digits than a double has, and to finite numbers beyond the range of a double.
pub(super) fn hide_a_difference(cells: [&[u8]; 2], number: f64) -> bool {
    let has_digits = |cell: &[u8]| cell.iter().any(u8::is_ascii_digit);
    let is_whole = |cell: &[u8]| cell.trim_ascii().iter().all(u8::is_ascii_digit);
    match number.is_infinite() {
        true => cells.into_iter().any(has_digits),
        false => number.abs() >= 9_007_199_254_740_992.0 && cells.into_iter().all(is_whole),
    }
}

/// Whether both numbers are the same, or both are NaN. 0 and −0 are the same.
pub fn is_same_number(a: f64, b: f64) -> bool {
    a == b || a.is_nan() && b.is_nan()
}

/// Returns the distance in doubles, which is 1 for neighbours, and 0 for 0 and −0. `None` if one of the numbers is NaN.
pub fn distance_ulps(a: f64, b: f64) -> Option<u64> {
    // Bits of numbers with one sign sort like the numbers.
    let at = |x: f64| {
        let size = (x.to_bits() & (u64::MAX >> 1)) as i64;
        if x.is_sign_negative() { -size } else { size }
    };
    (!a.is_nan() && !b.is_nan()).then(|| at(a).abs_diff(at(b)))
}

/// Returns the difference relative to the larger number; `None` if this ratio is not finite.
pub(super) fn relative(a: f64, b: f64) -> Option<f64> {
    let (far, larger) = ((a - b).abs(), a.abs().max(b.abs()));
    // The difference between huge numbers of opposite sign may overflow, but the ratio does not.
    let part = if far.is_finite() { far / larger } else { (a / larger - b / larger).abs() };
    if a == b { Some(0.0) } else { part.is_finite().then_some(part) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_an_ulp_apart_across_zero_too() {
        let least = f64::from_bits(1);
        for (a, b, ulps) in [
            (1.0, 1.0 + f64::EPSILON, Some(1)),
            (0.0, -0.0, Some(0)),
            (-least, least, Some(2)),
            (f64::MAX, f64::INFINITY, Some(1)),
            (1.0, f64::NAN, None),
        ] {
            assert_eq!(distance_ulps(a, b), ulps, "{a} {b}");
            assert_eq!(distance_ulps(b, a), ulps, "{b} {a}");
        }
    }

    #[test]
    fn a_hash_that_looks_like_a_number_with_an_exponent_is_text() {
        for text in ["0000E012", "A1B2", "00e1", "left", "12:30", "2026-11-26"] {
            assert!(is_text(text.as_bytes()), "{text}");
        }
        for number in
            ["0", "007", "0e5", "1E+12", "-0.5", "nan", "inf", "", "NA", "-1.#IND", "-nan(ind)"]
        {
            assert!(!is_text(number.as_bytes()), "{number}");
        }
    }

    #[test]
    fn a_relative_difference_is_at_most_two() {
        assert_eq!(relative(1.0, 3.0), Some(2.0 / 3.0));
        assert_eq!(relative(-f64::MAX, f64::MAX), Some(2.0));
        assert_eq!(relative(0.0, -0.0), Some(0.0));
        assert_eq!(relative(1.0, f64::INFINITY), None);
    }
}
