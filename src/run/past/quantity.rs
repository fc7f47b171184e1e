//! Quantities of a coordinate for the motion instrument.

use crate::race::LaneBody;
use crate::sim::bodies::{Coordinate, Ship};

/// A quantity of a coordinate that the motion instrument shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The coordinate.
    Position,
    /// The rate of change of the coordinate.
    Velocity,
}

impl Quantity {
    /// Both quantities, with the usual one first.
    pub const ALL: [Quantity; 2] = [Quantity::Position, Quantity::Velocity];

    /// Returns the default quantity of a plot, which is the position. A ship on a straight course sails on for ever, so
    /// its plot shows the speed.
    pub fn usual(body: &LaneBody) -> Self {
        if body.stepper.body().is::<Ship>() { Self::Velocity } else { Self::Position }
    }

    /// Returns the quantity's name for people.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Position => "position",
            Quantity::Velocity => "velocity",
        }
    }

    /// Returns the quantity's symbol for this coordinate.
    pub fn symbol(self, coordinate: &Coordinate) -> &str {
        match self {
            Quantity::Position => &coordinate.name,
            Quantity::Velocity => &coordinate.velocity,
        }
    }

    /// Returns the value of the quantity, given a coordinate and its velocity.
    pub fn value(self, [q, v]: [f64; 2]) -> f64 {
        match self {
            Quantity::Position => q,
            Quantity::Velocity => v,
        }
    }
}
