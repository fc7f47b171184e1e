//! A law, drawn as its scene says: beads on rails or in a plane, heights, a carriage, a follower, or discs in places of
//! its own.

use super::beads::Beads;
use super::{BodyPicture, typed};
use crate::run::race::LaneBody;
use crate::sim::State;
use crate::sim::bodies::Law;
use crate::sim::law::Layout;

use carriage::Carriage;
use follower::Follower;
use places::Places;
use vertical::Vertical;

mod carriage;
mod follower;
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

/// Brings the height of a coordinate to a hand.
fn lift(state: &mut State<Vec<f64>>, coordinate: usize, height: f64, velocity: f64) {
    state.q[coordinate] = height;
    state.v[coordinate] = velocity;
}
