//! The parameters of a body. Each has one description, which the scene file, the help, the sliders and the body itself
//! share.
//!
//! The source file of a body lists the body's parameters once, as [`ParameterOf`] that body. Each parameter is listed
//! with the struct field of its value. A [`Kind`](super::bodies::Kind) has the same list as plain [`Parameter`]s, for
//! code that does not know the struct.

use std::borrow::Cow;
use std::fmt;

/// Text from a static table, or owned by a kind made from a scene.
pub type Text = Cow<'static, str>;

/// The largest magnitude of a body's parameter; products in the force laws would overflow beyond this magnitude.
pub const MAX_VALUE: f64 = 1e15;

/// The maximum number of points of a curve, enough for a curve typed by hand.
pub const MAX_POINTS: usize = 64;

/// One key of a body's table in a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The key, which ends with the unit.
    pub key: Text,
    /// The name in words; `None` if it is the key without the unit.
    pub name: Option<&'static str>,
    /// The letter of the parameter in the equation of motion, if it has one.
    pub symbol: Option<&'static str>,
    /// The description of the parameter.
    pub about: &'static str,
    /// The symbol of the unit that ends the key, such as `N/m`; empty if the key names no unit.
    pub unit: Text,
    /// The default; `None` if the scene must give a value.
    pub default: Option<f64>,
    /// The allowed values.
    pub range: Range,
    /// When a change takes effect on a moving body.
    pub acts: TakesEffect,
    /// The key of a scene's list that has this number among others; `None` if a scene gives the number by itself. The
    /// numbers of a list follow each other, and have one range.
    pub list: Option<&'static str>,
}

impl Parameter {
    /// Returns a parameter without a letter, a unit and a default.
    pub(super) const fn new(
        key: Text,
        about: &'static str,
        range: Range,
        acts: TakesEffect,
    ) -> Self {
        let unit = Cow::Borrowed("");
        Self { key, name: None, symbol: None, about, unit, default: None, range, acts, list: None }
    }

    /// Returns the description after the letter, such as `m, the mass`, and before the list that the number is in.
    pub fn described(&self) -> String {
        let symbol = self.symbol.map_or_else(String::new, |symbol| format!("{symbol}, "));
        let list = self.list.map_or_else(String::new, |key| format!(" (in `{key}`)"));
        format!("{symbol}{}{list}", self.about)
    }

    /// Returns the name of the parameter in words.
    pub fn quantity(&self) -> String {
        self.name.map_or_else(|| in_words(&self.key), str::to_owned)
    }

    /// Returns the name in words of the list that the parameter is in, or else of the parameter.
    pub fn whole_quantity(&self) -> String {
        self.list.map_or_else(|| self.quantity(), in_words)
    }
}

/// Returns a key in words, without its unit.
fn in_words(key: &str) -> String {
    key.strip_suffix(unit(key).0).unwrap_or(key).replace('_', " ")
}

/// When a change of a parameter takes effect on a moving body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TakesEffect {
    /// The change takes effect at once, because the parameter acts on the forces or on the size of a kick.
    AtOnce,
    /// The change takes effect at the next start, because the parameter is part of the initial state, a count or a
    /// curve.
    AtStart,
}

impl TakesEffect {
    /// Returns the name in the output.
    pub fn id(self) -> &'static str {
        match self {
            TakesEffect::AtOnce => "at-once",
            TakesEffect::AtStart => "at-start",
        }
    }
}

/// The values a parameter may take. All are finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Greater than 0 and at most this number.
    Positive(f64),
    /// From 0 to this number.
    NonNegative(f64),
    /// From minus this number to this number.
    Within(f64),
    /// Whole numbers from 1 to this number.
    Count(u32),
    /// A curve of 2 to [`MAX_POINTS`] points `[x, y]` with rising x, each number from minus to plus [`MAX_VALUE`]. Only
    /// a kind's last parameter can be a curve.
    Curve {
        /// The unit of x.
        x: &'static str,
        /// The unit of y.
        y: &'static str,
    },
    /// From the first number to the second.
    Between(f64, f64),
}

impl Range {
    /// Greater than 0.
    pub const POSITIVE: Self = Self::Positive(MAX_VALUE);
    /// 0 or more.
    pub const NON_NEGATIVE: Self = Self::NonNegative(MAX_VALUE);
    /// Any sign, or 0.
    pub const ANY: Self = Self::Within(MAX_VALUE);

    /// Whether `value` is in the range; for a curve, whether the value can be a coordinate of a point.
    pub fn contains(self, value: f64) -> bool {
        match self {
            Range::Positive(most) => value > 0.0 && value <= most,
            Range::NonNegative(most) => value >= 0.0 && value <= most,
            Range::Within(most) => value >= -most && value <= most,
            Range::Count(most) => value >= 1.0 && value <= f64::from(most) && value.fract() == 0.0,
            Range::Curve { .. } => Range::Within(MAX_VALUE).contains(value),
            Range::Between(least, most) => value >= least && value <= most,
        }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_plain = |x: f64| x == 0.0 || (1e-4..1e9).contains(&x.abs());
        let short = |x: f64| if is_plain(x) { format!("{x}") } else { format!("{x:e}") };
        match *self {
            Range::Positive(most) => write!(f, "greater than 0 and at most {}", short(most)),
            Range::NonNegative(most) => write!(f, "from 0 to {}", short(most)),
            Range::Within(most) => write!(f, "from {} to {}", short(-most), short(most)),
            Range::Count(most) => write!(f, "whole, from 1 to {most}"),
            Range::Curve { x, y } => {
                write!(f, "2 to {MAX_POINTS} points [{x}, {y}] in rising order")
            }
            Range::Between(least, most) => write!(f, "from {} to {}", short(least), short(most)),
        }
    }
}

