//! Recognises columns that advance like a clock while nothing moves.

use crate::table::{Unit, words};

/// Words in the names of clocks and counters of any unit.
const CLOCKS: [&str; 27] = [
    "clock",
    "date",
    "elapsed",
    "epoch",
    "frame",
    "frames",
    "index",
    "micros",
    "millis",
    "milliseconds",
    "ms",
    "nanos",
    "ns",
    "sec",
    "second",
    "seconds",
    "secs",
    "step",
    "steps",
    "tick",
    "ticks",
    "time",
    "timestamp",
    "ts",
    "uptime",
    "us",
    "wall",
];
/// Endings of words that name a clock, as in `simtime`.
const CLOCK_ENDS: [&str; 3] = ["time", "clock", "stamp"];
/// Words in the names of coordinates, which may grow evenly.
const PLACES: [&str; 18] = [
    "altitude",
    "angle",
    "coordinate",
    "depth",
    "distance",
    "height",
    "phi",
    "place",
    "pos",
    "position",
    "px",
    "py",
    "pz",
    "q",
    "theta",
    "x",
    "y",
    "z",
];
/// Relative rounding error per step of a clock in double and in single precision.
const PRECISIONS: [f64; 2] = [1e-15, 2.4e-7];

/// The changes of a value column that count as motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Moves {
    /// No change counts, because another column is the coordinate.
    Never,
    /// Every change counts.
    Always,
    /// Only steps backwards count, because the column has a clock's name.
    Back,
    /// Only uneven changes count, because a clock of any name advances by the same amount in each row.
    Unevenly,
}

impl Moves {
    /// Judges a column by its name, and by whether no other column has values.
    pub(super) fn of_name(name: &str, is_only: bool) -> Self {
        let words = words(name);
        let has = |known: &[&str]| words.iter().any(|word| known.contains(&&**word));
        // The last word says what it is: a frame hash is no frame. A unit after it says nothing.
        let last = words.iter().rfind(|word| Unit::of_word(word).is_none()).or(words.last());
        let is_clock = last.is_some_and(|word| {
            CLOCKS.contains(&&**word) || CLOCK_ENDS.iter().any(|end| word.ends_with(end))
        });
        if has(&PLACES) {
            return Self::Always;
        }
        if is_clock {
            return Self::Back;
        }
        if is_only { Self::Always } else { Self::Unevenly }
    }
}

/// How a column advances through the rows with one key.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClockCheck {
    /// Place of the last row, and the values of both sides at that place.
    last: Option<(f64, [f64; 2])>,
    /// Exclusive limits on the growth per row, if the growth is constant, for each of [`PRECISIONS`].
    growth: [[f64; 2]; 2],
    steps: u32,
    /// Unit of the last digit in the last values.
    unit: f64,
}

impl Default for ClockCheck {
    fn default() -> Self {
        Self { last: None, growth: [[f64::NEG_INFINITY, f64::INFINITY]; 2], steps: 0, unit: 0.0 }
    }
}

impl ClockCheck {
    /// Adds the values of both sides at a place, with their cells. Returns whether the column may still be a clock.
    pub(super) fn add(
        &mut self,
        moves: Moves,
        place: f64,
        values: [f64; 2],
        cells: [&[u8]; 2],
    ) -> bool {
        if !values.iter().all(|value| value.is_finite()) {
            return true;
        }
        let last = self.last.replace((place, values));
        // Most columns never change or have a clock's name, and need no unit.
        if moves == Moves::Unevenly && last.is_none_or(|(_, last)| last != values) {
            self.unit = cells.map(unit_of).into_iter().fold(0.0, f64::max);
        }
        let Some((before, last)) = last else { return true };
        let (rows, unit) = (place - before, self.unit);
        let of_clock = |(value, last): (f64, f64)| match moves {
            Moves::Back => (value - last) * rows >= 0.0,
            _ => {
                let size = value.abs().max(last.abs());
                for (precision, [least, most]) in PRECISIONS.into_iter().zip(&mut self.growth) {
                    let rounding = unit.max(precision * size);
                    let ends = [-rounding, rounding].map(|off| (value - last + off) / rows);
                    *least = least.max(ends[0].min(ends[1]));
                    *most = most.min(ends[0].max(ends[1]));
                }
                rows != 0.0 && self.growth.iter().any(|[least, most]| least < most)
            }
        };
        self.steps = self.steps.saturating_add(1);
        values.into_iter().zip(last).all(of_clock)
    }

