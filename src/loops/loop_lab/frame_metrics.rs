//! What is measured of every frame that a loop displays.

use super::lane::LoopFrame;
use crate::run::{Scale, Unit};

/// A measure of a displayed frame.
#[derive(Debug)]
pub struct FrameMetric {
    /// Its name in output, `snake_case`.
    pub id: &'static str,
    /// Its name for people.
    pub name: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// How it is plotted.
    pub scale: Scale,
    /// Its value.
    pub measure: fn(&LoopFrame) -> f64,
}

/// Every measure of a frame, in menu order.
pub static FRAME_METRICS: &[FrameMetric] = &[
    FrameMetric {
        id: "position_error",
        name: "position error",
        unit: Unit::Coordinate,
        scale: Scale::Log,
        measure: |frame| (frame.q[0] - frame.exact[0]).abs(),
    },
    FrameMetric {
        id: "animation_error",
        name: "animation error",
        unit: Unit::Milliseconds,
        scale: Scale::Linear,
        measure: |frame| frame.animation_error_ms,
    },
    FrameMetric {
        id: "latency",
        name: "latency",
        unit: Unit::Milliseconds,
        scale: Scale::Linear,
        measure: LoopFrame::latency_ms,
    },
    FrameMetric {
        id: "ticks",
        name: "ticks per frame",
        unit: Unit::One,
        scale: Scale::Linear,
        measure: |frame| f64::from(frame.ticks),
    },
];
