//! Makes a scene of a custom body, for which a [`System`] and a start are enough.

use std::any::Any;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use super::lane_spec::LaneSpec;
use super::{
    Appearance, Drawing, MAX_LANES, MAX_NAME_CHARS, MAX_SECONDS, MIN_SECONDS, Mark, Scene,
    SceneBody, claim_horizon,
};
use crate::sim::bodies::{CustomFault, Extras, custom_kind, incompatibility};
use crate::sim::integrators::{METHODS, Method};
use crate::sim::{State, System, TickRate, Vector};

/// Draws a system at these coordinates, in metres, x right and y up.
pub type Draw<S> = fn(&S, &<S as System>::Vector) -> Vec<Mark>;

/// Maximum work of advice by default, in evaluations of one coordinate. It takes a second or two.
pub const MAX_WORK: u64 = 100_000_000;

/// Options of an experiment on a custom body. Every field has a [default](Options::default).
#[derive(Clone)]
pub struct Options<S: System> {
    /// Name of the body for people, with at most [`MAX_NAME_CHARS`] characters. The default is `body`.
    pub name: &'static str,
    /// Ticks per second, in [`Clock::TICK_HZ`](crate::sim::Clock::TICK_HZ). The default is 60.
    pub tick_hz: TickRate,
    /// Length of the run in seconds, from [`MIN_SECONDS`] to [`MAX_SECONDS`]. The default is 20. Verdicts are on the
    /// first minute.
    pub seconds: f64,
    /// The methods in the race, at most [`MAX_LANES`], from [`METHODS`] or custom ones. If the list is empty, all
    /// methods race that step such a body.
    pub methods: Vec<&'static Method>,
    /// Maximum work of advice, in evaluations of one coordinate. Because work is counted and not
    /// timed, advice is the same on every machine; lanes beyond the limit stay unknown. The default, [`MAX_WORK`],
    /// takes a second or two; `u64::MAX` is no limit.
    pub max_work: u64,
    /// Facts about the body beyond its equation.
    pub extras: Extras<S>,
    /// Draws the body. If it is `None`, the picture shows a bead in the plane, or a bead on a rail for each coordinate.
    pub draw: Option<Draw<S>>,
}

impl<S: System> Default for Options<S> {
    fn default() -> Self {
        Self {
            name: "body",
            tick_hz: TickRate::whole(60),
            seconds: 20.0,
            methods: Vec::new(),
            max_work: MAX_WORK,
            extras: Extras::default(),
            draw: None,
        }
    }
}

/// An invalid option, or a claim that the equation contradicts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OptionsError {
    /// The field of [`Options`] or [`Extras`], or `start`, or `acceleration`.
    pub field: &'static str,
    /// Description of the fault.
    pub what: String,
    /// Description of the remedy.
    pub remedy: String,
}

impl fmt::Display for OptionsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { field, what, remedy } = self;
        write!(f, "`{field}`: {what}; {remedy}")
    }
}

impl std::error::Error for OptionsError {}

impl From<CustomFault> for OptionsError {
    fn from(CustomFault { field, what, remedy }: CustomFault) -> Self {
        Self { field, what, remedy: remedy.to_owned() }
    }
}

fn error(field: &'static str, what: String, remedy: impl Into<String>) -> OptionsError {
    OptionsError { field, what, remedy: remedy.into() }
}

