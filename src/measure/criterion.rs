//! What a developer may require of a method, the errors that count as visible, and by how much a method meets it.

use crate::sim::TickRate;
use crate::sim::number::round;

/// A requirement that a developer may have of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// Nothing grows that does not grow in truth, over the scene and in the long run.
    Bounded,
    /// Amplitude and frequency show no visible error.
    LooksRight,
    /// The state shows no visible error at any moment.
    Accurate,
}

/// Every criterion, from the easiest to the hardest.
pub static CRITERIA: [Criterion; 3] =
    [Criterion::Bounded, Criterion::LooksRight, Criterion::Accurate];

impl Criterion {
    /// Its name in output, in kebab case.
    pub fn id(self) -> &'static str {
        match self {
            Criterion::Bounded => "bounded",
            Criterion::LooksRight => "looks-right",
            Criterion::Accurate => "accurate",
        }
    }

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Criterion::Bounded => "bounded",
            Criterion::LooksRight => "looks right",
            Criterion::Accurate => "accurate",
        }
    }

    /// The requirement in one line.
    pub fn about(self) -> &'static str {
        match self {
            Criterion::Bounded => {
                "nothing grows that should not: no mode of a linear body doubles within a year; any other body, followed \
                 for 20 times the scene, neither doubles its swing nor goes on gaining, and one that loses, followed \
                 for up to 2000 times, comes to rest"
            }
            Criterion::LooksRight => {
                "each swing as wide as the truth's, within 5 % of the widest, its peak found between the steps, and the \
                 frequency within 1 %; of several modes the root of all their energies within 5 %, and the frequency of the \
                 one with the most energy; a body that swings less than three times in the scene is followed until it has; \
                 without a swing, within 5 % of the range"
            }
            Criterion::Accurate => {
                "no coordinate or velocity off by more than 1 % of its amplitude"
            }
        }
    }
}

/// The largest factor by which bodies are made stiffer.
pub(super) const MAX_STIFFER: f64 = 10.0;

/// The fewest substeps with which a method meets a criterion, and its margins.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct CriterionMet {
    /// The requested tick rate in Hz, at which it meets it.
    pub tick_hz: TickRate,
    /// Steps per tick.
    pub substeps: u32,
    /// Evaluations of all bodies' accelerations per simulated second, of a method of equal steps in the long run.
    pub evaluations_per_s: f64,
    /// These evaluations times [what one costs](crate::sim::integrators::Method::evaluation_cost): methods are ranked by it first.
    pub cost_per_s: f64,
    /// Whether the margins have been searched. Where that is dear, they are for methods of about the least cost only.
    #[cfg_attr(feature = "serde", serde(rename = "margins_searched"))]
    pub are_margins_searched: bool,
    /// The lowest whole tick rate in Hz, going down from the requested one rounded up, at which the criterion still holds
    /// with as many substeps, as it does at all rates between that were tried; `None` if one hertz lower it is not known,
    /// for want of a truth or for too much work.
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

    /// The rate down to which it holds; `None` if it is not known.
    pub fn slowest(&self) -> Option<TickRate> {
        self.slowest_hz.map(|hz| TickRate::whole(hz).min(self.tick_hz))
    }

    /// The rate down to which it holds, in words; `None` if it is not known.
    pub fn slower(&self) -> Option<String> {
        let hz = self.slowest()?;
        let mark = if self.has_no_slower() { format!(" {NO_RESERVE}") } else { String::new() };
        Some(format!("{hz:.3} Hz{mark}"))
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
        let of_rate = self.slowest().filter(|_| self.tick_hz > 1).map(|slowest| {
            let ratio = self.tick_hz.hz() / slowest.hz();
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
        self.tick_hz > 1 && self.slowest().is_some_and(|slowest| slowest >= self.tick_hz)
    }
}

/// The largest error that counts as accurate, in amplitudes: about the smallest that can be seen.
pub const TOLERANCE: f64 = 0.01;

/// The smallest relative change of an amplitude that can be seen.
pub const VISIBLE: f64 = 0.05;

/// The largest relative frequency error that looks right.
pub const FREQUENCY_TOLERANCE: f64 = 0.01;
