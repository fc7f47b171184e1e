//! The trait that every body implements, the inputs of a body, and the smooth pieces of its force law.

use glam::DVec2;

use super::impact::Wall;
use super::parameter::{self, ParameterOf};
use super::state::Vector;
use super::system::{BodyClass, StateOf, System};

/// A kind of body that moves by an equation of motion.
pub trait Body: System<Vector: Vector> + Clone + Send + 'static {
    /// The class of the body, for methods that step only [some](super::integrators::Only) bodies.
    const CLASS: BodyClass = BodyClass::Forced;

    /// The inputs that the body accepts, from `throttle`, `rudder` and `kick`.
    const INPUTS: &'static [&'static str] = &["kick"];

    /// Whether the body has a closed form, [`Body::exact_into`].
    const HAS_EXACT: bool = false;

    /// Whether the body can have a [wall](Body::wall).
    const HAS_WALLS: bool = false;

    /// The parameters of this kind of body. The card of the kind describes them in
    /// `Kind::parameters`.
    const PARAMETERS: &'static [ParameterOf<Self>] = &[];

    /// Returns the body with these values of its [parameters](Body::PARAMETERS), in order. There is one value per
    /// parameter, and there are two per point of a curve.
    ///
    /// # Panics
    /// If the number of values is wrong, or if no body of this kind can be built from the values; see
    /// `Kind::check`.
    fn with_parameters(mut self, values: &[f64]) -> Self {
        parameter::write(&mut self, Self::PARAMETERS, values);
        self.prepare();
        self
    }

    /// Sets the parameter with this index, if it acts at once. Returns whether the body changed.
    fn set_parameter(&mut self, index: usize, value: f64) -> bool {
        let parameter = Self::PARAMETERS.get(index);
        let Some(field) = parameter.and_then(ParameterOf::acting_at_once) else { return false };
        let is_new = *field(self) != value;
        if is_new {
            *field(self) = value;
            self.prepare();
        }
        is_new
    }

    /// Recomputes fields derived from the parameters. Must be called after parameters are written.
    fn prepare(&mut self) {}

    /// Returns the memory of the body on the heap, in bytes.
    fn heap_bytes(&self) -> usize {
        0
    }

    /// Returns the state at tick 0.
    fn start(&self) -> StateOf<Self>;

    /// Overwrites `to` with the exact state `dt` (s) after the state `from` at time `t` (s), under constant input. The
    /// body must [have a closed form](Body::HAS_EXACT); the truth of any other body is a reference solution. Never
    /// allocates.
    fn exact_into(&self, _t: f64, _dt: f64, _from: &StateOf<Self>, _to: &mut StateOf<Self>) {
        unreachable!("a body with `HAS_EXACT` has a closed form");
    }

    /// Whether the body has a closed form with its parameters. A kind with [`Body::HAS_EXACT`] may lose it.
    fn has_exact(&self) -> bool {
        Self::HAS_EXACT
    }

    /// Returns the state that [`Body::exact_into`] computes from time 0; `None` if the body has no closed form.
    fn exact(&self, dt: f64, from: &StateOf<Self>) -> Option<StateOf<Self>> {
        self.has_exact().then(|| {
            let mut to = from.clone();
            self.exact_into(0.0, dt, from, &mut to);
            to
        })
    }

    /// Overwrites `to` with the exact state at time `t` (s) of a body untouched since the start. Returns whether the
    /// body knows this state. A body with [`Body::exact`] need not know it. Never allocates.
    fn exact_since_start(&self, _t: f64, _to: &mut StateOf<Self>) -> bool {
        false
    }

    /// Returns bounds on the rounding errors of a coordinate and of a velocity when [`Body::exact_into`] advances
    /// `_from` at time `_t` by `_dt` to `_to`. The bounds assume exact arguments.
    fn exact_error(
        &self,
        _t: f64,
        _dt: f64,
        _from: &StateOf<Self>,
        _to: &StateOf<Self>,
    ) -> [f64; 2] {
        [f64::INFINITY; 2]
    }

    /// Returns the acceleration of one coordinate. A body with walls and coordinates on the heap overrides this, so as
    /// not to allocate.
    fn acceleration_of(&self, t: f64, state: &StateOf<Self>, coordinate: usize) -> f64 {
        let mut a = state.v.clone();
        self.acceleration(t, &state.q, &state.v, &mut a);
        a.components()[coordinate]
    }

    /// Returns the wall with this index at time `t` (s), first the lower one; `None` beyond the last. Between impacts
    /// the body moves by its acceleration.
    fn wall(&self, _index: usize, _t: f64) -> Option<Wall> {
        None
    }

    /// Turns the velocities of a body that goes into a wall at time `t` (s). Returns whether the body does so itself,
    /// and not by the wall's restitution.
    fn turn(&self, _wall: usize, _t: f64, _state: &mut StateOf<Self>) -> bool {
        false
    }

    /// Makes the walls springs, or makes them hard again.
    fn soften(&mut self, _is_soft: bool) {}

    /// Returns the time (s) after the state `from` of the true impact of this number, and the height of the flight
    /// after it. Impacts count from 1, and number 0 is `from` itself. The height is NaN between two walls. `None` if
    /// there is no such impact, or no closed form.
    fn bounce(&self, _from: &StateOf<Self>, _impact: u64) -> Option<[f64; 2]> {
        None
    }

    /// Whether the acceleration is a linear function of coordinates and velocities, plus a constant.
    fn is_linear(&self) -> bool {
        false
    }

    /// Whether this coordinate is an angle, so that a full turn leaves the body unchanged.
    fn is_angle(&self, _coordinate: usize) -> bool {
        false
    }

    /// Returns the number of parts of the force law with corners or jumps.
    fn switches(&self) -> usize {
        0
    }

    /// Returns the first switch that is a wall, after all others. The reference solution sees to these switches.
    fn first_wall(&self) -> usize {
        usize::MAX
    }

    /// Returns the smooth piece of the force law at this time and state. A reference solution ends a step at each
    /// boundary between pieces, so that no step contains a corner.
    fn piece(&self, _t: f64, _state: &StateOf<Self>) -> Piece {
        Piece::FIRST
    }

    /// Returns the distances to the boundaries of a piece at this time and state.
    fn distances_to_ends(&self, _piece: &Piece, _t: f64, _state: &StateOf<Self>) -> Distances {
        NO_BOUNDARIES
    }

    /// Returns the mode of a switch beyond the lower boundary (`side` 0) or the upper boundary (`side` 1) of `mode`.
    fn neighbour(&self, _switch: usize, mode: i64, side: usize) -> i64 {
        mode + 2 * side as i64 - 1
    }

    /// Whether the force can jump at a boundary between pieces. If it only has corners, a step may miss a boundary by
    /// more than rounding.
    fn has_jumps(&self) -> bool {
        false
    }

    /// Overwrites `a` with the acceleration of this piece of the force law, continued smoothly beyond the piece's
    /// boundaries.
    #[inline]
    fn acceleration_on(
        &self,
        _piece: &Piece,
        t: f64,
        q: &Self::Vector,
        v: &Self::Vector,
        a: &mut Self::Vector,
    ) {
        self.acceleration(t, q, v, a);
    }

    /// Returns the conserved energy in joules; `None` if no energy is conserved.
    fn energy(&self, _state: &StateOf<Self>) -> Option<f64> {
        None
    }

    /// Returns the kinetic part of [`Body::energy`], in joules, which is the energy minus the energy of the body at
    /// rest in the same place. A body with coordinates on the heap overrides this function so that it does not
    /// allocate.
    fn kinetic_energy(&self, state: &StateOf<Self>) -> Option<f64> {
        let mut still = state.clone();
        still.v.components_mut().fill(0.0);
        Some(self.energy(state)? - self.energy(&still)?)
    }

    /// Returns the kinetic and the potential energy in joules, conserved or not; `None` if they are unknown. Damping
    /// can only decrease their sum.
    fn mechanical_energy(&self, state: &StateOf<Self>) -> Option<[f64; 2]> {
        let kinetic = self.kinetic_energy(state)?;
        Some([kinetic, self.energy(state)? - kinetic])
    }

    /// Estimates the work of a reference solution, in evaluations of the parts of the force law per simulated second. A
    /// body with more than [`MAX_REFERENCE_WORK`](super::MAX_REFERENCE_WORK) has no truth.
    fn reference_work(&self) -> f64 {
        0.0
    }

    /// Makes the numbers of a new state agree, where some follow from others. Changes no bit where they do.
    fn settle(&self, _state: &mut StateOf<Self>) {}

    /// Applies an input to the body or its state at once. Returns whether this kind of body accepts it.
    fn input(&mut self, input: Input, state: &mut StateOf<Self>) -> bool;

    /// Returns the position of the body in metres, to which the camera, trails and arrows refer. By default, this is
    /// the first coordinate, to the right.
    fn place(&self, q: &Self::Vector) -> DVec2 {
        DVec2::new(q.components()[0], 0.0)
    }
}

