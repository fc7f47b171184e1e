//! A custom body, which is any [`System`] with a start and optional properties.

use std::any::Any;
use std::sync::Arc;

use super::claims::{Checked, FalseClaims};
use super::kind::CustomInfo;
use super::prelude::*;
use crate::state::{Vector, bytes_with_vectors};
use crate::system::StateOf;

mod claims;
mod kind;
mod motion;

pub use claims::CustomFault;
pub use kind::custom_kind;
use motion::{Motion, Typed};

/// A custom body. It erases the type of its system, so that no system needs code of its own here.
#[derive(Clone, Debug)]
pub struct Custom {
    motion: Box<dyn Motion>,
    info: Arc<CustomInfo>,
    /// The present values of the parameters.
    values: Vec<f64>,
    start: State<Vec<f64>>,
    /// The change of the velocity by one kick.
    kick: Vec<f64>,
    /// Whether the acceleration is linear.
    is_linear: bool,
    checked: Checked,
}

impl Custom {
    /// Returns a body that moves as `system` does, without names, parameters and kicks. The claims of `extras` are not
    /// checked.
    pub(crate) fn unnamed<S>(system: S, start: &StateOf<S>, extras: &Extras<S>) -> Self
    where
        S: System<Vector: Vector> + Clone + Send + 'static,
    {
        let [q, v] = [&start.q, &start.v].map(|half| half.components().to_vec());
        Self {
            motion: Box::new(Typed::new(system, &start.q, extras)),
            info: Arc::new(CustomInfo { coordinates: Vec::new(), plane: None }),
            values: Vec::new(),
            kick: vec![0.0; q.len()],
            start: State { q, v },
            is_linear: extras.is_linear,
            checked: Checked::default(),
        }
    }

    /// Returns the coordinates, and the plane in which the body is drawn.
    pub fn info(&self) -> &CustomInfo {
        &self.info
    }

    /// Returns the system with its present parameters, of the type from which the body was made.
    pub fn system(&self) -> &dyn Any {
        self.motion.system()
    }

    /// Returns the claims that do not hold with the present parameters.
    pub fn false_claims(&self) -> FalseClaims {
        self.checked.false_claims(self, &self.values)
    }

    /// Returns the present values of the body's parameters.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Sets all parameters.
    fn write(&mut self, values: &[f64]) {
        for (index, &value) in values.iter().enumerate() {
            self.set_parameter(index, value);
        }
    }
}

impl System for Custom {
    type Vector = Vec<f64>;

    fn acceleration(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        self.motion.acceleration(t, q, v, a);
    }

    fn coupling(&self) -> Coupling {
        self.motion.coupling()
    }

    fn query(&self, t: f64, query: Query<'_, Vec<f64>>) -> bool {
        self.motion.query(t, query)
    }
}

impl Body for Custom {
    fn with_parameters(mut self, values: &[f64]) -> Self {
        self.write(values);
        // The claims are checked before the first tick, which must not allocate.
        self.false_claims();
        self
    }

    fn set_parameter(&mut self, index: usize, value: f64) -> bool {
        let is_new = self.values.get(index).is_some_and(|old| *old != value);
        if is_new {
            self.values[index] = value;
            self.motion.set(index, value);
            self.prepare();
        }
        is_new
    }

    fn prepare(&mut self) {
        self.checked.reset();
    }

    fn heap_bytes(&self) -> usize {
        bytes_with_vectors(size_of_val(&*self.motion), &self.start.q)
            + 2 * size_of_val(&self.values[..])
    }

    fn start(&self) -> State<Vec<f64>> {
        self.start.clone()
    }

    fn exact_since_start(&self, t: f64, to: &mut State<Vec<f64>>) -> bool {
        !self.false_claims().exact && self.motion.exact(t, to)
    }

    fn is_linear(&self) -> bool {
        self.is_linear
    }

    fn is_angle(&self, coordinate: usize) -> bool {
        self.info.coordinates[coordinate].unit == "rad"
    }

    fn energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        if self.false_claims().energy {
            return None;
        }
        self.motion.energy(&state.q, Some(&state.v))
    }

    fn kinetic_energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        Some(self.energy(state)? - self.motion.energy(&state.q, None)?)
    }

    fn input(&mut self, input: Input, state: &mut State<Vec<f64>>) -> bool {
        let Input::Kick(times) = input else { return false };
        state.v.iter_mut().zip(&self.kick).for_each(|(v, kick)| *v += times * kick);
        true
    }

    /// Returns the coordinates of the plane; without a plane, the first coordinate, to the right.
    fn place(&self, q: &Vec<f64>) -> DVec2 {
        match self.info.plane {
            Some([x, y]) => DVec2::new(q[x], q[y]),
            None => DVec2::new(q[0], 0.0),
        }
    }
}

/// A function that returns the energy in joules of a system in a state.
pub type Energy<S> = fn(&S, &State<<S as System>::Vector>) -> f64;

/// A function that returns the exact state of a system at a time (s) after the start.
pub type Exact<S> = fn(&S, f64) -> State<<S as System>::Vector>;

/// Optional properties of a custom body. Each has a default.
#[derive(Clone)]
pub struct Extras<S: System> {
    /// The name and the unit of each coordinate, such as `("height", "m")`; an angle has the unit `rad`. If empty, the
    /// coordinates are x, y and z, or q1, q2 …, in metres.
    pub coordinates: Vec<(&'static str, &'static str)>,
    /// The indices of the coordinates that are x and y of the drawing plane. If `None`, two coordinates in metres make
    /// a plane, and other coordinates get a rail each.
    pub plane: Option<[usize; 2]>,
    /// Numbers of the system that may change while it moves, made by [`ParameterOf::number`]. The first should be one
    /// that makes the system stiffer. If empty, the only parameter is `force`, a factor of the acceleration.
    pub parameters: Vec<ParameterOf<S>>,
    /// The energy in joules, which must be conserved. If `None`, the body has no energy to check.
    pub energy: Option<Energy<S>>,
    /// The exact state at time t (s) after the start. If `None`, the truth is a numerical reference solution.
    pub exact: Option<Exact<S>>,
    /// Whether the acceleration is at all times a linear function of coordinates and velocities, plus a constant.
    /// Methods are then judged by the normal modes, for any length of time. The default is no.
    pub is_linear: bool,
    /// The change of the velocity by one kick. If `None`, it is 1 per second in the first coordinate.
    pub kick: Option<S::Vector>,
}

impl<S: System> Default for Extras<S> {
    fn default() -> Self {
        Self {
            coordinates: Vec::new(),
            plane: None,
            parameters: Vec::new(),
            energy: None,
            exact: None,
            is_linear: false,
            kick: None,
        }
    }
}
