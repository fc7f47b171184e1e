//! A ship that is steered, from above.

use glam::{DVec2, DVec3};

use super::{Drawn, Framing, Handle, Mark, Outline, Pull};
use crate::sim::State;
use crate::sim::bodies::Helm;

/// What is shown across, in metres: a turning circle.
const WIDTH_M: f64 = 150.0;

/// The length of the hull, in metres.
const LENGTH_M: f64 = 0.15 * WIDTH_M;

impl Drawn for Helm {
    fn draw(&self, q: &DVec3, outline: &mut Outline) {
        let bow = DVec2::new(libm::cos(q.z), libm::sin(q.z));
        outline.marks.push(Mark::Hull { bow, length: LENGTH_M });
    }

    fn framing(&self) -> Framing {
        Framing::Follow { width_m: WIDTH_M, height_m: 0.6 * WIDTH_M, wake_s: 10.0 }
    }

    fn handles(&self, q: &DVec3) -> Vec<Handle> {
        vec![Handle { at: q.truncate(), radius: LENGTH_M / 2.0 }]
    }

    /// The ship keeps its heading, and turns no more.
    fn pull(&self, state: &mut State<DVec3>, pull: Pull) {
        state.q = pull.to.extend(state.q.z);
        state.v = pull.velocity.extend(0.0);
    }
}
