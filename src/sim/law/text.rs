//! The text of a law, as a scene writes it.

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
    /// The indices of the coordinates that are drawn as x and y of one point.
    pub plane: Option<[usize; 2]>,
    /// How the first coordinates lie in space.
    pub layout: Layout,
}

/// The inputs of its tapes, by their slots: after the time and the steering what moves, and then what is fixed.
impl LawText {
    /// The coordinates, then the velocities.
    pub(super) fn slots_of_motion(&self) -> Range<usize> {
        FIRST_COORDINATE..FIRST_COORDINATE + 2 * self.coordinates.len()
    }

    /// The constants, after which come the coordinates and the velocities at the start.
    pub(super) fn slots_of_constants(&self) -> Range<usize> {
        self.slots_of_motion().end..self.slots_of_motion().end + self.constants.len()
    }

    /// How many there are.
    pub(super) fn inputs(&self) -> usize {
        self.slots_of_constants().end + 2 * self.coordinates.len()
    }
}

/// The text of one coordinate.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct CoordinateText {
    /// Its name; its velocity is called `v` and this.
    pub name: String,
    /// One of [`UNITS`](super::UNITS).
    pub unit: &'static str,
    /// Its acceleration.
    pub acceleration: String,
    /// Where it is at time `t`, of `t`, constants and starts, as long as nobody intervenes.
    pub exact: Option<String>,
    /// Where it is drawn, of coordinates and constants: x to the right and y up, in metres.
    pub at: Option<[String; 2]>,
}

/// How the first coordinates of a law lie in space, for whoever draws them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Layout {
    /// Each on a line of its own, to the right.
    #[default]
    Beads,
    /// Heights above 0.
    Vertical,
    /// The heights of a carriage and of its wheel, each from its rest.
    Carriage,
    /// A place to the right, and the place that it follows, if the second has the same unit.
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

    /// Its name.
    pub fn id(self) -> &'static str {
        let named = Self::ALL.iter().find(|(_, layout)| *layout == self);
        named.expect("every layout is in the table").0
    }
}
