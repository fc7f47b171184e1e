//! Reads moments: numbers of any size, dates with times as in ISO 8601, and times of day.

use super::{Decimal, Unit, number};

/// A moment in the unit of its column; a date or a time of day is in nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Whole part of a number that is too long for a double.
    whole: i64,
    part: f64,
    /// Whether the cell is a date or a time of day.
    pub is_of_calendar: bool,
}

/// Numbers from here on lose digits that matter in a double.
const LONG: f64 = 1e12;
const DAY_NS: i64 = 86_400_000_000_000;

impl Moment {
    /// Reads a cell; `None` if it is no finite number, date or time of day.
    pub fn read(cell: &[u8], decimal: Decimal) -> Option<Self> {
        if let Some(part) = number(cell, decimal) {
            let text = std::str::from_utf8(cell).ok()?.trim();
            let digits = text.bytes().take_while(|b| b.is_ascii_digit() || *b == b'-').count();
            let whole = text[..digits].parse::<i64>().ok().filter(|_| part.abs() >= LONG);
            let rest = text[digits..].replace(',', ".");
            let long = whole.and_then(|whole| {
                let part = if rest.is_empty() { 0.0 } else { format!("0{rest}").parse().ok()? };
                (!rest.contains(['e', 'E'])).then_some((whole, part))
            });
            let (whole, part) = long.unwrap_or((0, part));
            return part.is_finite().then_some(Self { whole, part, is_of_calendar: false });
        }
        let text = std::str::from_utf8(cell).ok()?.trim().trim_end_matches('Z');
        let (days, time) = match text.split_once(['T', ' ']) {
            Some((date, time)) => {
                (days_since_1970(date)?, time.split_once('+').map_or(time, |it| it.0))
            }
            None => (0, text),
        };
        let mut parts = time.splitn(3, ':');
        let whole = |part: Option<&str>, most: i64| {
            part?.parse::<i64>().ok().filter(|part| (0..most).contains(part))
        };
        let (hours, minutes) = (whole(parts.next(), 24)?, whole(parts.next(), 60)?);
        let seconds = parts.next()?.replace(',', ".");
        let seconds: f64 = seconds.parse().ok().filter(|s| (0.0..61.0).contains(s))?;
        let ns = days.checked_mul(DAY_NS)? + (hours * 60 + minutes) * 60_000_000_000;
        let whole = ns.checked_add((seconds * 1e9).round() as i64)?;
        Some(Self { whole, part: 0.0, is_of_calendar: true })
    }

    /// Returns the time from `first` to here, in the unit of the column.
    pub fn since(self, first: Self) -> f64 {
        (self.whole.wrapping_sub(first.whole)) as f64 + (self.part - first.part)
    }

    /// Returns the number itself.
    pub fn value(self) -> f64 {
        self.whole as f64 + self.part
    }
}

/// Returns the days of a date such as 2026-02-19 since the beginning of 1970.
fn days_since_1970(date: &str) -> Option<i64> {
    let mut parts = date.splitn(3, ['-', '/']).map(|part| part.parse::<i64>().ok());
    let (year, month, day) = (parts.next()??, parts.next()??, parts.next()??);
    let fits = (1..=9999).contains(&year) && (1..=12).contains(&month) && (1..=31).contains(&day);
    // The year begins in March, so that a leap day is its last.
    let (year, month) = if month <= 2 { (year - 1, month + 9) } else { (year, month - 3) };
    let days = 365 * year + year / 4 - year / 100 + year / 400 + (153 * month + 2) / 5 + day;
    fits.then_some(days - 719_469)
}

/// How the moments of a column go.
#[derive(Clone, Debug, Default)]
pub struct Course {
    first: Option<Moment>,
    last: Option<Moment>,
    /// Values and distances of successive moments.
    pub values: Vec<f64>,
    /// Distances of successive moments that differ.
    pub steps: Vec<f64>,
    /// Number of moments.
    pub count: u64,
    falls: bool,
}

/// Maximum number of values whose median is taken.
const MAX_VALUES: usize = 100_000;

impl Course {
    /// Adds the next moment.
    pub fn add(&mut self, moment: Moment) {
        self.count += 1;
        self.first.get_or_insert(moment);
        if self.values.len() < MAX_VALUES {
            self.values.push(moment.value());
        }
        let step = self.last.replace(moment).map_or(0.0, |last| moment.since(last));
        self.falls |= step < 0.0;
        if step > 0.0 && self.steps.len() < MAX_VALUES {
            self.steps.push(step);
        }
    }

    /// Whether the moments rise from the first to the last, as those of a clock do.
    pub fn rises(&self) -> bool {
        self.count >= 4
            && !self.falls
            && 3 * self.steps.len() as u64 >= self.count.min(MAX_VALUES as u64)
    }

    /// Whether each step is exactly 1, as of a counter.
    pub fn counts(&self) -> bool {
        !self.steps.is_empty() && self.steps.iter().all(|step| *step == 1.0)
    }

    /// Whether the moments are dates or times of day.
    pub fn is_of_calendar(&self) -> bool {
        self.first.is_some_and(|first| first.is_of_calendar)
    }

    /// Returns the unit of the moments by the size of their steps.
    pub fn unit(&self) -> Option<Unit> {
        match self.is_of_calendar() {
            true => Some(Unit::Nanoseconds),
            false => Unit::of_step(median(&self.steps)?),
        }
    }
}

/// Returns the upper median.
pub fn median(values: &[f64]) -> Option<f64> {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_keep_their_nanoseconds_whatever_their_size() {
        let since = |a: &str, b: &str| {
            let read = |cell: &str| Moment::read(cell.as_bytes(), Decimal::Point).unwrap();
            read(b).since(read(a))
        };
        assert_eq!(since("1767225600000163182", "1767225600010046180"), 9_882_998.0);
        assert_eq!(since("0.25", "0.75"), 0.5);
        assert_eq!(since("2026-02-19T16:25:14.206", "2026-02-19T16:25:14.307"), 101e6);
        assert_eq!(since("2026-02-28 23:59:59.5", "2026-03-01 00:00:00,25Z"), 750e6);
        assert_eq!(since("12:34:56.789", "12:34:57.000"), 211e6);
        for cell in ["", "abc", "12:99:00", "2026-13-01T00:00:00", "NaN", "1e400", "12:34"] {
            assert_eq!(Moment::read(cell.as_bytes(), Decimal::Point), None, "{cell:?}");
        }
    }
}
