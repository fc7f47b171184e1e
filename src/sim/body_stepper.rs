//! A body of one type with its state and its propagator.

use std::any::Any;
use std::rc::Rc;

use glam::DVec2;

use super::body::Body;
#[cfg(feature = "lab")]
use super::cores;
use super::exact_flow::ExactFlow;
use super::integrators::{
    AnySystem, Construct, Integrator, Method, Problem, StepFailure, Stepped, any_integrator,
    construct, problem,
};
use super::propagator::{AnyMethod, MethodPropagator, Propagator};
use super::reference::{Reference, is_beyond_reference};
use super::solver::Solver;
use super::state::{State, Vector, bytes_with_vectors};
use super::stepper::{Change, PlacedBody, RecordedTick, Stepper};
use super::system::{BodyClass, Counted, Coupling, EngineSettings, Logged, Pursuit, System};
use crate::sim::system::StateOf;

/// Puts `body` at its start, at time 0, under `solver`.
pub fn stepper<B: Body>(body: B, solver: Solver) -> Box<dyn Stepper> {
    let state = body.start();
    let placed = Placed { body: Counted::new(body), state, lost_before: 0.0, lost_time: 0.0 };
    with_solver(placed, solver, 0.0)
}

/// Puts a body under `solver` at time `t` (s).
pub(super) fn with_solver<B: Body>(placed: Placed<B>, solver: Solver, t: f64) -> Box<dyn Stepper> {
    if let Some(method) = solver.method() {
        let coupling = placed.body.coupling();
        if const { <B::Vector as Vector>::IS_SMALL } {
            return construct(method, coupling, UnderMethod { placed, solver });
        }
        let mut integrator = any_integrator(method, B::CLASS, coupling, &placed.state.q);
        if let Solver::With(_, other) = solver {
            integrator.set(other);
        }
        Box::new(BodyStepper { placed, propagator: AnyMethod { id: method.id, integrator } })
    } else if B::HAS_EXACT {
        let propagator = ExactFlow::new(&placed.state, t);
        Box::new(BodyStepper { placed, propagator })
    } else {
        let propagator = Reference::new(&placed.body.system, &placed.state, t);
        Box::new(BodyStepper { placed, propagator })
    }
}

/// A body that is put under a method, with what the solver sets of it.
struct UnderMethod<B: Body> {
    placed: Placed<B>,
    solver: Solver,
}

impl<B: Body> Construct<Counted<B>> for UnderMethod<B> {
    type Output = Box<dyn Stepper>;

    const CLASS: Option<BodyClass> = Some(B::CLASS);

    #[inline(always)]
    fn of<I: Integrator<Counted<B>> + Clone + 'static>(
        self,
        new: impl FnOnce(&B::Vector) -> I,
    ) -> Self::Output {
        let Self { placed, solver } = self;
        let mut integrator = new(&placed.state.q);
        if let Solver::With(_, other) = solver {
            integrator.set(other);
        }
        Box::new(BodyStepper { placed, propagator: MethodPropagator(integrator) })
    }
}

/// The stepper of a body. Monomorphic, so that force law and method are compiled into one loop.
#[derive(Clone)]
struct BodyStepper<B: Body, D> {
    placed: Placed<B>,
    propagator: D,
}

impl<B: Body, D: Propagator<B>> BodyStepper<B, D> {
    /// Advances on the calling thread.
    #[inline]
    fn advance_here(&mut self, t: f64, h: f64, substeps: u32) -> Stepped {
        let Self { placed: Placed { body, state, lost_before, lost_time }, propagator } = self;
        let stepped = propagator.step(body, t, h, substeps, state);
        let lost = propagator.lost_time();
        if lost > 0.0 {
            *lost_time = *lost_before + lost;
        }
        stepped
    }
}

impl<B: Body, D: Propagator<B> + Clone> Stepper for BodyStepper<B, D> {
    fn advance(&mut self, t: f64, h: f64, substeps: u32) -> Stepped {
        StepFailure::check_step(t, h, substeps)?;
        #[cfg(feature = "lab")]
        if self.placed.body.coupling() == Coupling::Few && cores::is_large(self.placed.q().len()) {
            let mut stepped = Ok(());
            cores::enter(&mut || stepped = self.advance_here(t, h, substeps));
            return stepped;
        }
        self.advance_here(t, h, substeps)
    }

    fn change(&mut self, t: f64, change: Change<'_>) -> bool {
        let Self { placed: Placed { body, state, .. }, propagator } = self;
        propagator.jump(t, change, &mut body.system, state)
    }

    fn placed(&self) -> &(dyn PlacedBody + 'static) {
        &self.placed
    }

    fn memory(&self) -> &dyn Any {
        &self.propagator
    }

    fn boxed_clone(&self) -> Box<dyn Stepper> {
        Box::new(self.clone())
    }
}

/// A body and its state.
pub(super) struct Placed<B: Body> {
    pub(super) body: Counted<B>,
    pub(super) state: StateOf<B>,
    /// The time in seconds that methods left out of their steps: those before the present solver, and all.
    lost_before: f64,
    lost_time: f64,
}

impl<B: Body> Clone for Placed<B> {
    /// Apart from the methods, which would each have a copy of it.
    #[inline(never)]
    fn clone(&self) -> Self {
        let Self { body, state, lost_before, lost_time } = self;
        Self {
            body: body.clone(),
            state: state.clone(),
            lost_before: *lost_before,
            lost_time: *lost_time,
        }
    }
}

