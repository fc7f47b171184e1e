//! How a method meets a criterion, and by how much.

use crate::sim::number::round;

/// The largest factor by which bodies are made stiffer.
pub(super) const MAX_STIFFER: f64 = 10.0;

/// The fewest substeps with which a method meets a criterion, and its margins.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CriterionMet {
    /// Steps per tick.
    pub substeps: u32,
    /// Evaluations of all bodies' accelerations per simulated second.
    pub evaluations_per_s: f64,
    /// Whether the margins have been searched. Where that is dear, they are for methods of about the least cost only.
    #[cfg_attr(feature = "serde", serde(rename = "margins_searched"))]
    pub are_margins_searched: bool,
    /// The lowest tick rate in Hz, going down from the requested one, at which the criterion still holds with as many
    /// substeps, as it does at all rates between that were tried; `None` if one hertz lower it is not known, for want of
    /// a truth or for too much work.
    pub slowest_hz: Option<u32>,
    /// The largest factor by which the bodies may be stiffer, 1 to 10, to two digits: the criterion holds with every
    /// factor up to it that is tried, each at most a tenth above the one before. `None` if it is not known whether it
    /// holds with the next.
    pub stiffness_factor: Option<f64>,
    /// The parameter that the factor multiplies, of the body that fails first beyond it; `None` if the factor is.
    pub limited_by: Option<String>,
}

impl CriterionMet {
    /// Its margins, or that they are not known, as a part of a sentence.
    pub fn margins(&self) -> String {
        if !self.are_margins_searched {
            return "how much slower or stiffer, has not been searched".into();
        }
        let slower = self.slowest_hz.map(|hz| format!("holds down to {hz} Hz"));
        match (slower, self.stiffer()) {
            (Some(slower), Some(stiffer)) => format!("{slower}, or {stiffer}"),
            (Some(slower), None) => format!("{slower}; how much stiffer, is not known"),
            (None, Some(stiffer)) => {
                format!("holds up to {stiffer}; how much slower, is not known")
            }
            (None, None) => "how much slower or stiffer, is not known".into(),
        }
    }

    fn stiffer(&self) -> Option<String> {
        let factor = self.stiffness_factor?;
        let more = if factor >= MAX_STIFFER { "more than " } else { "" };
        Some(format!("{more}{} × {}", round(factor, 3), self.limited_by.as_deref()?))
    }
}
