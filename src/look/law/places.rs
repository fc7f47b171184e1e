//! Draws a disc at each place that the scene's equations define.

use glam::{DMat2, DVec2};

use super::super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::sim::bodies::Law;

/// Radius of a disc, relative to half the picture's size.
const DISC: f64 = 0.045;

/// Half the size of the picture, relative to half the size of the motion, and the minimum half-size in either
/// direction, relative to the other.
const BEYOND: f64 = 1.25;
const MIN_PART: f64 = 0.4;

/// Length of the trail, in seconds.
const TRAIL_S: f64 = 4.0;

/// Displacement of a coordinate to measure slopes, relative to the coordinate, or in its unit near 0.
const DISPLACEMENT: f64 = 1e-6;

/// Number of Newton iterations that bring a disc to the hand.
const ITERATIONS: usize = 12;

/// Largest change of a coordinate in one iteration, relative to the coordinate, or in its unit near 0.
const MAX_CHANGE: f64 = 1.0;

/// Share of the trace that is added to the diagonal of a matrix, because the matrix may be singular.
const DAMPING: f64 = 1e-9;

pub(super) struct Places<'a> {
    pub(super) law: &'a Law,
    /// Corners of the rectangle that contains the places in the first seconds.
    pub(super) corners: [DVec2; 2],
}

impl Places<'_> {
    /// Returns the centre of the picture, and half its size.
    fn room(&self) -> [DVec2; 2] {
        let [low, high] = self.corners;
        let (middle, half) = ((low + high) / 2.0, (high - low) / 2.0);
        if !(middle.is_finite() && half.is_finite()) {
            return [DVec2::ZERO, DVec2::ONE];
        }
        let most = half.max_element();
        let size = if most > 0.0 { most } else { 1.0 };
        [middle, BEYOND * half.max(DVec2::splat(MIN_PART * size))]
    }

    fn radius(&self) -> f64 {
        let [_, half] = self.room();
        DISC * half.max_element()
    }

    /// Returns the derivative of a place with respect to each coordinate.
    fn slopes(&self, place: usize, q: &[f64]) -> Vec<DVec2> {
        let mut moved = q.to_vec();
        let slope = |(i, &q): (usize, &f64)| {
            let d = DISPLACEMENT * q.abs().max(1.0);
            let ends = [q + d, q - d].map(|end| {
                moved[i] = end;
                self.law.places(&moved)[place]
            });
            moved[i] = q;
            (ends[0] - ends[1]) / (2.0 * d)
        };
        q.iter().enumerate().map(slope).collect()
    }
}

/// Returns the smallest change of the coordinates that moves a place with these slopes by `by`, or as close to `by` as
/// possible.
fn smallest_change(slopes: &[DVec2], by: DVec2) -> Vec<f64> {
    let outer = |slope: &DVec2| DMat2::from_cols(slope.x * *slope, slope.y * *slope);
    let square = slopes.iter().fold(DMat2::ZERO, |sum, slope| sum + outer(slope));
    let trace = square.x_axis.x + square.y_axis.y;
    if !(trace > 0.0 && trace.is_finite()) {
        return vec![0.0; slopes.len()];
    }
    let weights = (square + DMat2::from_diagonal(DVec2::splat(DAMPING * trace))).inverse() * by;
    slopes.iter().map(|slope| slope.dot(weights)).collect()
}

impl BodyPicture for Places<'_> {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let radius = self.radius();
        let discs = self.law.places(q).into_iter().map(|centre| Mark::Disc { centre, radius });
        outline.marks.extend(discs);
    }

    fn framing(&self) -> Framing {
        let [centre_m, half_m] = self.room();
        Framing::Fixed { centre_m, half_m, trail_s: TRAIL_S }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        let radius = self.radius();
        self.law.places(q).into_iter().map(|at| Handle { at, radius }).collect()
    }

    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        for _ in 0..ITERATIONS {
            let off = pull.to - self.law.places(q)[pull.handle];
            if !off.is_finite() {
                return;
            }
            let changes = smallest_change(&self.slopes(pull.handle, q), off);
            for (q, change) in q.iter_mut().zip(changes) {
                let most = MAX_CHANGE * q.abs().max(1.0);
                *q += change.clamp(-most, most);
            }
        }
        let slopes = self.slopes(pull.handle, q);
        let velocities = smallest_change(&slopes, pull.velocity);
        for ((v, velocity), slope) in v.iter_mut().zip(velocities).zip(&slopes) {
            if *slope != DVec2::ZERO {
                *v = velocity;
            }
        }
    }
}
