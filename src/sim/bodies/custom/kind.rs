//! The kind of a custom body, and batches of copies of it.

use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};

use super::motion::Motion;
use super::{Custom, CustomFault, Extras, claims};
use crate::batch::{Batch, Copies, InstructionSet, NewBatch, UniformBlock};
use crate::bodies::claims::ClaimHorizon;
use crate::bodies::kind::{Coordinate, CustomInfo, Kind, Origin};
use crate::integrators::Problem;
use crate::parameter::{Fault, Parameter, ParameterOf, Range, TakesEffect, Text};
use crate::state::{State, Vector};
use crate::stepper::Solver;
use crate::system::{StateOf, System};

/// The key of the only parameter of a body without parameters of its own.
const FORCE: &str = "force";

/// The maximum number of coordinates. A larger system needs a sparse Jacobian, and therefore a body type of its own.
const MAX_COORDINATES: usize = 256;

/// Returns the kind of bodies that move as `system` does, from `start`. Checks the claims of `extras` against the
/// motion at the ticks of `horizon`. The defaults of the kind's parameters are the numbers of `system`.
///
/// # Errors
/// If the start, a name or a unit is unfit, or if a claim of `extras` does not hold.
pub fn custom_kind<S>(
    system: &S,
    start: &StateOf<S>,
    extras: &Extras<S>,
    horizon: ClaimHorizon,
) -> Result<Arc<Kind>, CustomFault>
where
    S: System<Vector: Vector> + Clone + Send + 'static,
{
    let [n, velocities] = [&start.q, &start.v].map(|half| half.components().len());
    let fault = |field, what: String, remedy| Err(CustomFault { field, what, remedy });
    if n == 0 || n > MAX_COORDINATES || velocities != n {
        let what = format!("it has {n} coordinates and {velocities} velocities");
        return fault("start", what, "give it as many of both, 1 to 256");
    }
    let mut a = start.v.clone();
    system.acceleration(0.0, &start.q, &start.v, &mut a);
    let given = a.components().len();
    if given != n {
        let what = format!("it replaces its {n} numbers by {given}");
        return fault("acceleration", what, "overwrite the numbers of `a`, and keep its length");
    }
    let coordinates = coordinates(&extras.coordinates, n)?;
    let plane = plane(extras.plane, &coordinates)?;
    let parameters: Vec<Parameter> = match &extras.parameters[..] {
        [] => vec![force_parameter()],
        given => given.iter().map(|of| with_default(of, system)).collect(),
    };
    check_keys(&parameters)?;
    let mut kick = vec![0.0; n];
    match &extras.kick {
        Some(given) if given.components().len() == n => kick.copy_from_slice(given.components()),
        Some(_) => {
            return fault("kick", "it has another length".into(), "give it one velocity each");
        }
        None => kick[0] = 1.0,
    }
    let body = Custom {
        info: Arc::new(CustomInfo { coordinates, plane }),
        values: parameters.iter().filter_map(|parameter| parameter.default).collect(),
        kick,
        ..Custom::unnamed(system.clone(), start, extras)
    };
    claims::check(&body, horizon)?;
    Ok(Arc::new(kind(body, parameters)))
}

/// Returns the parameter, with the number of `system` as its default.
fn with_default<S: System<Vector: Vector> + Clone>(
    parameter: &ParameterOf<S>,
    system: &S,
) -> Parameter {
    let default = parameter.acting_at_once().map(|field| *field(&mut system.clone()));
    Parameter { default, ..parameter.parameter() }
}

fn force_parameter() -> Parameter {
    let about = "what its acceleration is multiplied by";
    let parameter = Parameter::new(FORCE.into(), about, Range::POSITIVE, TakesEffect::AtOnce);
    Parameter { default: Some(1.0), ..parameter }
}

fn kind(body: Custom, parameters: Vec<Parameter>) -> Kind {
    let info = body.info.clone();
    let leading = parameters[0].key.clone();
    let key = leading.clone();
    let check = move |mut body: Custom, values: &[f64]| {
        body.write(values);
        claims::check_start(&body).map_err(|fault| Fault {
            key: key.clone(),
            what: fault.what,
            remedy: "take values with a finite one".into(),
        })
    };
    Kind {
        id: "custom",
        about: "a body written in Rust".into(),
        all_coordinates: info.coordinates.clone().into(),
        parameters,
        leading,
        origin: Origin::Custom(info),
        batch,
        ..Kind::checked(body, check)
    }
}

