//! A system of any type behind a pointer, with its coordinates as plain numbers.

use std::any::Any;
use std::cell::RefCell;
use std::fmt;

use super::extras::{Energy, Exact, Extras};
use crate::sim::engine_settings::EngineSettings;
use crate::sim::parameter::ParameterOf;
use crate::sim::state::{State, Vector};
use crate::sim::system::System;

/// The motion of a custom body.
pub(super) trait Motion: Send {
    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]);
    /// As [`System::engine_settings`].
    fn engine_settings(
        &self,
        t: f64,
        q: &[f64],
        v: &[f64],
        f: &mut [f64],
    ) -> Option<EngineSettings>;
    /// The energy of a state, or of the same place at rest; `None` if nobody has said what it is.
    fn energy(&self, q: &[f64], v: Option<&[f64]>) -> Option<f64>;
    /// Overwrites `to` with the exact state at time `t` (s). Returns whether anybody has said what it is.
    fn exact(&self, t: f64, to: &mut State<Vec<f64>>) -> bool;
    /// Sets the parameter with this index.
    fn set(&mut self, index: usize, value: f64);
    fn system(&self) -> &dyn Any;
    fn boxed_clone(&self) -> Box<dyn Motion>;
    /// Its size, without coordinates on the heap.
    fn bytes(&self) -> usize;
    /// The number of coordinate vectors that it holds.
    fn vectors(&self) -> usize;
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

/// A system with what was told of it.
#[derive(Clone)]
pub(super) struct Typed<S: System<Vector: Vector>> {
    system: S,
    /// Multiplies the acceleration of a system without parameters.
    force: f64,
    parameters: Vec<fn(&mut S) -> &mut f64>,
    energy: Option<Energy<S>>,
    exact: Option<Exact<S>>,
    scratch: RefCell<Scratch<S::Vector>>,
}

#[derive(Clone)]
struct Scratch<V> {
    state: State<V>,
    a: V,
}

impl<S: System<Vector: Vector>> Typed<S> {
    pub(super) fn new(system: S, like: &State<S::Vector>, extras: &Extras<S>) -> Self {
        Self {
            system,
            force: 1.0,
            parameters: extras.parameters.iter().filter_map(ParameterOf::acting_at_once).collect(),
            energy: extras.energy,
            exact: extras.exact,
            scratch: RefCell::new(Scratch { state: like.clone(), a: like.v.clone() }),
        }
    }
}

impl<S: System<Vector: Vector> + Clone + Send + 'static> Motion for Typed<S> {
    fn acceleration(&self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) {
        let Scratch { state, a: own } = &mut *self.scratch.borrow_mut();
        state.q.components_mut().copy_from_slice(q);
        state.v.components_mut().copy_from_slice(v);
        self.system.acceleration(t, &state.q, &state.v, own);
        for (a, own) in a.iter_mut().zip(own.components()) {
            *a = self.force * own;
        }
    }

    fn engine_settings(
        &self,
        t: f64,
        q: &[f64],
        v: &[f64],
        f: &mut [f64],
    ) -> Option<EngineSettings> {
        let Scratch { state, a: own } = &mut *self.scratch.borrow_mut();
        state.q.components_mut().copy_from_slice(q);
        state.v.components_mut().copy_from_slice(v);
        let set = self.system.engine_settings(t, state, own)?;
        for (f, own) in f.iter_mut().zip(own.components()) {
            *f = self.force * own;
        }
        let [stiffness, damping, drag] =
            [set.stiffness, set.damping, set.drag].map(|setting| self.force * setting);
        Some(EngineSettings { stiffness, damping, drag })
    }

    fn energy(&self, q: &[f64], v: Option<&[f64]>) -> Option<f64> {
        let energy = self.energy?;
        let state = &mut self.scratch.borrow_mut().state;
        state.q.components_mut().copy_from_slice(q);
        match v {
            Some(v) => state.v.components_mut().copy_from_slice(v),
            None => state.v.components_mut().fill(0.0),
        }
        Some(energy(&self.system, state))
    }

    fn exact(&self, t: f64, to: &mut State<Vec<f64>>) -> bool {
        let Some(exact) = self.exact else { return false };
        let State { q, v } = exact(&self.system, t);
        to.q.copy_from_slice(q.components());
        to.v.copy_from_slice(v.components());
        true
    }

    fn set(&mut self, index: usize, value: f64) {
        match self.parameters.get(index) {
            Some(field) => *field(&mut self.system) = value,
            None => self.force = value,
        }
    }

    fn system(&self) -> &dyn Any {
        &self.system
    }

    fn boxed_clone(&self) -> Box<dyn Motion> {
        Box::new(self.clone())
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&self.parameters[..])
    }

    fn vectors(&self) -> usize {
        3
    }
}
