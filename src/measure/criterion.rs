//! The criteria that a developer may require, the sizes of visible errors, and the margins with which a method meets
//! a criterion.
//!
//! A game wants that nothing explodes, that the motion looks right, or that every position is right. The bounds are
//! errors that a person would just see in the picture. They are the same for all scenes, so that verdicts can be
//! compared.

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
    /// Returns the criterion's name in output, in kebab case.
    pub fn id(self) -> &'static str {
        match self {
            Criterion::Bounded => "bounded",
            Criterion::LooksRight => "looks-right",
            Criterion::Accurate => "accurate",
        }
    }

    /// Returns the criterion's name for people.
    pub fn name(self) -> &'static str {
        match self {
            Criterion::Bounded => "bounded",
            Criterion::LooksRight => "looks right",
            Criterion::Accurate => "accurate",
        }
    }

    /// Describes the requirement in one line.
    pub fn about(self) -> &'static str {
        match self {
            Criterion::Bounded => {
                "nothing grows that should not: no mode of a linear body doubles within a year; any other body, \
                 followed for 20 times the scene, neither doubles its swing nor keeps gaining, and one that loses \
                 comes to rest within 2000 times"
            }
            Criterion::LooksRight => {
                "each swing as wide as the truth's, within 5 % of the widest, its peak found between the steps, and \
                 the frequency within 1 %; with several modes, the root of their total energy within 5 %, and the \
                 frequency of the strongest; a body that swings less than three times in the scene runs on until it \
                 has; without a swing, within 5 % of the range"
            }
            Criterion::Accurate => {
                "no coordinate or velocity off by more than 1 % of its amplitude"
            }
        }
    }
}

/// Largest factor by which bodies are made stiffer.
pub(super) const MAX_STIFFER: f64 = 10.0;

/// The smallest number of substeps with which a method meets a criterion, and the margins of the method.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct CriterionMet {
    /// Requested tick rate in Hz, at which the criterion is met.
    pub tick_hz: TickRate,
    /// Number of steps per tick.
    pub substeps: u32,
    /// Number of evaluations of all bodies' accelerations per simulated second. For a method of equal steps, it is the
    /// number in the long run.
    pub evaluations_per_s: f64,
    /// Number of evaluations per simulated second times [the cost of
    /// one](crate::sim::integrators::Method::evaluation_cost), which is the first key of the ranking.
    pub cost_per_s: f64,
    /// Whether the margins have been searched. If a search is expensive, it is done only for cheap methods.
    #[serde(rename = "margins_searched")]
    pub are_margins_searched: bool,
    /// Lowest whole tick rate in Hz at which the criterion still holds with the same number of substeps. The search
    /// goes down from the requested rate, rounded up, and the criterion holds at all rates tried on the way. `None` if
    /// the result one hertz lower is unknown, because there is no truth or it takes too much work.
    pub slowest_hz: Option<u32>,
    /// Largest factor by which the bodies may be stiffer, from 1 to 10, to two digits. The criterion holds with this
    /// factor and with every smaller one tried, each of which is at most a tenth above the one before. `None` if the
    /// result for the next factor is unknown.
    pub stiffness_factor: Option<f64>,
    /// The parameter that the factor multiplies, for the body that fails first with a larger factor; `None` if the
    /// factor is `None`.
    pub limited_by: Option<String>,
}

/// Text that marks a zero margin.
const NO_RESERVE: &str = "(no reserve)";

impl CriterionMet {
    /// Describes the margins in words, as part of a sentence. If they were not searched, the text says so.
    pub fn margins(&self) -> String {
        if !self.are_margins_searched {
            return "the reserve has not been searched".into();
        }
        match (self.slower(), self.stiffer()) {
            (Some(slower), Some(stiffer)) => format!("holds down to {slower}, or {stiffer}"),
            (Some(slower), None) => {
                format!("holds down to {slower}; with stiffer bodies not known")
            }
            (None, Some(stiffer)) => {
                format!("holds up to {stiffer}; with slower ticks not known")
            }
            (None, None) => "the reserve is not known".into(),
        }
    }

    /// Returns the lowest rate at which the criterion holds; `None` if unknown.
    pub fn slowest(&self) -> Option<TickRate> {
        self.slowest_hz.map(|hz| TickRate::whole(hz).min(self.tick_hz))
    }

    /// Describes the lowest rate at which the criterion holds; `None` if unknown.
    pub fn slower(&self) -> Option<String> {
        let hz = self.slowest()?;
        let mark = if self.has_no_slower() { format!(" {NO_RESERVE}") } else { String::new() };
        Some(format!("{hz:.3} Hz{mark}"))
    }

    /// Describes the largest stiffness factor and its parameter; `None` if unknown.
    pub fn stiffer(&self) -> Option<String> {
        let factor = self.stiffness_factor?;
        let more = if factor >= MAX_STIFFER { "more than " } else { "" };
        let mark = if factor <= 1.0 { format!(" {NO_RESERVE}") } else { String::new() };
        Some(format!("{more}{} × {}{mark}", round(factor, 3), self.limited_by.as_deref()?))
    }

    /// Returns the reserve, which is the factor, at least 1, by which the bodies may be stiffer at this rate, or
    /// equivalently the rate lower. It is the smaller of the known margins, and `None` if neither is known. A stiffness
    /// that the search does not exceed is no margin.
    ///
    /// Both margins are factors of stiffness. A spring with f times the stiffness makes steps of the same angle at √f
    /// times the rate, so the ratio of rates is squared. At 1 Hz no lower rate is searched, and only the stiffness
    /// counts.
    pub fn reserve(&self) -> Option<f64> {
        let of_rate = self.slowest().filter(|_| self.tick_hz > 1).map(|slowest| {
            let ratio = self.tick_hz.hz() / slowest.hz();
            // The ratio is rounded down to one decimal, like the factors tried.
            libm::floor(10.0 * ratio * ratio) / 10.0
        });
        let of_stiffness =
            self.stiffness_factor.filter(|&factor| factor < MAX_STIFFER || of_rate.is_none());
        [of_rate, of_stiffness].into_iter().flatten().reduce(f64::min)
    }

    /// Whether a margin is zero, because the next rate or the next factor tried fails.
    pub fn has_no_reserve(&self) -> bool {
        self.has_no_slower() || self.stiffness_factor.is_some_and(|factor| factor <= 1.0)
    }

    /// Whether the next lower rate fails. No rate below 1 Hz is searched.
    fn has_no_slower(&self) -> bool {
        self.tick_hz > 1 && self.slowest().is_some_and(|slowest| slowest >= self.tick_hz)
    }
}

/// Largest error that counts as accurate, in amplitudes. It is about the smallest error that a person sees.
pub const TOLERANCE: f64 = 0.01;

/// Smallest relative change of an amplitude that a person sees.
pub const VISIBLE: f64 = 0.05;

/// Largest relative frequency error that looks right.
pub const FREQUENCY_TOLERANCE: f64 = 0.01;
