//! Draws a net: its threads, and a bead on each node if the net is small.

use std::sync::Arc;

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull, typed};
use crate::run::race::LaneBody;
use crate::scene::{Preview, Thread};
use crate::sim::bodies::Net;

/// Maximum number of nodes with beads. In larger nets beads would hide the threads.
const MAX_BEADS: usize = 64;

/// Radius of a bead, of a pin, and of a handle, relative to the length of the shortest spring.
const BEAD: f64 = 0.13;
const PIN: f64 = 0.16;
const GRIP: f64 = 0.45;

/// Largest radius of a bead or a pin, relative to the picture's width.
const MAX_BEAD: f64 = 0.01;

/// Margin around the motion, relative to the size of the motion.
const MARGIN: f64 = 0.12;

/// Length of the marked node's trail, in seconds.
const TRAIL_S: f64 = 1.2;

struct NetPicture<'a> {
    net: &'a Net,
    preview: Arc<Preview>,
}

pub(super) fn picture(body: &LaneBody) -> Box<dyn BodyPicture + '_> {
    Box::new(NetPicture { net: typed(body.stepper.body()), preview: body.preview() })
}

impl BodyPicture for NetPicture<'_> {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let Self { net, preview } = self;
        let [low, high] = preview.corners;
        let largest = MAX_BEAD * (high - low).max_element();
        let radius = |part: f64| (part * preview.springs.shortest).min(largest);
        outline.threads.extend(preview.springs.lines.iter().map(|line| Thread {
            points: line.nodes.iter().map(|&node| net.place_of(node, q)).collect(),
            is_border: line.is_border,
        }));
        for &centre in &preview.springs.fixed {
            outline.marks.push(Mark::Anchor { centre, radius: radius(PIN) });
        }
        let beads = Net::nodes(q).len() <= MAX_BEADS;
        for &node in Net::nodes(q).iter().filter(|_| beads) {
            outline.marks.push(Mark::Disc { centre: DVec2::from(node), radius: radius(BEAD) });
        }
    }

    fn framing(&self) -> Framing {
        let [low, high] = self.preview.corners;
        let half = (high - low) / 2.0;
        let half_m = (1.0 + MARGIN) * half.max(DVec2::splat(0.25 * half.max_element()));
        Framing::Fixed { centre_m: (low + high) / 2.0, half_m, trail_s: TRAIL_S }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        let radius = GRIP * self.preview.springs.shortest;
        Net::nodes(q).iter().map(|&node| Handle { at: DVec2::from(node), radius }).collect()
    }

    /// Moves the pulled node only. The other nodes keep their positions and velocities.
    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        Net::nodes_mut(q)[pull.handle] = pull.to.into();
        Net::nodes_mut(v)[pull.handle] = pull.velocity.into();
    }
}
