//! Maps by which physics engines integrate torque-free rotation in space.
//!
//! Let `I` be the principal moments of inertia, `ω` the angular velocity in the frame of their axes, and `L = I ω` the
//! angular momentum. Then `dL/dt = -ω × L`. Without torque, the axis of rotation changes unless it is a principal axis.
//! None of the maps is exact. The cards name the maps and the tests compute them; all but [`SpinMap::Constant`] are
//! checked against logs of engines (`tests/library/engines/tumble.rs`).

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
}

/// How an engine integrates torque-free rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FreeSpin {
    /// The default map of the engine.
    pub default: SpinMap,
    /// The map that a setting of the body or of the engine switches on; `None` if there is none.
    pub opt_in: Option<SpinMap>,
}
