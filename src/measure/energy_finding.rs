//! What the energy and the spectral radius of a tick say of a body that has no reference solution.

use std::fmt;

use super::amplitude::Trend;
use super::outcome::Outcome;
use crate::sim::bodies::Truth;
use crate::sim::number::round;

/// A radius above this is growth: the power iteration tells it to some thousandths.
const GROWING_RADIUS: f64 = 1.01;

/// What the energy and the spectral radius say of a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyFinding {
    /// The mean change of the kinetic and potential energy in the last quarter of the run, in units of the
    /// largest kinetic energy or of the most that was lost. What an input brings does not count.
    pub change: f64,
    /// How the energy changes.
    pub trend: Trend,
    /// The change of a conserved energy of largest magnitude, in percent of the unit of `change`.
    pub drift_percent: Option<f64>,
    /// Whether the body conserves its energy, so that a loss is the method's too.
    pub is_conserved: bool,
    /// The spectral radius of a tick about the start, of state and memory; `None` for a method that chooses its
    /// substeps, for an implicit one with memory, and where it takes too much work.
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

    /// Whether a small deviation grows, as far as the radius is known.
    fn has_growing_deviations(&self) -> bool {
        self.spectral_radius.is_some_and(|radius| radius >= GROWING_RADIUS)
    }

    /// What becomes of the energy where it neither grows nor is lost in a way that can be seen.
    pub(super) fn word(&self) -> &'static str {
        if self.is_conserved { "keeps energy" } else { "gains no energy" }
    }

    /// Within how much it keeps it, if it should.
    pub(super) fn number(&self) -> Option<String> {
        self.is_conserved.then(|| format!("within {} %", round(100.0 * self.change.abs(), 2)))
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
