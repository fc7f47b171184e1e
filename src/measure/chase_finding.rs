//! Findings on a body that follows a target: its half-life, its overshoot and its stability.

use std::fmt;

use super::pace::Pace;
use super::truth::BodyTruth;
use crate::run::race::Chase;
use crate::sim::Solver;
use crate::sim::number::{round, significant};
use crate::sim::numerics::bisect;

/// How a body approaches a fixed target, under a method and in truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChaseFinding {
    /// Time in seconds to cover half of the way; `None` if the body does not cover it.
    pub half_life_s: Option<f64>,
    /// True half-life in seconds.
    pub true_half_life_s: Option<f64>,
    /// Distance beyond the target, in percent of the way.
    pub overshoot_percent: f64,
    /// The rate times the step length, and the method's limit for this product, if the limit is exceeded.
    pub beyond_limit: Option<[f64; 2]>,
}

/// Number of moments that a search for the true half-life samples before narrowing it down. There is only one crossing,
/// because a true follower does not turn back.
const LOOKS: u32 = 1 << 10;

/// Smaller relative errors of the half-life are not mentioned.
const SLIGHT: f64 = 0.01;

/// Smaller overshoots in percent are not mentioned.
const FAINT_PERCENT: f64 = 0.1;

impl ChaseFinding {
    pub(super) fn of(
        truth: &BodyTruth,
        Pace { spec, tick_hz }: Pace,
        chase: Option<&Chase>,
    ) -> Option<Self> {
        let chase = chase?;
        let rate = truth.start(Solver::Truth).pursuit(0.0)?.rate;
        let step = rate / f64::from(tick_hz) / f64::from(spec.substeps);
        let limit = spec.method.only.and(spec.method.stability_limit);
        Some(Self {
            half_life_s: chase.half_life_s(),
            true_half_life_s: true_half_life_s(truth),
            overshoot_percent: chase.overshoot_percent(),
            beyond_limit: limit.filter(|&limit| step > limit).map(|limit| [step, limit]),
        })
    }
}

/// Returns the true half-life in seconds, if it is within the horizon.
fn true_half_life_s(truth: &BodyTruth) -> Option<f64> {
    let start = truth.start(Solver::Truth);
    let target = start.pursuit(0.0)?.target;
    let first = target - start.q()[0];
    let is_past = |t: f64| {
        let mut body = start.clone();
        body.advance(0.0, t, 1).is_ok() && (target - body.q()[0]) / first <= 0.5
    };
    let moment = |look: u32| truth.horizon_s * f64::from(look) / f64::from(LOOKS);
    let look = (1..=LOOKS).find(|&look| is_past(moment(look)))?;
    let [_, past] = bisect([moment(look - 1), moment(look)], 50, |t| !is_past(t));
    Some(past)
}

impl ChaseFinding {
    /// Returns the half-life in seconds and in words, which is the key figure of a body that approaches a target.
    pub(super) fn number(&self) -> Option<(f64, String)> {
        let half = self.half_life_s.filter(|_| self.beyond_limit.is_none())?;
        Some((half, format!("half-life {}", milliseconds(half))))
    }
}

fn milliseconds(seconds: f64) -> String {
    format!("{} ms", round(1e3 * seconds, 3))
}

impl fmt::Display for ChaseFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some([step, limit]) = self.beyond_limit {
            write!(f, "explodes, as k dt = {} is above {limit}", round(step, 3))?;
            return Ok(());
        }
        match (self.half_life_s, self.true_half_life_s) {
            (None, _) => f.write_str("never half-way")?,
            (Some(half), Some(wanted)) if (half / wanted - 1.0).abs() > SLIGHT => {
                write!(f, "half-life {}, not {}", milliseconds(half), milliseconds(wanted))?;
            }
            (Some(half), _) => write!(f, "half-life {}", milliseconds(half))?,
        }
        if self.overshoot_percent >= FAINT_PERCENT {
            write!(f, ", overshoots by {} %", significant(self.overshoot_percent, 2))?;
        }
        Ok(())
    }
}
