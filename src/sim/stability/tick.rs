//! The tick that is looked at.

/// One tick of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// When it begins, in seconds.
    pub t: f64,
    /// How long it is, in seconds.
    pub h: f64,
    /// Equal steps in it.
    pub substeps: u32,
}
