//! The values that keys of a scene file take, and their wording in messages.

use std::fmt;
use std::ops::RangeInclusive;

use super::nearest::listed;
use crate::CloudShape;
use crate::sim::TickRate;
use crate::sim::bodies::{self, Pin};
use crate::sim::law::Layout;

/// Maximum number of characters in the name of a layout or a pin.
const MAX_WORD_CHARS: usize = 16;

/// The part of a scene file in which a key stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// The part before the first table.
    Top,
    /// A table array of this name.
    Table(&'static str),
    /// A table of this name.
    Within(&'static str),
}

/// A key that a table may or must have.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) key: &'static str,
    pub(super) is_required: bool,
    /// Description for people.
    pub(super) about: &'static str,
    pub(super) wanted: Wanted,
}

impl Field {
    pub(super) const fn required(key: &'static str, about: &'static str, wanted: Wanted) -> Self {
        Self { key, is_required: true, about, wanted }
    }

    pub(super) const fn optional(key: &'static str, about: &'static str, wanted: Wanted) -> Self {
        Self { key, is_required: false, about, wanted }
    }
}

/// The kind of value that a key takes.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Wanted {
    /// A string of at most this many characters.
    Text(usize),
    /// A number, whole or not.
    Number(bodies::Range),
    /// A tick rate in Hz.
    TickRate,
    /// The length of a tick in seconds.
    Step,
    Whole(RangeInclusive<u64>),
    /// A list of points.
    Curve(bodies::Range),
    /// A point of a curve.
    Point,
    /// The id of a method.
    Method,
    /// The id of a rule for impacts.
    Impact,
    /// A list of methods' ids.
    Methods,
    /// A table array of this name.
    Tables(&'static str),
    /// A table of this name.
    Table(&'static str),
    /// A table of the numbers that expressions can name.
    Constants,
    /// A table of this name for each coordinate.
    Coordinates(&'static str),
    /// A table of this name for each event.
    Events(&'static str),
    /// A table of the new velocities of an event.
    Velocities,
    Expression,
    /// The lines of a step.
    Lines,
    /// The names of two coordinates.
    Plane,
    /// Two expressions.
    At,
    /// The name of a [`CloudShape`].
    Clouds,
    /// The name of a [`Layout`].
    Layout,
    /// The places of nodes.
    Places,
    /// The numbers of nodes.
    Nodes,
    /// The number of a node.
    Node,
    /// The numbers of two nodes.
    Ends,
    Springs,
    /// A spring in the list of springs.
    Spring,
    /// The name of a [`Pin`].
    Pin,
    /// `true` or `false`.
    Boolean,
    /// A list of this many numbers.
    Numbers(usize),
    /// The state of a lane, as 16 hexadecimal digits.
    Hash,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Top => f.write_str("at the top of the file"),
            Place::Table(name) => write!(f, "in `[[{name}]]`"),
            Place::Within(name) => write!(f, "in `{name}`"),
        }
    }
}

impl Wanted {
    /// Any number.
    pub(super) const ANY: Self = Self::Number(bodies::Range::ANY);

    /// Returns the kind of value that a parameter of this range takes.
    pub(super) fn of(range: bodies::Range) -> Self {
        match range {
            bodies::Range::Count(most) => Wanted::Whole(1..=most.into()),
            bodies::Range::Curve { .. } => Wanted::Curve(range),
            _ => Wanted::Number(range),
        }
    }

    /// Whether a number is in the range.
    pub(super) fn accepts_number(&self, number: f64) -> bool {
        matches!(self, Wanted::Number(range) if range.contains(number))
    }

    /// Whether a whole number is in the range.
    pub(super) fn accepts_whole(&self, whole: u64) -> bool {
        matches!(self, Wanted::Whole(range) if range.contains(&whole))
    }

    /// Returns the maximum number of characters of a text.
    pub(super) fn max_chars(&self) -> usize {
        if let Wanted::Text(most) = self { *most } else { MAX_WORD_CHARS }
    }

    /// Returns the remedy for a value that does not fit.
    pub(super) fn remedy(&self) -> String {
        format!("write {self}")
    }

    /// Returns the kind of value, for messages.
    pub(super) fn noun(&self) -> &'static str {
        match self {
            Wanted::Text(_)
            | Wanted::Method
            | Wanted::Impact
            | Wanted::Hash
            | Wanted::Expression
            | Wanted::Lines
            | Wanted::Pin
            | Wanted::Clouds
            | Wanted::Layout => "a string",
            Wanted::Number(_) | Wanted::TickRate | Wanted::Step => "a number",
            Wanted::Whole(_) => "an integer",
            Wanted::Methods | Wanted::Curve(_) | Wanted::Plane | Wanted::At => "a list",
            Wanted::Places => "a list of pairs",
            Wanted::Nodes | Wanted::Ends => "a list of whole numbers from 0",
            Wanted::Node => "a whole number from 0",
            Wanted::Springs => "a list of tables",
            Wanted::Spring => "a table",
            Wanted::Numbers(_) => "a list of numbers",
            Wanted::Boolean => "a boolean",
            Wanted::Table(_)
            | Wanted::Constants
            | Wanted::Coordinates(_)
            | Wanted::Events(_)
            | Wanted::Velocities => "a table",
            Wanted::Point => "a pair of numbers",
            Wanted::Tables(_) => "an array of tables",
        }
    }
}

