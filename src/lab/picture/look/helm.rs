//! A ship that is steered, from above.

use glam::{DVec2, DVec3};

use super::{Drawn, Framing, Outline};
use crate::sim::bodies::Helm;

/// What is shown across, in metres: a turning circle.
const WIDTH_M: f64 = 150.0;

impl Drawn for Helm {
    fn draw(&self, q: &DVec3, outline: &mut Outline) {
        let bow = DVec2::new(libm::cos(q.z), libm::sin(q.z));
        outline.hull(bow, 0.15 * WIDTH_M);
    }

    fn framing(&self) -> Framing {
        Framing::Follow { width_m: WIDTH_M, height_m: 0.6 * WIDTH_M, wake_s: 10.0 }
    }
}
