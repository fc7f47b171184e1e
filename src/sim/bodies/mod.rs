//! The bodies: one file each, one line each in the table below.
//!
//! A body is a closed system with natural coordinates, and an exact flow where there is one. Its
//! [`Kind`] card says how a scene describes it; how it looks is said elsewhere, by
//! [`Look`](crate::lab::picture::Look). To add one, copy `spring.rs`, declare it, and name it in
//! [`BODIES`].

use glam::DVec2;

use super::reference::REFERENCE_ACCURACY;
use super::stepper::{Solver, Stepper};
use super::system::{State, System, Vector};

mod chain;
mod helm;
mod kepler;
mod orbit;
mod oscillator;
mod parameter;
mod pendulum;
mod ship;
mod spring;

pub use chain::Chain;
pub use helm::{Helm, ThrustCurve};
pub use orbit::{Ellipse, Orbit};
pub use parameter::{Acts, Fault, LARGEST, MOST_POINTS, Parameter, ParameterOf, Range};
pub use pendulum::Pendulum;
pub use ship::Ship;
pub use spring::Spring;

/// Something that moves by an equation of motion.
pub trait Body: System + Clone + Send + 'static {
    /// What can be set about the body. Its card lists the descriptions, as [`Kind::parameters`].
    const PARAMETERS: &'static [ParameterOf<Self>] = &[];

    /// The body with these values of its [parameters](Body::PARAMETERS), in their order: one value for each
    /// parameter, and two for each point of a curve.
    ///
    /// # Panics
    /// If there are fewer values or more, or if no body of this kind can be built from them: see [`Kind::check`].
    fn with_parameters(mut self, values: &[f64]) -> Self {
        parameter::write(&mut self, Self::PARAMETERS, values);
        self.prepare();
        self
    }

    /// Computes again what the body keeps besides its parameters because it follows from them. Called whenever
    /// they were written.
    fn prepare(&mut self) {}

    /// The memory that it takes beyond its own size, in bytes.
    fn heap_bytes(&self) -> usize {
        0
    }

    /// The state at tick 0.
    fn start(&self) -> State<Self::Vector>;

    /// The exact flow over `dt` (s) under constant input. `None`, whatever the arguments, says that
    /// there is no closed form: the truth is then a reference solution.
    fn exact(&self, dt: f64, from: &State<Self::Vector>) -> Option<State<Self::Vector>>;

    /// Overwrites `to` with the same flow, and returns whether there is one. A body whose coordinates
    /// are on the heap does it without allocating.
    fn exact_into(
        &self,
        dt: f64,
        from: &State<Self::Vector>,
        to: &mut State<Self::Vector>,
    ) -> bool {
        let flown = self.exact(dt, from);
        flown.is_some_and(|state| {
            *to = state;
            true
        })
    }

    /// How far [`Body::exact`], over `dt` from `from`, may have rounded a coordinate and a velocity of `to`: a
    /// bound on the errors of its arithmetic, for exact arguments.
    fn exact_error(
        &self,
        _dt: f64,
        _from: &State<Self::Vector>,
        _to: &State<Self::Vector>,
    ) -> [f64; 2] {
        [f64::INFINITY; 2]
    }

    /// Whether the acceleration is a linear function of coordinates and velocities, but for a constant: then
    /// what a method makes of one deviation it makes of all.
    fn is_linear(&self) -> bool {
        false
    }

    /// Whether this coordinate is an angle, of which a full turn changes nothing.
    fn is_angle(&self, _coordinate: usize) -> bool {
        false
    }

    /// The smooth piece of the force law that a state lies on, of pieces in a row. A reference solution
    /// steps from one to the next without a corner inside a step.
    fn piece(&self, _state: &State<Self::Vector>) -> usize {
        0
    }

    /// How far a state is from the end of a piece towards the one before and towards the one after, of the
    /// order of 1; negative beyond it by more than a rounding.
    fn room(&self, _piece: usize, _state: &State<Self::Vector>) -> [f64; 2] {
        [f64::INFINITY; 2]
    }

    /// The acceleration by this piece of the force law, continued smoothly beyond its ends.
    #[inline]
    fn acceleration_on(
        &self,
        _piece: usize,
        t: f64,
        q: &Self::Vector,
        v: &Self::Vector,
        a: &mut Self::Vector,
    ) {
        self.acceleration(t, q, v, a);
    }

    /// The conserved energy in joules, or `None` where none is conserved.
    fn energy(&self, state: &State<Self::Vector>) -> Option<f64>;

    /// The part of that energy that is the motion's, in joules: what would be missing at rest in the same
    /// place. A body whose coordinates are on the heap says so without allocating.
    fn kinetic_energy(&self, state: &State<Self::Vector>) -> Option<f64> {
        let mut still = state.clone();
        still.v.components_mut().fill(0.0);
        Some(self.energy(state)? - self.energy(&still)?)
    }

    /// Changes the body or its state at once. Returns whether the body takes that kind of input.
    fn input(&mut self, input: Input, state: &mut State<Self::Vector>) -> bool;

    /// Where the body is, in metres: the point that the camera, trails and arrows refer to.
    fn place(&self, q: &Self::Vector) -> DVec2;
}

