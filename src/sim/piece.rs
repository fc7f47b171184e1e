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