impl fmt::Display for Wanted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Wanted::Text(most) => write!(f, "1 to {most} characters in double quotes"),
            Wanted::Number(range) => write!(f, "a number {range}"),
            Wanted::TickRate => write!(
                f,
                "a number from {} to {} with at most nine digits after the point, such as 60 or 66.667",
                TickRate::MIN,
                TickRate::MAX
            ),
            Wanted::Step => write!(
                f,
                "a number from {} to {} with at most nine digits after the point, such as 0.015",
                TickRate::MAX.step_s(),
                TickRate::MIN.step_s()
            ),
            Wanted::Whole(range) => {
                write!(f, "a whole number from {} to {}", range.start(), range.end())
            }
            Wanted::Curve(range) => write!(f, "a list of {range}"),
            Wanted::Point => write!(f, "two numbers in brackets, such as [0.0, 1.0]"),
            Wanted::Method => write!(f, "a method's name in double quotes, such as \"rk4\""),
            Wanted::Impact => {
                write!(f, "a rule of `regatta list impacts` in double quotes, such as \"clamp\"")
            }
            Wanted::Methods => write!(f, "a list of methods' names, such as [\"rk4\"]"),
            Wanted::Hash => write!(
                f,
                "16 digits from 0 to 9 and a to f in double quotes, as a recording has them"
            ),
            Wanted::Boolean => write!(f, "true or false"),
            Wanted::Numbers(1) => write!(f, "one number in brackets, such as [0.5]"),
            Wanted::Numbers(count) => write!(f, "{count} numbers in brackets, with commas between"),
            Wanted::Table(name) => write!(f, "`[{name}]` in brackets and its keys below"),
            Wanted::Constants => {
                write!(f, "names and numbers, such as {{ k = 18000.0, m = 250.0 }}")
            }
            Wanted::Coordinates(name) => {
                write!(f, "`[{name}.x]` for a coordinate x, and its keys below")
            }
            Wanted::Events(name) => {
                write!(f, "`[{name}.floor]` for an event floor, and its keys below")
            }
            Wanted::Velocities => write!(f, "velocities, such as {{ vy = \"-e*vy\" }}"),
            Wanted::Expression => write!(f, "an expression in double quotes, such as \"-k*x/m\""),
            Wanted::Lines => write!(
                f,
                "lines in three double quotes, such as \"\"\"v += h * a(x, v); x += h * v\"\"\""
            ),
            Wanted::Plane => write!(f, "the names of two coordinates, such as [\"x\", \"y\"]"),
            Wanted::At => {
                write!(f, "two expressions for x and y, such as [\"l*sin(a)\", \"-l*cos(a)\"]")
            }
            Wanted::Places => {
                write!(f, "the places of the nodes in metres, such as [[0.0, 0.0], [1.0, 0.0]]")
            }
            Wanted::Nodes => write!(f, "the numbers of nodes, such as [0, 3]"),
            Wanted::Node => write!(f, "the number of a node, such as 3"),
            Wanted::Ends => write!(f, "the numbers of two nodes, such as [0, 1]"),
            Wanted::Springs => write!(f, "a list such as [{{ between = [0, 1] }}]"),
            Wanted::Spring => write!(f, "a spring in braces, such as {{ between = [0, 1] }}"),
            Wanted::Clouds => {
                write!(f, "{}", listed(&CloudShape::ALL.map(CloudShape::id), '"', " or "))
            }
            Wanted::Layout => {
                write!(f, "{}", listed(&Layout::ALL.map(|(id, _)| id), '"', " or "))
            }
            Wanted::Pin => write!(f, "{}", listed(&Pin::ALL.map(Pin::id), '"', " or ")),
            Wanted::Tables(name) => write!(f, "`[[{name}]]` in double brackets and its keys below"),
        }
    }
}
