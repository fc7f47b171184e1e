//! A bob on a rod.

use glam::DVec2;

use super::{Drawn, Framing, Outline};
use crate::sim::bodies::Pendulum;

impl Drawn for Pendulum {
    fn draw(&self, _theta: &f64, outline: &mut Outline) {
        let (pivot, bob, unit) = (DVec2::ZERO, outline.at, self.length);
        outline.line(pivot, bob, 1.4);
        outline.taper(pivot, 0.035 * unit, pivot, 0.035 * unit);
        outline.taper(bob, 0.12 * unit, bob, 0.12 * unit);
    }

    fn framing(&self) -> Framing {
        let half_m = DVec2::splat(1.2 * self.length);
        Framing::Fixed { centre_m: DVec2::ZERO, half_m, trail_s: 1.0 }
    }
}
