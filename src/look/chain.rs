//! Draws a chain: beads on a line between two walls.

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::sim::bodies::Chain;

/// Returns the radius of the beads of a chain, in metres.
fn bead(chain: &Chain, beads: usize) -> f64 {
    let room = -2.0 * chain.place_of(0, 0.0).x / (beads + 1) as f64;
    (0.28 * room).min(0.11 * chain.amplitude())
}

impl BodyPicture for Chain {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let unit = self.amplitude();
        let half_wall = DVec2::Y * 0.5 * unit;
        let mut last = self.place_of(0, 0.0);
        for (j, &x) in (1..).zip(q.iter().chain([&0.0])) {
            let next = self.place_of(j, x);
            outline.marks.push(Mark::Rod { from: last, to: next });
            last = next;
        }
        for end in [self.place_of(0, 0.0), last] {
            outline.marks.push(Mark::Wall { from: end - half_wall, to: end + half_wall });
        }
        let radius = bead(self, q.len());
        for (j, &x) in (1..).zip(q) {
            let at = self.place_of(j, x);
            outline.marks.push(Mark::Disc { centre: at, radius });
        }
    }

    fn framing(&self) -> Framing {
        Framing::Fixed {
            centre_m: DVec2::ZERO,
            half_m: DVec2::new(-1.08 * self.place_of(0, 0.0).x, 1.15 * self.amplitude()),
            trail_s: 0.0,
        }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        let radius = bead(self, q.len());
        (1..).zip(q).map(|(j, &x)| Handle { at: self.place_of(j, x), radius }).collect()
    }

    /// Moves the pulled bead only. The other beads keep their positions and velocities.
    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        q[pull.handle] = pull.to.y;
        v[pull.handle] = pull.velocity.y;
    }
}
