//! A system of any type with its coordinates in a `Vec`.

use std::cell::RefCell;

use super::state::assert_length;
use super::state::{State, Vector};
use super::system::{Coupling, Pursuit, Query, System};

/// Presents a system as one with its coordinates in a `Vec`.
pub(super) struct VecSystem<'a, S: System> {
    system: &'a S,
    scratch: RefCell<&'a mut Scratch<S::Vector>>,
}

impl<'a, S: System> VecSystem<'a, S> {
    pub(super) fn new(system: &'a S, scratch: &'a mut Scratch<S::Vector>) -> Self {
        Self { system, scratch: RefCell::new(scratch) }
    }
}

/// Scratch in the system's own vectors, for a state, a direction and the result.
#[derive(Clone)]
pub(super) struct Scratch<V> {
    state: State<V>,
    along: State<V>,
    result: V,
}

impl<V: Vector> Scratch<V> {
    /// Returns scratch for coordinates shaped `like` these.
    pub(super) fn new(like: &V) -> Self {
        let state = State { q: like.clone(), v: like.clone() };
        Self { along: state.clone(), result: like.clone(), state }
    }

    /// Returns the state with these coordinates and velocities. The state is at rest if `v` is `None`.
    pub(super) fn state(&mut self, q: &[f64], v: Option<&[f64]>) -> &State<V> {
        self.state.q.components_mut().copy_from_slice(q);
        let own = self.state.v.components_mut();
        match v {
            Some(v) => own.copy_from_slice(v),
            None => own.fill(0.0),
        }
        &self.state
    }
}

impl<S: System<Vector: Vector>> System for VecSystem<'_, S> {
    type Vector = Vec<f64>;

    fn acceleration(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        let scratch = &mut **self.scratch.borrow_mut();
        scratch.state(q, Some(v));
        let Scratch { state, result, .. } = scratch;
        self.system.acceleration(t, &state.q, &state.v, result);
        let result = result.components();
        assert_length(result.len(), a.len());
        a.copy_from_slice(result);
    }

    fn coupling(&self) -> Coupling {
        self.system.coupling()
    }

    fn query(&self, t: f64, query: Query<'_, Vec<f64>>) -> bool {
        let scratch = &mut **self.scratch.borrow_mut();
        let (is_answered, to) = match query {
            Query::Slope { state: State { q, v }, along: toward, slope } => {
                scratch.state(q, Some(v));
                let Scratch { state, along, result } = scratch;
                along.q.components_mut().copy_from_slice(&toward.q);
                along.v.components_mut().copy_from_slice(&toward.v);
                (self.system.query(t, Query::Slope { state, along, slope: result }), slope)
            }
            Query::Engine { state: State { q, v }, settings, force } => {
                scratch.state(q, Some(v));
                let Scratch { state, result, .. } = scratch;
                let query = Query::Engine { state, settings, force: result };
                (self.system.query(t, query), force)
            }
            Query::Target(pursuit) => {
                // The vector of the last answer serves again, so that a step need not allocate.
                let mut to = pursuit.take().map(|found| found.target).unwrap_or_default();
                *pursuit = Pursuit::of(self.system, t).map(|found| {
                    let Pursuit { target, rate, order, is_still } = found;
                    to.clear();
                    to.extend_from_slice(target.components());
                    Pursuit { target: to, rate, order, is_still }
                });
                return pursuit.is_some();
            }
            Query::Spin(moments) => return self.system.query(t, Query::Spin(moments)),
        };
        if is_answered {
            to.copy_from_slice(scratch.result.components());
        }
        is_answered
    }
}
