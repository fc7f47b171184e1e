//! The bodies: one file each, one line each in the table below.
//!
//! A body is a closed system with natural coordinates, an exact flow where there is one, and an
//! outline. Its [`Kind`] card says how a scene describes it. To add one, copy `spring.rs`, declare it,
//! and name it in [`BODIES`].

use super::stepper::{Solver, Stepper};
use super::system::{State, System};

mod pen;
mod ship;
mod spring;

pub use pen::{Mark, Pen};
pub use ship::Ship;
pub use spring::Spring;

/// Something that moves by an equation of motion and can be drawn.
pub trait Body: System + Clone + Send + 'static {
    /// The state at tick 0.
    fn start(&self) -> State<Self::Vector>;

    /// The exact flow over `dt` (s) under constant input, or `None` where there is no closed form.
    fn exact(&self, dt: f64, from: &State<Self::Vector>) -> Option<State<Self::Vector>>;

    /// The conserved energy in joules, or `None` where none is conserved.
    fn energy(&self, state: &State<Self::Vector>) -> Option<f64>;

    /// Changes the body or its state at once. Returns whether the body takes that kind of input.
    fn input(&mut self, input: Input, state: &mut State<Self::Vector>) -> bool;

    /// Draws the body in metres, x right and y up, colourless: the lane brings the colour.
    fn outline(&self, state: &State<Self::Vector>, pen: &mut Pen);

    /// How the body wants to be looked at.
    fn view(&self) -> View;
}

/// What a person or a script does to a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// Sets the thrust to this part of the full thrust, -1 to 1.
    Throttle(f64),
    /// Adds an impulse: this many times the body's own kick.
    Kick(f64),
}

/// How a body wants to be looked at: what part of its world the stage shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// The camera follows the true body; this many metres are shown across.
    Follow {
        /// Metres across.
        width_m: f64,
    },
    /// The camera stays on the origin and shows this many metres to each side, more if the true
    /// body swings further.
    Fixed {
        /// Metres from the middle to the edge.
        half_width_m: f64,
    },
}

/// A body kind's card: its name, its coordinates, and the keys by which a scene describes it.
#[derive(Debug)]
pub struct Kind {
    /// The name of its table array in a scene.
    pub id: &'static str,
    /// Its equation of motion, in one line.
    pub about: &'static str,
    /// The coordinates, in state order.
    pub coordinates: &'static [Coordinate],
    /// The keys of its table, in the order [`Kind::build`] takes their values.
    pub parameters: &'static [Parameter],
    /// The kinds of input it takes: `throttle`, `kick`.
    pub inputs: &'static [&'static str],
    /// Puts a body with these parameter values at its start under a solver.
    pub build: fn(&[f64], Solver) -> Box<dyn Stepper>,
}

/// One coordinate of a body.
#[derive(Debug)]
pub struct Coordinate {
    /// Its letter, as in the CSV's `coordinate` column.
    pub name: &'static str,
    /// The letter of its velocity.
    pub velocity: &'static str,
    /// Its unit.
    pub unit: &'static str,
}

/// One key of a body's table in a scene.
#[derive(Debug)]
pub struct Parameter {
    /// The key, unit included.
    pub key: &'static str,
    /// What it is.
    pub about: &'static str,
    /// Its value where the scene does not say; `None` where the scene must.
    pub default: Option<f64>,
    /// What values are possible.
    pub range: Range,
}

/// The values a parameter may take. All are finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Greater than 0 and at most this.
    Positive(f64),
    /// From 0 to this.
    NonNegative(f64),
    /// From minus this to this.
    Within(f64),
}

impl Range {
    /// Whether `value` is possible.
    pub fn contains(self, value: f64) -> bool {
        match self {
            Range::Positive(most) => value > 0.0 && value <= most,
            Range::NonNegative(most) => value >= 0.0 && value <= most,
            Range::Within(most) => value >= -most && value <= most,
        }
    }
}

impl std::fmt::Display for Range {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let short = |x: f64| if x.abs() < 1e9 { format!("{x}") } else { format!("{x:e}") };
        match *self {
            Range::Positive(most) => write!(f, "greater than 0 and at most {}", short(most)),
            Range::NonNegative(most) => write!(f, "from 0 to {}", short(most)),
            Range::Within(most) => write!(f, "from {} to {}", short(-most), short(most)),
        }
    }
}

/// The largest magnitude of a body's parameter: beyond it, products in the force laws overflow.
pub const LARGEST: f64 = 1e15;

/// Every kind of body, in menu order.
pub static BODIES: &[Kind] = &[ship::KIND, spring::KIND];

/// The kind with this id.
pub fn kind(id: &str) -> Option<&'static Kind> {
    BODIES.iter().find(|kind| kind.id == id)
}
