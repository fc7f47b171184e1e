//! Threads between nodes, and a bead on each node of a small net.

use glam::DVec2;

use super::{Drawn, Framing, Handle, Mark, Outline, Pull};
use crate::lab::picture::outline::Thread;
use crate::sim::State;
use crate::sim::bodies::Net;

/// The most nodes with beads: of more, beads hide the threads.
const MOST_BEADS: usize = 64;

/// The radius of a bead, of a pin, and of what a hand can take hold of, in units of the shortest spring.
const BEAD: f64 = 0.13;
const PIN: f64 = 0.16;
const GRIP: f64 = 0.45;

/// The largest radius of a bead and of a pin, in units of the picture's width.
const LARGEST_BEAD: f64 = 0.01;

/// The room around the motion, as a part of it.
const MARGIN: f64 = 0.12;

/// How long the trail of the marked node is, in seconds.
const TRAIL_S: f64 = 1.2;

impl Drawn for Net {
    fn draw(&self, q: &Vec<f64>, outline: &mut Outline) {
        let [low, high] = self.range();
        let largest = LARGEST_BEAD * (high - low).max_element();
        let radius = |part: f64| (part * self.shortest()).min(largest);
        outline.threads.extend(
            self.threads(q)
                .map(|(points, is_border)| Thread { points: points.collect(), is_border }),
        );
        for centre in self.fixed() {
            outline.marks.push(Mark::Anchor { centre, radius: radius(PIN) });
        }
        let beads = Self::nodes(q).len() <= MOST_BEADS;
        for &node in Self::nodes(q).iter().filter(|_| beads) {
            outline.marks.push(Mark::Disc { centre: DVec2::from(node), radius: radius(BEAD) });
        }
    }

    fn framing(&self) -> Framing {
        let [low, high] = self.range();
        let half = (high - low) / 2.0;
        let half_m = (1.0 + MARGIN) * half.max(DVec2::splat(0.25 * half.max_element()));
        Framing::Fixed { centre_m: (low + high) / 2.0, half_m, trail_s: TRAIL_S }
    }

    fn handles(&self, q: &Vec<f64>) -> Vec<Handle> {
        let radius = GRIP * self.shortest();
        Self::nodes(q).iter().map(|&node| Handle { at: DVec2::from(node), radius }).collect()
    }

    /// The other nodes keep their places and their velocities.
    fn pull(&self, state: &mut State<Vec<f64>>, pull: Pull) {
        Self::nodes_mut(&mut state.q)[pull.handle] = pull.to.into();
        Self::nodes_mut(&mut state.v)[pull.handle] = pull.velocity.into();
    }
}