impl<B: Body> PlacedBody for Placed<B> {
    fn q(&self) -> &[f64] {
        self.state.q.components()
    }
    fn v(&self) -> &[f64] {
        self.state.v.components()
    }

    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        let mut at = self.state.clone();
        write(&mut at, q, v);
        let mut acceleration = self.state.q.clone();
        self.body.system.acceleration(t, &at.q, &at.v, &mut acceleration);
        a.copy_from_slice(acceleration.components());
    }

    fn record(
        &self,
        memory: &dyn Any,
        method: &Method,
        t: f64,
        h: f64,
        substeps: u32,
    ) -> Option<RecordedTick> {
        let log = Rc::default();
        let system = problem(Logged { system: self.body.system.clone(), log: Rc::clone(&log) });
        let mut state = self.state.clone();
        let stepped = if const { <B::Vector as Vector>::IS_SMALL } {
            let of = Recording { system: &system, memory, state: &mut state, t, h, substeps };
            construct(method, system.coupling(), of)?
        } else {
            let AnyMethod { id, integrator } = memory.downcast_ref::<AnyMethod<B::Vector>>()?;
            let system: AnySystem<'_, B::Vector> = &system;
            let step = || integrator.boxed_clone().steps(&system, t, h, substeps, &mut state);
            (*id == method.id).then(step)?
        };
        let State { q, v } = state;
        let landing = stepped.map(|()| [q, v].map(|vector| vector.components().to_vec()));
        Some(RecordedTick { evaluations: log.take(), landing })
    }

    fn evaluations(&self) -> u64 {
        self.body.evaluations()
    }
    fn lost_time(&self) -> f64 {
        self.lost_time
    }
    fn is_linear(&self) -> bool {
        self.body.system.is_linear()
    }
    fn is_angle(&self, coordinate: usize) -> bool {
        self.body.system.is_angle(coordinate)
    }
    fn is_beyond_reference(&self) -> bool {
        is_beyond_reference(&self.body.system)
    }
    fn coupling(&self) -> Coupling {
        self.body.coupling()
    }

    fn is_closed_form_of(&self, memory: &dyn Any) -> bool {
        truth::<B>(memory).is_some_and(Propagator::is_closed_form)
    }

    fn truth_error_of(&self, memory: &dyn Any) -> Option<[f64; 2]> {
        truth::<B>(memory)?.truth_error(&self.body, &self.state)
    }

    fn energy(&self) -> Option<f64> {
        self.body.system.energy(&self.state)
    }
    fn kinetic_energy(&self) -> Option<f64> {
        self.body.system.kinetic_energy(&self.state)
    }
    fn mechanical_energy(&self) -> Option<[f64; 2]> {
        self.body.system.mechanical_energy(&self.state)
    }

    fn pursuit(&self, t: f64) -> Option<Pursuit<f64>> {
        let Pursuit { target, rate, order, is_still } = Pursuit::of(&self.body.system, t)?;
        Some(Pursuit { target: target.components()[0], rate, order, is_still })
    }
    fn engine_settings(&self, t: f64) -> EngineSettings {
        EngineSettings::of(&self.body.system, t, &self.state, &mut self.state.q.clone())
    }

    fn place(&self) -> DVec2 {
        self.body.system.place(&self.state.q)
    }
    fn body(&self) -> &dyn Any {
        &self.body.system
    }

    fn with_solver(&self, solver: Solver, t: f64) -> Box<dyn Stepper> {
        with_solver(Self { lost_before: self.lost_time, ..self.clone() }, solver, t)
    }

    fn bytes_with(&self, memory: &dyn Any) -> usize {
        let own = bytes_with_vectors(self, self.q()) + self.body.system.heap_bytes();
        let method = memory.downcast_ref::<AnyMethod<B::Vector>>();
        let boxed = method.map_or(0, |method| bytes_with_vectors(&*method.integrator, self.q()));
        let truth = truth::<B>(memory).map_or(0, Propagator::heap_bytes);
        own + bytes_with_vectors(memory, self.q()) + boxed + truth
    }
}

/// The propagator of a truth; `None` for a method.
fn truth<B: Body>(memory: &dyn Any) -> Option<&dyn Propagator<B>> {
    let exact = memory.downcast_ref::<ExactFlow<B::Vector>>().map(|truth| truth as _);
    let reference = || memory.downcast_ref::<Reference<B::Vector>>().map(|truth| truth as _);
    exact.or_else(reference)
}

/// A tick to take with a copy of a method's memory.
struct Recording<'a, V: Vector> {
    system: &'a Problem<V>,
    memory: &'a dyn Any,
    state: &'a mut State<V>,
    t: f64,
    h: f64,
    substeps: u32,
}

impl<V: Vector> Construct<Problem<V>> for Recording<'_, V> {
    type Output = Option<Stepped>;

    fn of<I: Integrator<Problem<V>> + Clone + 'static>(
        self,
        _new: impl FnOnce(&V) -> I,
    ) -> Self::Output {
        // An integrator's type depends on the vector and not on the system, so that the one that steps
        // the body can step a problem too.
        let MethodPropagator(integrator) = self.memory.downcast_ref::<MethodPropagator<I>>()?;
        let Self { system, state, t, h, substeps, .. } = self;
        Some(integrator.clone().steps(system, t, h, substeps, state))
    }
}

fn write<V: Vector>(state: &mut State<V>, q: &[f64], v: &[f64]) {
    state.q.components_mut().copy_from_slice(q);
    state.v.components_mut().copy_from_slice(v);
}
