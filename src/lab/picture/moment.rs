//! The moment that is drawn: where every body is between two ticks.

use super::Rgba;
use crate::lab::palette::Palette;
use crate::lab::race::Entrant;
use crate::lab::{History, Interpolation, Lab, LaneBody};

/// The part of a scene's duration that a chart recorder's paper holds: three swings of the harbour's
/// 1 Hz spring, and no more of a faster one than can be told apart.
const PAPER: f64 = 0.15;
/// The most that the paper holds, in seconds.
const LONGEST_PAPER_S: f64 = 3.0;

/// The moment that is drawn.
pub(super) struct Moment<'a> {
    pub(super) lab: &'a Lab,
    pub(super) palette: &'static Palette,
    /// How far the moment is from the previous tick to the present one.
    pub(super) alpha: f64,
    /// The last tick's length in seconds.
    h: f64,
    /// The moment in seconds.
    pub(super) t: f64,
    /// The moment at which lanes are drawn, in seconds: without interpolation the present tick.
    pub(super) lanes_t: f64,
    /// How far a chart recorder's trail reaches back, in seconds.
    pub(super) paper_s: f64,
}

impl<'a> Moment<'a> {
    pub(super) fn of(lab: &'a Lab) -> Self {
        let race = lab.race();
        let (alpha, h) = (lab.clock().alpha(), race.last_step_s());
        let t = race.t() - (1.0 - alpha) * h;
        Self {
            lab,
            palette: lab.display().theme.palette(),
            alpha,
            h,
            t,
            lanes_t: match lab.display().interpolation {
                Interpolation::Raw => race.t(),
                Interpolation::Linear | Interpolation::Hermite => t,
            },
            paper_s: (PAPER * lab.scene().seconds).min(LONGEST_PAPER_S),
        }
    }

    /// The colour and the dash pattern of the method on this place of the list.
    pub(super) fn style(&self, entry: usize) -> (Rgba, [f32; 2]) {
        self.lab.display().theme.style(self.lab.entries()[entry].method)
    }

    /// A body's coordinates at the moment drawn.
    pub(super) fn coordinates(&self, body: &LaneBody) -> Vec<f64> {
        let (q0, v0) = (&body.previous_q, &body.previous_v);
        let (q1, v1) = (body.stepper.q(), body.stepper.v());
        let each = |f: &dyn Fn(usize) -> f64| (0..q1.len()).map(f).collect();
        match self.lab.display().interpolation {
            Interpolation::Raw => q1.to_vec(),
            Interpolation::Linear => each(&|i| q0[i] + (q1[i] - q0[i]) * self.alpha),
            Interpolation::Hermite => {
                each(&|i| hermite(self.alpha, self.h, [q0[i], q1[i]], [v0[i], v1[i]]))
            }
        }
    }

    /// What is remembered of a body in a lane.
    pub(super) fn history(&self, entrant: &Entrant, body: usize) -> &'a History {
        let entrants = self.lab.race().entrants();
        let place = entrants.iter().position(|other| other.lane_number == entrant.lane_number);
        &self.lab.past().histories(place.expect("it is in the race"))[body]
    }
}

/// Whether a body leaves the line that it starts on: the one coordinate of the others is along it.
pub(super) fn turns(body: &LaneBody) -> bool {
    body.coordinates.len() > 1
}

/// The cubic through `q` at both ends of a tick of `h` seconds with the velocities `v` there, at the
/// part `alpha` of it.
fn hermite(alpha: f64, h: f64, q: [f64; 2], v: [f64; 2]) -> f64 {
    let (a, b) = (alpha, 1.0 - alpha);
    let ends = b * b * (1.0 + 2.0 * a) * q[0] + a * a * (1.0 + 2.0 * b) * q[1];
    ends + h * a * b * (b * v[0] - a * v[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hermite_cubic_passes_its_ends_with_their_slopes_and_keeps_a_parabola() {
        let (q, v) = (|t: f64| 3.0 + 2.0 * t - t * t, |t: f64| 2.0 - 2.0 * t);
        for alpha in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let h = 0.5;
            let shown = hermite(alpha, h, [q(1.0), q(1.5)], [v(1.0), v(1.5)]);
            assert!((shown - q(1.0 + alpha * h)).abs() < 1e-15, "at {alpha}: {shown}");
        }
    }
}
