//! What a verdict says of a body that follows a target: its half-life, its overshoot, and its stability.

use std::fmt;

use super::truth::BodyTruth;
use crate::run::race::Chase;
use crate::scene::LaneSpec;
use crate::sim::number::{round, significant};
use crate::sim::numerics::bisect;
use crate::sim::{Solver, TickRate};

/// How a body closes on a target that stays, under a method and in truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChaseFinding {
    /// The time in seconds in which it covers half of the way; `None` if it does not.
    pub half_life_s: Option<f64>,
    /// The same in truth.
    pub true_half_life_s: Option<f64>,
    /// How far it goes beyond the target, in percent of the way.
    pub overshoot_percent: f64,
    /// The rate times the length of a step, if that is above the limit of the method, and that limit.
    pub beyond_limit: Option<[f64; 2]>,
}

/// Moments at which the true half-life is looked for before it is narrowed down. It is the first: a true follower does
/// not turn round.
const LOOKS: u32 = 1 << 10;

/// A relative error of the half-life below this is not told.
const SLIGHT: f64 = 0.01;

/// An overshoot below this percentage is not told.
const FAINT_PERCENT: f64 = 0.1;

impl ChaseFinding {
    pub(super) fn of(
        truth: &BodyTruth,
        spec: LaneSpec,
        tick_hz: TickRate,
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

/// The true half-life in seconds, if it is within the horizon.
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
    /// The half-life in seconds and in words: the one number of a body that closes on its target.
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
