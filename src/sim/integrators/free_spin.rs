//! Maps by which physics engines integrate torque-free rotation in space.
//!
//! Let `I` be the principal moments of inertia, `ω` the angular velocity in the frame of their axes, and `L = I ω` the
//! angular momentum. Then `dL/dt = -ω × L`. Without torque, the axis of rotation changes unless it is a principal axis.
//! None of the maps is exact. All but [`SpinMap::Constant`] are checked against logs of engines
//! (`tests/library/engines/tumble.rs`).

use glam::{DMat3, DQuat, DVec3};

use crate::spin::{free_acceleration, turn_by};

/// One step of the angular velocity of a body without torque. `'` marks values at the end of the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpinMap {
    /// `ω' = ω`, which omits the term `ω × L`. It is used by Godot, and by default by Jolt and PhysX.
    Constant,
    /// `L' = L - h ω × L`, then scaled to the length of `L`. This map keeps the length of `L` and changes the energy.
    /// It is used by Rapier, by Jolt with `mApplyGyroscopicForce`, and by PhysX with `eENABLE_GYROSCOPIC_FORCES`.
    ScaledMomentum,
    /// One Newton step from `ω` towards the root of implicit Euler, `I (ω' - ω) + h ω' × I ω' = 0`: `ω' = ω - J⁻¹ h ω ×
    /// L` with `J = I + h ([ω] I - [L])`, where `[a] b = a × b`. It is not finite if `J` has no inverse. It is used by
    /// Bullet (`computeGyroscopicImpulseImplicit_Body`), by Box3D, and by MuJoCo's integrators `implicit` and
    /// `implicitfast`.
    NewtonStep,
    /// `ω' = ω - h I⁻¹ (ω × L)`, which is explicit Euler. It is used by MuJoCo's integrator `Euler`.
    Explicit,
    /// The classical Runge-Kutta method on `dω/dt = -I⁻¹ (ω × L)`. It is used by MuJoCo's integrator `RK4`.
    RungeKutta,
}

impl SpinMap {
    /// Every map with its name.
    pub const ALL: [(&str, SpinMap); 5] = [
        ("constant", SpinMap::Constant),
        ("scaled-momentum", SpinMap::ScaledMomentum),
        ("newton-step", SpinMap::NewtonStep),
        ("explicit", SpinMap::Explicit),
        ("runge-kutta", SpinMap::RungeKutta),
    ];

    /// Returns the kebab-case name of the map.
    pub fn id(self) -> &'static str {
        super::id_in(&Self::ALL, self)
    }

    /// Returns the angular velocity after a step of `h` (s) from `omega` (rad/s), both in the frame of the principal
    /// axes. The moments about them (kg m²) are greater than 0.
    pub fn step(self, moments: DVec3, omega: DVec3, h: f64) -> DVec3 {
        match self {
            SpinMap::Constant => omega,
            SpinMap::ScaledMomentum => {
                let before = moments * omega;
                let after = before - h * omega.cross(before);
                match after.length() {
                    // A body at rest has no direction to scale.
                    0.0 => omega,
                    length => after * (before.length() / length) / moments,
                }
            }
            SpinMap::NewtonStep => {
                let momentum = moments * omega;
                let of_moments = cross_matrix(omega) * DMat3::from_diagonal(moments);
                let change = of_moments - cross_matrix(momentum);
                let jacobian = DMat3::from_diagonal(moments) + h * change;
                omega - jacobian.inverse() * (h * omega.cross(momentum))
            }
            SpinMap::Explicit => omega + h * free_acceleration(moments, omega),
            SpinMap::RungeKutta => {
                let [_, k2, k3, k4] = stages(moments, omega, h);
                let rates = [omega, k2, k3, k4].map(|omega| free_acceleration(moments, omega));
                omega + h / 6.0 * (rates[0] + 2.0 * rates[1] + 2.0 * rates[2] + rates[3])
            }
        }
    }

    /// Makes the same step, and returns the turn of the body during it as well.
    pub(super) fn turn(self, moments: DVec3, omega: DVec3, h: f64) -> (DVec3, DQuat) {
        let after = self.step(moments, omega, h);
        let turn = match self {
            SpinMap::RungeKutta => {
                let [k1, w2, w3, w4] = stages(moments, omega, h);
                let k2 = on_group(h / 2.0 * k1, w2);
                let k3 = on_group(h / 2.0 * k2, w3);
                let k4 = on_group(h * k3, w4);
                h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
            }
            _ => h * after,
        };
        (after, turn_by(turn))
    }
}

/// Returns the angular velocities at the four stages of the classical Runge-Kutta method.
fn stages(moments: DVec3, omega: DVec3, h: f64) -> [DVec3; 4] {
    let rate = |omega| free_acceleration(moments, omega);
    let w2 = omega + h / 2.0 * rate(omega);
    let w3 = omega + h / 2.0 * rate(w2);
    [omega, w2, w3, omega + h * rate(w3)]
}

/// Returns the rate of the turn by `u` of a frame that spins by `omega`, to fourth order.
pub(super) fn on_group(u: DVec3, omega: DVec3) -> DVec3 {
    let across = u.cross(omega);
    omega + across / 2.0 + u.cross(across) / 12.0
}

/// Returns the matrix `[a]` with `[a] b = a × b`.
fn cross_matrix(a: DVec3) -> DMat3 {
    DMat3::from_cols(a.cross(DVec3::X), a.cross(DVec3::Y), a.cross(DVec3::Z))
}

/// How an engine integrates torque-free rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FreeSpin {
    /// The default map of the engine.
    pub default: SpinMap,
    /// The map that a setting of the body or of the engine switches on; `None` if there is none.
    pub opt_in: Option<SpinMap>,
    /// Whether the engine applies its map once a tick; otherwise in each substep.
    pub is_once_a_tick: bool,
}

impl FreeSpin {
    /// Creates the card of an engine with one map, which it applies in each substep.
    pub(super) const fn of(default: SpinMap) -> Self {
        Self { default, opt_in: None, is_once_a_tick: false }
    }
}
