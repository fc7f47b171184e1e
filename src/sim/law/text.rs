//! The text of a law in a scene.

use std::ops::Range;

use super::FIRST_COORDINATE;

/// The text of a law: its structure, names and expressions, but no values.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LawText {
    /// The names of the constants.
    pub constants: Vec<String>,
    /// The coordinates, one or more.
    pub coordinates: Vec<CoordinateText>,
    /// The events, at most [`MAX_EVENTS`](super::MAX_EVENTS).
    pub events: Vec<EventText>,
    /// The conserved energy in joules, of coordinates, velocities and constants.
    pub energy: Option<String>,
    /// The indices of the coordinates drawn as x and y of one point.
    pub plane: Option<[usize; 2]>,
    /// The placement of the first coordinates in space.
    pub layout: Layout,
}

/// The slots of the tape's inputs. They are the time and the steering, then the moving inputs, then the fixed inputs.
impl LawText {
    /// Returns the slots of the coordinates, then of the velocities.
    pub(super) fn slots_of_motion(&self) -> Range<usize> {
        FIRST_COORDINATE..FIRST_COORDINATE + 2 * self.coordinates.len()
    }

    /// Returns the slots of the constants. The slots of the coordinates and the velocities at the start follow them.
    pub(super) fn slots_of_constants(&self) -> Range<usize> {
        self.slots_of_motion().end..self.slots_of_motion().end + self.constants.len()
    }

    /// Returns the number of inputs.
    pub(super) fn inputs(&self) -> usize {
        self.slots_of_constants().end + 2 * self.coordinates.len()
    }
}

/// The text of one coordinate.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CoordinateText {
    /// The name of the coordinate. The velocity has the same name with a `v` before it.
    pub name: String,
    /// The unit of the coordinate, which is one of [`UNITS`](super::UNITS).
    pub unit: &'static str,
    /// The acceleration of the coordinate.
    pub acceleration: String,
    /// The value of the coordinate at time `t` if nobody intervenes, as an expression of `t`, constants and starts.
    pub exact: Option<String>,
    /// The drawing position of the coordinate as expressions of coordinates and constants, with x to the right and y
    /// up, in metres.
    pub at: Option<[String; 2]>,
}

/// The text of an event: a wall, and how the law leaves it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct EventText {
    /// The name of the event.
    pub name: String,
    /// A coordinate, its opposite or a multiple, plus an expression of constants and `t`. The law meets the wall where
    /// this falls through 0.
    pub when: String,
    /// Whether it falls; otherwise the law meets the wall where it rises.
    pub falls: bool,
    /// The coordinates whose velocities change, each with the new velocity by the old ones.
    pub then: Vec<(usize, String)>,
}

/// The placement of a law's first coordinates in space, for drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Layout {
    /// Each coordinate is a position to the right, on a line of its own.
    #[default]
    Beads,
    /// The coordinates are heights above 0.
    Vertical,
    /// The coordinates are the heights of a carriage and of its wheel, each from its place of rest.
    Carriage,
    /// The first coordinate is a position to the right. The second is the position that the first one follows, if it
    /// has the same unit.
    Follower,
}

impl Layout {
    /// Every layout with its name.
    pub const ALL: [(&str, Layout); 4] = [
        ("beads", Layout::Beads),
        ("vertical", Layout::Vertical),
        ("carriage", Layout::Carriage),
        ("follower", Layout::Follower),
    ];

    /// Returns the name of the layout.
    pub fn id(self) -> &'static str {
        let named = Self::ALL.iter().find(|(_, layout)| *layout == self);
        named.expect("every layout is in the table").0
    }
}
