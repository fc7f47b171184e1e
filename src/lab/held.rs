//! A body that a person holds with the mouse.

use glam::DVec2;

/// A body held in the place that the pointer gives it. Time stands still until it is let go: a body that went on
/// meanwhile would be another one than was taken, and in a race the lanes would part before they start from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    /// The number of the lane in whose cell it is held.
    pub lane: usize,
    /// The body's place in the scene.
    pub body: usize,
    /// The coordinates in which it would be let go.
    pub q: Box<[f64]>,
    /// The velocities with which it would be let go.
    pub v: Box<[f64]>,
    /// Where the hand is, in metres.
    pub hand: DVec2,
    /// Where the part of the body is that it holds, in metres: as near to the hand as the body can be.
    pub handle: DVec2,
}
