//! A body that a person holds with the mouse.

use glam::DVec2;

use crate::scene::LaneId;

/// A body that the pointer holds in a place. Time stands still until it is released: otherwise the body would move on
/// meanwhile, and the lanes of a race would diverge before they start from the new state.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldBody {
    /// The lane in whose cell it is held.
    pub lane: LaneId,
    /// The body's index in the scene.
    pub body: usize,
    /// The coordinates with which it would be released.
    pub q: Box<[f64]>,
    /// The velocities with which it would be released.
    pub v: Box<[f64]>,
    /// The place of the pointer, in metres.
    pub hand: DVec2,
    /// The place of the held point of the body, in metres: as near to the pointer as the body can be.
    pub handle: DVec2,
}
