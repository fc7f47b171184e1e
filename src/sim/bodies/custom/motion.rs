//! A system of any type behind a pointer, with its coordinates as plain numbers.

use std::any::Any;
use std::cell::RefCell;
use std::fmt;

use super::{Energy, Exact, Extras};
use crate::integrators::{Problem, problem};
use crate::parameter::ParameterOf;
use crate::state::{Elementwise, State, Vector};
use crate::system::{Coupling, EngineSettings, Query, System};
use crate::vec_system::{Scratch, VecSystem};

/// The motion of a custom body. It answers no query for a target, because a body that follows a target has a kind of
/// its own.
pub(super) trait Motion: System<Vector = Vec<f64>> + Send {
    /// Returns the energy of a state, which is at rest if `v` is `None`. Returns `None` if the body has no energy
    /// function.
    fn energy(&self, q: &[f64], v: Option<&[f64]>) -> Option<f64>;
    /// Overwrites `to` with the exact state at time `t` (s). Returns whether the body has an exact solution.
    fn exact(&self, t: f64, to: &mut State<Vec<f64>>) -> bool;
    /// Sets the parameter with this index.
    fn set(&mut self, index: usize, value: f64);
    fn system(&self) -> &dyn Any;
    /// Returns the bare system; `None` if its coordinate vector is not one `f64`.
    fn alone(&self) -> Option<Problem<f64>>;
    fn boxed_clone(&self) -> Box<dyn Motion>;
}

impl Clone for Box<dyn Motion> {
    fn clone(&self) -> Self {
        self.boxed_clone()
    }
}

impl fmt::Debug for dyn Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Motion")
    }
}

/// A system with a factor on its force.
#[derive(Clone)]
struct Scaled<S> {
    system: S,
    /// The factor on the force; 1 for a system with parameters of its own.
    force: f64,
}

impl<S: System<Vector: Vector>> System for Scaled<S> {
    type Vector = S::Vector;

    fn acceleration(&self, t: f64, q: &S::Vector, v: &S::Vector, a: &mut S::Vector) {
        self.system.acceleration(t, q, v, a);
        a.scale(self.force);
    }

    fn coupling(&self) -> Coupling {
        self.system.coupling()
    }

    fn query(&self, t: f64, query: Query<'_, S::Vector>) -> bool {
        match query {
            Query::Slope { state, along, slope } => {
                let query = Query::Slope { state, along, slope: &mut *slope };
                let is_answered = self.system.query(t, query);
                slope.scale(self.force);
                is_answered
            }
            Query::Engine { state, settings, force } => {
                let (engine, own) = (&mut *settings, &mut *force);
                let query = Query::Engine { state, settings: engine, force: own };
                let is_answered = self.system.query(t, query);
                force.scale(self.force);
                let EngineSettings { stiffness, damping, drag } = settings;
                [stiffness, damping, drag].into_iter().for_each(|setting| *setting *= self.force);
                is_answered
            }
            Query::Target(_) | Query::Spin(_) => false,
        }
    }
}

/// A system with its optional properties.
#[derive(Clone)]
pub(super) struct Typed<S: System<Vector: Vector>> {
    scaled: Scaled<S>,
    parameters: Vec<fn(&mut S) -> &mut f64>,
    energy: Option<Energy<S>>,
    exact: Option<Exact<S>>,
    scratch: RefCell<Scratch<S::Vector>>,
}

impl<S: System<Vector: Vector>> Typed<S> {
    pub(super) fn new(system: S, like: &S::Vector, extras: &Extras<S>) -> Self {
        Self {
            scaled: Scaled { system, force: 1.0 },
            parameters: extras.parameters.iter().filter_map(ParameterOf::acting_at_once).collect(),
            energy: extras.energy,
            exact: extras.exact,
            scratch: RefCell::new(Scratch::new(like)),
        }
    }
}

impl<S: System<Vector: Vector>> System for Typed<S> {
    type Vector = Vec<f64>;

    fn acceleration(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        VecSystem::new(&self.scaled, &mut self.scratch.borrow_mut()).acceleration(t, q, v, a);
    }

    fn coupling(&self) -> Coupling {
        self.scaled.coupling()
    }

    fn query(&self, t: f64, query: Query<'_, Vec<f64>>) -> bool {
        VecSystem::new(&self.scaled, &mut self.scratch.borrow_mut()).query(t, query)
    }
}

impl<S: System<Vector: Vector> + Clone + Send + 'static> Motion for Typed<S> {
    fn energy(&self, q: &[f64], v: Option<&[f64]>) -> Option<f64> {
        let energy = self.energy?;
        Some(energy(&self.scaled.system, self.scratch.borrow_mut().state(q, v)))
    }

    fn exact(&self, t: f64, to: &mut State<Vec<f64>>) -> bool {
        let Some(exact) = self.exact else { return false };
        let State { q, v } = exact(&self.scaled.system, t);
        to.q.copy_from_slice(q.components());
        to.v.copy_from_slice(v.components());
        true
    }

    fn set(&mut self, index: usize, value: f64) {
        match self.parameters.get(index) {
            Some(field) => *field(&mut self.scaled.system) = value,
            None => self.scaled.force = value,
        }
    }

    fn system(&self) -> &dyn Any {
        &self.scaled.system
    }

    fn alone(&self) -> Option<Problem<f64>> {
        let problem: Box<dyn Any> = Box::new(problem(self.scaled.clone()));
        problem.downcast().ok().map(|problem| *problem)
    }

    fn boxed_clone(&self) -> Box<dyn Motion> {
        Box::new(self.clone())
    }
}
