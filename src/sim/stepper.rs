//! A body, its solver and its state behind one object-safe face: one dynamic call per tick.

use std::any::Any;

use glam::DVec2;

use super::bodies::Input;
use super::integrators::StepFailure;
use super::solver::Solver;
use super::system::Counts;

/// A body under a solver. Everything above this layer sees bodies only so.
pub trait Stepper: Send {
    /// Advances from `t` to `t + h` (s), a method in `substeps` equal steps.
    ///
    /// # Errors
    /// As [`Integrator::step`](super::integrators::Integrator::step).
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
