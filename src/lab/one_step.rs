//! The anatomy of the selected method's next tick: where it evaluates the force, what it finds there, where it lands, and
//! where the true motion from the same state lands. It is taken on copies, so that the run is not disturbed.

pub use formulas::{FORMULAS, Formula};

use super::lab::Lab;
use super::lane::{Lane, LaneBody};
use super::lane_spec::LaneSpec;
use crate::sim::Solver;
use crate::sim::stability::Tick;

mod formulas;

/// Points on the true motion over the tick: enough for it to look smooth if it makes less than a turn.
const EXACT_POINTS: u32 = 48;

/// A tick of a body in the phase plane of its first coordinate. Points are coordinate and velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct OneStep {
    /// The method with its substeps.
    pub spec: LaneSpec,
    /// The number of the tick at its start.
    pub tick: u64,
    /// Its length in seconds.
    pub h: f64,
    /// The present state.
    pub from: [f64; 2],
    /// Every evaluation of the force, in order.
    pub evaluations: Vec<Slope>,
    /// Where the method lands; `None` if it fails.
    pub landing: Option<[f64; 2]>,
    /// The true motion from the present state, up to the end of the tick; empty if it is not known.
    pub exact: Vec<[f64; 2]>,
    /// The weighted slopes added up, from the present state to the landing; empty if the landing is no such sum.
    pub chain: Vec<[f64; 2]>,
}

/// An evaluation of the force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// When, as a part of the tick.
    pub when: f64,
    /// The state in which the force was evaluated.
    pub at: [f64; 2],
    /// The derivative there, per second.
    pub slope: [f64; 2],
}

impl OneStep {
    /// Where the true motion lands.
    pub fn exact_landing(&self) -> Option<[f64; 2]> {
        self.exact.last().copied()
    }

    /// How its method is written.
    pub fn formula(&self) -> Option<&'static Formula> {
        FORMULAS.iter().find(|formula| formula.method == self.spec.method.id)
    }
}

impl Lab {
    /// What the selected lane is about to do with the displayed body. `None` if the body has halted.
    pub fn one_step(&self) -> Option<OneStep> {
        let (entrant, race) = (self.selected(), self.race());
        let spec = LaneSpec { substeps: entrant.lane.substeps(), ..self.entries()[entrant.entry] };
        let h = 1.0 / f64::from(race.tick_hz());
        let tick = Tick { t: race.t(), h, substeps: spec.substeps };
        one_step(&entrant.lane.bodies()[self.display().body], spec, race.tick(), tick)
    }

    /// The evaluations in the next tick of the lane at this place among the entrants.
    pub fn evaluations_of_next_tick(&self, place: usize) -> u64 {
        let (race, mut lane) = (self.race(), self.race().entrants()[place].lane.clone());
        let before = lane.evaluations();
        lane.tick(race.tick(), race.t(), 1.0 / f64::from(race.tick_hz()));
        lane.evaluations() - before
    }
}

/// A tick of one body of a lane.
fn one_step(body: &LaneBody, spec: LaneSpec, number: u64, tick: Tick) -> Option<OneStep> {
    if body.halted().is_some() {
        return None;
    }
    let recorded = body.stepper.recorded(spec.method, tick.t, tick.h, tick.substeps)?;
    let from = [body.stepper.q()[0], body.stepper.v()[0]];
    let evaluation = |evaluation: crate::sim::Evaluation| Slope {
        when: (evaluation.t - tick.t) / tick.h,
        at: [evaluation.q[0], evaluation.v[0]],
        slope: [evaluation.v[0], evaluation.a[0]],
    };
    let mut step = OneStep {
        spec,
        tick: number,
        h: tick.h,
        from,
        evaluations: recorded.evaluations.into_iter().map(evaluation).collect(),
        landing: recorded.landing.ok().map(|[q, v]| [q[0], v[0]]),
        exact: exact(body, tick),
        chain: Vec::new(),
    };
    step.chain = chain(&step);
    Some(step)
}

/// The true motion from the present state.
fn exact(body: &LaneBody, tick: Tick) -> Vec<[f64; 2]> {
    let mut truth = body.stepper.with_solver(Solver::Truth, tick.t);
    let part = tick.h / f64::from(EXACT_POINTS);
    let mut points = vec![[truth.q()[0], truth.v()[0]]];
    for i in 0..EXACT_POINTS {
        if truth.advance(tick.t + part * f64::from(i), part, 1).is_err() {
            return Vec::new();
        }
        points.push([truth.q()[0], truth.v()[0]]);
    }
    points
}

/// The present state with one weighted slope after the other added.
fn chain(step: &OneStep) -> Vec<[f64; 2]> {
    let weights = step.formula().map_or(&[][..], |formula| formula.weights);
    if step.spec.substeps != 1 || weights.is_empty() || weights.len() != step.evaluations.len() {
        return Vec::new();
    }
    let mut at = step.from;
    let slopes = step.evaluations.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
    let ends = slopes.map(|(Slope { slope, .. }, weight)| {
        at = std::array::from_fn(|i| at[i] + step.h * weight * slope[i]);
        at
    });
    std::iter::once(step.from).chain(ends).collect()
}

impl Lane {
    /// The time in nanoseconds of a tick, by a clock that says how many have passed: the least over `runs` runs of
    /// `ticks` ticks each, on copies. `None` if a body halts.
    pub fn ns_per_tick(
        &self,
        (tick, t, h): (u64, f64, f64),
        ticks: u32,
        runs: u32,
        clock: impl Fn() -> u64,
    ) -> Option<f64> {
        let mut least = f64::INFINITY;
        for _ in 0..runs {
            let mut lane = self.clone();
            let start = clock();
            for i in 0..ticks {
                lane.tick(tick + u64::from(i), t + h * f64::from(i), h);
            }
            let passed = clock().saturating_sub(start);
            if lane.halted().is_some() {
                return None;
            }
            least = least.min(passed as f64 / f64::from(ticks));
        }
        least.is_finite().then_some(least)
    }
}

#[cfg(test)]
mod tests;
