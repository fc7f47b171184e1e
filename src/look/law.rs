//! A law, drawn as its scene says: beads on rails or in a plane, heights, a carriage, a follower, or discs in places of
//! its own.

use glam::DVec2;

use super::beads::Beads;
use super::{Drawn, Framing, Handle, Mark, Outline, Pull, typed};
use crate::run::race::LaneBody;
use crate::sim::bodies::Law;
use crate::sim::law::Layout;
use carriage::Carriage;
use places::Places;
use vertical::Vertical;

mod carriage;
mod places;
mod vertical;

pub(super) fn picture(body: &LaneBody) -> Box<dyn Drawn + '_> {
    let law = typed::<Law>(body.stepper.body());
    let (text, preview) = (law.equations().text(), body.preview());
    if law.equations().has_places() {
        return Box::new(Places { law, corners: preview.corners });
    }
    let unit = text.coordinates[0].unit;
    let alike = text.coordinates.iter().take_while(|of| of.unit == unit).count();
    // Those of other units are no places.
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

/// The least and the greatest of some ranges and of 0; of nothing but 0, a unit to either side.
fn reach(ranges: &[(f64, f64)]) -> [f64; 2] {
    let (low, high) =
        ranges.iter().fold((0.0_f64, 0.0_f64), |all, next| (all.0.min(next.0), all.1.max(next.1)));
    if low < high { [low, high] } else { [-1.0, 1.0] }
}

/// The radii of a follower and of what it follows, in parts of the farthest that they go.
const BODY: f64 = 0.08;
const TARGET: f64 = 0.05;

/// The body on a chart recorder's paper, with a line to what it follows if that is a coordinate too.
struct Follower {
    ranges: Vec<(f64, f64)>,
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

impl Drawn for Follower {
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
