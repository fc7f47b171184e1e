//! How a method meets a criterion, and by how much.

use crate::sim::number::round;

/// The largest factor by which bodies are made stiffer.
pub(super) const MAX_STIFFER: f64 = 10.0;

/// The fewest substeps with which a method meets a criterion, and its margins.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CriterionMet {
    /// The requested tick rate in Hz, at which it meets it.
    pub tick_hz: u32,
    /// Steps per tick.
    pub substeps: u32,
    /// Evaluations of all bodies' accelerations per simulated second, of a method of equal steps in the long run.
    pub evaluations_per_s: f64,
    /// These evaluations times [what one costs](crate::sim::integrators::Method::evaluation_cost): methods are ranked by it first.
    pub cost_per_s: f64,
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

/// Said of a margin that leaves nothing.
const NO_RESERVE: &str = "(no reserve)";

impl CriterionMet {
    /// Its margins, or that they are not known, as a part of a sentence.
    pub fn margins(&self) -> String {
        if !self.are_margins_searched {
            return "how much slower or stiffer, has not been searched".into();
        }
        match (self.slower(), self.stiffer()) {
            (Some(slower), Some(stiffer)) => format!("holds down to {slower}, or {stiffer}"),
            (Some(slower), None) => {
                format!("holds down to {slower}; how much stiffer, is not known")
            }
            (None, Some(stiffer)) => {
                format!("holds up to {stiffer}; how much slower, is not known")
            }
            (None, None) => "how much slower or stiffer, is not known".into(),
        }
    }

    /// The rate down to which it holds, in words; `None` if it is not known.
    pub fn slower(&self) -> Option<String> {
        let hz = self.slowest_hz?;
        let mark = if self.has_no_slower() { format!(" {NO_RESERVE}") } else { String::new() };
        Some(format!("{hz} Hz{mark}"))
    }

    /// The factor and the parameter up to which it holds, in words; `None` if they are not known.
    pub fn stiffer(&self) -> Option<String> {
        let factor = self.stiffness_factor?;
        let more = if factor >= MAX_STIFFER { "more than " } else { "" };
        let mark = if factor <= 1.0 { format!(" {NO_RESERVE}") } else { String::new() };
        Some(format!("{more}{} × {}{mark}", round(factor, 3), self.limited_by.as_deref()?))
    }

    /// Its reserve: the factor, 1 to 10, by which the bodies may be stiffer at this rate, or at once as much slower. It is the
    /// lesser of the two margins that are known, and `None` if neither is.
    ///
    /// Both are factors of stiffness: a spring of f times the stiffness takes steps of the same angle at √f times the rate,
    /// so that a rate counts by its square. At 1 Hz, below which none is searched, the stiffness decides alone.
    pub fn reserve(&self) -> Option<f64> {
        let of_rate = self.slowest_hz.filter(|_| self.tick_hz > 1).map(|hz| {
            let ratio = f64::from(self.tick_hz) / f64::from(hz);
            // To one digit after the point, as factors are tried.
            libm::floor(10.0 * ratio * ratio) / 10.0
        });
        let least = [of_rate, self.stiffness_factor].into_iter().flatten().reduce(f64::min)?;
        Some(least.min(MAX_STIFFER))
    }

    /// Whether one of its margins leaves nothing: the next rate or the next factor that was tried fails.
    pub fn has_no_reserve(&self) -> bool {
        self.has_no_slower() || self.stiffness_factor.is_some_and(|factor| factor <= 1.0)
    }

    /// Whether the next lower rate fails. Below 1 Hz none is searched.
    fn has_no_slower(&self) -> bool {
        self.tick_hz > 1 && self.slowest_hz.is_some_and(|hz| hz >= self.tick_hz)
    }
}
