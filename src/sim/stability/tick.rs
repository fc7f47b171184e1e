//! A tick.

/// One tick of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Its start, in seconds.
    pub t: f64,
    /// Its length, in seconds.
    pub h: f64,
    /// Equal steps in it.
    pub substeps: u32,
}
