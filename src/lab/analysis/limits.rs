//! What can be seen of an error: the limits by which a run is judged.

/// The error that still counts as accurate: a hundredth of the amplitude, about what can be seen.
pub const TOLERANCE: f64 = 0.01;

/// The change of a swing's amplitude that is seen: a twentieth.
pub const VISIBLE: f64 = 0.05;

/// The frequency error that still looks right.
pub const RIGHT_PITCH: f64 = 0.01;
