//! What of a coordinate the motion instrument shows.

use crate::run::race::LaneBody;
use crate::sim::bodies::{Coordinate, Ship};

/// What of a coordinate the motion instrument shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The coordinate.
    Position,
    /// Its rate of change.
    Velocity,
}

impl Quantity {
    /// Both, the usual one first.
    pub const ALL: [Quantity; 2] = [Quantity::Position, Quantity::Velocity];

    /// What a plot shows of a body unless a person chooses otherwise: of a ship on a straight course its speed, for it runs on
    /// for ever.
    pub fn usual(body: &LaneBody) -> Self {
        if body.stepper.body().is::<Ship>() { Self::Velocity } else { Self::Position }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Position => "position",
            Quantity::Velocity => "velocity",
        }
    }

    /// Its symbol for this coordinate.
    pub fn symbol(self, coordinate: &Coordinate) -> &str {
        match self {
            Quantity::Position => &coordinate.name,
            Quantity::Velocity => &coordinate.velocity,
        }
    }

    /// Its value among a coordinate and its velocity.
    pub fn among(self, [q, v]: [f64; 2]) -> f64 {
        match self {
            Quantity::Position => q,
            Quantity::Velocity => v,
        }
    }
}
