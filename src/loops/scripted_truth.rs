//! The exact solution at each time of display, the distance of the pictures from it, and the script that acts on both.

use std::sync::Arc;

use super::paced_lane::PacedLane;
use crate::run::race::{Lane, LaneBody};
use crate::scene::{Action, Scene};
use crate::sim::Solver;

/// The exact solution of a scene, stepped from one time of display to the next.
#[derive(Clone)]
pub(super) struct ScriptedTruth {
    lane: Lane,
    t: f64,
    script: TimedScript,
    errors: Vec<BodyError>,
}

/// Largest distance so far between the states of each body in two lanes, in the unit of the body's first coordinate.
#[derive(Default)]
pub(super) struct MaxDistances(Vec<f64>);

/// Errors of a body's pictures.
#[derive(Clone, Copy)]
struct BodyError {
    squares: f64,
    count: u64,
    /// Range of the first coordinate.
    range: [f64; 2],
}

impl BodyError {
    /// Returns half the range, if the body moves.
    fn amplitude(&self) -> Option<f64> {
        Some((self.range[1] - self.range[0]) / 2.0).filter(|half| *half > 0.0 && half.is_finite())
    }

    /// Returns the RMS distance in amplitudes.
    fn rms(&self) -> Option<f64> {
        Some((self.squares / self.count as f64).sqrt() / self.amplitude()?)
    }
}

impl ScriptedTruth {
    pub(super) fn new(scene: &Scene) -> Self {
        let lane = Lane::new(scene, Solver::Truth, 1);
        let none = BodyError { squares: 0.0, count: 0, range: [f64::INFINITY, f64::NEG_INFINITY] };
        let errors = lane.bodies().iter().map(|_| none).collect();
        Self { lane, t: 0.0, script: TimedScript::new(scene), errors }
    }

    /// Advances the exact solution to `t` (s), and adds the distance of every drawn body from its exact position.
    pub(super) fn compare(&mut self, t: f64, paced: &PacedLane) {
        while let Some((at, action)) = self.script.next_due(t) {
            self.advance(at);
            self.lane.act(0, at, &action);
        }
        self.advance(t);
        for (index, (body, error)) in self.lane.bodies().iter().zip(&mut self.errors).enumerate() {
            if body.halted().is_some() {
                continue;
            }
            let exact = body.stepper.q();
            let largest = distance(body, exact, &paced.drawn_coordinates(index));
            error.squares += largest * largest;
            error.count += 1;
            error.range = [error.range[0].min(exact[0]), error.range[1].max(exact[0])];
        }
    }

    /// Returns the body with this index in its exact state.
    pub(super) fn body(&self, body: usize) -> &LaneBody {
        &self.lane.bodies()[body]
    }

    /// Updates `furthest` with the distances between the bodies of two lanes.
    pub(super) fn update_max_distances(
        &self,
        furthest: &mut MaxDistances,
        one: &Lane,
        other: &Lane,
    ) {
        furthest.0.resize(one.bodies().len(), 0.0);
        let bodies = one.bodies().iter().zip(other.bodies()).zip(&mut furthest.0);
        for ((one, other), most) in bodies {
            *most = most.max(distance(one, one.stepper.q(), other.stepper.q()));
        }
    }

    /// Returns the largest distance of the worst body, in amplitudes.
    pub(super) fn in_amplitudes(&self, furthest: &MaxDistances) -> Option<f64> {
        let bodies = furthest.0.iter().zip(&self.errors);
        let shares = bodies.filter_map(|(most, error)| Some(most / error.amplitude()?));
        shares.reduce(f64::max)
    }

    fn advance(&mut self, t: f64) {
        if t > self.t {
            self.lane.tick(0, self.t, t - self.t);
            self.t = t;
        }
    }

    /// Returns the RMS distance of the worst body, in amplitudes.
    pub(super) fn position_error_rms(&self) -> Option<f64> {
        self.errors.iter().filter_map(BodyError::rms).reduce(f64::max)
    }
}

/// Returns the largest distance between two states of a body, over the coordinates in the unit of the first.
fn distance(body: &LaneBody, one: &[f64], other: &[f64]) -> f64 {
    let pairs = body.like_first(one).zip(body.like_first(other));
    pairs.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}

/// The actions of a script that are still to come.
#[derive(Clone)]
pub(super) struct TimedScript {
    /// Rows of the script, sorted by time in seconds.
    rows: Arc<[(f64, Action)]>,
    done: usize,
}

impl TimedScript {
    pub(super) fn new(scene: &Scene) -> Self {
        let rows = scene.timed_script().map(|(t, action)| (t, action.clone()));
        Self { rows: rows.collect(), done: 0 }
    }

    /// Takes the next action that is due by `t` (s), with its time.
    pub(super) fn next_due(&mut self, t: f64) -> Option<(f64, Action)> {
        let due = self.rows.get(self.done).filter(|(at, _)| *at <= t).cloned();
        self.done += usize::from(due.is_some());
        due
    }
}
