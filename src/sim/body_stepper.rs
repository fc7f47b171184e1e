//! A body of one type with its state and its propagator.

use std::any::Any;

use glam::DVec2;

use super::body::{Body, Input};
use super::exact_flow::ExactFlow;
use super::exact_since_start::{ExactSinceStart, is_start};
use super::integrators::{Construct, Integrator, Method, StepFailure, Tolerance, construct};
use super::propagator::{Jump, MethodPropagator, Propagator};
use super::reference::{MOST_REFERENCE_WORK, Reference};
use super::solver::Solver;
use super::stepper::{RecordedTick, Stepper};
use super::system::{Counted, Counts, Pursuit, Recorded, State, Vector};

/// Puts `body` at its start, at time 0, under `solver`.
pub fn stepper<B: Body>(body: B, solver: Solver) -> Box<dyn Stepper> {
    let state = body.start();
    StepperParts { body: Counted::new(body), state, tolerance: None }.build(solver, 0.0)
}

/// What a stepper is built from.
struct StepperParts<B: Body> {
    body: Counted<B>,
    state: State<B::Vector>,
    /// Overrides the tolerance on the card of an adaptive method.
    tolerance: Option<Tolerance>,
}

impl<B: Body> StepperParts<B> {
    fn build(self, solver: Solver, t: f64) -> Box<dyn Stepper> {
        match solver {
            Solver::Method(method) => construct(method, self),
            Solver::WithTolerance(method, tolerance) => {
                construct(method, Self { tolerance: Some(Tolerance::uniform(tolerance)), ..self })
            }
            Solver::Truth if self.body.system.exact(0.0, &self.state).is_some() => {
                let propagator = ExactFlow::new(&self.state, t);
                self.with_propagator(propagator)
            }
            Solver::Truth if self.is_solved(t) => {
                let propagator = ExactSinceStart::new(&self.state);
                self.with_propagator(propagator)
            }
            Solver::Truth => {
                let propagator = Reference::new(&self.state);
                self.with_propagator(propagator)
            }
        }
    }

    /// Whether the body stands at its start, and knows its exact motion from there.
    fn is_solved(&self, t: f64) -> bool {
        let body = &self.body.system;
        is_start(body, t, &self.state) && body.exact_since_start(t, &mut self.state.clone())
    }

    fn with_propagator<D: Propagator<B>>(self, propagator: D) -> Box<dyn Stepper> {
        let Self { body, state, .. } = self;
        Box::new(BodyStepper { body, propagator, state })
    }
}

impl<B: Body> Construct<Counted<B>> for StepperParts<B> {
    type Output = Box<dyn Stepper>;

    fn of<I: Integrator<Counted<B>> + Clone + 'static>(
        self,
        new: impl FnOnce(&B::Vector) -> I,
    ) -> Self::Output {
        let mut integrator = new(&self.state.q);
        if let Some(tolerance) = self.tolerance {
            integrator.set_tolerance(tolerance);
        }
        self.with_propagator(MethodPropagator(integrator))
    }
}

/// A tick to record, with the method's memory in `propagator`.
struct Recording<'a, V: Vector> {
    system: Recorded<'a, V>,
    propagator: &'a dyn Any,
    state: State<V>,
    t: f64,
    h: f64,
    substeps: u32,
}

impl<'a, V: Vector> Construct<Recorded<'a, V>> for Recording<'a, V> {
    type Output = Option<RecordedTick>;

    fn of<I: Integrator<Recorded<'a, V>> + Clone + 'static>(
        self,
        _new: impl FnOnce(&V) -> I,
    ) -> Self::Output {
        // An integrator's type depends on the vector and not on the system, so that the one that steps
        // the body can step the recorded system too.
        let MethodPropagator(integrator) = self.propagator.downcast_ref::<MethodPropagator<I>>()?;
        let mut integrator = integrator.clone();
        let Self { system, mut state, t, h, substeps, .. } = self;
        let stepped = integrator.steps(&system, t, h, substeps, &mut state);
        let State { q, v } = state;
        let landing = stepped.map(|()| [q, v].map(|vector| vector.components().to_vec()));
        Some(RecordedTick { evaluations: system.into_evaluations(), landing })
    }
}

