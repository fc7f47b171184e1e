//! The card of a kind of body.

use std::any::Any;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use crate::batch::{Batch, InstructionSet, NewBatch};
use crate::body::Body;
use crate::body_stepper::stepper;
use crate::impact::Impact;
use crate::law::{Equations, shown_unit};
use crate::net_plan::NetPlan;
use crate::parameter::{Fault, Parameter, ParameterOf, Text};
use crate::reference::REFERENCE_ACCURACY;
use crate::state::State;
use crate::stepper::{Solver, Stepper};
use crate::system::{BodyClass, EngineSettings};

/// The kind of solution with which methods are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// A closed form, evaluated at every tick.
    Exact,
    /// A numerical solution that aims at [`REFERENCE_ACCURACY`] and estimates its error on each run.
    ///
    /// [`REFERENCE_ACCURACY`]: crate::REFERENCE_ACCURACY
    Reference,
}

impl Truth {
    /// Returns the name of the truth's lane in the output.
    pub fn id(self) -> &'static str {
        match self {
            Truth::Exact => "exact",
            Truth::Reference => "reference",
        }
    }

    /// Returns the caption of a run without this truth.
    pub fn missing(self) -> &'static str {
        match self {
            Truth::Exact => "no exact solution",
            Truth::Reference => "no reference",
        }
    }

    /// Returns the error that a reference solution aims at, [`REFERENCE_ACCURACY`]; `None` for an exact truth.
    ///
    /// [`REFERENCE_ACCURACY`]: crate::REFERENCE_ACCURACY
    pub fn aimed_accuracy(self) -> Option<f64> {
        match self {
            Truth::Exact => None,
            Truth::Reference => Some(REFERENCE_ACCURACY),
        }
    }
}

/// A function that builds a body from the values of its parameters, under a solver.
pub type Build = dyn Fn(&[f64], Solver) -> Box<dyn Stepper> + Send + Sync;

/// A function that checks combinations of values, each of which is in range.
pub type Check = dyn Fn(&[f64]) -> Result<(), Fault> + Send + Sync;

/// A function that makes copies of a body from these starts, on an instruction set. It returns `None` if the body has
/// no batch.
pub type BatchFn = fn(&dyn Any, InstructionSet, Solver, Vec<State<f64>>) -> Option<NewBatch>;

/// The card of a kind of body: its name, its coordinates, and its keys in a scene.
pub struct Kind {
    /// The name of the table array in a scene.
    pub id: &'static str,
    /// The equation of motion, in one line.
    pub about: Text,
    /// All coordinates that such a body can have, in state order.
    pub all_coordinates: Coordinates,
    /// Whether the first parameter is the number of coordinates; otherwise a body has all of them.
    pub is_counted: bool,
    /// The keys of the table in a scene, in the order of the values that [`Kind::build`] expects.
    pub parameters: Vec<Parameter>,
    /// The inputs that the body accepts, from `throttle`, `rudder` and `kick`.
    pub inputs: &'static [&'static str],
    /// The key of the parameter that makes the body stiffer. Larger values make the motion faster in relation to the
    /// tick.
    pub leading: Text,
    /// Whether the truth of the body is a closed form or a reference solution.
    pub truth: Truth,
    /// Whether such bodies meet walls, whose impacts follow a rule of [`IMPACTS`](crate::IMPACTS).
    pub has_walls: bool,
    /// Checks combinations of values, each of which is in range.
    pub check: Box<Check>,
    /// Builds a body from these parameter values (see [`Body::with_parameters`](super::Body::with_parameters)), at the
    /// body's start under a solver.
    pub build: Box<Build>,
    /// The class of the bodies, for methods that step only some bodies.
    pub class: BodyClass,
    /// The source of the equations.
    pub origin: Origin,
    /// Makes copies of a body with its present parameters and inputs. Returns `None` if the body has several
    /// coordinates.
    pub batch: BatchFn,
}

/// The source of a kind's equations.
#[derive(Clone, Debug)]
pub enum Origin {
    /// A line of [`BODIES`](super::BODIES).
    Table,
    /// The equations of a [law](super::law_kind), which a scene writes itself.
    Law(Arc<Equations>),
    /// A [custom body](super::custom_kind).
    Custom(Arc<CustomInfo>),
    /// The nodes and springs of a [net](super::net_kind), which a scene lays out.
    Net(Arc<NetPlan>),
}