impl Scene {
    /// Returns the scene of one body that moves as `system` does, from `start`. The scene has no source text, so it
    /// cannot be recorded.
    ///
    /// # Errors
    /// If an option is out of its range or unfit, or if the equation contradicts an energy or an exact solution.
    pub fn of<S>(
        system: &S,
        start: State<S::Vector>,
        options: Options<S>,
    ) -> Result<Scene, OptionsError>
    where
        S: System<Vector: Vector> + Clone + Send + 'static,
    {
        let Options { name, tick_hz, seconds, methods, max_work: _, extras, draw } = options;
        if name.is_empty() || name.chars().count() > MAX_NAME_CHARS {
            let what = format!("{name:?} has {} characters", name.chars().count());
            return Err(error("name", what, format!("give it 1 to {MAX_NAME_CHARS}")));
        }
        if !tick_hz.is_in_range() {
            let remedy = format!("give a rate from {} to {} Hz", TickRate::MIN, TickRate::MAX);
            return Err(error("tick_hz", tick_hz.to_string(), remedy));
        }
        if !(MIN_SECONDS..=MAX_SECONDS).contains(&seconds) {
            let remedy = format!("give a length from {MIN_SECONDS} to {MAX_SECONDS} s");
            return Err(error("seconds", seconds.to_string(), remedy));
        }
        let drawing = draw.map(|draw| drawing::<S>(draw, start.q.clone()));
        let appearance = Arc::new(Appearance::drawn(drawing));
        let kind = custom_kind(system, &start, &extras, claim_horizon(seconds, tick_hz))?;
        let values = kind.plain_values();
        let steps = |method: &&'static Method| incompatibility(method, &kind, &values).is_none();
        let lanes = match &methods[..] {
            [] => METHODS
                .iter()
                .filter(|method| method.is_for_games())
                .filter(steps)
                .map(LaneSpec::plain)
                .collect(),
            chosen => {
                check_methods(chosen)?;
                if let Some(method) = chosen.iter().find(|method| !steps(method)) {
                    let reason = incompatibility(method, &kind, &values).unwrap_or_default();
                    return Err(error(
                        "methods",
                        format!("{}: {reason}", method.id),
                        "leave it out",
                    ));
                }
                chosen.iter().map(|method| LaneSpec::plain(method)).collect()
            }
        };
        Ok(Scene {
            name: name.to_owned(),
            source: None,
            title: name.to_owned(),
            about: String::new(),
            hint: None,
            tick_hz,
            seconds,
            lanes,
            opening_method: None,
            equal_cost: false,
            opens_as_race: methods.len() != 1,
            opens_in_bands: false,
            clouds: None,
            bodies: vec![SceneBody { appearance, ..SceneBody::new(name, kind, values) }],
            script: Vec::new(),
            own_methods: Vec::new(),
            checks: Vec::new(),
        })
    }
}

/// Returns the scene of these options.
///
/// # Panics
/// If an option is invalid.
#[track_caller]
pub fn scene<S>(system: &S, start: State<S::Vector>, options: Options<S>) -> Scene
where
    S: System<Vector: Vector> + Clone + Send + 'static,
{
    match Scene::of(system, start, options) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

fn check_methods(chosen: &[&'static Method]) -> Result<(), OptionsError> {
    if chosen.len() > MAX_LANES {
        let remedy = format!("name at most {MAX_LANES}");
        return Err(error("methods", format!("these are {}", chosen.len()), remedy));
    }
    for (i, method) in chosen.iter().enumerate() {
        if chosen[..i].contains(method) {
            return Err(error("methods", format!("two have the id {:?}", method.id), "rename one"));
        }
        let is_listed = METHODS.iter().any(|listed| listed.id == method.id);
        if is_listed && method.custom.is_some() {
            let what = format!("a method of the table has the id {:?} too", method.id);
            return Err(error("methods", what, "give yours another id"));
        }
        if !is_listed && method.custom.is_none() {
            let what = format!("{:?} is not in the table", method.id);
            return Err(error(
                "methods",
                what,
                "say in the field `custom` of its card how it is built",
            ));
        }
    }
    Ok(())
}

/// Returns the drawing function of a custom body. `like` is a vector with the body's number of coordinates.
fn drawing<S: System<Vector: Vector> + 'static>(draw: Draw<S>, like: S::Vector) -> Box<Drawing> {
    let like = Mutex::new(like);
    let draw = move |system: &dyn Any, q: &[f64]| {
        let mut own_q = like.lock().unwrap_or_else(PoisonError::into_inner).clone();
        own_q.components_mut().copy_from_slice(q);
        system.downcast_ref().map_or_else(Vec::new, |system| draw(system, &own_q))
    };
    Box::new(draw)
}
