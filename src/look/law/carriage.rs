//! Draws a carriage on its spring and damper, on a wheel, on a road.

use glam::DVec2;

use super::super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use super::reach;
use crate::sim::System;
use crate::sim::bodies::Law;

/// Half the size of the body, its height above the hub at rest, the radius of the wheel, and half the length of the
/// road. The unit is the largest displacement of carriage or wheel from rest.
const HALF_BODY: DVec2 = DVec2::new(2.6, 0.75);
const ABOVE_HUB: f64 = 3.2;
const WHEEL: f64 = 1.2;
const HALF_ROAD: f64 = 5.0;
/// Distance that the carriage covers in a second, in the same unit, and the number of road segments in view.
const SPEED: f64 = HALF_ROAD;
const PIECES: u32 = 80;
/// Distance of the spring on one side and of the damper on the other side from the middle, and the radius of the coil.
const ASIDE: f64 = 0.75;
const TURNS: f64 = 0.35;

pub(super) struct Carriage<'a> {
    law: &'a Law,
    /// Largest displacement of carriage or wheel from rest.
    unit: f64,
}

impl<'a> Carriage<'a> {
    pub(super) fn new(law: &'a Law, ranges: &[(f64, f64)]) -> Self {
        let [low, high] = reach(ranges);
        Self { law, unit: high.max(-low) }
    }

    /// Returns the height of the road under the wheel at time `t` (s). At this height, wheel and carriage would rest
    /// together.
    fn road(&self, t: f64) -> f64 {
        let n = self.law.equations().text().coordinates.len();
        let push = |height: f64| {
            let mut a = vec![0.0; n];
            self.law.acceleration(t, &vec![height; n], &vec![0.0; n], &mut a);
            a.get(1).copied().unwrap_or_default()
        };
        let (low, high) = (push(0.0), push(self.unit));
        let height = self.unit * low / (low - high);
        if height.is_finite() { height.clamp(-self.unit, self.unit) } else { 0.0 }
    }

    /// Returns the visible road at time `t`, as the road passes under the wheel. Corners are kept only where the slope
    /// changes.
    fn roadway(&self, t: f64) -> Vec<DVec2> {
        let step = 2.0 * HALF_ROAD / f64::from(PIECES);
        let places = (0..=PIECES).map(|i| {
            let x = f64::from(i) * step - HALF_ROAD;
            let height = self.road(t + x / SPEED);
            self.hub(height) + DVec2::new(x, -WHEEL) * self.unit
        });
        let mut corners: Vec<DVec2> = Vec::new();
        for place in places {
            if let [.., before, last] = corners[..]
                && (last - before).perp_dot(place - last).abs() < 1e-9 * self.unit * self.unit
            {
                corners.pop();
            }
            corners.push(place);
        }
        corners
    }

    /// Returns the position of the wheel's hub when the wheel is at this height above its rest.
    fn hub(&self, height: f64) -> DVec2 {
        DVec2::new(0.0, height - ABOVE_HUB * self.unit)
    }
}

impl BodyPicture for Carriage<'_> {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let unit = self.unit;
        let (body, hub) = (DVec2::new(0.0, q[0]), self.hub(q[1]));
        let aside = DVec2::X * ASIDE * unit;
        let floor = body - DVec2::Y * HALF_BODY.y * unit;
        let road = self.roadway(outline.t);
        let pieces = road.windows(2).map(|ends| Mark::Wall { from: ends[0], to: ends[1] });
        outline.marks.extend(pieces);
        outline.marks.extend([
            Mark::Rod { from: hub - aside, to: hub + aside },
            Mark::Coil { from: hub - aside, to: floor - aside, radius: TURNS * unit },
            Mark::Rod { from: hub + aside, to: floor + aside },
            Mark::Disc { centre: hub, radius: WHEEL * unit },
            Mark::Block { centre: body, half: HALF_BODY * unit },
        ]);
    }

    fn framing(&self) -> Framing {
        let unit = self.unit;
        let (top, bottom) = (1.2 + HALF_BODY.y, -ABOVE_HUB - WHEEL - 0.4);
        let centre_m = DVec2::new(0.0, (top + bottom) / 2.0) * unit;
        let half_m = DVec2::new(HALF_ROAD, (top - bottom) / 2.0) * unit;
        Framing::Fixed { centre_m, half_m, trail_s: 0.0 }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        let body = Handle { at: DVec2::new(0.0, q[0]), radius: HALF_BODY.y * self.unit };
        vec![body, Handle { at: self.hub(q[1]), radius: WHEEL * self.unit }]
    }

    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        let rest = if pull.handle == 0 { 0.0 } else { self.hub(0.0).y };
        (q[pull.handle], v[pull.handle]) = (pull.to.y - rest, pull.velocity.y);
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::Look;
    use super::*;
    use crate::run::Race;
    use crate::scene::Scene;

    #[test]
    fn the_wheel_ends_up_on_the_approaching_kerb() {
        let mut race = Race::of_scene(&Scene::built_in("quarter-car").unwrap());
        let road = |race: &Race, t: f64| -> Vec<[DVec2; 2]> {
            let body = &race.truth().bodies()[0];
            let outline = Look::of(body).outline(t, body.stepper.q());
            let walls = outline.marks.iter().filter_map(|mark| match mark {
                Mark::Wall { from, to } => Some([*from, *to]),
                _ => None,
            });
            walls.collect()
        };
        let height = |road: &[[DVec2; 2]], x: f64| {
            let piece = road.iter().find(|ends| (ends[0].x..=ends[1].x).contains(&x)).unwrap();
            piece[0].lerp(piece[1], (x - piece[0].x) / (piece[1].x - piece[0].x)).y
        };
        let flat = road(&race, -5.0);
        assert_eq!(flat.len(), 1, "{flat:?}");
        let before = road(&race, 0.6);
        let ahead = before.last().unwrap()[1].x;
        let rise = height(&before, ahead) - height(&before, 0.0);
        assert!((rise - 0.1).abs() < 1e-9 && before.len() <= 6, "{before:?}");
        race.run(400);
        let after = road(&race, 4.0);
        let body = &race.truth().bodies()[0];
        let discs = Look::of(body).outline(4.0, body.stepper.q()).marks;
        let bottom = discs.iter().find_map(|mark| match mark {
            Mark::Disc { centre, radius } => Some(centre.y - radius),
            _ => None,
        });
        let gap = bottom.unwrap() - height(&after, 0.0);
        assert!(gap.abs() < 0.01, "the wheel is {gap} m above the road");
    }
}
