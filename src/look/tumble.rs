//! Draws a body that turns in space, as a box of the same moments, from a fixed direction and without perspective.

use glam::{DQuat, DVec2, DVec3};

use super::{BodyPicture, Framing, Handle, Mark, Outline, Pull};
use crate::run::race::LaneBody;
use crate::sim::bodies::Tumble;

/// Sine and cosine of the camera's azimuth, 30°, and of its elevation, 20°.
const AZIMUTH: [f64; 2] = [0.5, 0.866_025_403_784_438_6];
const ELEVATION: [f64; 2] = [0.342_020_143_325_668_7, 0.939_692_620_785_908_4];

/// Right, up and towards the viewer.
const VIEW: [DVec3; 3] = [
    DVec3::new(-AZIMUTH[0], AZIMUTH[1], 0.0),
    DVec3::new(-ELEVATION[0] * AZIMUTH[1], -ELEVATION[0] * AZIMUTH[0], ELEVATION[1]),
    DVec3::new(ELEVATION[1] * AZIMUTH[1], ELEVATION[1] * AZIMUTH[0], ELEVATION[0]),
];

/// Direction of the light.
const LIGHT: DVec3 = DVec3::new(0.48, -0.36, 0.8);

/// Half the thickness of a flat plate, in parts of its longest half side.
const PLATE: f64 = 0.04;

/// Lengths of the arrows of L and ω at the start, and half the width of the picture, in halves of the box's diagonal.
const MOMENTUM: f64 = 1.5;
const OMEGA: f64 = 1.15;
const MOST: f64 = 1.7;
const WIDE: f64 = 1.8;

/// The part of a face that its mark covers, along its longer and its shorter side.
const STRIPE: [[f64; 2]; 2] = [[0.35, 0.8], [-0.8, 0.8]];

/// A body with the vectors that a picture shows beside it.
struct Turning {
    body: Tumble,
    /// L and ω in the frame of the world.
    momentum: DVec3,
    omega: DVec3,
}

/// Returns the picture of a body at its present state. Between ticks the box turns, and the arrows are those of the
/// tick.
pub(super) fn picture(body: &LaneBody) -> Box<dyn BodyPicture + '_> {
    let tumble: &Tumble = super::typed(body.stepper.body());
    let (q, v) = (body.stepper.q(), body.stepper.v());
    let omega = Tumble::attitude_of(q) * Tumble::spin_of(v);
    let momentum = tumble.momentum(q, v);
    Box::new(Turning { body: tumble.clone(), momentum, omega })
}

fn seen(place: DVec3) -> DVec2 {
    DVec2::new(VIEW[0].dot(place), VIEW[1].dot(place))
}

impl Turning {
    /// Returns half the sides of the box with these moments and this mass.
    fn half_sides(&self) -> DVec3 {
        let moments = self.body.moments;
        let square = DVec3::splat(moments.element_sum()) - 2.0 * moments;
        let sides = (1.5 / self.body.mass * square.max(DVec3::ZERO)).map(f64::sqrt);
        sides.max(DVec3::splat(PLATE * sides.max_element()))
    }

    /// Returns the axis of the longest side, in the frame of the world and up to the end of the box.
    fn tip(&self, attitude: DQuat) -> DVec3 {
        let sides = self.half_sides();
        let longest = sides.max_position();
        attitude * (DVec3::AXES[longest] * sides[longest])
    }

    fn radius(&self) -> f64 {
        self.half_sides().length()
    }
}

