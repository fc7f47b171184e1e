//! Follows one body under one solver from its start, and counts the work.

use std::ops::ControlFlow;

use super::BodyTruth;
use crate::run::race::{StopReason, Ticked, Ticker, advance_checked};
use crate::scene::Action;
use crate::sim::bodies::Coordinates;
use crate::sim::integrators::{Family, StepFailure};
use crate::sim::stability::Tick;
use crate::sim::{Solver, Stepper, TickRate};
use crate::swings::Swings;

/// Work of a tick besides its evaluations, per coordinate, for the comparison with the truth and the energy.
const WORK_OF_TICK: u64 = 4;

/// Number of coordinates above which an implicit method spends more work on its matrix than on evaluations.
const SMALL_MATRIX: u64 = 20;

/// Number of ticks between two checks of the work, for a body with one coordinate.
const TICKS_PER_LOOK: u64 = 64;

/// Returns the work of `evaluations` evaluations of a body with `n` coordinates, in evaluations of one coordinate.
pub(crate) fn work_of(evaluations: u64, n: u64, solver: Solver) -> u64 {
    let has_matrix = solver
        .method()
        .is_some_and(|method| matches!(method.family, Family::Implicit | Family::Linearised));
    let matrix = if has_matrix { n / SMALL_MATRIX } else { 0 };
    evaluations.saturating_mul(n * (1 + matrix))
}

/// A body that is stepped alone.
pub(crate) struct FollowedBody {
    pub(crate) stepper: Box<dyn Stepper>,
    coordinates: Coordinates,
    solver: Solver,
    substeps: u32,
    /// Initial energy plus the energy that inputs have added, in joules.
    pub(crate) base_j: f64,
    /// The body's swings, if they are measured.
    pub(crate) swings: Option<Swings>,
    /// Work per tick of a true motion, whose work is not measured in any other way.
    work_of_moment: u64,
    /// Work that the meter has counted.
    counted: u64,
}

/// A body followed from its start, with the inputs of the script.
pub(crate) type FollowedRun = Ticker<'static, FollowedBody>;

impl BodyTruth {
    /// Returns the body before its first tick, under `solver` at this rate.
    pub(crate) fn follow(&self, solver: Solver, substeps: u32, tick_hz: TickRate) -> FollowedRun {
        let mut body = FollowedBody {
            stepper: self.start(solver),
            coordinates: self.coordinates(),
            solver,
            substeps,
            base_j: 0.0,
            swings: None,
            work_of_moment: self.work_of_moment(),
            counted: 0,
        };
        body.base_j = body.energy();
        Ticker::new(body, tick_hz).with_script(self.inputs.clone())
    }

    /// Continues until `end` ticks are made, or `see` stops the run.
    pub(crate) async fn run_until(
        &self,
        run: &mut FollowedRun,
        end: u64,
        mut see: impl FnMut(&FollowedBody, u64) -> ControlFlow<()>,
    ) -> StopReason {
        loop {
            let (left, mut is_paused) = (self.meter.work_left(), false);
            let stop = run.run(end, |body, tick| {
                see(body, tick)?;
                is_paused = body.has_worked_more(body.counted.saturating_add(left), tick);
                if is_paused { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            let work = run.body.work(run.ticks());
            let new = work - run.body.counted;
            run.body.counted = work;
            self.meter.count(new).await;
            if !is_paused {
                return stop;
            }
        }
    }
}

impl FollowedBody {
    /// Returns the work of this many ticks, in evaluations of one coordinate.
    fn work(&self, ticks: u64) -> u64 {
        if self.solver == Solver::Truth {
            return self.work_of_moment * ticks;
        }
        let (n, evaluations) = (self.stepper.q().len() as u64, self.stepper.evaluations());
        let steps = match self.stepper.is_sparse() {
            true => evaluations.saturating_mul(n),
            false => work_of(evaluations, n, self.solver),
        };
        steps.saturating_add(WORK_OF_TICK * n * ticks)
    }

    /// Returns the kinetic and potential energy in joules.
    pub(crate) fn energies(&self) -> [f64; 2] {
        self.stepper.mechanical_energy().unwrap_or([0.0; 2])
    }

    /// Returns the total energy in joules.
    pub(crate) fn energy(&self) -> f64 {
        let [kinetic, potential] = self.energies();
        kinetic + potential
    }
}

impl Ticked for FollowedBody {
    fn act(&mut self, _: u64, t: f64, action: &Action) {
        let before = self.energy();
        if let Some(swings) = &mut self.swings {
            swings.finish_before_input(&*self.stepper);
        }
        action.apply_to(&mut *self.stepper, t);
        if let Some(swings) = &mut self.swings {
            swings.resume_after_input(&*self.stepper, t);
        }
        self.base_j += self.energy() - before;
    }

    fn tick(&mut self, _: u64, t: f64, h: f64) -> Result<(), StepFailure> {
        let Self { stepper, coordinates, solver, substeps, swings, .. } = self;
        let Some(swings) = swings else {
            return advance_checked(&mut **stepper, coordinates, (t, h), *substeps);
        };
        let (step, times) = Tick { t, h, substeps: *substeps }.repeated(solver.method());
        for i in 0..times {
            let t = t + f64::from(i) * step.h;
            advance_checked(&mut **stepper, coordinates, (t, step.h), step.substeps)?;
            swings.add(&**stepper, t + step.h);
        }
        Ok(())
    }

    fn has_worked_more(&self, than: u64, ticks: u64) -> bool {
        let ticks_per_look = (TICKS_PER_LOOK / self.coordinates.len() as u64).max(1);
        ticks.is_multiple_of(ticks_per_look) && self.work(ticks) > than
    }
}

/// Fraction of a tick by which the end of a span may be early, because its time is rounded.
const ON_TIME: f64 = 1e-6;

/// Returns the number of whole ticks at this rate in `seconds`.
pub(crate) fn ticks(seconds: f64, tick_hz: TickRate) -> u64 {
    (seconds * f64::from(tick_hz) + ON_TIME).floor() as u64
}