/// The coordinates of a custom body, and the plane in which it is drawn.
#[derive(Debug)]
pub struct CustomInfo {
    /// The coordinates, in state order.
    pub coordinates: Vec<Coordinate>,
    /// The indices of the coordinates that are x and y of the drawing plane; `None` if there is no plane.
    pub plane: Option<[usize; 2]>,
}

/// Two origins are equal if both describe the same bodies, by the same text or plan, or as clones of one custom body.
impl PartialEq for Origin {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Origin::Table, Origin::Table) => true,
            (Origin::Law(a), Origin::Law(b)) => a.text() == b.text(),
            (Origin::Custom(a), Origin::Custom(b)) => Arc::ptr_eq(a, b),
            (Origin::Net(a), Origin::Net(b)) => a == b,
            _ => false,
        }
    }
}

/// Two kinds are equal if both describe the same bodies.
impl PartialEq for Kind {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id && self.origin == other.origin
    }
}

impl fmt::Debug for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Kind").field("id", &self.id).field("about", &self.about).finish()
    }
}

impl Kind {
    /// Returns the kind of bodies like `blank`. It has the fields that most kinds share, but no name, coordinates and
    /// leading parameter yet.
    pub(super) fn of<B: Body>(blank: B) -> Self {
        Self::checked(blank, |_, _| Ok(()))
    }

    /// Returns a kind as [`Kind::of`] does, but with a check of combinations of values, which gets a copy of `blank`.
    pub(super) fn checked<B: Body>(
        blank: B,
        check: impl Fn(B, &[f64]) -> Result<(), Fault> + Send + Sync + 'static,
    ) -> Self {
        // A body need not be `Sync`, so that each thread gets a copy.
        let template = Arc::new(Mutex::new(blank));
        let copy = move || template.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let copy_to_check = copy.clone();
        Self {
            id: "",
            about: "".into(),
            all_coordinates: Vec::new().into(),
            is_counted: false,
            parameters: B::PARAMETERS.iter().map(ParameterOf::parameter).collect(),
            inputs: B::INPUTS,
            leading: "".into(),
            truth: if B::HAS_EXACT { Truth::Exact } else { Truth::Reference },
            has_walls: B::HAS_WALLS,
            check: Box::new(move |values| check(copy_to_check(), values)),
            build: Box::new(move |values, solver| stepper(copy().with_parameters(values), solver)),
            class: B::CLASS,
            origin: Origin::Table,
            batch: |_, _, _, _| None,
        }
    }

    /// Returns a kind as [`Kind::of`] does, for bodies of one coordinate whose copies are stepped in blocks.
    pub(super) fn of_one<B: Body<Vector = f64> + Sync>(blank: B) -> Self {
        let batch: BatchFn = |body, set, solver, starts| {
            Some(Batch::on(set, body.downcast_ref::<B>()?, solver, starts.into_iter()))
        };
        Self { batch, ..Self::of(blank) }
    }

    /// Returns the kind of truth of a body with these parameter values. A floor that moves takes a ball's closed form.
    pub fn truth_of(&self, values: &[f64]) -> Truth {
        let is_exact =
            self.truth == Truth::Exact && (self.build)(values, Solver::Truth).is_closed_form();
        if is_exact { Truth::Exact } else { Truth::Reference }
    }

    /// Returns the coordinates of a body with these parameter values, in state order.
    pub fn coordinates(&self, values: &[f64]) -> Coordinates {
        match values {
            [count, ..] if self.is_counted => self.all_coordinates.first(*count as usize),
            _ => self.all_coordinates.clone(),
        }
    }

