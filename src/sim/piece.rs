//! The smooth pieces of a force law.

/// The most switches of a body.
pub const MAX_SWITCHES: usize = 32;

/// A smooth piece of a force law, named by the mode of each switch: a part of the law that has a corner
/// or a jump. A body without switches has one piece.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// The modes, in the order of the switches; 0 beyond the last.
    pub modes: [i64; MAX_SWITCHES],
}

impl Piece {
    /// The piece with every switch in mode 0.
    pub const FIRST: Self = Self { modes: [0; MAX_SWITCHES] };
}

/// Signed distances from a state to the boundaries of a piece: for each switch, to that with the mode
/// below and to that with the mode above. A distance is negative if the state is beyond that boundary by
/// more than rounding; it is infinite where there is no boundary.
pub type Distances = [[f64; 2]; MAX_SWITCHES];

/// No boundary anywhere.
pub const NO_BOUNDARIES: Distances = [[f64::INFINITY; 2]; MAX_SWITCHES];

/// Rounding of a value at a boundary, relative to the numbers that are compared. A smaller tolerance would take a
/// rounded boundary for a crossing.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The distance of `value` from the lower boundary `end`; negative below it by more than rounding.
pub(super) fn above(value: f64, end: f64) -> f64 {
    value - end + ROUNDING * (value.abs() + end.abs())
}

/// The distance of `value` from the upper boundary `end`; negative above it by more than rounding.
pub(super) fn below(value: f64, end: f64) -> f64 {
    above(-value, -end)
}
