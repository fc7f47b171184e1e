//! The card of a kind of body.

use std::fmt;

use super::own_sheet::OwnSheet;
use crate::sim::law::{Equations, shown_unit};
use crate::sim::net_plan::NetPlan;
use crate::sim::parameter::{Fault, Parameter};
use crate::sim::reference::REFERENCE_ACCURACY;
use crate::sim::solver::Solver;
use crate::sim::stepper::Stepper;

/// The kind of solution that methods are compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// A closed form, evaluated at every tick.
    Exact,
    /// A numerical solution that aims at [`REFERENCE_ACCURACY`] and estimates its error on each run.
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

    /// What is said where it is missing, for people.
    pub fn missing(self) -> &'static str {
        match self {
            Truth::Exact => "no exact solution",
            Truth::Reference => "no reference",
        }
    }

    /// The error that a reference solution aims at, [`REFERENCE_ACCURACY`]; `None` for an exact truth.
    ///
    /// [`REFERENCE_ACCURACY`]: crate::sim::REFERENCE_ACCURACY
    pub fn aimed_accuracy(self) -> Option<f64> {
        match self {
            Truth::Exact => None,
            Truth::Reference => Some(REFERENCE_ACCURACY),
        }
    }
}

/// Builds a body from the values of its parameters, under a solver.
pub type Build = dyn Fn(&[f64], Solver) -> Box<dyn Stepper> + Send + Sync;

/// A body kind's card: its name, its coordinates, and the keys by which a scene describes it.
pub struct Kind {
    /// The name of its table array in a scene.
    pub id: &'static str,
    /// Its equation of motion, in one line.
    pub about: &'static str,
    /// The coordinates of a body with these parameter values, in state order.
    pub coordinates: &'static (dyn Fn(&[f64]) -> &'static [Coordinate] + Send + Sync),
    /// The keys of its table, in the order of the values that [`Kind::build`] expects.
    pub parameters: &'static [Parameter],
    /// The inputs that it accepts: `throttle`, `rudder`, `kick`.
    pub inputs: &'static [&'static str],
    /// The key of the parameter that makes it stiffer: larger values make the motion faster in relation
    /// to the tick.
    pub leading: &'static str,
    /// Whether its truth is a closed form or a reference solution.
    pub truth: Truth,
    /// Checks values that are each in range for errors in combination.
    pub check: &'static (dyn Fn(&[f64]) -> Result<(), Fault> + Send + Sync),
    /// Builds a body from these parameter values (see
    /// [`Body::with_parameters`](super::Body::with_parameters)), at its start under a solver.
    pub build: &'static Build,
    /// Why an engine cannot be [told](crate::sim::System::engine_settings) of such a body: a clause in lower case that
    /// follows a colon. `None` if it can.
    pub engine_refusal: Option<&'static str>,
    /// The equations of a [law](super::law_kind), which a scene writes itself; `None` for a kind of the
    /// table.
    pub law: Option<&'static Equations>,
    /// What is known of a [body of one's own](super::own_kind); `None` for a kind of the table.
    pub own: Option<&'static OwnSheet>,
    /// The nodes and springs of a [net](super::net_kind), which a scene lays out; `None` for any other kind.
    pub net: Option<&'static NetPlan>,
}

impl fmt::Debug for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Kind").field("id", &self.id).field("about", &self.about).finish()
    }
}

impl Kind {
    /// The coordinates of a body with default parameters, and 1 for those without a default.
    pub fn plain_coordinates(&self) -> &'static [Coordinate] {
        let default = |parameter: &Parameter| parameter.default.unwrap_or(1.0);
        (self.coordinates)(&self.parameters.iter().map(default).collect::<Vec<_>>())
    }

    /// The unit of what is drawn in its own scale, for people; empty if it has none.
    pub fn drawn_unit(&self) -> &'static str {
        match (self.law, self.own) {
            (Some(law), _) => law.drawn_unit(),
            (_, Some(sheet)) => sheet.drawn_unit(),
            (None, None) => "m",
        }
    }

    /// The parameter with this key, and its index in [`Kind::parameters`].
    pub fn parameter(&self, key: &str) -> Option<(usize, &'static Parameter)> {
        self.parameters.iter().enumerate().find(|(_, parameter)| parameter.key == key)
    }
}

/// One coordinate of a body.
#[derive(Debug)]
pub struct Coordinate {
    /// Its name, as in the `coordinate` column of the CSV: ASCII, easy to type.
    pub name: &'static str,
    /// The name of its velocity.
    pub velocity: &'static str,
    /// Its unit.
    pub unit: &'static str,
}

impl Coordinate {
    /// Its unit for people: empty for a pure number.
    pub fn shown_unit(&self) -> &'static str {
        shown_unit(self.unit)
    }
}
