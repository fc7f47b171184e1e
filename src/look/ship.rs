//! A ship on a straight course, from above.

use glam::DVec2;

use super::{Drawn, Framing, Handle, Mark, Outline, Pull};
use crate::sim::State;
use crate::sim::bodies::Ship;
use crate::sim::number::round;

/// The length of the hull, in metres.
const LENGTH_M: f64 = 9.0;

impl Drawn for Ship {
    fn draw(&self, _s: &f64, outline: &mut Outline) {
        outline.marks.push(Mark::Hull { bow: DVec2::X, length: LENGTH_M });
    }

    fn framing(&self) -> Framing {
        Framing::Follow { width_m: 38.0, height_m: 9.0, wake_s: 3.0 }
    }

    fn promise(&self, state: &State<f64>) -> Option<String> {
        let last = self.throttle * self.thrust / self.drag;
        let way = if state.v.abs() < last.abs() { "speeds up" } else { "slows down" };
        last.is_finite().then(|| format!("{way} to {} m/s", round(last, 3)))
    }

    fn handles(&self, s: &f64) -> Vec<Handle> {
        vec![Handle { at: DVec2::new(*s, 0.0), radius: LENGTH_M / 2.0 }]
    }

    fn pull(&self, state: &mut State<f64>, pull: Pull) {
        *state = State { q: pull.to.x, v: pull.velocity.x };
    }
}
