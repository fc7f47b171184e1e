//! A body that turns in space: its state as seven coordinates, and rotations.
//!
//! The coordinates are three turns γ with γ′ = ω, the angular velocity in the frame of the principal axes. The attitude
//! follows as a quaternion w, x, y, z from that frame to the world. A method that does not know a rotation steps
//! all seven by their accelerations, so that its ω is that of `ω′ = -I⁻¹(ω × Iω)` alone.

use glam::{DQuat, DVec3};

/// The state of a body that turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spin {
    /// γ, the turns about the principal axes since the start, in radians.
    pub(super) turns: DVec3,
    /// ω, the angular velocity in the frame of the principal axes, in rad/s.
    pub(super) omega: DVec3,
    /// The rotation from that frame to the world, a quaternion of length 1.
    pub(super) attitude: DQuat,
}

/// A squared length as near to 1 as this is that of a quaternion of length 1.
const ROUNDING: f64 = 1e-14;

impl Spin {
    /// Reads a state of seven coordinates, with its attitude [scaled](unit_attitude).
    pub(super) fn of(q: &[f64], v: &[f64]) -> Self {
        let [turns, omega] = [q, v].map(|x| DVec3::new(x[0], x[1], x[2]));
        Self { turns, omega, attitude: unit_attitude(q) }
    }

    /// Writes the coordinates and the velocities, in which q′ = ½ q ⊗ ω agrees with ω.
    pub(super) fn write(&self, q: &mut [f64], v: &mut [f64]) {
        let Self { turns, omega, attitude } = *self;
        let rate = attitude * pure(omega) * 0.5;
        let numbers = |turns: DVec3, x: DQuat| [turns.x, turns.y, turns.z, x.w, x.x, x.y, x.z];
        q.copy_from_slice(&numbers(turns, attitude));
        v.copy_from_slice(&numbers(omega, rate));
    }
}

/// Returns the quaternion of seven coordinates, which may have another length than 1.
pub(super) fn quaternion_at(q: &[f64]) -> DQuat {
    DQuat::from_xyzw(q[4], q[5], q[6], q[3])
}

/// Returns the attitude of seven coordinates, scaled to length 1 if it has another, or no turn if it has no direction.
pub(super) fn unit_attitude(q: &[f64]) -> DQuat {
    let attitude = quaternion_at(q);
    let square = attitude.length_squared();
    match square {
        _ if (square - 1.0).abs() <= ROUNDING => attitude,
        _ if square > 0.0 && square.is_finite() => attitude * (1.0 / square.sqrt()),
        _ => DQuat::IDENTITY,
    }
}

/// Returns the indices of the principal axes, from the least moment to the greatest.
pub(super) fn axes_by_moment(moments: DVec3) -> [usize; 3] {
    let mut axes = [0, 1, 2];
    axes.sort_by(|a, b| moments[*a].total_cmp(&moments[*b]));
    axes
}

/// Returns the quaternion 0, v.
pub(super) fn pure(v: DVec3) -> DQuat {
    DQuat::from_xyzw(v.x, v.y, v.z, 0.0)
}

/// Returns the turn by the vector `v` (rad).
pub(super) fn turn_by(v: DVec3) -> DQuat {
    let angle = v.length();
    if angle == 0.0 {
        return DQuat::IDENTITY;
    }
    let (sin, cos) = libm::sincos(angle / 2.0);
    let axis = v * (sin / angle);
    DQuat::from_xyzw(axis.x, axis.y, axis.z, cos)
}

/// Returns the vector (rad) of a turn, from 0 to a whole turn.
pub(super) fn vector_of(turn: DQuat) -> DVec3 {
    let v = turn.xyz();
    let sin = v.length();
    if sin == 0.0 { 2.0 * v } else { v * (2.0 * libm::atan2(sin, turn.w) / sin) }
}

/// Returns a vector in the frame that has turned by `turn`.
pub(super) fn seen_from(turn: DQuat, v: DVec3) -> DVec3 {
    turn.conjugate() * v
}

/// Returns `-I⁻¹(ω × Iω)`, the angular acceleration without torque.
pub(super) fn free_acceleration(moments: DVec3, omega: DVec3) -> DVec3 {
    -omega.cross(moments * omega) / moments
}

/// Returns the change of the [free acceleration](free_acceleration) with a small change of `omega`.
pub(super) fn free_jerk(moments: DVec3, omega: DVec3, change: DVec3) -> DVec3 {
    -(change.cross(moments * omega) + omega.cross(moments * change)) / moments
}
