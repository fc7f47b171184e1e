//! Draws a camera on a chart recorder's paper, with a line to the target that it follows.

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::sim::bodies::Follow;

/// Returns the largest distance of the camera or the target from 0 at the start, in metres; 1 if both stay at 0.
fn reach(follow: &Follow) -> f64 {
    let target = follow.step.abs() + follow.sine.abs();
    let reach = target.max(follow.x0.abs());
    if reach > 0.0 { reach } else { 1.0 }
}

/// Radius of the camera, radius of the target, and half the length of the line across the target, as multiples of the
/// `reach`.
const CAMERA: f64 = 0.09;
const TARGET: f64 = 0.045;
const HALF_POST: f64 = 0.16;

impl BodyPicture for Follow {
    fn draw(&self, _q: &[f64], outline: &mut Outline) {
        let (reach, at) = (reach(self), DVec2::new(self.target(outline.t), 0.0));
        let half_post = DVec2::Y * HALF_POST * reach;
        outline.marks.push(Mark::Rod { from: outline.at, to: at });
        outline.marks.push(Mark::Wall { from: at - half_post, to: at + half_post });
        outline.marks.push(Mark::Anchor { centre: at, radius: TARGET * reach });
        outline.marks.push(Mark::Disc { centre: outline.at, radius: CAMERA * reach });
    }

    fn framing(&self) -> Framing {
        Framing::Recorder { half_width_m: 1.3 * reach(self) }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        vec![Handle { at: DVec2::new(q[0], 0.0), radius: CAMERA * reach(self) }]
    }

    /// Pulls the camera. Under the first-order law, its velocity follows from its position instead of the pull.
    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        v[0] = match self.order {
            1 => v[0] - self.rate * (pull.to.x - q[0]),
            _ => pull.velocity.x,
        };
        q[0] = pull.to.x;
    }
}
