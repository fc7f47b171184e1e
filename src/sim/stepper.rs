//! One body, its solver and its state behind one object-safe face: one dynamic call a tick.

use std::any::Any;

use glam::DVec2;

use super::bodies::{Body, Input, ParameterOf};
use super::drive::{ByMethod, Drive, Jump};
use super::exact_flow::ExactFlow;
use super::integrators::{Construct, Integrator, Method, StepFailure, Tolerance, construct};
use super::reference::Reference;
use super::system::{Counted, Counts, State, Vector};

/// What carries a body forward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// A method from the table.
    Method(&'static Method),
    /// An adaptive method from the table with this tolerance, in all its parts, for its card's.
    Within(&'static Method, f64),
    /// The exact flow, from the last moment at which the input changed; for a body without a closed
    /// form, a reference solution.
    Truth,
}

impl Solver {
    /// The method that steps, if one does.
    pub fn method(self) -> Option<&'static Method> {
        match self {
            Solver::Method(method) | Solver::Within(method, _) => Some(method),
            Solver::Truth => None,
        }
    }
}

/// A body under a solver. Everything above this layer sees bodies only so.
pub trait Stepper: Send {
    /// Advances from `t` to `t + h` (s), a method in `substeps` equal steps.
    ///
    /// # Errors
    /// As [`Integrator::step`].
    fn advance(&mut self, t: f64, h: f64, substeps: u32) -> Result<(), StepFailure>;

    /// The coordinates, in the order of the body kind's
    /// [`coordinates`](super::bodies::Kind::coordinates).
    fn q(&self) -> &[f64];
    /// Their velocities.
    fn v(&self) -> &[f64];
    /// Puts the body into a state at time `t` (s). The solver begins again there.
    fn set(&mut self, t: f64, q: &[f64], v: &[f64]);

    /// Gives the body an input at time `t` (s). Returns whether it takes that kind.
    fn input(&mut self, t: f64, input: Input) -> bool;

    /// Sets a parameter of the body, by its place among the kind's
    /// [`parameters`](super::bodies::Kind::parameters), at time `t` (s), the state left as it is. Returns whether
    /// that changed the body: a value that is set already does not, nor does a parameter that
    /// [acts at the start](super::bodies::Acts). `value` is in the parameter's range and fits the others.
    fn set_parameter(&mut self, t: f64, place: usize, value: f64) -> bool;

    /// Overwrites `a` with the acceleration in the given state under the present input; not counted.
    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]);

    /// What methods did with the body since the start, whichever it was under. The truth counts nothing.
    fn counts(&self) -> Counts;
    /// Evaluations of the acceleration since the start.
    fn evaluations(&self) -> u64 {
        self.counts().evaluations
    }
    /// Whether the body's equation of motion is linear, but for a constant.
    fn is_linear(&self) -> bool;
    /// How far the truth may be off by now: the largest error expected of a coordinate and of a velocity, in
    /// their own units. Of a closed form it bounds the roundings; of a reference solution it is estimated on
    /// this run, from a second one by other steps. Infinite where nothing is known. `None` under a method.
    fn truth_error(&self) -> Option<[f64; 2]>;
    /// The conserved energy in joules, where the body conserves one under its present input.
    fn energy(&self) -> Option<f64>;
    /// The part of that energy that is the motion's, in joules. Never allocates.
    fn kinetic_energy(&self) -> Option<f64>;

    /// Where the body is, in metres. Never allocates.
    fn place(&self) -> DVec2;
    /// The body with its present parameters, of the type that its kind builds.
    fn body(&self) -> &dyn Any;

    /// The same body, under the same input and in the same state to the bit, under another solver.
    fn with_solver(&self, solver: Solver, t: f64) -> Box<dyn Stepper>;

    /// The same body under the same solver, with all that the solver carries from step to step: both go on
    /// alike to the bit.
    fn boxed_clone(&self) -> Box<dyn Stepper>;
    /// The memory that it takes, in bytes, no less than it is.
    fn bytes(&self) -> usize;
}

impl Clone for Box<dyn Stepper> {
    fn clone(&self) -> Self {
        (**self).boxed_clone()
    }
}

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
