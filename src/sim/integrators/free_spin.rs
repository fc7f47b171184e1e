//! Maps by which physics engines integrate torque-free rotation in space.
//!
//! With `I` the principal moments of inertia, `ω` the angular velocity in the frame of their axes and `L = I ω` the
//! angular momentum, `dL/dt = -ω × L`. Without torque the axis of a body changes unless it is a principal one. None of
//! the maps is exact. The cards name them and the tests compute them; all but [`SpinMap::Constant`] are checked
//! against logs of engines (`tests/library/engines/tumble.rs`).

/// One step of the angular velocity of a body without torque. `'` marks values at the end of the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpinMap {
    /// `ω' = ω`: omits the term `ω × L`. The default of Jolt and PhysX; Godot.
    Constant,
    /// `L' = L - h ω × L`, then scaled to the length of `L`. It keeps that length and changes the energy. Rapier; Jolt
    /// with `mApplyGyroscopicForce`, PhysX with `eENABLE_GYROSCOPIC_FORCES`.
    ScaledMomentum,
    /// One Newton step from `ω` towards the root of implicit Euler, `I (ω' - ω) + h ω' × I ω' = 0`:
    /// `ω' = ω - J⁻¹ h ω × L` with `J = I + h ([ω] I - [L])`, where `[a] b = a × b`. Bullet
    /// (`computeGyroscopicImpulseImplicit_Body`); MuJoCo's integrators `implicit` and `implicitfast`. Not finite where
    /// `J` has no inverse.
    NewtonStep,
    /// `ω' = ω - h I⁻¹ (ω × L)`, explicit Euler. MuJoCo's integrator `Euler`.
    Explicit,
    /// The classical Runge-Kutta method on `dω/dt = -I⁻¹ (ω × L)`. MuJoCo's integrator `RK4`.
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
}

/// How an engine integrates torque-free rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FreeSpin {
    /// Its default map.
    pub default: SpinMap,
    /// The map that a setting of the body or of the engine switches on; `None` if there is none.
    pub opt_in: Option<SpinMap>,
}
