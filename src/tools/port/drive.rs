//! How stiff and how damped a drive may be.

use super::seen::NO_GROWTH;
use super::{MAX_SUBSTEPS, Setup};
use crate::sim::numerics::bisect;
use crate::tools::identify::Effective;

/// The gains that are stable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GainRange {
    /// The least; 0 if all below the most are.
    pub least: f64,
    /// The most; `None` if all above the least are, and 0 if none is.
    pub most: Option<f64>,
}

/// The limits of a drive: of an engine's own, or of a force of user code that is held through some ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveLimits {
    /// The ticks through which user code holds the force; `None` for the engine's own drive.
    pub held_ticks: Option<u32>,
    /// The stable stiffnesses with the damping given, per unit of mass, in 1/s².
    pub stiffness: GainRange,
    /// The stable dampings with the stiffness given, per unit of mass, in 1/s.
    pub damping: GainRange,
    /// The largest part of the state that a tick keeps with the pair given: it is stable up to 1. `None` if the engine makes
    /// nothing of it.
    pub spectral_radius: Option<f64>,
    /// The fewest substeps with which the pair given is stable, up to 64; `None` if it is with none.
    pub fewest_substeps: Option<u32>,
    /// What a player sees of the pair given; `None` if nothing swings or decays.
    pub sees: Option<Effective>,
}

/// Gains beyond this multiple of the given one are not sought.
const MAX_MULTIPLE: f64 = 1e9;
/// The factor from gain to gain, and how often the last step is halved.
const STEP: f64 = 1.02;
const HALVINGS: u32 = 50;

/// The limits of a drive with this stiffness in 1/s² and damping in 1/s, each per unit of mass.
pub fn drive_limits(setup: Setup, joint: [f64; 2], held_ticks: Option<u32>) -> DriveLimits {
    let growth = |setup: Setup, joint: [f64; 2]| match held_ticks {
        Some(ticks) => setup.held_growth(joint, ticks),
        None => setup.growth(joint),
    };
    let holds = |setup: Setup, joint| growth(setup, joint).is_some_and(|kept| kept <= NO_GROWTH);
    let rate = setup.tick_hz * setup.tick_hz;
    let [stiffness, damping] = joint;
    let with = |substeps| Setup { substeps, ..setup };
    DriveLimits {
        held_ticks,
        stiffness: range(rate * 1e-6, |k| holds(setup, [k, damping])),
        damping: range(setup.tick_hz * 1e-4, |c| holds(setup, [stiffness, c])),
        spectral_radius: growth(setup, joint),
        fewest_substeps: (1..=MAX_SUBSTEPS).find(|n| holds(with(*n), joint)),
        sees: match held_ticks {
            Some(ticks) => setup.sees_held(joint, ticks),
            None => setup.sees(joint),
        },
    }
}

/// The gains that hold, from `first` up, or from 0 if that holds.
fn range(first: f64, holds: impl Fn(f64) -> bool) -> GainRange {
    let gains = || std::iter::successors(Some(first), |gain| Some(gain * STEP));
    let within = |gain: &f64| *gain < first * MAX_MULTIPLE;
    let Some(lowest) = gains().take_while(within).find(|gain| holds(*gain)) else {
        return GainRange { least: 0.0, most: Some(0.0) };
    };
    let least = match lowest == first {
        true => 0.0,
        false => bisect([lowest / STEP, lowest], HALVINGS, |gain| !holds(gain))[1],
    };
    let (mut low, mut high) = (lowest, lowest);
    while holds(high) {
        (low, high) = (high, high * STEP);
        if high > first * MAX_MULTIPLE {
            return GainRange { least, most: None };
        }
    }
    let [low, _] = bisect([low, high], HALVINGS, holds);
    GainRange { least, most: Some(low) }
}
