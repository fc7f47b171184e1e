//! A law: beads on rails, or in a plane.

use super::beads::Beads;
use super::{Drawn, Framing, Handle, Outline, Pull};
use crate::sim::State;
use crate::sim::bodies::Law;

fn beads(law: &Law) -> Beads<'_> {
    let text = law.equations().text();
    let coordinates = text.coordinates.iter().map(|of| [&*of.name, of.unit]).collect();
    Beads { coordinates, ranges: law.ranges(), plane: text.plane }
}

impl Drawn for Law {
    fn draw(&self, q: &Vec<f64>, outline: &mut Outline) {
        beads(self).draw(q, outline);
    }

    fn framing(&self) -> Framing {
        beads(self).framing()
    }

    fn handles(&self, q: &Vec<f64>) -> Vec<Handle> {
        beads(self).handles(q)
    }

    fn pull(&self, state: &mut State<Vec<f64>>, pull: Pull) {
        beads(self).pull(state, pull);
    }
}
