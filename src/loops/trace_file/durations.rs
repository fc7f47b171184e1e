//! Parses the times in logs to whole nanoseconds.

use crate::scene::clip;
use crate::table::Unit;

const DAY_NS: i64 = 86_400_000_000_000;

/// Returns the number of decimals that a nanosecond has in this unit.
fn places(unit: Unit) -> i64 {
    match unit {
        Unit::Seconds => 9,
        Unit::Milliseconds => 6,
        Unit::Microseconds => 3,
        Unit::Nanoseconds | Unit::Ticks => 0,
    }
}

/// The reason why a cell is not a time.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum Unreadable {
    #[error("expected a time, found \"{0}\"; write a number such as 16.683, or NA")]
    NotANumber(String),
    #[error("{0} is negative; time does not run backwards: take the row out")]
    Negative(String),
    #[error("{0} is more than a day; take the row out")]
    TooLong(String),
}

/// Converts a decimal number in this unit to nanoseconds, rounding its digits once; `None` if the log marks the number
/// as missing. The decimal sign may be a comma. Only signed times may be negative.
pub(super) fn nanoseconds(
    cell: &str,
    unit: Unit,
    is_signed: bool,
) -> Result<Option<i64>, Unreadable> {
    let cell = cell.trim();
    if is_missing(cell) {
        return Ok(None);
    }
    let (negative, number) = match cell.strip_prefix('-') {
        Some(number) => (true, number),
        None => (false, cell.strip_prefix('+').unwrap_or(cell)),
    };
    let ns = unsigned(number, places(unit)).ok_or_else(|| Unreadable::NotANumber(clip(cell)))?;
    match ns {
        1.. if negative && !is_signed => Err(Unreadable::Negative(clip(cell))),
        DAY_NS.. => Err(Unreadable::TooLong(clip(cell))),
        _ => Ok(Some(if negative { -ns } else { ns })),
    }
}

/// Whether the log marks a number as missing.
pub(super) fn is_missing(cell: &str) -> bool {
    ["", "na", "n/a"].iter().any(|none| cell.trim().eq_ignore_ascii_case(none))
}

/// Parses a number without a sign, capped at a day; `None` if the text is not a number.
fn unsigned(number: &str, unit_places: i64) -> Option<i64> {
    let (decimal, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    // No tool writes longer exponents, and these would only take time.
    let exponent = exponent.parse::<i64>().ok().filter(|e| (-99..=99).contains(e))?;
    let (whole, fraction) = decimal.split_once(['.', ',']).unwrap_or((decimal, ""));
    let digits = || whole.bytes().chain(fraction.bytes());
    if digits().next().is_none() || !digits().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let places = i64::try_from(whole.len()).ok()? + exponent + unit_places;
    let mut rest = digits().map(|byte| i64::from(byte - b'0'));
    let mut ns = 0;
    for _ in 0..places {
        ns = 10 * ns + rest.next().unwrap_or(0);
        if ns >= DAY_NS {
            return Some(DAY_NS);
        }
    }
    let rounds_up = places >= 0 && rest.next().is_some_and(|digit| digit >= 5);
    Some(ns + i64::from(rounds_up))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn milliseconds_become_nanoseconds_to_the_digit() {
        for (cell, ns) in [
            ("16.683", 16_683_000),
            ("16,683", 16_683_000),
            (" 567.25049999999999 ", 567_250_500),
            ("0.0000004", 0),
            ("0.0000005", 1),
            ("1e-05", 10),
            ("1.5E+3", 1_500_000_000),
            ("1e-60", 0),
            ("00000000000000000000000000000007", 7_000_000),
            ("+.5", 500_000),
            ("7.", 7_000_000),
            ("-0.0", 0),
            ("86399999.999999", DAY_NS - 1),
        ] {
            assert_eq!(nanoseconds(cell, Unit::Milliseconds, false), Ok(Some(ns)), "{cell}");
        }
        for cell in ["NA", "na", "", "  ", "N/A"] {
            assert_eq!(nanoseconds(cell, Unit::Milliseconds, false), Ok(None), "{cell}");
        }
    }

    #[test]
    fn a_time_is_the_same_in_every_unit() {
        for (cell, unit) in [
            ("0.0166667", Unit::Seconds),
            ("16.6667", Unit::Milliseconds),
            ("16666.7", Unit::Microseconds),
        ] {
            assert_eq!(nanoseconds(cell, unit, false), Ok(Some(16_666_700)), "{cell}");
        }
    }

    #[test]
    fn an_invalid_duration_is_refused() {
        for cell in
            ["nan", "inf", "-inf", ".", "-", "1.2.3", "1,234.5", "16 ms", "0x10", "1e", "1e999"]
        {
            assert_eq!(
                nanoseconds(cell, Unit::Milliseconds, false),
                Err(Unreadable::NotANumber(cell.into())),
                "{cell}"
            );
        }
        assert_eq!(
            nanoseconds("-16.7", Unit::Milliseconds, false),
            Err(Unreadable::Negative("-16.7".into()))
        );
        for cell in ["86400000", "1e99", "99999999999999999999999999"] {
            assert_eq!(
                nanoseconds(cell, Unit::Milliseconds, false),
                Err(Unreadable::TooLong(cell.into())),
                "{cell}"
            );
        }
    }
}
