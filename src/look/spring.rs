//! Draws a block on a coil spring, on a chart recorder's paper.

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::sim::bodies::Spring;
use crate::sim::number::round;

/// Returns the amplitude of the undamped motion from the spring's start, in metres; 1 if the spring starts at rest.
fn amplitude(spring: &Spring) -> f64 {
    let amplitude = libm::hypot(spring.x0, spring.v0 / spring.angular_frequency());
    if amplitude > 0.0 { amplitude } else { 1.0 }
}

/// Half the side of the block, relative to the amplitude.
const HALF_BLOCK: f64 = 0.16;

impl BodyPicture for Spring {
    fn draw(&self, _q: &[f64], outline: &mut Outline) {
        outline.marks.push(Mark::Sprung);
    }

    fn framing(&self) -> Framing {
        Framing::Recorder { half_width_m: 2.0 * amplitude(self) }
    }

    fn describe_motion(&self, q: &[f64], v: &[f64]) -> Option<String> {
        if self.damping > 0.0 {
            return Some("should come to rest".into());
        }
        Some(format!("should keep to ±{} m", round(self.swing_m(q, v)?, 3)))
    }

    fn swing_m(&self, q: &[f64], v: &[f64]) -> Option<f64> {
        Some(libm::hypot(q[0], v[0] / self.angular_frequency()))
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        vec![Handle { at: DVec2::new(q[0], 0.0), radius: HALF_BLOCK * amplitude(self) }]
    }

    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        (q[0], v[0]) = (pull.to.x, pull.velocity.x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frame_of_a_spring_is_twice_its_amplitude_on_each_side() {
        // The spring oscillates at 5 rad/s. At rest, the amplitude counts as 1 m.
        for (x0, v0, amplitude) in [
            (0.5, 0.0, 0.5),
            (0.0, -2.0, 0.4),
            (0.3, 2.0, 0.5),
            (300.0, 2000.0, 500.0),
            (0.0, 0.0, 1.0_f64),
        ] {
            let spring = Spring { mass: 4.0, stiffness: 100.0, damping: 0.5, x0, v0, kick: 1.0 };
            let Framing::Recorder { half_width_m } = spring.framing() else { panic!() };
            assert!((half_width_m / amplitude - 2.0).abs() < 1e-12, "{x0} m, {v0} m/s");
        }
    }
}
