//! The systems that methods are measured on.

use std::cell::RefCell;
use std::marker::PhantomData;
use std::rc::Rc;

use glam::DVec2;
use regatta::sim::{Coupling, State, System, Vector};

pub(crate) use regatta::conformance::problems::{
    Kepler, Problem, UnitPendulum, fixed_step, fresh, kepler_orbit, problem, spring,
};

/// As many independent damped springs as the vector has components.
struct Springs<V> {
    stiffness: f64,
    damping: f64,
    vector: PhantomData<V>,
}

/// Springs of a kilogram, of this stiffness and damping.
pub(crate) fn springs<V: Vector>(stiffness: f64, damping: f64) -> Problem<V> {
    problem(Springs { stiffness, damping, vector: PhantomData })
}

impl<V: Vector> System for Springs<V> {
    type Vector = V;
    fn acceleration(&self, _t: f64, q: &V, v: &V, a: &mut V) {
        let pairs = q.components().iter().zip(v.components());
        for (a, (q, v)) in a.components_mut().iter_mut().zip(pairs) {
            *a = -self.stiffness * q - self.damping * v;
        }
    }
}

/// A system that declares a sparse Jacobian, so that methods store no matrix of it.
pub(crate) struct Sparse<S>(pub(crate) S);

impl<S: System> System for Sparse<S> {
    type Vector = S::Vector;
    fn acceleration(&self, t: f64, q: &S::Vector, v: &S::Vector, a: &mut S::Vector) {
        self.0.acceleration(t, q, v, a);
    }
    fn coupling(&self) -> Coupling {
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
    /// The system, and where it keeps the times.
    pub(crate) fn new(power: i32) -> (Problem<DVec2>, Rc<Self>) {
        let system = Rc::new(Self { power, asked: RefCell::default() });
        (problem(system.clone()), system)
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
