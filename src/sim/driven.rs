//! A body of one type under what drives it.

use std::any::Any;

use glam::DVec2;

use super::bodies::{Body, Input, ParameterOf};
use super::drive::{ByMethod, Drive, Jump};
use super::exact_flow::ExactFlow;
use super::integrators::{Construct, Integrator, StepFailure, Tolerance, construct};
use super::reference::Reference;
use super::solver::Solver;
use super::stepper::Stepper;
use super::system::{Counted, Counts, State, Vector};

/// Puts `body` at its start, at time 0, under `solver`.
pub fn stepper<B: Body>(body: B, solver: Solver) -> Box<dyn Stepper> {
    let state = body.start();
    Launch { body: Counted::new(body), state, tolerance: None }.under(solver, 0.0)
}

/// A body about to come under a solver.
struct Launch<B: Body> {
    body: Counted<B>,
    state: State<B::Vector>,
    /// For an adaptive method's own.
    tolerance: Option<Tolerance>,
}

impl<B: Body> Launch<B> {
    fn under(self, solver: Solver, t: f64) -> Box<dyn Stepper> {
        match solver {
            Solver::Method(method) => construct(method, self),
            Solver::Within(method, tolerance) => {
                construct(method, Self { tolerance: Some(Tolerance::uniform(tolerance)), ..self })
            }
            Solver::Truth if self.body.system.exact(0.0, &self.state).is_some() => {
                let drive = ExactFlow::new(&self.state, t);
                self.driven(drive)
            }
            Solver::Truth => {
                let drive = Reference::new(&self.state);
                self.driven(drive)
            }
        }
    }

    fn driven<D: Drive<B>>(self, drive: D) -> Box<dyn Stepper> {
        let Self { body, state, .. } = self;
        Box::new(Driven { body, drive, state })
    }
}

impl<B: Body> Construct<Counted<B>> for Launch<B> {
    type Output = Box<dyn Stepper>;

    fn of<I: Integrator<Counted<B>> + Clone + 'static>(self) -> Self::Output {
        let mut integrator = I::new(&self.state.q);
        if let Some(tolerance) = self.tolerance {
            integrator.set_tolerance(tolerance);
        }
        self.driven(ByMethod(integrator))
    }
}

/// A body under what drives it; monomorphic, so that force law and method become one loop.
#[derive(Clone)]
struct Driven<B: Body, D> {
    body: Counted<B>,
    drive: D,
    state: State<B::Vector>,
}

impl<B: Body, D: Drive<B>> Driven<B, D> {
    fn jump(
        &mut self,
        jump: Jump,
        t: f64,
        change: impl FnOnce(&mut B, &mut State<B::Vector>) -> bool,
    ) -> bool {
        self.drive.jump(jump, t, &mut self.body.system, &mut self.state, change)
    }
}

impl<B: Body, D: Drive<B>> Stepper for Driven<B, D> {
    fn advance(&mut self, t: f64, h: f64, substeps: u32) -> Result<(), StepFailure> {
        self.drive.advance(&self.body, t, h, substeps, &mut self.state)
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
        let parameter = B::PARAMETERS.get(place);
        let Some(field) = parameter.and_then(ParameterOf::acting_at_once) else { return false };
        self.jump(Jump::Pushed, t, |body, _| {
            let is_new = *field(body) != value;
            if is_new {
                *field(body) = value;
                body.prepare();
            }
            is_new
        })
    }

    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        let mut at = self.state.clone();
        write(&mut at, q, v);
        let mut acceleration = self.state.q.clone();
        self.body.system.acceleration(t, &at.q, &at.v, &mut acceleration);
        a.copy_from_slice(acceleration.components());
    }

    fn counts(&self) -> Counts {
        self.body.counts()
    }
    fn is_linear(&self) -> bool {
        self.body.system.is_linear()
    }
    fn truth_error(&self) -> Option<[f64; 2]> {
        self.drive.truth_error(&self.body, &self.state)
    }
    fn energy(&self) -> Option<f64> {
        self.body.system.energy(&self.state)
    }
    fn kinetic_energy(&self) -> Option<f64> {
        self.body.system.kinetic_energy(&self.state)
    }

    fn place(&self) -> DVec2 {
        self.body.system.place(&self.state.q)
    }
    fn body(&self) -> &dyn Any {
        &self.body.system
    }

    fn with_solver(&self, solver: Solver, t: f64) -> Box<dyn Stepper> {
        let (body, state) = (self.body.clone(), self.state.clone());
        Launch { body, state, tolerance: None }.under(solver, t)
    }

    fn boxed_clone(&self) -> Box<dyn Stepper> {
        Box::new(self.clone())
    }

    fn bytes(&self) -> usize {
        // As if it were made of coordinate vectors and nothing else.
        let vectors = size_of::<Self>() / size_of::<B::Vector>();
        let vectors = vectors * self.state.q.heap_bytes();
        size_of::<Self>() + vectors + self.body.system.heap_bytes() + self.drive.heap_bytes()
    }
}

fn write<V: Vector>(state: &mut State<V>, q: &[f64], v: &[f64]) {
    state.q.components_mut().copy_from_slice(q);
    state.v.components_mut().copy_from_slice(v);
}
