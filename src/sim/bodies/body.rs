//! What every body implements, and what can be done to one.

use glam::DVec2;

use super::parameter::{self, ParameterOf};
use crate::sim::system::{State, System, Vector};

/// Something that moves by an equation of motion.
pub trait Body: System + Clone + Send + 'static {
    /// What can be set about the body. Its card lists the descriptions, as [`Kind::parameters`](super::Kind::parameters).
    const PARAMETERS: &'static [ParameterOf<Self>] = &[];

    /// The body with these values of its [parameters](Body::PARAMETERS), in their order: one value for each
    /// parameter, and two for each point of a curve.
    ///
    /// # Panics
    /// If there are fewer values or more, or if no body of this kind can be built from them: see [`Kind::check`](super::Kind::check).
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
