//! An object-safe stepper, which has a body, its solver and its state behind one dynamic call per tick.

use std::any::Any;
use std::ops::Deref;

use glam::DVec2;

use super::body::{Body, Input};
use super::impact::{Bounces, Impact};
use super::integrators::{Method, Override, StepFailure, Stepped};
use super::state::Vector;
use super::system::{Coupling, EngineSettings, Evaluation, Pursuit, StateOf};

/// The solver of a body, which is a method or the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// A method from the table.
    Method(&'static Method),
    /// A method from the table, with an override of its card's tolerance or of the body's joint. A method without a
    /// tolerance ignores the override, as does an engine on a body without a joint.
    With(&'static Method, Override),
    /// A method from the table, perhaps with an override, and another rule for impacts than the default.
    Bouncing(&'static Method, Option<Override>, &'static Impact),
    /// The exact flow from the last jump, or a reference solution if the body has no closed form.
    Truth,
}

impl Solver {
    /// Returns the method; `None` if the solver is the truth.
    pub fn method(self) -> Option<&'static Method> {
        match self {
            Solver::Method(method) | Solver::With(method, _) | Solver::Bouncing(method, ..) => {
                Some(method)
            }
            Solver::Truth => None,
        }
    }

    /// Returns the override of the method's settings, if there is one.
    pub fn setting(self) -> Option<Override> {
        match self {
            Solver::With(_, setting) => Some(setting),
            Solver::Bouncing(_, setting, _) => setting,
            Solver::Method(_) | Solver::Truth => None,
        }
    }

    /// Returns the rule for impacts.
    pub fn impact(self) -> &'static Impact {
        match self {
            Solver::Bouncing(method, _, impact) if impact.fits(method) => impact,
            _ => self.method().map(Impact::of).unwrap_or_default(),
        }
    }
}

/// A recorded tick, made on a copy of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedTick {
    /// Every evaluation of the acceleration, in the order of the method.
    pub evaluations: Vec<Evaluation>,
    /// The coordinates and the velocities at the end, or the failure of the step.
    pub landing: Result<[Vec<f64>; 2], StepFailure>,
}

/// A body under a solver. The layers above this one see bodies only through `dyn Stepper`.
///
/// This trait has only the functions that depend on body *and* solver, because it is compiled for each pair of them. A
/// stepper dereferences to the [body at its state](PlacedBody), which is compiled for each body.
pub trait Stepper: Send {
    /// Advances from `t` to `t + h` (s). A method takes `substeps` equal steps.
    ///
    /// # Errors
    /// The same as for [`Integrator::step`](super::integrators::Integrator::step).
    fn advance(&mut self, t: f64, h: f64, substeps: u32) -> Stepped;

    /// Changes the body or its state at time `t` (s), and restarts the solver there. Returns whether anything changed.
    fn change(&mut self, t: f64, change: Change<'_>) -> bool;

    /// Returns the body at its state.
    fn placed(&self) -> &(dyn PlacedBody + 'static);

    /// Records a [`Stepper::advance`] with the method's present memory, on a copy. The body and its counts are
    /// unchanged. Returns `None` if the body is not under `method`.
    fn recorded(&self, method: &Method, t: f64, h: f64, substeps: u32) -> Option<RecordedTick>;

    /// Whether the current state comes from a closed form; `false` under a reference solution or a method. A body that
    /// knows its exact motion only from the start has no closed form after an input, an edit or a placement.
    fn is_closed_form(&self) -> bool;

    /// Returns the largest error of a coordinate and that of a velocity at the current state of the truth, in their own
    /// units. For a closed form, the errors are bounds on rounding. For a reference solution, they are estimated from a
    /// second solution with other steps. An unknown error is infinite. Returns `None` under a method.
    fn truth_error(&self) -> Option<[f64; 2]>;

    /// Returns the time (s) of the true impact of this number since the last input, edit or placement, and the height
    /// of the flight after it. `None` under a method, and if there is no such impact.
    fn true_bounce(&self, impact: u64) -> Option<[f64; 2]>;

    /// Returns an upper bound on the memory of the stepper under its `solver`, in bytes.
    fn bytes(&self, solver: Solver) -> usize;

    /// Returns a copy with all memory of the solver, so that original and copy continue with the same bits.
    fn boxed_clone(&self) -> Box<dyn Stepper>;
}

impl Deref for dyn Stepper + '_ {
    type Target = dyn PlacedBody;

    fn deref(&self) -> &Self::Target {
        self.placed()
    }
}

impl dyn Stepper + '_ {
    /// Puts the body into a state at time `t` (s), and restarts the solver there.
    pub fn set(&mut self, t: f64, q: &[f64], v: &[f64]) {
        self.change(t, Change::State { q, v });
    }

