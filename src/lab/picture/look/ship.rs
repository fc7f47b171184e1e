//! A ship on a straight course, from above.

use glam::DVec2;

use super::{Drawn, Framing, Outline};
use crate::sim::bodies::Ship;

impl Drawn for Ship {
    fn draw(&self, _s: &f64, outline: &mut Outline) {
        outline.hull(DVec2::X, 9.0);
    }

    fn framing(&self) -> Framing {
        Framing::Follow { width_m: 60.0, height_m: 9.0, wake_s: 3.0 }
    }
}
