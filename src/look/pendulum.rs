//! Draws a bob on a rod.

use std::f64::consts::TAU;

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::sim::bodies::{Body, Pendulum};

/// Radius of the bob, relative to the length of the rod.
const BOB: f64 = 0.12;

impl BodyPicture for Pendulum {
    fn draw(&self, _q: &[f64], outline: &mut Outline) {
        let (pivot, bob, unit) = (DVec2::ZERO, outline.at, self.length);
        outline.marks.push(Mark::Rod { from: pivot, to: bob });
        outline.marks.push(Mark::Anchor { centre: pivot, radius: 0.035 * unit });
        outline.marks.push(Mark::Disc { centre: bob, radius: BOB * unit });
    }

    fn framing(&self) -> Framing {
        let half_m = DVec2::splat(1.2 * self.length);
        Framing::Fixed { centre_m: DVec2::ZERO, half_m, trail_s: 1.0 }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        vec![Handle { at: self.place(&q[0]), radius: BOB * self.length }]
    }

    /// Chooses the equivalent angle that is nearest to the current one, so that turns add up while the bob is led
    /// around.
    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        if pull.to != DVec2::ZERO {
            let angle = libm::atan2(pull.to.x, -pull.to.y);
            q[0] = angle + TAU * libm::round((q[0] - angle) / TAU);
        }
        let tangent = DVec2::new(libm::cos(q[0]), libm::sin(q[0]));
        v[0] = pull.velocity.dot(tangent) / self.length;
    }
}
