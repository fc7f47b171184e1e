//! Optional properties of a custom body.

use crate::sim::parameter::ParameterOf;
use crate::sim::state::State;
use crate::sim::system::System;

/// The energy in joules of a system in a state.
pub type Energy<S> = fn(&S, &State<<S as System>::Vector>) -> f64;

/// The exact state of a system at a time (s) after the start.
pub type Exact<S> = fn(&S, f64) -> State<<S as System>::Vector>;

/// Optional properties of a custom body. Each has a default.
pub struct Extras<S: System> {
    /// The name and the unit of each coordinate, such as `("height", "m")`; an angle has the unit `rad`. Empty:
    /// x, y and z, or q1, q2 …, in metres.
    pub coordinates: Vec<(&'static str, &'static str)>,
    /// The indices of the coordinates that are x and y of the plane in which it is drawn. `None`: two
    /// coordinates in metres make a plane, others have a rail each.
    pub plane: Option<[usize; 2]>,
    /// Numbers of the system that may be changed while it moves, made by
    /// [`ParameterOf::number`]. The first should be one that makes it stiffer. Empty: a factor of the acceleration,
    /// `force`.
    pub parameters: Vec<ParameterOf<S>>,
    /// The energy in joules, which must be conserved. `None`: nothing is said of energy.
    pub energy: Option<Energy<S>>,
    /// The exact state at time t (s) after the start. `None`: the truth is a numerical reference solution.
    pub exact: Option<Exact<S>>,
    /// Whether the acceleration is a linear function of coordinates and velocities, apart from a constant, at all
    /// times. Methods are then judged by the normal modes, for any length of time. The default is no.
    pub is_linear: bool,
    /// The change of the velocity by one kick. `None`: 1 per second in the first coordinate.
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
