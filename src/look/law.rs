//! Draws a law in the layout that its scene names: beads on rails or in a plane, heights, a carriage, a follower, or
//! discs at the scene's places.

use glam::DVec2;

use super::beads::Beads;
use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull, typed};
use crate::run::race::LaneBody;
use crate::sim::bodies::Law;
use crate::sim::law::Layout;
use carriage::Carriage;
use places::Places;
use vertical::Vertical;

mod carriage;
mod places;
mod vertical;

pub(super) fn picture(body: &LaneBody) -> Box<dyn BodyPicture + '_> {
    let law = typed::<Law>(body.stepper.body());
    let (text, preview) = (law.equations().text(), body.preview());
    if law.equations().has_places() {
        return Box::new(Places { law, corners: preview.corners });
    }
    let unit = text.coordinates[0].unit;
    let alike = text.coordinates.iter().take_while(|of| of.unit == unit).count();
    // Coordinates in other units are not positions on this axis.
    let ranges = preview.ranges[..alike].to_vec();
    match text.layout {
        Layout::Beads => {
            let coordinates = text.coordinates.iter().map(|of| [&*of.name, of.unit]).collect();
            Box::new(Beads { coordinates, ranges: preview.ranges.clone(), plane: text.plane })
        }
        Layout::Vertical => Box::new(Vertical { ranges }),
        Layout::Carriage => Box::new(Carriage::new(law, &ranges)),
        Layout::Follower => Box::new(Follower { ranges }),
    }
}

/// Returns the minimum and maximum of 0 and all ranges; -1 and 1 if every range is 0.
fn reach(ranges: &[(f64, f64)]) -> [f64; 2] {
    let (low, high) =
        ranges.iter().fold((0.0_f64, 0.0_f64), |all, next| (all.0.min(next.0), all.1.max(next.1)));
    if low < high { [low, high] } else { [-1.0, 1.0] }
}

/// Radius of the follower and of its target, relative to the largest distance from 0 that either of them reaches.
const BODY: f64 = 0.08;
const TARGET: f64 = 0.05;

/// The body on a chart recorder's paper, with a line to its target if the target is a coordinate too.
struct Follower {
    ranges: Vec<(f64, f64)>,
}

impl Follower {
    fn farthest(&self) -> f64 {
        let [low, high] = reach(&self.ranges);
        high.max(-low)
    }

    /// Returns the drawn coordinates, which are the follower and, if there is one, its target.
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

    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        q[pull.handle] = pull.to.x;
        v[pull.handle] = pull.velocity.x;
    }
}
