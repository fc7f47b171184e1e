//! How physics engines integrate torque-free rotation in space.
//!
//! With `I` the principal moments of inertia, `ω` the angular velocity in the frame of their axes and `L = I ω` the
//! angular momentum, `dL/dt = -ω × L`: without torque the axis of a body changes unless it is a principal one. None of
//! the maps is exact. Each is held against logs of engines (`tests/library/engines/tumble.rs`), except [`SpinMap::Constant`].

use glam::{DMat3, DVec3};

/// One step of the angular velocity of a body without torque. `'` marks values at the end of the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpinMap {
    /// `ω' = ω`: the term `ω × L` is left out. The default of Jolt and PhysX; Godot.
    Constant,
    /// `L' = L - h ω × L`, then scaled to the length of `L`. It keeps that length and changes the energy. Rapier; Jolt
    /// with `mApplyGyroscopicForce`, PhysX with `eENABLE_GYROSCOPIC_FORCES`.
    ScaledMomentum,
    /// One Newton step from `ω` towards the root of implicit Euler, `I (ω' - ω) + h ω' × I ω' = 0`: `ω' = ω - J⁻¹ h ω × L`
    /// with `J = I + h ([ω] I - [L])`, where `[a] b = a × b`. Bullet (`computeGyroscopicImpulseImplicit_Body`);
    /// MuJoCo's integrators `implicit` and `implicitfast`. Not finite where `J` has no inverse.
    NewtonStep,
    /// `ω' = ω - h I⁻¹ (ω × L)`, explicit Euler. MuJoCo's integrator `Euler`.
    Explicit,
    /// The classical Runge-Kutta method on `dω/dt = -I⁻¹ (ω × L)`. MuJoCo's integrator `RK4`.
    RungeKutta,
}

impl SpinMap {
    /// Every map.
    pub const ALL: [SpinMap; 5] = [
        SpinMap::Constant,
        SpinMap::ScaledMomentum,
        SpinMap::NewtonStep,
        SpinMap::Explicit,
        SpinMap::RungeKutta,
    ];

    /// Kebab-case name.
    pub fn id(self) -> &'static str {
        match self {
            SpinMap::Constant => "constant",
            SpinMap::ScaledMomentum => "scaled-momentum",
            SpinMap::NewtonStep => "newton-step",
            SpinMap::Explicit => "explicit",
            SpinMap::RungeKutta => "runge-kutta",
        }
    }

    /// The angular velocity after a step of `h` (s) from `omega` (rad/s), both in the frame of the principal axes.
    /// `inertia` has the moments about them (kg m²), each more than 0.
    pub fn step(self, inertia: DVec3, omega: DVec3, h: f64) -> DVec3 {
        let rate = |omega: DVec3| -omega.cross(inertia * omega) / inertia;
        match self {
            SpinMap::Constant => omega,
            SpinMap::ScaledMomentum => scaled_momentum(inertia, omega, h),
            SpinMap::NewtonStep => newton_step(inertia, omega, h),
            SpinMap::Explicit => omega + h * rate(omega),
            SpinMap::RungeKutta => {
                let k1 = rate(omega);
                let k2 = rate(omega + h / 2.0 * k1);
                let k3 = rate(omega + h / 2.0 * k2);
                let k4 = rate(omega + h * k3);
                omega + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
            }
        }
    }
}

fn scaled_momentum(inertia: DVec3, omega: DVec3, h: f64) -> DVec3 {
    let before = inertia * omega;
    let after = before - h * omega.cross(before);
    match after.length() {
        // A body at rest has no direction to scale.
        0.0 => omega,
        length => after * (before.length() / length) / inertia,
    }
}

fn newton_step(inertia: DVec3, omega: DVec3, h: f64) -> DVec3 {
    let momentum = inertia * omega;
    let moments = DMat3::from_diagonal(inertia);
    let jacobian = moments + h * (cross_matrix(omega) * moments - cross_matrix(momentum));
    omega - jacobian.inverse() * (h * omega.cross(momentum))
}

/// The matrix `[a]` with `[a] b = a × b`.
fn cross_matrix(a: DVec3) -> DMat3 {
    DMat3::from_cols(a.cross(DVec3::X), a.cross(DVec3::Y), a.cross(DVec3::Z))
}

/// How an engine integrates torque-free rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FreeSpin {
    /// Its default map.
    pub default: SpinMap,
    /// The map that a setting of the body or of the engine switches on; `None` if there is none.
    pub opt_in: Option<SpinMap>,
    /// Whether each of a tick's substeps applies the map, with `h` the substep. If not, it is applied once a tick. The
    /// logs with more than one substep are of Rapier and PhysX; Jolt, Bullet and MuJoCo repeat their whole step.
    pub per_substep: bool,
}

impl FreeSpin {
    /// The angular velocity after a tick of `length` (s) with `substeps` substeps, at least 1, by `map`. The other
    /// arguments are as in [`SpinMap::step`].
    pub fn tick(
        self,
        map: SpinMap,
        inertia: DVec3,
        omega: DVec3,
        length: f64,
        substeps: u32,
    ) -> DVec3 {
        let steps = if self.per_substep { substeps } else { 1 };
        let h = length / f64::from(steps);
        (0..steps).fold(omega, |omega, _| map.step(inertia, omega, h))
    }
}
