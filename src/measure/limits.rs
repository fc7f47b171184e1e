//! The limits by which a run is judged: the errors that a player sees.

/// The largest error that counts as accurate, in amplitudes: about the smallest that can be seen.
pub const TOLERANCE: f64 = 0.01;

/// The smallest relative change of an amplitude that can be seen.
pub const VISIBLE: f64 = 0.05;

/// The largest relative frequency error that looks right.
pub const FREQUENCY_TOLERANCE: f64 = 0.01;
