//! The methods: one file each, one line each in the table below.
//!
//! A method implements [`Integrator`] for every [`System`] and describes itself on a [`Method`] card.
//! Menus, command line, help and tests loop over [`METHODS`]; the conformance suite measures each field
//! of each card, both ways. To add one, copy `improved_euler.rs`, declare it, and name it in `methods!`.

use super::system::{State, System, Vector};

mod adaptive_euler;
mod explicit_euler;
mod improved_euler;
mod rk4;
mod semi_implicit_euler;

pub use adaptive_euler::{AdaptiveEuler, Tolerance};
pub use explicit_euler::ExplicitEuler;
pub use improved_euler::ImprovedEuler;
pub use rk4::Rk4;
pub use semi_implicit_euler::SemiImplicitEuler;

/// A way to advance a system by one step.
///
/// The system is a parameter of the trait: the force law is inlined into the method, and
/// `Box<dyn Integrator<Ship>>` is still swappable at run time.
pub trait Integrator<S: System>: Send {
    /// A method at rest, with scratch space for coordinate vectors shaped `like` this one.
    fn new(like: &S::Vector) -> Self
    where
        Self: Sized;

    /// Advances `state` from `t` to exactly `t + h` (s). Never allocates.
    ///
    /// # Errors
    /// A [`StepFailure`] of the method's own; `state` is then somewhere on the way. Values that
    /// overflow are not the method's business: its caller checks them.
    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure>;

    /// Advances from `t` to `t + h` in `n` equal steps: one dynamic call for a whole tick.
    ///
    /// # Errors
    /// As [`Integrator::step`].
    fn steps(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        n: u32,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        let part = h / f64::from(n);
        for i in 0..n {
            self.step(system, t + part * f64::from(i), part, state)?;
        }
        Ok(())
    }

    /// Forgets whatever is carried between steps. Called when the state or the forces jump.
    fn reset(&mut self) {}
}

/// Why a body could not be carried to the end of its tick.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepFailure {
    /// An adaptive method used up its substeps before the end of the tick.
    #[error("needs more than {limit} substeps for one tick; raise the tick rate or the tolerance")]
    TooManySubsteps {
        /// The most attempts that a tick may take.
        limit: u32,
    },
    /// A value became infinite or undefined.
    #[error("left the numbers: {coordinate} is {value}")]
    NotFinite {
        /// The coordinate's name.
        coordinate: &'static str,
        /// What it became.
        value: f64,
    },
    /// A value left the range that is followed; see [`crate::lab::ESCAPE`].
    #[error("left the stage: {coordinate} reached {value:.1e}")]
    Escaped {
        /// The coordinate's name.
        coordinate: &'static str,
        /// The value that was too large.
        value: f64,
    },
}

/// How a method works, for menus and tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Each stage from values already known.
    Explicit,
    /// Conserves phase-space area on systems without drag.
    Symplectic,
    /// Chooses its own substeps to meet a tolerance.
    Adaptive,
}

impl Family {
    /// The family in one lower-case word.
    pub fn id(self) -> &'static str {
        match self {
            Family::Explicit => "explicit",
            Family::Symplectic => "symplectic",
            Family::Adaptive => "adaptive",
        }
    }
}

/// A method's card: what it claims. Every field is measured by `tests/conformance`.
#[derive(Debug)]
pub struct Method {
    /// Kebab-case name in scenes, on the command line and in output.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// What to expect of it, in one line.
    pub about: &'static str,
    /// How it works.
    pub family: Family,
    /// Global order of the error in `q` and `v` where forces depend on position only.
    pub order: u32,
    /// Global order where forces depend on velocity too.
    pub order_with_drag: u32,
    /// Evaluations of the acceleration in one step; `None` where the method decides.
    pub evaluations: Option<u32>,
    /// Whether the one-step map conserves phase-space area on a system without drag.
    pub symplectic: bool,
    /// Whether a step of `-h` undoes a step of `h`, up to round-off.
    pub reversible: bool,
    /// The largest `h ω` at which the undamped oscillator stays bounded; `None` where the method
    /// chooses its own substeps.
    pub stability_limit: Option<f64>,
    /// The error that an adaptive method allows in a substep.
    pub tolerance: Option<Tolerance>,
    /// Whether this is the chapter's listing with its faults.
    pub as_printed: bool,
    /// Where the method comes from.
    pub source: &'static str,
}

impl PartialEq for Method {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

/// Something to be made of an integrator whose type is chosen at run time; see [`construct`].
pub trait Construct<S: System> {
    /// What is made.
    type Output;
    /// Makes it of the method `I`.
    fn of<I: Integrator<S> + 'static>(self) -> Self::Output;
}

macro_rules! methods {
    ($($file:ident::$Type:ident),+ $(,)?) => {
        /// Every method, in the order of the digit keys and of race lanes.
        pub static METHODS: &[Method] = &[$($file::CARD),+];

        /// Calls `construct` with the integrator type that `method` is the card of.
        ///
        /// # Panics
        /// If `method` is not from [`METHODS`].
        pub fn construct<S: System, C: Construct<S>>(method: &Method, construct: C) -> C::Output {
            $(if method.id == $file::CARD.id {
                return construct.of::<$Type<S::Vector>>();
            })+
            panic!("{} is not in METHODS", method.id)
        }
    };
}

methods! {
    explicit_euler::ExplicitEuler,
    semi_implicit_euler::SemiImplicitEuler,
    improved_euler::ImprovedEuler,
    rk4::Rk4,
    adaptive_euler::AdaptiveEuler,
}

/// The method with this id.
pub fn method(id: &str) -> Option<&'static Method> {
    METHODS.iter().find(|method| method.id == id)
}

/// A fresh integrator of `method` for systems with coordinates shaped `like` these.
///
/// ```
/// # use regatta::sim::{State, bodies::Spring, integrators::{integrator, method}};
/// let spring = Spring { mass: 1.0, stiffness: 40.0, damping: 0.0, x0: 1.0, v0: 0.0, kick: 1.0 };
/// let mut state = State { q: 1.0, v: 0.0 };
/// let mut rk4 = integrator(method("rk4").unwrap(), &state.q);
/// rk4.step(&spring, 0.0, 1.0 / 60.0, &mut state).unwrap();
/// assert!(state.q < 1.0);
/// ```
pub fn integrator<S: System + 'static>(
    method: &Method,
    like: &S::Vector,
) -> Box<dyn Integrator<S>> {
    struct Boxed<'a, V>(&'a V);
    impl<S: System + 'static> Construct<S> for Boxed<'_, S::Vector> {
        type Output = Box<dyn Integrator<S>>;
        fn of<I: Integrator<S> + 'static>(self) -> Self::Output {
            Box::new(I::new(self.0))
        }
    }
    construct::<S, _>(method, Boxed(like))
}