    /// Returns the default of each parameter, or 1 if the parameter has no default.
    pub fn plain_values(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.default.unwrap_or(1.0)).collect()
    }

    /// Returns the equations, if this is the kind of a law.
    pub fn law(&self) -> Option<&Arc<Equations>> {
        if let Origin::Law(equations) = &self.origin { Some(equations) } else { None }
    }

    /// Returns the reason why such bodies do not follow a rule for impacts, in words; `None` if they may, or meet no
    /// wall.
    pub fn impact_refusal(&self, impact: &Impact) -> Option<String> {
        let law = self.law().filter(|_| self.has_walls && impact.needs_energy())?;
        let why = "needs the `energy` of the law, which has none";
        law.text().energy.is_none().then(|| format!("the rule {impact:?} {why}"))
    }

    /// Returns the plan, if this is the kind of a net.
    pub fn net(&self) -> Option<&Arc<NetPlan>> {
        if let Origin::Net(plan) = &self.origin { Some(plan) } else { None }
    }

    /// Splits a coordinate name of a net into the symbol and the node number, for example `vx11` into `vx` and `11`.
    /// Returns `None` for other kinds.
    pub fn node<'n>(&self, name: &'n str) -> Option<(&'n str, &'n str)> {
        let symbol = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
        self.net().map(|_| name.split_at(symbol.len()))
    }

    /// Returns the stiffness in 1/s² and the damping in 1/s, each per unit of mass, of the engine joint that equals
    /// this body. Returns `None` if the body is no spring, or has other forces too.
    pub fn joint(&self, body: &dyn Stepper) -> Option<[f64; 2]> {
        let EngineSettings { stiffness, damping, drag } = body.engine_settings(0.0);
        let is_joint = self.class == BodyClass::Joint && stiffness > 0.0 && drag == 0.0;
        is_joint.then_some([stiffness, damping])
    }

    /// Returns the parameter with this key, and its index in [`Kind::parameters`].
    pub fn parameter(&self, key: &str) -> Option<(usize, &Parameter)> {
        self.parameters.iter().enumerate().find(|(_, parameter)| parameter.key == key)
    }
}

/// One coordinate of a body.
#[derive(Clone, Debug)]
pub struct Coordinate {
    /// The name of the coordinate, as in the `coordinate` column of the CSV. It is ASCII, and easy to type.
    pub name: Arc<str>,
    /// The name of the coordinate's velocity.
    pub velocity: Arc<str>,
    /// The unit of the coordinate.
    pub unit: &'static str,
}

/// The coordinates of a body, in state order. A large net computes the names of its coordinates on demand.
#[derive(Clone)]
pub struct Coordinates {
    count: usize,
    named: Named,
}

/// A function that names a coordinate and its velocity by the coordinate's index.
type Naming = dyn Fn(usize) -> [String; 2] + Send + Sync;

#[derive(Clone)]
enum Named {
    List(Arc<[Coordinate]>),
    Computed { naming: Arc<Naming>, unit: &'static str },
}

impl From<Vec<Coordinate>> for Coordinates {
    fn from(list: Vec<Coordinate>) -> Self {
        Self { count: list.len(), named: Named::List(list.into()) }
    }
}

impl Coordinates {
    /// Returns `count` coordinates of one unit; `naming` names each coordinate and its velocity.
    pub(super) fn by_rule(count: usize, unit: &'static str, naming: Arc<Naming>) -> Self {
        Self { count, named: Named::Computed { naming, unit } }
    }

    /// Returns the first `count` coordinates, or all coordinates if there are fewer.
    #[must_use]
    pub fn first(&self, count: usize) -> Self {
        Self { count: count.min(self.count), named: self.named.clone() }
    }

    /// Returns the number of coordinates.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are no coordinates, as in a blank kind.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Returns the coordinate with this index, if there is one.
    pub fn get(&self, index: usize) -> Option<Coordinate> {
        (index < self.count).then(|| match &self.named {
            Named::List(list) => list[index].clone(),
            Named::Computed { naming, unit } => {
                let [name, velocity] = naming(index);
                Coordinate::new(name, velocity, unit)
            }
        })
    }

    /// Returns the coordinate with this index.
    ///
    /// # Panics
    /// If there is no coordinate with this index.
    pub fn at(&self, index: usize) -> Coordinate {
        self.get(index).expect("an index of a coordinate")
    }

    /// Iterates over all coordinates.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Coordinate> + Clone + '_ {
        (0..self.count).map(|index| self.at(index))
    }

    /// Returns the unit of each coordinate.
    pub fn units(&self) -> impl Iterator<Item = &'static str> + Clone + '_ {
        (0..self.count).map(|index| match &self.named {
            Named::List(list) => list[index].unit,
            Named::Computed { unit, .. } => unit,
        })
    }
}

impl Coordinate {
    pub(super) fn new(
        name: impl Into<Arc<str>>,
        velocity: impl Into<Arc<str>>,
        unit: &'static str,
    ) -> Self {
        Self { name: name.into(), velocity: velocity.into(), unit }
    }

    /// Returns the unit as people read it, which is empty for a pure number.
    pub fn shown_unit(&self) -> &'static str {
        shown_unit(self.unit)
    }
}
