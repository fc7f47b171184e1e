//! A satellite and the centre that it goes round, framed by the whole path.

use glam::DVec2;

use super::{Drawn, Framing, Outline};
use crate::sim::bodies::{Ellipse, Orbit};

impl Drawn for Orbit {
    fn draw(&self, _q: &DVec2, outline: &mut Outline) {
        let unit = self.ellipse().map_or(self.q0.length(), |ellipse| ellipse.half.max_element());
        let (centre, at) = (DVec2::ZERO, outline.at);
        outline.taper(centre, 0.075 * unit, centre, 0.075 * unit);
        outline.taper(at, 0.045 * unit, at, 0.045 * unit);
    }

    fn framing(&self) -> Framing {
        match self.ellipse() {
            Some(Ellipse { middle, half, period_s }) => {
                Framing::Fixed { centre_m: middle, half_m: 1.12 * half, trail_s: period_s }
            }
            None => {
                let half_m = DVec2::splat(3.0 * self.q0.length());
                let trail_s = 10.0 * self.q0.length() / self.v0.length();
                Framing::Fixed { centre_m: DVec2::ZERO, half_m, trail_s }
            }
        }
    }
}
