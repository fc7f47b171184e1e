//! The anatomy of the selected method's next tick, with its force evaluations, its landing point, and the landing point
//! of the true motion from the same state. It is computed on copies and leaves the run undisturbed.

use crate::run::race::LaneBody;
use crate::scene::LaneSpec;
use crate::sim::Solver;
use crate::sim::numerics::bisect;
use crate::sim::stability::Tick;

/// Number of points on the true motion over the tick, which is enough for a smooth curve if the motion makes less than
/// a turn.
const EXACT_POINTS: u32 = 48;

/// Number of points of an orbit across a plot, and number of bisections to find a turning point.
const ORBIT_POINTS: u32 = 96;
const HALVINGS: u32 = 40;

/// A tick of a body in the phase plane of the body's first coordinate. A point is a coordinate and a velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct OneStep {
    /// The method with its substeps.
    pub spec: LaneSpec,
    /// Index of the tick at which the step starts.
    pub tick: u64,
    /// Length of the tick in seconds.
    pub h: f64,
    /// The current state.
    pub from: [f64; 2],
    /// Every evaluation of the force, in order.
    pub evaluations: Vec<Slope>,
    /// The state after the tick; `None` if the method fails.
    pub landing: Option<[f64; 2]>,
    /// The true motion from the current state to the end of the tick; empty if unknown.
    pub exact: Vec<[f64; 2]>,
    /// The running sum of the weighted slopes, from the current state to the landing; empty if the landing is not
    /// such a sum.
    pub chain: Vec<[f64; 2]>,
    /// Relative change of the swing by the tick, and by the same tick in twice the number of steps. `None` if the body
    /// is not linear, does not swing about 0 or does not conserve its energy.
    pub growth: Option<[f64; 2]>,
}

/// An evaluation of the force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// Time as a fraction of the tick.
    pub when: f64,
    /// State in which the force was evaluated.
    pub at: [f64; 2],
    /// Derivative of that state, per second.
    pub slope: [f64; 2],
}

impl OneStep {
    /// Returns the end of the true motion.
    pub fn exact_landing(&self) -> Option<[f64; 2]> {
        self.exact.last().copied()
    }
}

/// Returns the anatomy of the tick with this number; `None` if the body has halted.
pub fn one_step(body: &LaneBody, spec: LaneSpec, number: u64, tick: Tick) -> Option<OneStep> {
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
        growth: growth(body, spec, tick),
    };
    step.chain = chain(&step);
    Some(step)
}

/// Returns the relative change of the swing by a tick; see [`OneStep::growth`].
fn growth(body: &LaneBody, spec: LaneSpec, Tick { t, h, substeps }: Tick) -> Option<[f64; 2]> {
    let stepper = &body.stepper;
    let mut at_rest = [0.0];
    if body.coordinates().len() > 1 || !stepper.is_linear() {
        return None;
    }
    stepper.acceleration(t, &[0.0], &[0.0], &mut at_rest);
    let before = stepper.energy().filter(|&energy| energy > 0.0 && at_rest == [0.0])?;
    let mut copy = stepper.clone();
    let mut by = |substeps: u32| {
        let [q, v] = stepper.recorded(spec.method, t, h, substeps)?.landing.ok()?;
        copy.set(t, &q, &v);
        Some((copy.energy()? / before).sqrt() - 1.0)
    };
    Some([by(substeps)?, by(2 * substeps)?])
}

/// Returns lines through the states with the same energy as `through`, for coordinates from `low` to `high`. The result
/// is empty if the body has several coordinates or conserves no energy.
pub fn orbit(
    body: &LaneBody,
    t: f64,
    through: [f64; 2],
    [low, high]: [f64; 2],
) -> Vec<Vec<[f64; 2]>> {
    if body.coordinates().len() != 1 {
        return Vec::new();
    }
    let mut copy = body.stepper.clone();
    let mut energy = |q: f64, v: f64| {
        copy.set(t, &[q], &[v]);
        copy.energy()
    };
    let mut speed = |q: f64| {
        let (potential, kinetic) = (energy(q, 0.0)?, energy(q, 1.0)? - energy(q, 0.0)?);
        Some(((energy(through[0], through[1])? - potential) / kinetic).sqrt())
    };
    let part = |i: u32| low + (high - low) * f64::from(i) / f64::from(ORBIT_POINTS);
    let mut pieces = Vec::new();
    let mut piece: Vec<[f64; 2]> = Vec::new();
    for i in 0..=ORBIT_POINTS {
        let Some(v) = speed(part(i)) else { return Vec::new() };
        let was_seen = !piece.is_empty();
        if i > 0 && was_seen != v.is_finite() {
            // The orbit turns between these two points.
            let ends = if was_seen { [i - 1, i] } else { [i, i - 1] };
            let is_inside = |q: f64| speed(q).is_some_and(f64::is_finite);
            let [inside, _] = bisect(ends.map(part), HALVINGS, is_inside);
            piece.push([inside, 0.0]);
        }
        if v.is_finite() {
            piece.push([part(i), v]);
        } else if was_seen {
            pieces.push(std::mem::take(&mut piece));
        }
    }
    pieces.push(piece);
    let mirrored = |line: &Vec<[f64; 2]>| line.iter().map(|[q, v]| [*q, -v]).collect();
    let below: Vec<Vec<[f64; 2]>> = pieces.iter().map(mirrored).collect();
    pieces.into_iter().chain(below).filter(|line| line.len() > 1).collect()
}

/// Returns the true motion from the current state.
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

/// Returns the running sum of the weighted slopes, from the current state.
fn chain(step: &OneStep) -> Vec<[f64; 2]> {
    let weights = step.spec.method.weights;
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
