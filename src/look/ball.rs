//! Draws a ball above a floor, or between two walls. The part of it that is beyond a wall is hatched.

use glam::DVec2;

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::sim::Wall;
use crate::sim::bodies::{Ball, Body};
use crate::sim::number::round;

/// Radius of the ball, half the length of the floor, and the margin, relative to the range of the motion.
const BALL: f64 = 0.06;
const HALF_FLOOR: f64 = 0.45;
const MARGIN: f64 = 0.1;

/// Lines of the hatching per radius.
const HATCHES: f64 = 4.0;

/// Returns the height of the first flight, or the distance of the walls.
fn range(ball: &Ball) -> f64 {
    let highest = ball.height + ball.speed * ball.speed / (2.0 * ball.gravity.max(1.0));
    let range = if ball.ceiling > 0.0 { ball.ceiling } else { highest };
    if range > 0.0 { range } else { 1.0 }
}

fn radius(ball: &Ball) -> f64 {
    BALL * range(ball)
}

/// Returns the point at this height and this distance aside; between two walls the motion is to the right.
fn at(ball: &Ball, height: f64, aside: f64) -> DVec2 {
    if ball.ceiling > 0.0 { DVec2::new(height, aside) } else { DVec2::new(aside, height) }
}

/// Hatches the part of a disc around `centre` that is beyond a wall at `wall`, on its lower (1) or upper (-1) side.
fn hatch(ball: &Ball, centre: f64, wall: f64, side: f64, outline: &mut Outline) {
    let (radius, step) = (radius(ball), radius(ball) / HATCHES);
    let mut depth = step / 2.0;
    while depth < 2.0 * radius {
        let off = (wall - side * depth - centre).abs();
        let half = (radius * radius - off * off).max(0.0).sqrt();
        if half > 0.0 {
            let height = wall - side * depth;
            let [from, to] = [-half, half].map(|aside| at(ball, height, aside));
            outline.marks.push(Mark::Hatch { from, to });
        }
        depth += step;
    }
}

impl BodyPicture for Ball {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let half = HALF_FLOOR * range(self);
        // The coordinate is drawn at the centre, so that the walls are a radius beyond it.
        let radius = radius(self);
        let (centre, t) = (q[0], outline.t);
        outline.marks.push(Mark::Disc { centre: at(self, centre, 0.0), radius });
        for Wall { at: place, side, .. } in (0..).map_while(|index| self.wall(index, t)) {
            let wall = place - side * radius;
            let [from, to] = [-half, half].map(|aside| at(self, wall, aside));
            outline.marks.push(Mark::Wall { from, to });
            hatch(self, centre, wall, side, outline);
        }
    }

    fn framing(&self) -> Framing {
        let (range, margin) = (range(self), 1.0 + 2.0 * MARGIN);
        let half = at(self, range / 2.0 * margin + radius(self), HALF_FLOOR * range);
        Framing::Fixed { centre_m: at(self, range / 2.0, 0.0), half_m: half, trail_s: 0.0 }
    }

    fn describe_motion(&self, q: &[f64], v: &[f64]) -> Option<String> {
        let falls = self.gravity > 0.0 && self.drag == 0.0 && self.floor_amplitude == 0.0;
        let apex = q[0].max(0.0) + v[0] * v[0] / (2.0 * self.gravity);
        let part = 100.0 * self.restitution * self.restitution;
        falls.then(|| format!("bounces from {} m to {} %", round(apex, 3), round(part, 3)))
    }

    fn has_ground(&self) -> bool {
        self.ceiling == 0.0
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        vec![Handle { at: at(self, q[0], 0.0), radius: radius(self) }]
    }

    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        let along = |to: DVec2| if self.ceiling > 0.0 { to.x } else { to.y };
        (q[0], v[0]) = (along(pull.to), along(pull.velocity));
    }
}
