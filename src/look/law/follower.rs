//! A body on a chart recorder's paper, with a line to what it follows if that is a coordinate too.

use glam::DVec2;

use super::super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use super::reach;
use crate::sim::State;

/// The radii of the body and of what it follows, in parts of the farthest that they go.
const BODY: f64 = 0.08;
const TARGET: f64 = 0.05;

pub(super) struct Follower {
    pub(super) ranges: Vec<(f64, f64)>,
}

impl Follower {
    fn farthest(&self) -> f64 {
        let [low, high] = reach(&self.ranges);
        high.max(-low)
    }

    /// The coordinates that are drawn: the follower, and what it follows.
    fn places<'q>(&self, q: &'q [f64]) -> &'q [f64] {
        &q[..self.ranges.len().min(2)]
    }
}

impl BodyPicture for Follower {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let farthest = self.farthest();
        let at = |x: f64| DVec2::new(x, 0.0);
        if let [own, target] = *self.places(q) {
            outline.marks.push(Mark::Rod { from: at(own), to: at(target) });
            outline.marks.push(Mark::Disc { centre: at(target), radius: TARGET * farthest });
        }
        outline.marks.push(Mark::Disc { centre: outline.at, radius: BODY * farthest });
    }

    fn framing(&self) -> Framing {
        Framing::Recorder { half_width_m: 1.25 * self.farthest() }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        let radii = [BODY, TARGET].map(|part| part * self.farthest());
        let places = self.places(q).iter().zip(radii);
        places.map(|(&x, radius)| Handle { at: DVec2::new(x, 0.0), radius }).collect()
    }

    fn pull(&self, state: &mut State<Vec<f64>>, pull: Pull) {
        state.q[pull.handle] = pull.to.x;
        state.v[pull.handle] = pull.velocity.x;
    }
}
