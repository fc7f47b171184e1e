//! Draws a steered ship from above.

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::sim::bodies::Helm;

/// Width of the view in metres, enough for a turning circle.
const WIDTH_M: f64 = 150.0;

/// Length of the hull, in metres.
const LENGTH_M: f64 = 0.15 * WIDTH_M;

impl BodyPicture for Helm {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let bow = DVec2::new(libm::cos(q[2]), libm::sin(q[2]));
        outline.marks.push(Mark::Hull { bow, length: LENGTH_M });
    }

    fn framing(&self) -> Framing {
        Framing::Follow { width_m: WIDTH_M, height_m: 0.6 * WIDTH_M, wake_s: 10.0 }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        vec![Handle { at: DVec2::from_slice(q), radius: LENGTH_M / 2.0 }]
    }

    /// Moves the ship, which keeps its heading and stops turning.
    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        pull.to.write_to_slice(q);
        pull.velocity.extend(0.0).write_to_slice(v);
    }
}
