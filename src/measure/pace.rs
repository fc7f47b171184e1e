//! How fast a lane is stepped, and by which method.

use crate::scene::LaneSpec;
use crate::sim::TickRate;

/// A lane's method, with its substeps, at a tick rate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    pub(super) spec: LaneSpec,
    pub(super) tick_hz: TickRate,
}