/// An error in a combination of several parameters. Messages are in lower case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The key of the value to change.
    pub key: Text,
    /// The error message.
    pub what: String,
    /// How to fix the fault.
    pub remedy: String,
}

/// A parameter of bodies of type `B`, with the field of its value.
#[derive(Clone)]
pub struct ParameterOf<B> {
    parameter: Parameter,
    slot: Slot<B>,
}

/// The field of a parameter's value in a body.
#[derive(Clone)]
enum Slot<B> {
    Number(fn(&mut B) -> &mut f64),
    Count(fn(&mut B) -> &mut usize),
    /// Writes the points.
    Curve(fn(&mut B, &[[f64; 2]])),
}

impl<B> ParameterOf<B> {
    const fn new(key: &'static str, range: Range, acts: TakesEffect, slot: Slot<B>) -> Self {
        Self { parameter: Parameter::new(Cow::Borrowed(key), "", range, acts), slot }
    }

    /// Returns a parameter that is a number, has no default and acts at once.
    pub const fn number(key: &'static str, range: Range, field: fn(&mut B) -> &mut f64) -> Self {
        Self::new(key, range, TakesEffect::AtOnce, Slot::Number(field))
    }

    /// Returns a parameter that is a number of any sign, has this default and is part of the initial state.
    pub const fn start(key: &'static str, default: f64, field: fn(&mut B) -> &mut f64) -> Self {
        Self::number(key, Range::ANY, field).or(default).at_start()
    }

    /// Returns a parameter that is a whole number from 1 to `most`, has no default and acts at the start.
    pub const fn count(key: &'static str, most: u32, field: fn(&mut B) -> &mut usize) -> Self {
        Self::new(key, Range::Count(most), TakesEffect::AtStart, Slot::Count(field))
    }

    /// Returns a parameter that is a curve through points in the units `x` and `y`, has no default and acts at the
    /// start. `write` stores points in rising order in the body.
    pub const fn curve(
        key: &'static str,
        [x, y]: [&'static str; 2],
        write: fn(&mut B, &[[f64; 2]]),
    ) -> Self {
        Self::new(key, Range::Curve { x, y }, TakesEffect::AtStart, Slot::Curve(write))
    }

    /// Sets the name in words.
    pub const fn named(mut self, name: &'static str) -> Self {
        self.parameter.name = Some(name);
        self
    }

    /// Sets the letter in the equation of motion.
    pub const fn symbol(mut self, symbol: &'static str) -> Self {
        self.parameter.symbol = Some(symbol);
        self
    }

    /// Sets the description.
    pub const fn about(mut self, about: &'static str) -> Self {
        self.parameter.about = about;
        self
    }

    /// Sets a default, so that a scene may omit the parameter.
    pub const fn or(mut self, default: f64) -> Self {
        self.parameter.default = Some(default);
        self
    }

    /// Makes the number part of a scene's list with this key.
    pub const fn in_list(mut self, key: &'static str) -> Self {
        self.parameter.list = Some(key);
        self
    }

    /// Makes the number part of the initial state, so that it acts at the start.
    pub const fn at_start(mut self) -> Self {
        self.parameter.acts = TakesEffect::AtStart;
        self
    }

    /// Returns the parameter without its field.
    pub(super) fn parameter(&self) -> Parameter {
        Parameter { unit: unit(&self.parameter.key).1.into(), ..self.parameter.clone() }
    }

    /// Returns the field of a parameter that acts at once; `None` for other parameters.
    pub(super) fn acting_at_once(&self) -> Option<fn(&mut B) -> &mut f64> {
        match self.slot {
            Slot::Number(field) if self.parameter.acts == TakesEffect::AtOnce => Some(field),
            Slot::Number(_) | Slot::Count(_) | Slot::Curve(_) => None,
        }
    }

    /// Writes the first of `values`, or all of them for a curve, and returns the rest.
    fn write<'v>(&self, body: &mut B, values: &'v [f64]) -> &'v [f64] {
        let first = || values.split_first().expect("a body is given a value for each parameter");
        match self.slot {
            Slot::Number(field) => *field(body) = *first().0,
            Slot::Count(field) => *field(body) = *first().0 as usize,
            Slot::Curve(write) => {
                write(body, values.as_chunks().0);
                return &[];
            }
        }
        first().1
    }
}

/// Writes `values`, in the order of `parameters`, into the fields of `body`. A curve uses all remaining values.
pub(super) fn write<B>(body: &mut B, parameters: &[ParameterOf<B>], values: &[f64]) {
    let left = parameters.iter().fold(values, |values, parameter| parameter.write(body, values));
    assert!(left.is_empty(), "values without a parameter: {left:?}");
}

/// Suffixes of keys, each with the symbol of its unit. A suffix comes before any shorter suffix with which it ends.
const UNITS: [(&str, &str); 15] = [
    ("_kg_m2", "kg·m²"),
    ("_n_s_per_m", "N·s/m"),
    ("_n_per_m", "N/m"),
    ("_n_m_s", "N·m·s"),
    ("_n_s", "N·s"),
    ("_m3_per_s2", "m³/s²"),
    ("_m_per_s2", "m/s²"),
    ("_m_per_s", "m/s"),
    ("_rad_per_s", "rad/s"),
    ("_per_s", "1/s"),
    ("_hz", "Hz"),
    ("_rad", "rad"),
    ("_kg", "kg"),
    ("_n", "N"),
    ("_m", "m"),
];

/// Returns the unit suffix of a key and the symbol of the unit. Both are empty if the key names no unit.
fn unit(key: &str) -> (&'static str, &'static str) {
    UNITS.into_iter().find(|(end, _)| key.ends_with(end)).unwrap_or_default()
}
