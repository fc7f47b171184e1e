//! The card on which a kind of body describes itself.

use super::parameter::{Fault, Parameter};
use crate::sim::reference::REFERENCE_ACCURACY;
use crate::sim::solver::Solver;
use crate::sim::stepper::Stepper;

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
    /// Puts a body with these parameter values, as [`Body::with_parameters`](super::Body::with_parameters) takes them, at its start under a
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
