//! The systems that methods are measured on, and a way to put a method on them.

use std::cell::RefCell;

use glam::DVec2;
use regatta::sim::integrators::{Integrator, Method, Override, integrator};
use regatta::sim::{Coupling, State, System, Vector};

pub(crate) use regatta::conformance::problems::{Kepler, UnitPendulum, kepler_orbit, spring};

/// A fresh integrator for systems of one coordinate, compiled for `S`.
pub(crate) fn fresh<S: System<Vector = f64> + 'static>(method: &Method) -> Box<dyn Integrator<S>> {
    integrator(method, &0.0)
}

/// A fresh integrator that takes the steps it is given: an adaptive one gets a tolerance that does not bind.
pub(crate) fn unbound<S: System<Vector: Vector> + 'static>(
    method: &Method,
    like: &S::Vector,
) -> Box<dyn Integrator<S>> {
    let mut integrator = integrator(method, like);
    integrator.set(Override::tolerance(1e100));
    integrator
}

/// As many independent damped springs as the vector has components.
pub(crate) struct Springs<V>(pub(crate) std::marker::PhantomData<V>);

impl<V: Vector> System for Springs<V> {
    type Vector = V;
    fn acceleration(&self, _t: f64, q: &V, v: &V, a: &mut V) {
        let pairs = q.components().iter().zip(v.components());
        for (a, (q, v)) in a.components_mut().iter_mut().zip(pairs) {
            *a = -9.0 * q - 0.4 * v;
        }
    }
}

/// A system whose coordinates are said to act on few others each, so that methods keep no matrix of it.
pub(crate) struct Sparse<S>(pub(crate) S);

impl<S: System> System for Sparse<S> {
    type Vector = S::Vector;
    fn acceleration(&self, t: f64, q: &S::Vector, v: &S::Vector, a: &mut S::Vector) {
        self.0.acceleration(t, q, v, a);
    }
    fn coupling() -> Coupling {
        Coupling::Few
    }
}

/// Two coordinates: one under a force `power · t^(power - 1)` that only the time changes, one on a
/// spring stiff enough to make an adaptive method take many substeps. Remembers the times it is asked
/// for.
pub(crate) struct Timetable {
    pub(crate) power: i32,
    pub(crate) asked: RefCell<Vec<f64>>,
}

impl Timetable {
    pub(crate) fn new(power: i32) -> Self {
        Self { power, asked: RefCell::default() }
    }
}

impl System for Timetable {
    type Vector = DVec2;
    fn acceleration(&self, t: f64, q: &DVec2, _v: &DVec2, a: &mut DVec2) {
        self.asked.borrow_mut().push(t);
        a.x = match self.power {
            0 => 0.0,
            power => f64::from(power) * t.powi(power - 1),
        };
        a.y = -400.0 * q.y;
    }
}

/// The bits of a state, for comparing exactly.
pub(crate) fn bits<V: Vector>(state: &State<V>) -> Vec<u64> {
    state.q.components().iter().chain(state.v.components()).map(|x| x.to_bits()).collect()
}
