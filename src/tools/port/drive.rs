//! Finds the limits of a drive's stiffness and damping.

use super::seen::NO_GROWTH;
use super::{MAX_SUBSTEPS, Setup};
use crate::identify::Effective;
use crate::sim::numerics::bisect;

/// A range of stable gains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GainRange {
    /// Smallest stable gain; 0 if there is no lower limit.
    pub least: f64,
    /// Largest stable gain; `None` if there is no upper limit, and 0 if no gain is stable.
    pub most: Option<f64>,
}

/// The limits of an engine's own drive, or of a force that user code holds through some ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveLimits {
    /// Number of ticks through which user code holds the force; `None` for the engine's own drive.
    pub held_ticks: Option<u32>,
    /// Stable stiffnesses at the given damping, per unit of mass, in 1/s².
    pub stiffness: GainRange,
    /// Stable dampings at the given stiffness, per unit of mass, in 1/s.
    pub damping: GainRange,
    /// Spectral radius of a tick's map for the given pair of stiffness and damping. The pair is stable up to a radius
    /// of 1. `None` if the engine cannot run the pair.
    pub spectral_radius: Option<f64>,
    /// Minimum number of substeps, up to 64, at which the given pair is stable; `None` if there is none.
    pub fewest_substeps: Option<u32>,
    /// Visible motion with the given pair; `None` if the motion neither swings nor decays.
    pub sees: Option<Effective>,
}

/// Multiple of the first gain at which the search ends.
const MAX_MULTIPLE: f64 = 1e9;
/// Ratio of successive gains, and number of times that the last step is halved.
const STEP: f64 = 1.02;
const HALVINGS: u32 = 50;

/// Returns the limits of a drive with this stiffness in 1/s² and damping in 1/s, each per unit of mass.
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
            None => setup.visible_motion(joint),
        },
    }
}

/// Returns the first range of gains for which `holds` is true, from `first` up. The range starts at 0 if `first` holds.
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
