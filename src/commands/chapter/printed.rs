//! Numbers as the chapter prints them, and the tick for numbers that agree.

/// A row of Table 7-1: time in seconds, then speed in m/s exactly and by Euler's method, and the error.
pub(super) const TABLE_7_1: [(f64, [&str; 3]); 5] = [
    (6.5, ["9.559084", "9.733158", "1.82%"]),
    (7.0, ["10.06829", "10.2465", "1.77%"]),
    (7.5, ["10.55267", "10.73418", "1.72%"]),
    (8.0, ["11.01342", "11.19747", "1.67%"]),
    (8.5, ["11.4517", "11.63759", "1.62%"]),
];

/// The average errors over those rows, of three methods.
pub(super) const AVERAGES: [(&str, &str); 3] =
    [("explicit-euler", "1.72%"), ("improved-euler", "0.03%"), ("rk4", "3.6e-6%")];

/// The number found, with a tick if the chapter prints the same, or else with the printed number.
pub(super) fn marked(found: &str, printed: &str) -> String {
    if found == printed { format!("{found} ✓") } else { format!("{found} (printed: {printed})") }
}

/// As C's `%.7g` prints it, for numbers from 1e-4 up to 1e7.
pub(super) fn seven_digits(x: f64) -> String {
    let digits_before = libm::floor(libm::log10(x.abs())) as i32;
    // Rounding may carry into another digit.
    let carried = format!("{x:.6e}").rsplit('e').next().and_then(|e| e.parse().ok());
    let decimals = usize::try_from(6 - carried.unwrap_or(digits_before)).unwrap_or(0);
    let fixed = format!("{x:.decimals$}");
    match fixed.contains('.') {
        true => fixed.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => fixed,
    }
}

/// As C's `%.2f%%` prints it; two digits and a power of ten where that would print 0.
pub(super) fn percent(x: f64) -> String {
    if x.abs() < 0.005 { format!("{x:.1e}%") } else { format!("{x:.2}%") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_printed_as_c_prints_them() {
        for (x, shown) in [
            (10.246500418, "10.2465"),
            (9.7331583, "9.733158"),
            (11.45170136, "11.4517"),
            (9.99999999, "10"),
            (0.000123456789, "0.0001234568"),
            (1234567.8, "1234568"),
        ] {
            assert_eq!(seven_digits(x), shown);
        }
        assert_eq!(percent(1.7210), "1.72%");
        assert_eq!(percent(3.648e-6), "3.6e-6%");
    }

    #[test]
    fn what_differs_shows_both() {
        assert_eq!(marked("9.5", "9.5"), "9.5 ✓");
        assert_eq!(marked("9.5", "9.6"), "9.5 (printed: 9.6)");
    }
}