/// Returns the names and units of `n` coordinates.
fn coordinates(
    given: &[(&'static str, &'static str)],
    n: usize,
) -> Result<Vec<Coordinate>, CustomFault> {
    let coordinate = |name: Text, unit| {
        let velocity = format!("v{name}");
        Coordinate::new(name, velocity, unit)
    };
    let fault = |what: String| {
        let remedy = "give each a name of its own of letters, digits and underscores";
        Err(CustomFault { field: "coordinates", what, remedy })
    };
    if given.is_empty() {
        let name = |i: usize| match n {
            ..=3 => ["x", "y", "z"][i].into(),
            _ => format!("q{}", i + 1).into(),
        };
        return Ok((0..n).map(|i| coordinate(name(i), "m")).collect());
    }
    if given.len() != n {
        return fault(format!("it names {} coordinates, and the start has {n}", given.len()));
    }
    for (i, (name, _)) in given.iter().enumerate() {
        if !is_name(name) || given[..i].iter().any(|(earlier, _)| earlier == name) {
            return fault(format!("{name:?} is no name for a coordinate, or the second"));
        }
    }
    Ok(given.iter().map(|&(name, unit)| coordinate(name.into(), unit)).collect())
}

fn is_name(name: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(is_letter)
}

/// Returns the given plane, or else the plane of two coordinates in metres.
fn plane(
    given: Option<[usize; 2]>,
    coordinates: &[Coordinate],
) -> Result<Option<[usize; 2]>, CustomFault> {
    match (given, coordinates) {
        (Some([x, y]), _) if x == y || x.max(y) >= coordinates.len() => Err(CustomFault {
            field: "plane",
            what: format!("coordinates {x} and {y} of {} make no plane", coordinates.len()),
            remedy: "name two coordinates by their indices, from 0",
        }),
        (None, [Coordinate { unit: "m", .. }, Coordinate { unit: "m", .. }]) => Ok(Some([0, 1])),
        (given, _) => Ok(given),
    }
}

fn check_keys(parameters: &[Parameter]) -> Result<(), CustomFault> {
    for (i, Parameter { key, acts, range, default, .. }) in parameters.iter().enumerate() {
        let is_taken = parameters[..i].iter().any(|earlier| earlier.key == *key);
        let is_number =
            *acts == TakesEffect::AtOnce && !matches!(range, Range::Count(_) | Range::Curve { .. });
        if !is_name(key) || is_taken || !is_number {
            return Err(CustomFault {
                field: "parameters",
                what: format!("{key:?} is no name for a number that acts at once, or the second"),
                remedy: "give each a name of its own, and make it by `ParameterOf::number`",
            });
        }
        let value = default.unwrap_or(f64::NAN);
        if !range.contains(value) {
            return Err(CustomFault {
                field: "parameters",
                what: format!("{key} is {value}, and its range is {range}"),
                remedy: "give the system another number, or the parameter a wider range",
            });
        }
    }
    Ok(())
}

/// Copies of a custom body of one coordinate. Threads do not share a motion, so that each copy has its own.
#[derive(Clone)]
struct CustomCopies(Arc<Mutex<Box<dyn Motion>>>);

/// Returns a batch of copies of a custom body; `None` if its coordinate vector is not one `f64`.
fn batch(
    body: &dyn Any,
    set: InstructionSet,
    solver: Solver,
    starts: Vec<State<f64>>,
) -> Option<NewBatch> {
    let Custom { motion, .. } = body.downcast_ref()?;
    motion.alone()?;
    let copies = CustomCopies(Arc::new(Mutex::new(motion.clone())));
    Some(Batch::with(&copies, solver, starts.into_iter(), set))
}

impl Copies for CustomCopies {
    const IS_INTERPRETED: bool = true;
    type Block<const W: usize> = UniformBlock<Problem<f64>, W>;

    fn block<const W: usize>(&self, _set: InstructionSet) -> UniformBlock<Problem<f64>, W> {
        UniformBlock(self.alone())
    }

    fn alone(&self) -> Problem<f64> {
        let motion = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        motion.alone().expect("it was of one coordinate")
    }
}
