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
    /// The conserved energy in joules, of coordinates, velocities and constants.
    pub energy: Option<String>,
    /// The indices of the coordinates drawn as x and y of one point.
    pub plane: Option<[usize; 2]>,
    /// The placement of the first coordinates in space.
    pub layout: Layout,
}

/// The slots of the tape's inputs: the time and the steering, then the moving inputs, then the fixed ones.
impl LawText {
    /// The coordinates, then the velocities.
    pub(super) fn slots_of_motion(&self) -> Range<usize> {
        FIRST_COORDINATE..FIRST_COORDINATE + 2 * self.coordinates.len()
    }

    /// The constants, followed by the coordinates and the velocities at the start.
    pub(super) fn slots_of_constants(&self) -> Range<usize> {
        self.slots_of_motion().end..self.slots_of_motion().end + self.constants.len()
    }

    /// Number of inputs.
    pub(super) fn inputs(&self) -> usize {
        self.slots_of_constants().end + 2 * self.coordinates.len()
    }
}

/// The text of one coordinate.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CoordinateText {
    /// Its name; its velocity has the same name with a `v` before it.
    pub name: String,
    /// One of [`UNITS`](super::UNITS).
    pub unit: &'static str,
    /// Its acceleration.
    pub acceleration: String,
    /// Its value at time `t` if nobody intervenes, as an expression of `t`, constants and starts.
    pub exact: Option<String>,
    /// Its drawing position as expressions of coordinates and constants: x to the right and y up, in metres.
    pub at: Option<[String; 2]>,
}

/// The placement of a law's first coordinates in space, for drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Layout {
    /// Each on its own line, to the right.
    #[default]
    Beads,
    /// Heights above 0.
    Vertical,
    /// The heights of a carriage and of its wheel, each from its rest.
    Carriage,
    /// A position to the right, and the position that it follows, if the second has the same unit.
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

    /// The name of the layout.
    pub fn id(self) -> &'static str {
        let named = Self::ALL.iter().find(|(_, layout)| *layout == self);
        named.expect("every layout is in the table").0
    }
}