impl BodyPicture for Turning {
    fn draw(&self, q: &[f64], outline: &mut Outline) {
        let (attitude, sides) = (Tumble::attitude_of(q), self.half_sides());
        let place = |at: DVec3| seen(attitude * at);
        let is_seen =
            |axis: usize, side: f64| (attitude * (DVec3::AXES[axis] * side)).dot(VIEW[2]) > 0.0;
        let thinnest = sides.min_position();
        for axis in 0..3 {
            let [mut along, mut across] = [(axis + 1) % 3, (axis + 2) % 3];
            if sides[across] > sides[along] {
                (along, across) = (across, along);
            }
            for side in [-1.0, 1.0] {
                if !is_seen(axis, side) {
                    continue;
                }
                let normal = DVec3::AXES[axis] * side;
                let face = |[u, v]: [[f64; 2]; 2]| {
                    [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[i, j]| {
                        place(
                            sides
                                * (normal + u[i] * DVec3::AXES[along] + v[j] * DVec3::AXES[across]),
                        )
                    })
                };
                let light = (attitude * normal).dot(LIGHT);
                let corners = face([[-1.0, 1.0]; 2]);
                outline.marks.push(Mark::Face { corners, light, is_mark: false });
                if axis == thinnest && side > 0.0 {
                    outline.marks.push(Mark::Face { corners: face(STRIPE), light, is_mark: true });
                }
            }
        }
        for axis in 0..3 {
            let [first, second] = [(axis + 1) % 3, (axis + 2) % 3];
            for (a, b) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)] {
                let middle = a * DVec3::AXES[first] + b * DVec3::AXES[second];
                let [from, to] =
                    [-1.0, 1.0].map(|end| place(sides * (middle + end * DVec3::AXES[axis])));
                let is_hidden = !is_seen(first, a) && !is_seen(second, b);
                outline.marks.push(Mark::Edge { from, to, is_hidden });
            }
        }
        let radius = self.radius();
        let start = self.body.spin;
        let arrows = [
            (self.momentum, (self.body.moments * start).length(), MOMENTUM, true),
            (self.omega, start.length(), OMEGA, false),
        ];
        for (vector, whole, length, is_still) in arrows {
            let whole = if whole > 0.0 { whole } else { vector.length() };
            let size = length * vector.length() / whole;
            if size > 0.0 && size.is_finite() {
                let to = seen(vector / vector.length() * (size.min(MOST) * radius));
                outline.marks.push(Mark::Arrow { from: DVec2::ZERO, to, is_still });
            }
        }
    }

    fn framing(&self) -> Framing {
        let half_m = DVec2::splat(WIDE * self.radius());
        Framing::Fixed { centre_m: DVec2::ZERO, half_m, trail_s: 0.0 }
    }

    fn handles(&self, q: &[f64]) -> Vec<Handle> {
        let tip = self.tip(Tumble::attitude_of(q));
        vec![Handle { at: seen(tip), radius: 0.3 * self.radius() }]
    }

    /// Turns the end of the longest side towards the target, the shorter way, and lets the body spin as it was moved.
    fn pull(&self, q: &mut [f64], v: &mut [f64], pull: Pull) {
        let before = Tumble::attitude_of(q);
        let from = self.tip(before);
        let reach = from.length();
        let flat = pull.to.clamp_length_max(reach);
        let deep = (reach * reach - flat.length_squared()).max(0.0).sqrt();
        let deep = deep.copysign(from.dot(VIEW[2]));
        let to = flat.x * VIEW[0] + flat.y * VIEW[1] + deep * VIEW[2];
        let (sum, turn) = (from + to, from.cross(from + to));
        if sum.length() > 1e-9 * reach {
            let turn = DQuat::from_xyzw(turn.x, turn.y, turn.z, from.dot(sum));
            let after = turn * (1.0 / turn.length()) * before;
            let after = after * (1.0 / after.length());
            q[3..].copy_from_slice(&[after.w, after.x, after.y, after.z]);
        }
        let velocity = pull.velocity.x * VIEW[0] + pull.velocity.y * VIEW[1];
        let omega = Tumble::attitude_of(q).conjugate() * (to.cross(velocity) / (reach * reach));
        v[..3].copy_from_slice(&omega.to_array());
        v[3..].fill(0.0);
    }
}
