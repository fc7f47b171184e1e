//! A solver on its own copy of the scene's bodies; the truth is one too.

use super::number::superscript;
use super::scene::Scene;
use crate::sim::bodies::{Coordinate, Input, Kind, Truth};
use crate::sim::integrators::StepFailure;
use crate::sim::{Solver, Stepper};

/// The largest magnitude that is followed. Beyond it a value would no longer fit the f32 of the
/// picture, and nothing is left to learn: the lane halts.
pub const ESCAPE: f64 = 1e38;

/// Why and when a lane stopped.
#[derive(Clone, Debug, PartialEq)]
pub struct Halt {
    /// The tick that could not be completed. The lane keeps the state it had before.
    pub tick: u64,
    /// The body that failed, by its place in the scene.
    pub body: usize,
    /// What happened to it.
    pub failure: StepFailure,
}

/// One body of a lane.
pub struct LaneBody {
    /// Its card.
    pub kind: &'static Kind,
    /// Its coordinates, in state order.
    pub coordinates: &'static [Coordinate],
    /// Itself, under the lane's solver.
    pub stepper: Box<dyn Stepper>,
    /// Coordinates one tick ago, for drawing between ticks.
    pub previous_q: Vec<f64>,
    /// Velocities one tick ago.
    pub previous_v: Vec<f64>,
}

impl LaneBody {
    /// A body of `kind` with `values` at its start, under `solver`.
    pub(super) fn new(kind: &'static Kind, values: &[f64], solver: Solver) -> Self {
        let stepper = (kind.build)(values, solver);
        let [previous_q, previous_v] = [stepper.q(), stepper.v()].map(<[f64]>::to_vec);
        Self { kind, coordinates: (kind.coordinates)(values), stepper, previous_q, previous_v }
    }

    /// What is known of the body's motion, for people: `exact`, or how far a reference can be believed by
    /// now, in the units of its coordinates.
    pub fn truth_in_words(&self) -> String {
        let id = self.kind.truth.id();
        match (self.kind.truth, self.stepper.truth_error()) {
            (Truth::Exact, _) | (_, None) => id.into(),
            (Truth::Reference, Some([error, _])) if error.is_finite() => {
                // At the start it is exact.
                let exponent = libm::ceil(libm::log10(error.max(f64::MIN_POSITIVE))) as i32;
                format!("{id} to 10{}", superscript(exponent))
            }
            (Truth::Reference, Some(_)) => format!("{id} lost"),
        }
    }

    fn remember(&mut self) {
        self.previous_q.copy_from_slice(self.stepper.q());
        self.previous_v.copy_from_slice(self.stepper.v());
    }

    /// The first value that is not finite or beyond [`ESCAPE`].
    fn check(&self) -> Result<(), StepFailure> {
        let names = self.coordinates.iter();
        let q = names.clone().map(|c| c.name).zip(self.stepper.q());
        let v = names.map(|c| c.velocity).zip(self.stepper.v());
        for (coordinate, &value) in q.chain(v) {
            if !value.is_finite() {
                return Err(StepFailure::NotFinite { coordinate, value });
            }
            if value.abs() > ESCAPE {
                return Err(StepFailure::Escaped { coordinate, value });
            }
        }
        Ok(())
    }
}

/// A solver on its own copy of the scene.
pub struct Lane {
    solver: Solver,
    substeps: u32,
    bodies: Vec<LaneBody>,
    halted: Option<Halt>,
}

impl Lane {
    /// The scene's bodies at their start under `solver`, which takes `substeps` steps in a tick.
    pub fn new(scene: &Scene, solver: Solver, substeps: u32) -> Self {
        let bodies = scene.bodies.iter();
        let bodies = bodies.map(|body| LaneBody::new(body.kind, &body.values, solver)).collect();
        Self { solver, substeps, bodies, halted: None }
    }

    /// What carries the bodies forward.
    pub fn solver(&self) -> Solver {
        self.solver
    }
    /// Steps in one tick.
    pub fn substeps(&self) -> u32 {
        self.substeps
    }
    /// The bodies, in scene order.
    pub fn bodies(&self) -> &[LaneBody] {
        &self.bodies
    }
    /// Why the lane stopped, if it did.
    pub fn halted(&self) -> Option<&Halt> {
        self.halted.as_ref()
    }
    /// Evaluations of all bodies' accelerations since the start.
    pub fn evaluations(&self) -> u64 {
        self.bodies.iter().map(|body| body.stepper.evaluations()).sum()
    }

    /// Steps every body from `t` by `h` (s), from tick `tick` to the next. If one fails, all keep the
    /// state they had, and the lane halts.
    pub fn tick(&mut self, tick: u64, t: f64, h: f64) {
        if self.halted.is_some() {
            return;
        }
        for i in 0..self.bodies.len() {
            let body = &mut self.bodies[i];
            body.remember();
            let stepped = body.stepper.advance(t, h, self.substeps).and_then(|()| body.check());
            if let Err(failure) = stepped {
                for body in &mut self.bodies[..=i] {
                    body.stepper.set(t, &body.previous_q, &body.previous_v);
                }
                for body in &mut self.bodies[i..] {
                    body.remember();
                }
                self.halted = Some(Halt { tick, body: i, failure });
                return;
            }
        }
    }

    /// Gives an input at time `t` (s) to every body that takes it. A halted lane feels no kick, but
    /// keeps the throttle for when it goes on.
    pub fn input(&mut self, t: f64, input: Input) {
        let kick = matches!(input, Input::Kick(_));
        if self.halted.is_none() || !kick {
            for body in &mut self.bodies {
                body.stepper.input(t, input);
            }
        }
    }

    /// Makes the solver begin anew from the state as it is: the steps to come are of another length.
    pub fn reset(&mut self) {
        for body in &mut self.bodies {
            body.stepper.reset();
        }
    }

    /// Puts the bodies under another solver, their state carried exactly. A halted lane goes on from
    /// its last good state.
    pub fn switch(&mut self, solver: Solver, substeps: u32, t: f64) {
        self.solver = solver;
        self.substeps = substeps;
        self.halted = None;
        for body in &mut self.bodies {
            body.stepper = body.stepper.with_solver(solver, t);
        }
    }
}
