//! Draws heights above 0. Bodies that are mostly below 0 hang there on cords; otherwise 0 is the ground.

use glam::DVec2;

use super::super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use super::reach;

/// Radius of a body, distance of two bodies, and half the length of the line at 0, relative to the range of heights.
const BODY: f64 = 0.05;
const APART: f64 = 0.3;
const HALF_GROUND: f64 = 0.4;
/// Margin above and below the motion, relative to the range of heights.
const MARGIN: f64 = 0.12;

pub(super) struct Vertical {
    pub(super) ranges: Vec<(f64, f64)>,
}

impl Vertical {
    fn range(&self) -> f64 {
        let [low, high] = reach(&self.ranges);
        high - low
    }

    /// Returns the position of a coordinate in the picture if the coordinate has this height.
    fn at(&self, coordinate: usize, height: f64) -> DVec2 {
        DVec2::new(APART * self.range() * coordinate as f64, height)
    }
}

impl BodyPicture for Vertical {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let ([low, high], range) = (reach(&self.ranges), self.range());
        let last = self.at(self.ranges.len() - 1, 0.0);
        let aside = DVec2::X * HALF_GROUND * range;
        outline.marks.push(Mark::Wall { from: -aside, to: last + aside });
        let hangs = low + high < 0.0;
        for (coordinate, &height) in q.iter().enumerate().take(self.ranges.len()) {
            let (foot, at) = (self.at(coordinate, 0.0), self.at(coordinate, height));
            match hangs {
                true => outline.marks.push(Mark::Rod { from: foot, to: at }),
                false => {
                    let top = self.at(coordinate, high);
                    outline.marks.push(Mark::Rail { from: foot, to: top });
                }
            }
            outline.marks.push(Mark::Disc { centre: at, radius: BODY * range });
        }
    }

    fn framing(&self) -> Framing {
        let ([low, high], range) = (reach(&self.ranges), self.range());
        let last = self.at(self.ranges.len() - 1, 0.0).x;
        let centre_m = DVec2::new(last / 2.0, (low + high) / 2.0);
        let half_m = DVec2::new(last / 2.0 + HALF_GROUND * range, (0.5 + MARGIN) * range);
        Framing::Fixed { centre_m, half_m, trail_s: 0.0 }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        let radius = BODY * self.range();
        let heights = q.iter().enumerate().take(self.ranges.len());
        heights.map(|(n, &height)| Handle { at: self.at(n, height), radius }).collect()
    }

    fn has_ground(&self) -> bool {
        let [low, high] = reach(&self.ranges);
        self.ranges.len() == 1 && low + high >= 0.0
    }

    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        (q[pull.handle], v[pull.handle]) = (pull.to.y, pull.velocity.y);
    }
}
