//! The identity of a lane.

use std::fmt;

/// Which lane of a run is meant: its number, from 1 in the order of the scene. It stays the same when others leave the run or
/// come back, and under whatever method the lane goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LaneId(pub usize);

impl LaneId {
    /// The lane at this index of a scene's lanes.
    pub const fn of_index(index: usize) -> Self {
        Self(index + 1)
    }

    /// Its index among the scene's lanes.
    pub fn index(self) -> usize {
        self.0 - 1
    }
}

/// Its number.
impl fmt::Display for LaneId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
