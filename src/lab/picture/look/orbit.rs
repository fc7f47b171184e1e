//! A satellite and the centre that it goes round, framed by the whole path.

use glam::DVec2;

use super::{Drawn, Framing, Handle, Mark, Outline, Pull};
use crate::sim::State;
use crate::sim::bodies::{Ellipse, Orbit};

/// The radius of the satellite, in units.
const SATELLITE: f64 = 0.045;

/// Half the longer side of the rectangle round the orbit, in metres; of one that is not closed, its first distance.
fn unit(orbit: &Orbit) -> f64 {
    orbit.ellipse().map_or(orbit.q0.length(), |ellipse| ellipse.half.max_element())
}

impl Drawn for Orbit {
    fn draw(&self, _q: &DVec2, outline: &mut Outline) {
        let unit = unit(self);
        let (centre, at) = (DVec2::ZERO, outline.at);
        outline.marks.push(Mark::Anchor { centre, radius: 0.075 * unit });
        outline.marks.push(Mark::Disc { centre: at, radius: SATELLITE * unit });
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

    fn handles(&self, q: &DVec2) -> Vec<Handle> {
        vec![Handle { at: *q, radius: SATELLITE * unit(self) }]
    }

    fn pull(&self, state: &mut State<DVec2>, pull: Pull) {
        *state = State { q: pull.to, v: pull.velocity };
    }
}