    /// Gives the body an input at time `t` (s). Returns whether this kind of body accepts it.
    pub fn input(&mut self, t: f64, input: Input) -> bool {
        self.change(t, Change::Input(input))
    }

    /// Sets a parameter of the body at time `t` (s), by its index in the kind's
    /// `parameters`. The state is unchanged. Returns whether the body changed. The body does not change if the value
    /// equals the old one, or if the parameter acts at the start. `value` must be in the parameter's range and pass the
    /// kind's check.
    pub fn set_parameter(&mut self, t: f64, index: usize, value: f64) -> bool {
        self.change(t, Change::Parameter { index, value })
    }
}

impl Clone for Box<dyn Stepper> {
    fn clone(&self) -> Self {
        (**self).boxed_clone()
    }
}

/// A change of a body between ticks.
#[derive(Clone, Copy, Debug)]
pub enum Change<'a> {
    /// Puts the body into a state that is known exactly and unrelated to the state before.
    State {
        /// The coordinates.
        q: &'a [f64],
        /// The velocities.
        v: &'a [f64],
    },
    /// Applies an input to the state or the forces of the body.
    Input(Input),
    /// Edits a parameter of the body.
    Parameter {
        /// The index of the parameter in the kind's `parameters`.
        index: usize,
        /// The new value of the parameter.
        value: f64,
    },
}

impl Change<'_> {
    /// Changes `body` or its `state`. Returns whether anything changed.
    pub(super) fn apply<B: Body>(self, body: &mut B, state: &mut StateOf<B>) -> bool {
        match self {
            Change::State { q, v } => {
                state.q.components_mut().copy_from_slice(q);
                state.v.components_mut().copy_from_slice(v);
                body.settle(state);
                true
            }
            Change::Input(input) => body.input(input, state),
            Change::Parameter { index, value } => body.set_parameter(index, value),
        }
    }

    /// Whether the change places the body in a state, which removes the accumulated error.
    pub(super) fn is_placing(self) -> bool {
        matches!(self, Change::State { .. })
    }
}

/// The body of a [`Stepper`] at its state, independent of the solver.
pub trait PlacedBody {
    /// Returns the coordinates, in the order of the body kind's `coordinates`.
    fn q(&self) -> &[f64];
    /// Returns the velocities, in the order of the coordinates.
    fn v(&self) -> &[f64];

    /// Overwrites `a` with the acceleration at the given state under the current input. Does not count as an
    /// evaluation.
    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]);

    /// Returns the number of evaluations of the acceleration by all methods since the start, without the evaluations of
    /// the truth.
    fn evaluations(&self) -> u64;
    /// Returns the time in seconds that methods left out of their steps since the start.
    fn lost_time(&self) -> f64;
    /// Returns the record of the impacts of a body with walls; `None` for other bodies. The truth keeps none.
    fn bounces(&self) -> Option<&Bounces>;
    /// Whether the equation of motion is linear, apart from a constant.
    fn is_linear(&self) -> bool;
    /// Whether this coordinate is an angle, so that a full turn leaves the body unchanged.
    fn is_angle(&self, coordinate: usize) -> bool;
    /// Whether a reference solution would take more than [`MAX_REFERENCE_WORK`](super::MAX_REFERENCE_WORK).
    fn is_beyond_reference(&self) -> bool;
    /// Returns the dependence between coordinates.
    fn coupling(&self) -> Coupling;
    /// Whether implicit methods solve the body's equations without a matrix.
    fn is_sparse(&self) -> bool {
        self.coupling() == Coupling::Few
    }
    /// Returns the conserved energy in joules; `None` if the body conserves none under its current input.
    fn energy(&self) -> Option<f64>;
    /// Returns the kinetic part of [`PlacedBody::energy`], in joules. Never allocates.
    fn kinetic_energy(&self) -> Option<f64>;

    /// Returns the kinetic and the potential energy in joules, conserved or not; `None` if the body does not know them.
    /// Never allocates.
    fn mechanical_energy(&self) -> Option<[f64; 2]>;

    /// Returns the target of the body at time `t` (s), in its first coordinate; `None` if the body follows no target.
    /// Does not count as an evaluation.
    fn pursuit(&self, t: f64) -> Option<Pursuit<f64>>;
    /// Returns the joint and damping settings of the body in a physics engine. Does not count as an evaluation.
    fn engine_settings(&self, t: f64) -> EngineSettings;

    /// Returns the position of the body, in metres. Never allocates.
    fn place(&self) -> DVec2;
    /// Returns the body with its current parameters, of the type that the kind builds.
    fn body(&self) -> &dyn Any;

    /// Returns a copy of the body under another solver, with the same input and the same state to the bit.
    fn with_solver(&self, solver: Solver, t: f64) -> Box<dyn Stepper>;
}