/// The stepper of a body. Monomorphic, so that force law and method are compiled into one loop.
#[derive(Clone)]
struct BodyStepper<B: Body, D> {
    body: Counted<B>,
    propagator: D,
    state: State<B::Vector>,
}

impl<B: Body, D: Propagator<B>> BodyStepper<B, D> {
    fn jump(
        &mut self,
        jump: Jump,
        t: f64,
        change: impl FnOnce(&mut B, &mut State<B::Vector>) -> bool,
    ) -> bool {
        self.propagator.jump(jump, t, &mut self.body.system, &mut self.state, change)
    }
}

impl<B: Body, D: Propagator<B>> Stepper for BodyStepper<B, D> {
    fn advance(&mut self, t: f64, h: f64, substeps: u32) -> Result<(), StepFailure> {
        self.propagator.advance(&self.body, t, h, substeps, &mut self.state)
    }

    fn q(&self) -> &[f64] {
        self.state.q.components()
    }
    fn v(&self) -> &[f64] {
        self.state.v.components()
    }
    fn set(&mut self, t: f64, q: &[f64], v: &[f64]) {
        self.jump(Jump::Placed, t, |_, state| {
            write(state, q, v);
            true
        });
    }

    fn input(&mut self, t: f64, input: Input) -> bool {
        self.jump(Jump::Pushed, t, |body, state| body.input(input, state))
    }

    fn set_parameter(&mut self, t: f64, place: usize, value: f64) -> bool {
        self.jump(Jump::Pushed, t, |body, _| body.set_parameter(place, value))
    }

    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        let mut at = self.state.clone();
        write(&mut at, q, v);
        let mut acceleration = self.state.q.clone();
        self.body.system.acceleration(t, &at.q, &at.v, &mut acceleration);
        a.copy_from_slice(acceleration.components());
    }

    fn recorded(&self, method: &Method, t: f64, h: f64, substeps: u32) -> Option<RecordedTick> {
        let system = Recorded::new(&self.body.system);
        let state = self.state.clone();
        let propagator = &self.propagator;
        construct(method, Recording { system, propagator, state, t, h, substeps })
    }

    fn counts(&self) -> Counts {
        self.body.counts()
    }
    fn is_linear(&self) -> bool {
        self.body.system.is_linear()
    }
    fn is_beyond_reference(&self) -> bool {
        self.body.system.reference_work() > MOST_REFERENCE_WORK
    }
    fn is_sparse(&self) -> bool {
        B::Vector::IS_SPARSE
    }
    fn is_closed_form(&self) -> bool {
        self.propagator.is_closed_form()
    }
    fn truth_error(&self) -> Option<[f64; 2]> {
        self.propagator.truth_error(&self.body, &self.state)
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
        let Pursuit { target, rate, order, is_still } = self.body.system.pursuit(t)?;
        Some(Pursuit { target: target.components()[0], rate, order, is_still })
    }

    fn place(&self) -> DVec2 {
        self.body.system.place(&self.state.q)
    }
    fn body(&self) -> &dyn Any {
        &self.body.system
    }

    fn with_solver(&self, solver: Solver, t: f64) -> Box<dyn Stepper> {
        let (body, state) = (self.body.clone(), self.state.clone());
        StepperParts { body, state, tolerance: None }.build(solver, t)
    }

    fn boxed_clone(&self) -> Box<dyn Stepper> {
        Box::new(self.clone())
    }

    fn bytes(&self) -> usize {
        // An upper bound: as if every field were a coordinate vector.
        let vectors = size_of::<Self>() / size_of::<B::Vector>();
        let vectors = vectors * self.state.q.heap_bytes();
        size_of::<Self>() + vectors + self.body.system.heap_bytes() + self.propagator.heap_bytes()
    }
}

fn write<V: Vector>(state: &mut State<V>, q: &[f64], v: &[f64]) {
    state.q.components_mut().copy_from_slice(q);
    state.v.components_mut().copy_from_slice(v);
}
