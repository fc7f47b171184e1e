//! A carriage on its spring and damper, on a wheel, on a road.

use glam::DVec2;

use super::super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use super::{lift, reach};
use crate::sim::State;

/// The sizes of the parts, in units of the farthest that the carriage or the wheel goes from its rest: half the body,
/// its height above the hub at rest, the radius of the wheel, and half the length of the road.
const HALF_BODY: DVec2 = DVec2::new(2.6, 0.75);
const ABOVE_HUB: f64 = 3.2;
const WHEEL: f64 = 1.2;
const HALF_ROAD: f64 = 5.0;
/// From the middle to the spring on one side and the damper on the other, and the radius of the spring's turns.
const ASIDE: f64 = 0.75;
const TURNS: f64 = 0.35;

pub(super) struct Carriage {
    /// The farthest from rest.
    unit: f64,
}

impl Carriage {
    pub(super) fn new(ranges: &[(f64, f64)]) -> Self {
        let [low, high] = reach(ranges);
        Self { unit: high.max(-low) }
    }

    /// The hub of the wheel, which is this high above its rest.
    fn hub(&self, height: f64) -> DVec2 {
        DVec2::new(0.0, height - ABOVE_HUB * self.unit)
    }
}

impl BodyPicture for Carriage {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let unit = self.unit;
        let (body, hub) = (DVec2::new(0.0, q[0]), self.hub(q[1]));
        let road = self.hub(0.0) - DVec2::Y * WHEEL * unit;
        let along = DVec2::X * HALF_ROAD * unit;
        let aside = DVec2::X * ASIDE * unit;
        let floor = body - DVec2::Y * HALF_BODY.y * unit;
        outline.marks.extend([
            Mark::Wall { from: road - along, to: road + along },
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

    fn pull(&self, state: &mut State<Vec<f64>>, pull: Pull) {
        let rest = if pull.handle == 0 { 0.0 } else { self.hub(0.0).y };
        lift(state, pull.handle, pull.to.y - rest, pull.velocity.y);
    }
}
