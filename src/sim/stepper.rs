//! One body, its solver and its state behind one object-safe face: one dynamic call a tick.

use super::bodies::{Body, Input, Pen, View};
use super::integrators::{Construct, Integrator, Method, StepFailure, construct};
use super::system::{Counted, State, Vector};

/// What carries a body forward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// A method from the table.
    Method(&'static Method),
    /// The exact flow, from the last moment at which the input changed.
    Exact,
}

/// A body under a solver. Everything above this layer sees bodies only so.
pub trait Stepper: Send {
    /// Advances from `t` to `t + h` (s), a method in `substeps` equal steps.
    ///
    /// # Errors
    /// As [`Integrator::step`]; [`StepFailure::NoClosedForm`] from an exact solver whose body has none.
    fn advance(&mut self, t: f64, h: f64, substeps: u32) -> Result<(), StepFailure>;

    /// The coordinates, in the order of the body kind's [`coordinates`](super::bodies::Kind::coordinates).
    fn q(&self) -> &[f64];
    /// Their velocities.
    fn v(&self) -> &[f64];
    /// Puts the body into a state at time `t` (s) and makes the solver forget what it carried.
    fn set(&mut self, t: f64, q: &[f64], v: &[f64]);
    /// Makes the solver forget what it carried from step to step, the state left as it is.
    fn reset(&mut self);

    /// Gives the body an input at time `t` (s). Returns whether it takes that kind.
    fn input(&mut self, t: f64, input: Input) -> bool;

    /// Overwrites `a` with the acceleration in the given state under the present input; not counted.
    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]);

    /// Evaluations of the acceleration since the start, under whatever methods.
    fn evaluations(&self) -> u64;
    /// Seconds by which the body is behind, because methods it was under
    /// [did not keep time](Method::keeps_time).
    fn lost_time(&self) -> f64;
    /// The conserved energy in joules, where the body conserves one under its present input.
    fn energy(&self) -> Option<f64>;

    /// Draws the body in the given state, in metres.
    fn outline(&self, q: &[f64], v: &[f64], pen: &mut Pen);
    /// How the body wants to be looked at.
    fn view(&self) -> View;

    /// The same body, under the same input and in the same state to the bit, under another solver.
    fn with_solver(&self, solver: Solver, t: f64) -> Box<dyn Stepper>;
}

/// Puts `body` at its start, at time 0, under `solver`.
pub fn stepper<B: Body>(body: B, solver: Solver) -> Box<dyn Stepper> {
    let state = body.start();
    Launch { body: Counted::new(body), state, behind: 0.0 }.under(solver, 0.0)
}

/// A body about to come under a solver.
struct Launch<B: Body> {
    body: Counted<B>,
    state: State<B::Vector>,
    /// The time lost so far, in seconds.
    behind: f64,
}

impl<B: Body> Launch<B> {
    fn under(self, solver: Solver, t: f64) -> Box<dyn Stepper> {
        match solver {
            Solver::Method(method) => construct::<Counted<B>, _>(method, self),
            Solver::Exact => {
                let Self { body, state, behind } = self;
                Box::new(Follower { body, anchor: state.clone(), anchored_at: t, state, behind })
            }
        }
    }
}

impl<B: Body> Construct<Counted<B>> for Launch<B> {
    type Output = Box<dyn Stepper>;

    fn of<I: Integrator<Counted<B>> + 'static>(self) -> Self::Output {
        let Self { body, state, behind } = self;
        Box::new(Stepped { integrator: I::new(&state.q), body, state, behind })
    }
}

/// A body under a method; monomorphic, so that force law and method become one loop.
struct Stepped<B: Body, I> {
    body: Counted<B>,
    integrator: I,
    state: State<B::Vector>,
    /// The time lost under earlier solvers, in seconds.
    behind: f64,
}

impl<B: Body, I: Integrator<Counted<B>>> Stepper for Stepped<B, I> {
    fn advance(&mut self, t: f64, h: f64, substeps: u32) -> Result<(), StepFailure> {
        self.integrator.steps(&self.body, t, h, substeps, &mut self.state)
    }