/// An input from a person or a script.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Input {
    /// Sets the thrust to this fraction of full thrust, from -1 to 1.
    Throttle(f64),
    /// Sets the rudder to this fraction of its full angle, from -1 (hard right) to 1 (hard left).
    Rudder(f64),
    /// Adds an impulse, which is this multiple of the body's own kick.
    Kick(f64),
}

/// The largest number of switches of a body.
pub const MAX_SWITCHES: usize = 32;

/// A smooth piece of a force law, named by the mode of each switch. A switch is a part of the law with a corner or a
/// jump; a body without switches has one piece.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// The modes, in the order of the switches; 0 beyond the last switch.
    pub modes: [i64; MAX_SWITCHES],
}

impl Piece {
    /// The piece with every switch in mode 0.
    pub const FIRST: Self = Self { modes: [0; MAX_SWITCHES] };
}

/// Signed distances from a state to the boundaries of a piece. Each switch has a distance to the mode below and one to
/// the mode above. A distance is negative if the state is beyond the boundary by more than rounding, and infinite if
/// there is no boundary.
pub type Distances = [[f64; 2]; MAX_SWITCHES];

/// The distances of a piece without boundaries.
pub const NO_BOUNDARIES: Distances = [[f64::INFINITY; 2]; MAX_SWITCHES];
