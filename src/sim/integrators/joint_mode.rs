//! Names and units of the stiffness and the damping of a spring in an engine.

use std::f64::consts::TAU;

/// The stiffness per unit of mass, in 1/s², and the damping, in 1/s, of a setting of 1 in Matter.js.
pub(super) const FULL_STIFFNESS: f64 = 24_000.0;
pub(super) const FULL_DAMPING: f64 = 240.0;

/// 1 / (c d² √K) for a setting d of Bullet's btGeneric6DofSpringConstraint, with which the spring shows a slight
/// damping c at 60 Hz. It is 18π: half a swing loses a share of K / s² of its speed, with 6 d K for the speed s of the
/// motor.
pub(super) const MOTOR_LOSS: f64 = 56.5;
/// The largest such setting, beyond which only rounding damps.
const NO_LOSS: f64 = 1e6;
/// The damping per kilogram, in 1/s, in place of a 0 that cannot be written.
const NEARLY_UNDAMPED: f64 = 1e-9;

/// A way to set a spring in an engine, by one setting for stiffness and one for damping.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointMode {
    /// Kebab-case name, unique among the modes of the engine.
    pub id: &'static str,
    /// The setting for the stiffness.
    pub stiffness: Setting,
    /// The setting for the damping.
    pub damping: Setting,
    /// Whether the engine computes the spring's force at the start of a substep, like a force of user code.
    pub is_explicit: bool,
    /// The other engine with the same map that the lines of code are of. `None` for the engine of the card.
    pub engine: Option<OtherEngine>,
    /// Lines of code that set the spring, in the engine's own language, with the names of settings in braces.
    pub code: &'static str,
}

/// An [other engine](super::Method::also) with the map of a card, and the version that was run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OtherEngine {
    /// Kebab-case name on the command line.
    pub id: &'static str,
    /// The version of the engine.
    pub version: &'static str,
    /// As [`Engine::logged`](super::Engine::logged).
    pub logged: Option<&'static str>,
}

/// A numerical setting of an engine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The name of the setting in the engine.
    pub name: &'static str,
    /// The quantity of the setting.
    pub quantity: JointQuantity,
    /// The value in the engine where code leaves the setting out.
    pub usual: f64,
}

/// The quantity of a joint's setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointQuantity {
    /// The stiffness k, in N/m.
    Stiffness,
    /// The stiffness per unit of mass, k/m, in 1/s².
    StiffnessPerMass,
    /// The compliance 1/k, in m/N.
    Compliance,
    /// The frequency √(k/m) / 2π, in Hz.
    Frequency,
    /// The damping c, in N s/m.
    Damping,
    /// The damping c, in N s/m, of which the engine takes a 0 as 1.
    NonzeroDamping,
    /// The part of its way to the rest by which Matter.js moves a body in an iteration, at 60 Hz.
    IterationPart,
    /// The damping per unit of mass, c/m, in 1/s.
    DampingPerMass,
    /// The part of its velocity that Matter.js takes from a body in an iteration, at 60 Hz.
    IterationBrake,
    /// The damping of Bullet's btGeneric6DofSpringConstraint, in m/N, of which less damps more.
    MotorDamping,
    /// The damping ratio c / (2 √(k m)).
    DampingRatio,
    /// A damping that must stay 0, because with more the spring is not linear.
    Undamped,
}

use JointQuantity::*;

impl JointQuantity {
    /// Returns the unit; empty if the quantity has no unit.
    pub fn unit(self) -> &'static str {
        match self {
            Stiffness => "N/m",
            StiffnessPerMass => "1/s²",
            Compliance | MotorDamping => "m/N",
            Frequency => "Hz",
            Damping | NonzeroDamping | Undamped => "N s/m",
            DampingPerMass => "1/s",
            IterationPart | IterationBrake | DampingRatio => "",
        }
    }

    /// Returns the value of the quantity for a joint of this stiffness in 1/s² and damping in 1/s, each per unit of
    /// mass, on a mass in kg.
    pub fn of(self, [stiffness, damping]: [f64; 2], mass_kg: f64) -> f64 {
        match self {
            Stiffness => stiffness * mass_kg,
            StiffnessPerMass => stiffness,
            Compliance => 1.0 / (stiffness * mass_kg),
            Frequency => libm::sqrt(stiffness) / TAU,
            IterationPart => stiffness / FULL_STIFFNESS,
            Damping => damping * mass_kg,
            NonzeroDamping => damping.max(NEARLY_UNDAMPED) * mass_kg,
            DampingPerMass => damping,
            IterationBrake => damping / FULL_DAMPING,
            MotorDamping => {
                let loss = MOTOR_LOSS * damping * libm::sqrt(stiffness);
                (1.0 / libm::sqrt(loss)).min(NO_LOSS) / mass_kg
            }
            DampingRatio => damping / (2.0 * libm::sqrt(stiffness)),
            Undamped => 0.0,
        }
    }
}

impl JointMode {
    /// Returns the mode as one of this version of another engine with the same map, as it was logged.
    pub(super) const fn of(self, id: &'static str, version: &'static str) -> Self {
        let engine = OtherEngine { id, version, logged: Some("2026-11-27") };
        Self { engine: Some(engine), ..self }
    }

    /// Like [`JointMode::of`], of an engine without logs.
    pub(super) const fn unlogged_of(self, id: &'static str, version: &'static str) -> Self {
        Self { engine: Some(OtherEngine { id, version, logged: None }), ..self }
    }