    fn q(&self) -> &[f64] {
        self.state.q.components()
    }
    fn v(&self) -> &[f64] {
        self.state.v.components()
    }
    fn set(&mut self, _t: f64, q: &[f64], v: &[f64]) {
        write(&mut self.state, q, v);
        self.integrator.reset();
    }
    fn reset(&mut self) {
        self.integrator.reset();
    }

    fn input(&mut self, _t: f64, input: Input) -> bool {
        let taken = self.body.system.input(input, &mut self.state);
        if taken {
            self.integrator.reset();
        }
        taken
    }

    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        acceleration(&self.body.system, &self.state, t, (q, v), a);
    }

    fn evaluations(&self) -> u64 {
        self.body.evaluations()
    }
    fn lost_time(&self) -> f64 {
        self.behind + self.integrator.lost_time()
    }
    fn energy(&self) -> Option<f64> {
        self.body.system.energy(&self.state)
    }

    fn outline(&self, q: &[f64], v: &[f64], pen: &mut Pen) {
        outline(&self.body.system, &self.state, q, v, pen);
    }
    fn view(&self) -> View {
        self.body.system.view()
    }

    fn with_solver(&self, solver: Solver, t: f64) -> Box<dyn Stepper> {
        let (body, state, behind) = (self.body.clone(), self.state.clone(), self.lost_time());
        Launch { body, state, behind }.under(solver, t)
    }
}

/// A body on its exact flow, always computed in one stride from `anchor`, so that nothing accumulates.
struct Follower<B: Body> {
    /// Costs nothing here, but keeps the count of what it cost before.
    body: Counted<B>,
    anchor: State<B::Vector>,
    anchored_at: f64,
    state: State<B::Vector>,
    /// The time lost under earlier solvers, in seconds.
    behind: f64,
}

impl<B: Body> Stepper for Follower<B> {
    fn advance(&mut self, t: f64, h: f64, _substeps: u32) -> Result<(), StepFailure> {
        self.state = self
            .body
            .system
            .exact(t + h - self.anchored_at, &self.anchor)
            .ok_or(StepFailure::NoClosedForm)?;
        Ok(())
    }

    fn q(&self) -> &[f64] {
        self.state.q.components()
    }
    fn v(&self) -> &[f64] {
        self.state.v.components()
    }
    fn set(&mut self, t: f64, q: &[f64], v: &[f64]) {
        write(&mut self.state, q, v);
        self.anchor.assign(&self.state);
        self.anchored_at = t;
    }
    fn reset(&mut self) {}

    fn input(&mut self, t: f64, input: Input) -> bool {
        let taken = self.body.system.input(input, &mut self.state);
        if taken {
            self.anchor.assign(&self.state);
            self.anchored_at = t;
        }
        taken
    }

    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        acceleration(&self.body.system, &self.state, t, (q, v), a);
    }

    fn evaluations(&self) -> u64 {
        self.body.evaluations()
    }
    fn lost_time(&self) -> f64 {
        self.behind
    }
    fn energy(&self) -> Option<f64> {
        self.body.system.energy(&self.state)
    }

    fn outline(&self, q: &[f64], v: &[f64], pen: &mut Pen) {
        outline(&self.body.system, &self.state, q, v, pen);
    }
    fn view(&self) -> View {
        self.body.system.view()
    }

    fn with_solver(&self, solver: Solver, t: f64) -> Box<dyn Stepper> {
        let (body, state, behind) = (self.body.clone(), self.state.clone(), self.lost_time());
        Launch { body, state, behind }.under(solver, t)
    }
}

fn write<V: Vector>(state: &mut State<V>, q: &[f64], v: &[f64]) {
    state.q.components_mut().copy_from_slice(q);
    state.v.components_mut().copy_from_slice(v);
}

fn acceleration<B: Body>(
    body: &B,
    like: &State<B::Vector>,
    t: f64,
    (q, v): (&[f64], &[f64]),
    a: &mut [f64],
) {
    let mut at = like.clone();
    write(&mut at, q, v);
    let mut acceleration = like.q.clone();
    body.acceleration(t, &at.q, &at.v, &mut acceleration);
    a.copy_from_slice(acceleration.components());
}

fn outline<B: Body>(body: &B, like: &State<B::Vector>, q: &[f64], v: &[f64], pen: &mut Pen) {
    let mut shown = like.clone();
    write(&mut shown, q, v);
    body.outline(&shown, pen);
}
