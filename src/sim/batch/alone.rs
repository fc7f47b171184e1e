//! Copies stepped each alone, on all cores: under methods that look at a body as a whole.

use rayon::prelude::*;

use super::copies::Copies;
use super::{Advance, Ticks};
use crate::sim::integrators::{Integrator, Tolerance, integrator};
use crate::sim::solver::Solver;
use crate::sim::state::State;
use crate::sim::system::System;

/// A system of one coordinate whose type is forgotten, so that all methods are compiled for it once.
type AnySystem = Box<dyn System<Vector = f64>>;

/// Copies with an integrator each.
pub(super) struct Alone<C> {
    copies: C,
    integrators: Vec<Box<dyn Integrator<AnySystem>>>,
}

/// The copies that a thread takes at a time: a step of an implicit method takes a microsecond.
const GRAIN: usize = 64;

impl<C: Copies> Alone<C> {
    /// `count` copies under `solver`; `None` under the truth.
    pub(super) fn new(copies: &C, solver: Solver, count: usize) -> Option<Self> {
        let method = solver.method()?;
        let own = |_| {
            let mut own: Box<dyn Integrator<AnySystem>> = integrator(method, &0.0);
            match solver {
                Solver::WithTolerance(_, tolerance) => {
                    own.set_tolerance(Tolerance::uniform(tolerance));
                }
                Solver::WithJoint(_, joint) => own.set_joint(joint),
                Solver::Method(_) | Solver::Truth => {}
            }
            own
        };
        Some(Self { copies: copies.clone(), integrators: (0..count).map(own).collect() })
    }
}

impl<C: Copies> Advance for Alone<C> {
    fn advance(&mut self, ticks: Ticks, q: &mut [f64], v: &mut [f64]) {
        let Self { copies, integrators } = self;
        let states = q.par_chunks_mut(GRAIN).zip(v.par_chunks_mut(GRAIN));
        let grains = states.zip(integrators.par_chunks_mut(GRAIN)).enumerate();
        grains.for_each(|(grain, ((q, v), integrators))| {
            for (n, ((q, v), own)) in q.iter_mut().zip(v).zip(integrators).enumerate() {
                let system = copies.alone(grain * GRAIN + n);
                let mut state = State { q: *q, v: *v };
                let mut ticks_left = ticks.first..ticks.first + ticks.count;
                let gave_up = ticks_left.any(|tick| {
                    let (t, h) = (ticks.t(tick), ticks.h());
                    let is_finite = state.q.is_finite() && state.v.is_finite();
                    !is_finite || own.steps(&system, t, h, ticks.substeps, &mut state).is_err()
                });
                (*q, *v) = if gave_up { (f64::NAN, f64::NAN) } else { (state.q, state.v) };
            }
        });
    }

    fn reset(&mut self) {
        self.integrators.iter_mut().for_each(|own| own.reset());
    }
}