    /// Returns the mode with this damping where code leaves it out.
    pub(super) const fn usually(self, damping: f64) -> Self {
        Self { damping: Setting { usual: damping, ..self.damping }, ..self }
    }

    /// Returns the settings for the stiffness and for the damping.
    pub fn settings(&self) -> [Setting; 2] {
        [self.stiffness, self.damping]
    }

    /// Returns the joint that the mode has in place of this one, which is without damping if the mode takes none.
    pub fn possible(&self, [stiffness, damping]: [f64; 2]) -> [f64; 2] {
        let is_undamped = self.damping.quantity == Undamped;
        [stiffness, if is_undamped { 0.0 } else { damping }]
    }

    /// Whether a tick of a joint with this damping is a linear map.
    pub fn is_linear(&self, damping: f64) -> bool {
        self.damping.quantity != MotorDamping || damping == 0.0
    }

    /// Returns the values of the mode's settings for a joint on a mass in kg. The joint is given by its stiffness in
    /// 1/s² and its damping in 1/s, each per unit of mass.
    pub fn values(&self, joint: [f64; 2], mass_kg: f64) -> [f64; 2] {
        self.settings().map(|setting| setting.quantity.of(joint, mass_kg))
    }

    /// Returns the joint that these values of the mode's settings make on a mass in kg. The joint is given by its
    /// stiffness in 1/s² and its damping in 1/s, each per unit of mass.
    pub fn joint(&self, [first, second]: [f64; 2], mass_kg: f64) -> [f64; 2] {
        let stiffness = match self.stiffness.quantity {
            Stiffness => first / mass_kg,
            Compliance => 1.0 / (first * mass_kg),
            Frequency => (TAU * first) * (TAU * first),
            IterationPart => first * FULL_STIFFNESS,
            _ => first,
        };
        let damping = match self.damping.quantity {
            Damping => second / mass_kg,
            NonzeroDamping if second == 0.0 => 1.0 / mass_kg,
            NonzeroDamping => second / mass_kg,
            DampingRatio => 2.0 * second * libm::sqrt(stiffness),
            IterationBrake => second * FULL_DAMPING,
            MotorDamping => {
                let setting = second * mass_kg;
                1.0 / (MOTOR_LOSS * setting * setting * libm::sqrt(stiffness))
            }
            Undamped => 0.0,
            _ => second,
        };
        [stiffness, damping]
    }

    /// Returns the mode's lines of code with these values. A whole number gets a decimal point.
    pub fn code_with(&self, values: [f64; 2]) -> String {
        let mut code = self.code.to_owned();
        for (setting, value) in self.settings().into_iter().zip(values) {
            code = code.replace(&format!("{{{}}}", setting.name), &in_code(value));
        }
        code
    }
}

/// Writes a number as in code, with a decimal point or an exponent, to nine digits.
pub fn in_code(value: f64) -> String {
    let rounded = format!("{value:.8e}").parse::<f64>();
    format!("{:?}", rounded.unwrap_or(value))
}

/// Returns a mode that is not explicit.
pub(super) const fn mode(
    id: &'static str,
    stiffness: (&'static str, JointQuantity),
    damping: (&'static str, JointQuantity),
    code: &'static str,
) -> JointMode {
    let stiffness = Setting { name: stiffness.0, quantity: stiffness.1, usual: 0.0 };
    let damping = Setting { name: damping.0, quantity: damping.1, usual: 0.0 };
    JointMode { id, stiffness, damping, is_explicit: false, engine: None, code }
}

/// Returns a [`mode`] with the settings `stiffness`, in N/m, and `damping`, in N s/m.
pub(super) const fn si_mode(id: &'static str, code: &'static str) -> JointMode {
    mode(id, ("stiffness", Stiffness), ("damping", Damping), code)
}

/// Returns a [`mode`] of a solver of Newton, for the engine whose id is `engine-` and that of the mode.
macro_rules! newton_mode {
    ($id:literal, $solver:literal) => {
        $crate::integrators::joint_mode::mode(
            $id,
            ("target_ke", $crate::integrators::joint_mode::JointQuantity::Stiffness),
            ("target_kd", $crate::integrators::joint_mode::JointQuantity::Damping),
            concat!(
                "dof = newton.ModelBuilder.JointDofConfig(axis, target_ke={target_ke}, target_kd={target_kd})\n",
                "solver = newton.solvers.",
                $solver,
                "(model)"
            ),
        )
        .of(concat!("engine-", $id), "1.8.0")
    };
}
pub(super) use newton_mode;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_pair_of_settings_gives_the_same_joint() {
        let joint = [39.5, 0.7];
        for stiffness in [Stiffness, StiffnessPerMass, Compliance, Frequency, IterationPart] {
            for damping in [
                Damping,
                NonzeroDamping,
                DampingPerMass,
                DampingRatio,
                IterationBrake,
                MotorDamping,
            ] {
                let mode = mode("any", ("a", stiffness), ("b", damping), "f({a}, {b})");
                let back = mode.joint(mode.values(joint, 80.0), 80.0);
                let is_near = |(a, b): (f64, f64)| (a / b - 1.0).abs() < 1e-14;
                assert!(back.into_iter().zip(joint).all(is_near), "{mode:?}: {back:?}");
                assert_eq!(mode.code_with([2.0, 0.25]), "f(2.0, 0.25)");
            }
        }
    }
}