    /// Whether the column advanced like a clock. If it does not have a clock's name, two steps are necessary, because
    /// one step is always even.
    pub(super) fn is_of_a_clock(&self, moves: Moves) -> bool {
        let grows = |[least, most]: [f64; 2]| least < most && (least >= 0.0 || most <= 0.0);
        moves == Moves::Back || self.steps >= 2 && self.growth.into_iter().any(grows)
    }
}

/// Returns the unit of the last digit of a written number.
fn unit_of(cell: &[u8]) -> f64 {
    let cell = cell.trim_ascii();
    let exponent_at = cell.iter().position(|sign| matches!(sign, b'e' | b'E'));
    let (digits, exponent) = cell.split_at(exponent_at.unwrap_or(cell.len()));
    let exponent = std::str::from_utf8(exponent.get(1..).unwrap_or_default());
    let exponent: i32 = exponent.ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    let point = digits.iter().position(|sign| *sign == b'.');
    let decimals = point.map_or(0, |point| digits.len() - point - 1);
    libm::pow(10.0, f64::from(exponent) - decimals as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_a_column_name_mark_a_clock_or_a_coordinate() {
        for name in ["time", "sim_time", "gameTimeMs", "time_ms", "elapsed", "sim_frame", "ts"] {
            assert_eq!(Moves::of_name(name, false), Moves::Back, "{name}");
        }
        for name in ["x", "pos.y", "position_m", "frame_x", "playerX"] {
            assert_eq!(Moves::of_name(name, false), Moves::Always, "{name}");
        }
        for name in ["crc", "vx2", "T", "energy", "v_m_per_s"] {
            assert_eq!(Moves::of_name(name, false), Moves::Unevenly, "{name}");
            assert_eq!(Moves::of_name(name, true), Moves::Always, "{name}");
        }
    }

    #[test]
    fn a_clock_grows_evenly_to_its_rounding_and_a_motion_does_not() {
        let is_clock = |cells: &[&str]| {
            let mut course = ClockCheck::default();
            let goes_on = cells.iter().zip(0..).all(|(cell, place)| {
                let value: f64 = cell.parse().unwrap();
                course.add(Moves::Unevenly, f64::from(place), [value; 2], [cell.as_bytes(); 2])
            });
            goes_on && course.is_of_a_clock(Moves::Unevenly)
        };
        assert!(is_clock(&["0.0", "0.016667", "0.033333", "0.05"]));
        assert!(is_clock(&["0", "17", "33", "50", "67"]) && is_clock(&["0", "1", "2", "3"]));
        assert!(is_clock(&["1.6e9", "1.7e9", "1.8e9"]) && is_clock(&["3", "2", "1"]));
        // These are seconds since 1970, and a step of 1/60 summed in single precision.
        assert!(is_clock(&["1700000000", "1700000001", "1700000002"]));
        assert!(is_clock(&["1700000000.016667", "1700000000.033333", "1700000000.05"]));
        let mut single = 0.0_f32;
        let cells: Vec<String> = std::iter::repeat_with(|| {
            single += 1.0 / 60.0;
            f64::from(single).to_string()
        })
        .take(5000)
        .collect();
        assert!(is_clock(&cells.iter().map(|cell| &**cell).collect::<Vec<_>>()));
        assert!(!is_clock(&["0", "0", "0"]) && !is_clock(&["1.5", "1.5", "1.5"]));
        assert!(!is_clock(&["0", "1"]) && !is_clock(&["0", "0", "1", "1", "0"]));
        assert!(!is_clock(&["0.0", "0.16", "0.33", "0.49", "0.64", "0.78"]));
    }
}