/// What a person or a script does to a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// Sets the thrust to this part of the full thrust, -1 to 1.
    Throttle(f64),
    /// Lays the rudder to this part of its full angle: -1 is hard right, 1 hard left.
    Rudder(f64),
    /// Adds an impulse: this many times the body's own kick.
    Kick(f64),
}

/// What is known of a body's motion, for methods to be held against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// A closed form, computed afresh at every tick.
    Exact,
    /// No closed form: a numerical solution that aims at [`REFERENCE_ACCURACY`], and estimates on each run
    /// what it reaches.
    ///
    /// [`REFERENCE_ACCURACY`]: crate::sim::REFERENCE_ACCURACY
    Reference,
}

impl Truth {
    /// The name of the truth's lane in output.
    pub fn id(self) -> &'static str {
        match self {
            Truth::Exact => "exact",
            Truth::Reference => "reference",
        }
    }

    /// The error that what is not exact aims at; see [`REFERENCE_ACCURACY`].
    ///
    /// [`REFERENCE_ACCURACY`]: crate::sim::REFERENCE_ACCURACY
    pub fn aimed_accuracy(self) -> Option<f64> {
        match self {
            Truth::Exact => None,
            Truth::Reference => Some(REFERENCE_ACCURACY),
        }
    }
}

/// A body kind's card: its name, its coordinates, and the keys by which a scene describes it.
#[derive(Debug)]
pub struct Kind {
    /// The name of its table array in a scene.
    pub id: &'static str,
    /// Its equation of motion, in one line.
    pub about: &'static str,
    /// The coordinates of a body with these parameter values, in state order.
    pub coordinates: fn(&[f64]) -> &'static [Coordinate],
    /// The keys of its table, in the order in which [`Kind::build`] takes their values.
    pub parameters: &'static [Parameter],
    /// The kinds of input it takes: `throttle`, `rudder`, `kick`.
    pub inputs: &'static [&'static str],
    /// The key of the parameter that makes it stiffer: the motion faster, and the tick coarser beside it.
    pub leading: &'static str,
    /// Whether its motion has a closed form.
    pub truth: Truth,
    /// Says what is wrong with values that are each in range but do not go together.
    pub check: fn(&[f64]) -> Result<(), Fault>,
    /// Puts a body with these parameter values, as [`Body::with_parameters`] takes them, at its start under a
    /// solver.
    pub build: fn(&[f64], Solver) -> Box<dyn Stepper>,
}

impl Kind {
    /// The coordinates of a body that says no more than it must.
    pub fn plain_coordinates(&self) -> &'static [Coordinate] {
        let default = |parameter: &Parameter| parameter.default.unwrap_or(1.0);
        (self.coordinates)(&self.parameters.iter().map(default).collect::<Vec<_>>())
    }

    /// The parameter with this key, and its place among [`Kind::parameters`].
    pub fn parameter(&self, key: &str) -> Option<(usize, &'static Parameter)> {
        self.parameters.iter().enumerate().find(|(_, parameter)| parameter.key == key)
    }
}

/// One coordinate of a body.
#[derive(Debug)]
pub struct Coordinate {
    /// Its name, as in the CSV's `coordinate` column: fit to be typed.
    pub name: &'static str,
    /// The letter of its velocity.
    pub velocity: &'static str,
    /// Its unit.
    pub unit: &'static str,
}

/// Every kind of body, in menu order.
pub static BODIES: &[Kind] =
    &[ship::KIND, spring::KIND, chain::KIND, pendulum::KIND, orbit::KIND, helm::KIND];

/// The kind with this id.
pub fn kind(id: &str) -> Option<&'static Kind> {
    BODIES.iter().find(|kind| kind.id == id)
}
