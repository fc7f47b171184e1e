//! Units of time, and the units that headings name.

use crate::sim::number::significant;

/// The unit of a column of times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Seconds.
    Seconds,
    /// Milliseconds.
    Milliseconds,
    /// Microseconds.
    Microseconds,
    /// Nanoseconds.
    Nanoseconds,
    /// Ticks of a rate that the log does not have.
    Ticks,
}

/// Units of time from large to small, with the number of nanoseconds in each, its name for people, and its words in
/// headings.
const UNITS: [(Unit, f64, &str, &[&str]); 4] = [
    (Unit::Seconds, 1e9, "seconds", &["s", "sec", "secs", "second", "seconds"]),
    (
        Unit::Milliseconds,
        1e6,
        "ms",
        &["ms", "msec", "msecs", "millis", "millisecond", "milliseconds"],
    ),
    (
        Unit::Microseconds,
        1e3,
        "µs",
        &["us", "µs", "μs", "usec", "usecs", "micros", "microsecond", "microseconds"],
    ),
    (Unit::Nanoseconds, 1.0, "ns", &["ns", "nsec", "nsecs", "nanos", "nanosecond", "nanoseconds"]),
];
/// Rows in a second that a log may plausibly have, and the rate that counts as the most usual one.
const PLAUSIBLE_HZ: std::ops::RangeInclusive<f64> = 0.2..=2000.0;
const USUAL_HZ: f64 = 60.0;

impl Unit {
    /// Returns the number of nanoseconds in this unit; NaN for ticks.
    pub fn ns(self) -> f64 {
        UNITS.iter().find(|(unit, ..)| *unit == self).map_or(f64::NAN, |(_, ns, ..)| *ns)
    }

    /// Returns the name of the unit for people.
    pub fn name(self) -> &'static str {
        UNITS.iter().find(|(unit, ..)| *unit == self).map_or("ticks", |(_, _, name, _)| *name)
    }

    /// Returns the unit in which rows this far apart come at the most plausible rate; `None` if no unit is plausible.
    pub fn of_step(step: f64) -> Option<Self> {
        let off = |ns: f64| libm::fabs(libm::log(1e9 / (step * ns) / USUAL_HZ));
        let plausible =
            UNITS.iter().filter(|(_, ns, ..)| PLAUSIBLE_HZ.contains(&(1e9 / (step * ns))));
        plausible.min_by(|a, b| off(a.1).total_cmp(&off(b.1))).map(|(unit, ..)| *unit)
    }

    /// Returns the unit that a word in a heading stands for, ignoring case.
    pub fn of_word(word: &str) -> Option<Self> {
        let word = word.trim().to_lowercase();
        UNITS.iter().find(|(.., words)| words.contains(&&*word)).map(|(unit, ..)| *unit)
    }

    /// Returns a time in this unit in words, in seconds.
    pub fn seconds_in_words(self, time: f64) -> String {
        format!("{} s", significant(time * self.ns() / 1e9, 3))
    }
}

/// A heading without its unit, and the unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Heading {
    /// The words before the unit in lower case, separated by spaces.
    pub base: String,
    /// The unit that the heading names.
    pub unit: Option<Unit>,
    /// Text in brackets that is no known unit of time.
    pub unknown: Option<String>,
}

impl Heading {
    /// Splits a heading such as `Frame Time (µs)`, `frame_time_us` or `TimeInSeconds`.
    pub fn of(name: &str) -> Self {
        let name = name.trim().trim_start_matches('%');
        let bracketed = name.find(['(', '[']).zip(name.rfind([')', ']'])).filter(|(a, b)| a < b);
        let (plain, inside) = match bracketed {
            Some((from, to)) => (&name[..from], Some(name[from + 1..to].trim())),
            None => (name, None),
        };
        let mut words = words(plain);
        let in_brackets = inside.map(|inside| (inside, Unit::of_word(inside)));
        let unit = match in_brackets {
            Some((_, Some(unit))) => Some(unit),
            Some(_) => None,
            None => words.last().and_then(|word| Unit::of_word(word)),
        };
        if in_brackets.is_none() && unit.is_some() && words.len() > 1 {
            words.pop();
            words.pop_if(|word| word == "in");
        }
        // A number in brackets is an index.
        let is_unknown = |inside: &str| inside.chars().any(char::is_alphabetic);
        let unknown = in_brackets.filter(|(inside, unit)| unit.is_none() && is_unknown(inside));
        Self { base: words.join(" "), unit, unknown: unknown.map(|(inside, _)| inside.to_owned()) }
    }
}

/// Splits a name into its words in lower case. `simTime`, `sim_time` and `sim.time` have the same two words.
pub fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut was_lower = false;
    for sign in name.chars() {
        let begins = !sign.is_alphanumeric() || sign.is_uppercase() && was_lower;
        if begins {
            words.push(String::new());
        }
        was_lower = sign.is_lowercase();
        let last = words.last_mut().expect("there is one");
        last.extend(sign.to_lowercase().filter(|sign| sign.is_alphanumeric()));
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_is_split_into_its_words_and_its_unit() {
        for (name, base, unit) in [
            ("Frame Time (ns)", "frame time", Some(Unit::Nanoseconds)),
            ("time (us)", "time", Some(Unit::Microseconds)),
            ("Time (µs)", "time", Some(Unit::Microseconds)),
            ("frame_time_ms", "frame time", Some(Unit::Milliseconds)),
            ("TimeInSeconds", "time", Some(Unit::Seconds)),
            ("ms", "ms", Some(Unit::Milliseconds)),
            ("t_s", "t", Some(Unit::Seconds)),
            ("%time", "time", None),
            ("gyroADC[0]", "gyro adc", None),
        ] {
            let found = Heading::of(name);
            assert_eq!((found.base.as_str(), found.unit), (base, unit), "{name}");
            assert_eq!(found.unknown, None, "{name}");
        }
        assert_eq!(Heading::of("Frame Time (jiffies)").unknown.as_deref(), Some("jiffies"));
    }

    #[test]
    fn the_unit_of_a_step_is_the_one_with_a_plausible_rate() {
        for (step, unit) in [
            (0.016_667, Some(Unit::Seconds)),
            (16.7, Some(Unit::Milliseconds)),
            (1.0, Some(Unit::Milliseconds)),
            (0.5, Some(Unit::Seconds)),
            (16_667.0, Some(Unit::Microseconds)),
            (8.3e6, Some(Unit::Nanoseconds)),
            (0.0, None),
            (1e12, None),
        ] {
            assert_eq!(Unit::of_step(step), unit, "{step}");
        }
    }
}
