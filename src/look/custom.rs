//! Draws a custom body with its author's drawing function or, if there is none, as beads on rails or in a plane.

use super::beads::Beads;
use super::{BodyPicture, Framing, Handle, Outline, Pull, typed};
use crate::run::race::LaneBody;
use crate::sim::bodies::Custom;

struct CustomPicture<'a> {
    body: &'a LaneBody,
    custom: &'a Custom,
    beads: Beads<'a>,
}

pub(super) fn picture(body: &LaneBody) -> Box<dyn BodyPicture + '_> {
    let custom = typed::<Custom>(body.stepper.body());
    let info = custom.info();
    let coordinates = info.coordinates.iter().map(|of| [&*of.name, of.unit]).collect();
    let beads = Beads { coordinates, ranges: body.preview().ranges.clone(), plane: info.plane };
    Box::new(CustomPicture { body, custom, beads })
}

impl BodyPicture for CustomPicture<'_> {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        match self.body.drawing() {
            Some(draw) => outline.marks.extend(draw(self.custom.system(), q)),
            None => self.beads.draw(q, outline),
        }
    }

    fn framing(&self) -> Framing {
        self.beads.framing()
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        self.beads.handles(q)
    }

    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        self.beads.pull(q, v, pull);
    }
}
