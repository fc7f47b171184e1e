//! A custom body: as its author draws it, or beads on rails or in a plane.

use std::any::Any;

use super::beads::Beads;
use super::{Drawn, Framing, Handle, Mark, Outline, Pull};
use crate::sim::State;
use crate::sim::bodies::Custom;

/// What its author draws: the system and the coordinates, to marks.
type Draw = dyn Fn(&dyn Any, &[f64]) -> Vec<Mark> + Send + Sync;

/// How the author of a body draws it; its kind holds it.
pub(in crate::lab) struct Drawing(pub(in crate::lab) Box<Draw>);

fn beads(own: &Custom) -> Beads<'_> {
    let info = own.info();
    let coordinates = info.coordinates.iter().map(|of| [&*of.name, of.unit]).collect();
    Beads { coordinates, ranges: own.bounds(), plane: info.plane }
}

impl Drawn for Custom {
    fn draw(&self, q: &Vec<f64>, outline: &mut Outline) {
        match self.info().drawing.as_ref().and_then(|drawing| drawing.downcast_ref::<Drawing>()) {
            Some(Drawing(draw)) => outline.marks.extend(draw(self.system(), q)),
            None => beads(self).draw(q, outline),
        }
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
