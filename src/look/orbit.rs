//! Draws a satellite and the planet that it orbits, framed by the whole path.

use std::f64::consts::TAU;

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::sim::bodies::{Ellipse, Orbit};

/// Radius of the satellite and of the planet, relative to the `unit`.
const SATELLITE: f64 = 0.035;
const PLANET: f64 = 0.12;

/// Number of segments of a drawn course.
const CORNERS: u16 = 180;

/// Returns half the longer side of the rectangle around the orbit, in metres; for an open orbit, the initial distance.
fn unit(orbit: &Orbit) -> f64 {
    orbit.ellipse().map_or(orbit.q0.length(), |ellipse| ellipse.half.max_element())
}

impl BodyPicture for Orbit {
    fn draw(&self, _q: &[f64], outline: &mut Outline) {
        let unit = unit(self);
        let (centre, at) = (DVec2::ZERO, outline.at);
        outline.marks.push(Mark::Planet { centre, radius: PLANET * unit });
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

    /// Returns the ellipse on which the satellite moves from this state, by its polar equation about the focus.
    fn course(&self, q: &[f64], v: &[f64]) -> Vec<DVec2> {
        let [q, v] = [q, v].map(DVec2::from_slice);
        let now = Orbit { q0: q, v0: v, ..self.clone() };
        if now.ellipse().is_none() {
            return Vec::new();
        }
        let momentum = q.perp_dot(v);
        let eccentricity = -v.perp() * momentum / self.mu - q.normalize_or_zero();
        let parameter = momentum * momentum / self.mu;
        let corner = |i| {
            let angle = TAU * f64::from(i) / f64::from(CORNERS);
            let to = DVec2::new(libm::cos(angle), libm::sin(angle));
            to * (parameter / (1.0 + eccentricity.dot(to)))
        };
        (0..=CORNERS).map(corner).collect()
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        vec![Handle { at: DVec2::from_slice(q), radius: SATELLITE * unit(self) }]
    }

    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        pull.to.write_to_slice(q);
        pull.velocity.write_to_slice(v);
    }
}
