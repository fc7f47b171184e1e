//! One body under one solver, followed from its start, and the work of that.

use super::truth::{BodyTruth, tick_after};
use crate::lab::action::Action;
use crate::lab::follow::{Follow, Ticked};
use crate::lab::lane::advance_checked;
use crate::lab::scene::Scripted;
use crate::sim::bodies::Coordinates;
use crate::sim::integrators::{Family, StepFailure};
use crate::sim::{Solver, Stepper};

/// The work of a tick beside its evaluations, for each coordinate: comparing it with the truth, and its energy.
const WORK_OF_TICK: u64 = 4;

/// The number of coordinates above which an implicit method spends more work on its matrix than on evaluations.
const SMALL_MATRIX: u64 = 20;

/// Ticks between two checks of the work done, for a body of one coordinate.
const TICKS_PER_LOOK: u64 = 64;

/// The work of `evaluations` evaluations of a body of `n` coordinates, in evaluations of one.
pub(super) fn work_of(evaluations: u64, n: u64, solver: Solver) -> u64 {
    let has_matrix = solver
        .method()
        .is_some_and(|method| matches!(method.family, Family::Implicit | Family::Linearised));
    let matrix = if has_matrix { n / SMALL_MATRIX } else { 0 };
    evaluations.saturating_mul(n * (1 + matrix))
}

/// A body that is stepped alone.
pub(super) struct FollowedBody {
    pub(super) stepper: Box<dyn Stepper>,
    coordinates: Coordinates,
    solver: Solver,
    substeps: u32,
    /// The work that its truth has counted.
    counted: u64,
}

impl BodyTruth {
    /// The body at its start under `solver`.
    pub(super) fn body_under(&self, solver: Solver, substeps: u32) -> FollowedBody {
        let (stepper, coordinates) = (self.start(solver), self.coordinates());
        FollowedBody { stepper, coordinates, solver, substeps, counted: 0 }
    }

    /// `body` before its first tick at this rate, with the inputs of the script.
    pub(super) fn follow<B: Ticked>(&self, body: B, tick_hz: u32) -> Follow<'static, B> {
        let script = self.inputs.iter().map(|input| Scripted {
            tick: tick_after(input.t, tick_hz),
            action: input.action.clone(),
        });
        Follow::new(body, tick_hz).with_script(script.collect::<Vec<_>>())
    }
}

impl FollowedBody {
    /// The work done in this many ticks, in evaluations of one coordinate.
    fn work(&self, ticks: u64) -> u64 {
        let (n, evaluations) = (self.stepper.q().len() as u64, self.stepper.evaluations());
        let steps = match self.stepper.is_sparse() {
            true => evaluations.saturating_mul(n),
            false => work_of(evaluations, n, self.solver),
        };
        steps.saturating_add(WORK_OF_TICK * n * ticks)
    }

    /// Whether `work` was done in its `ticks` ticks since work was last counted. It looks at some ticks only.
    pub(super) fn has_worked(&self, work: u64, ticks: u64) -> bool {
        self.has_worked_more(self.counted.saturating_add(work), ticks)
    }

    /// Counts the work done in its `ticks` ticks as work on `truth`, so far as it was not counted.
    pub(super) fn count_work(&mut self, truth: &BodyTruth, ticks: u64) {
        let work = self.work(ticks);
        truth.count_work(work - self.counted);
        self.counted = work;
    }
}

impl Ticked for FollowedBody {
    fn act(&mut self, _: u64, t: f64, action: &Action) {
        action.apply_to(&mut *self.stepper, t);
    }

    fn tick(&mut self, _: u64, t: f64, h: f64) -> Result<(), StepFailure> {
        advance_checked(&mut *self.stepper, &self.coordinates, (t, h), self.substeps)
    }

    fn has_worked_more(&self, than: u64, ticks: u64) -> bool {
        let ticks_per_look = (TICKS_PER_LOOK / self.coordinates.len() as u64).max(1);
        ticks.is_multiple_of(ticks_per_look) && self.work(ticks) > than
    }
}
