//! Steps copies one by one, on all cores, under methods that need a whole body.

use std::ops::Range;

use super::{Advance, Chunks, Copies, Ticks};
use crate::integrators::{Integrator, Problem, fresh};
use crate::state::State;
use crate::stepper::Solver;

/// Neighbouring copies, each with its own integrator.
struct OneByOne<C> {
    copies: C,
    integrators: Vec<Box<dyn Integrator<Problem<f64>>>>,
}

/// The number of copies that a thread handles at a time. A step of an implicit method takes a microsecond.
const GRAIN: usize = 64;

/// Builds the stepper of `count` copies under `solver`, one by one; `None` for the truth.
pub(super) fn one_by_one<C: Copies>(
    copies: &C,
    solver: Solver,
    count: usize,
) -> Option<Box<dyn Advance>> {
    let method = solver.method()?;
    let own = |_| {
        let mut own = fresh(method);
        if let Some(other) = solver.setting() {
            own.set(other);
        }
        own
    };
    let part = |part: Range<usize>| {
        Box::new(OneByOne { copies: copies.clone(), integrators: part.map(own).collect() }) as _
    };
    Some(Box::new(Chunks::new(GRAIN, count, part)))
}

impl<C: Copies> Advance for OneByOne<C> {
    fn advance(&mut self, ticks: Ticks, q: &mut [f64], v: &mut [f64]) {
        let Self { copies, integrators } = self;
        let system = copies.alone();
        for ((q, v), own) in q.iter_mut().zip(v).zip(integrators) {
            let mut state = State { q: *q, v: *v };
            let mut ticks_left = ticks.first..ticks.first + ticks.count;
            let gave_up = ticks_left.any(|tick| {
                let (t, h) = (ticks.t(tick), ticks.h());
                let is_finite = state.q.is_finite() && state.v.is_finite();
                !is_finite || own.steps(&system, t, h, ticks.substeps, &mut state).is_err()
            });
            (*q, *v) = if gave_up { (f64::NAN, f64::NAN) } else { (state.q, state.v) };
        }
    }

    fn reset(&mut self) {
        self.integrators.iter_mut().for_each(|own| own.reset());
    }
}
