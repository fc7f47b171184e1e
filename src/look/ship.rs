//! Draws a ship on a straight course, from above.

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::sim::bodies::Ship;
use crate::sim::number::round;

/// Length of the hull, in metres.
const LENGTH_M: f64 = 9.0;

impl BodyPicture for Ship {
    fn draw(&self, _q: &[f64], outline: &mut Outline) {
        outline.marks.push(Mark::Hull { bow: DVec2::X, length: LENGTH_M });
    }

    fn framing(&self) -> Framing {
        Framing::Follow { width_m: 38.0, height_m: 9.0, wake_s: 3.0 }
    }

    fn describe_motion(&self, _q: &[f64], v: &[f64]) -> Option<String> {
        let last = self.throttle * self.thrust / self.drag;
        let way = if v[0].abs() < last.abs() { "speeds up" } else { "slows down" };
        last.is_finite().then(|| format!("{way} to {} m/s", round(last, 3)))
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        vec![Handle { at: DVec2::new(q[0], 0.0), radius: LENGTH_M / 2.0 }]
    }

    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        (q[0], v[0]) = (pull.to.x, pull.velocity.x);
    }
}
