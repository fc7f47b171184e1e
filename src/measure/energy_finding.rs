//! Findings from the energy and the spectral radius of a tick, for a body without a reference solution.

use std::fmt;

use super::amplitude::Trend;
use super::outcome::Outcome;
use crate::sim::bodies::Truth;
use crate::sim::number::round;

/// Spectral radius above which deviations count as growing. It is not 1, because the power iteration is accurate only
/// to some thousandths.
const GROWING_RADIUS: f64 = 1.01;

/// Findings on a lane from its energy and the spectral radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyFinding {
    /// Change of kinetic and potential energy at the end of the run, without the energy that an input adds. The unit is
    /// the largest kinetic energy, or the largest loss if the loss is larger.
    pub change: f64,
    /// Trend of the energy.
    pub trend: Trend,
    /// Largest change in magnitude of a conserved energy, in percent of the unit of `change`.
    pub drift_percent: Option<f64>,
    /// Whether the body conserves its energy, so that a loss is an error of the method too.
    pub is_conserved: bool,
    /// Spectral radius of a tick around the start, for state and memory. `None` for a method that chooses its substeps,
    /// for an implicit one with memory, and if the radius takes too much work.
    pub spectral_radius: Option<f64>,
}

impl EnergyFinding {
    pub(super) fn outcome(&self) -> Outcome {
        match self.trend {
            Trend::Grows => Outcome::Grows,
            Trend::Dies => Outcome::DiesAway,
            Trend::None => Outcome::NoTruth,
        }
    }

    /// Whether neither the energy nor a small deviation grows.
    pub(super) fn is_bounded(&self) -> bool {
        self.trend != Trend::Grows && !self.has_growing_deviations()
    }

    /// Whether a small deviation is known to grow.
    fn has_growing_deviations(&self) -> bool {
        self.spectral_radius.is_some_and(|radius| radius >= GROWING_RADIUS)
    }

    /// Returns the words for an energy that shows no visible growth or loss.
    pub(super) fn word(&self) -> &'static str {
        if self.is_conserved { "keeps energy" } else { "gains no energy" }
    }

    /// Returns the largest change of a conserved energy in percent and in words.
    pub(super) fn number(&self) -> Option<(f64, String)> {
        let percent = self.drift_percent?.abs();
        Some((percent, format!("within {} %", round(percent, 2))))
    }
}

impl fmt::Display for EnergyFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: by energy", Truth::Reference.missing())?;
        match self.spectral_radius {
            Some(radius) => write!(f, " and spectral radius {}", round(radius, 4)),
            None => f.write_str(" alone"),
        }
    }
}
