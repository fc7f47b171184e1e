//! The equation of motion `q″ = a(t, q, v)`.

use std::cell::{Cell, RefCell};
use std::ops::Deref;
use std::rc::Rc;

use glam::DVec3;

use super::state::{Elementwise, State, Vector};

/// An equation of motion of second order, `q″ = a(t, q, v)`.
///
/// The equation is not reduced to first order, because symplectic methods need the split into `q` and `v`.
pub trait System {
    /// The body's natural coordinates. Every method steps a [`Vector`], the coordinates of one body. Only methods that
    /// do not look across components step a mere [`Elementwise`].
    type Vector: Elementwise;

    /// Overwrites `a` with the acceleration at time `t` (s). Uses only `+ - × ÷ √` and `libm`.
    fn acceleration(&self, t: f64, q: &Self::Vector, v: &Self::Vector, a: &mut Self::Vector);

    /// Overwrites `d` with the derivative `(v, a)` of the state, by one evaluation.
    #[inline(always)]
    fn derivative(&self, t: f64, state: &StateOf<Self>, d: &mut StateOf<Self>) {
        d.q.assign(&state.v);
        self.acceleration(t, &state.q, &state.v, &mut d.v);
    }

    /// Answers an optional query at time `t` (s). Returns `false` if the system has no answer. A system that wraps
    /// another must forward this function, the coupling, the generation and the acceleration, and nothing else.
    #[inline]
    fn query(&self, _t: f64, _question: Query<'_, Self::Vector>) -> bool {
        false
    }

    /// Returns the dependence between coordinates. A system that wraps another must forward this function.
    #[inline]
    fn coupling(&self) -> Coupling {
        Coupling::All
    }

    /// Returns a number that changes whenever the forces jump: at a new input, wind, stiffness. An integrator from
    /// [`integrator()`](super::integrators::integrator()) that sees another number
    /// [resets](super::integrators::Integrator::reset) itself, so that no method goes on with a memory of the old
    /// forces. A system that wraps another must forward this function.
    #[inline]
    fn generation(&self) -> u64 {
        0
    }
}

/// The state of a system.
pub type StateOf<S> = State<<S as System>::Vector>;

/// A query to a system. [`Counted`] counts an answer as an evaluation.
#[derive(Debug)]
#[non_exhaustive]
pub enum Query<'a, V> {
    /// The derivative of the acceleration at a state in the direction `along`. Without an answer, methods use
    /// differences.
    Slope {
        /// The state.
        state: &'a State<V>,
        /// The direction.
        along: &'a State<V>,
        /// Receives the derivative.
        slope: &'a mut V,
    },
    /// The target that the body follows; see [`Pursuit::of`].
    Target(&'a mut Option<Pursuit<V>>),
    /// The principal moments of inertia (kg m²) of a body that turns in space. Its coordinates are three turns about
    /// its axes, whose velocities are ω there, and a quaternion w, x, y, z from their frame to the world.
    Spin(&'a mut Option<DVec3>),
    /// The body as a physics engine sees it; see [`EngineSettings::of`].
    Engine {
        /// The state.
        state: &'a State<V>,
        /// Receives the settings that the engine integrates itself. They are [`EngineSettings::NONE`] before the query.
        settings: &'a mut EngineSettings,
        /// Receives the remaining force per unit mass.
        force: &'a mut V,
    },
}

/// The coordinates and velocities on which the acceleration of a coordinate depends. Implicit methods choose their
/// linear algebra by this coupling.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupling {
    /// The acceleration can depend on any coordinate, so that the whole Jacobian is factored.
    All,
    /// The acceleration depends on coordinates whose index differs by at most this number. The Jacobian is a band,
    /// which is factored.
    Band(usize),
    /// The acceleration depends on few coordinates, at any index. Equations are solved by iteration, without a matrix.
    Few,
}

impl Coupling {
    /// Returns the largest distance of an entry from the diagonal, in a Jacobian of `size` rows; `None` if the Jacobian
    /// should not be formed.
    #[inline]
    pub(super) fn reach(self, size: usize) -> Option<usize> {
        match self {
            Self::All => Some(size - 1),
            Self::Band(reach) => Some(reach.min(size - 1)),
            Self::Few => None,
        }
    }
}

/// A system behind a pointer, so that methods on systems of any type are compiled only once for each vector type.
impl<S: System + ?Sized, P: Deref<Target = S>> System for P {
    type Vector = S::Vector;

    fn acceleration(&self, t: f64, q: &S::Vector, v: &S::Vector, a: &mut S::Vector) {
        (**self).acceleration(t, q, v, a);
    }

    fn query(&self, t: f64, query: Query<'_, S::Vector>) -> bool {
        (**self).query(t, query)
    }

    fn coupling(&self) -> Coupling {
        (**self).coupling()
    }

    fn generation(&self) -> u64 {
        (**self).generation()
    }
}

/// The target of a body at one moment, and the law by which the body follows the target.
#[derive(Clone, Debug, PartialEq)]
pub struct Pursuit<V> {
    /// The target, in the units of the coordinates.
    pub target: V,
    /// The rate k of a first-order law or ω of a second-order one, per second; positive.
    pub rate: f64,
    /// The order of the law: 1 or 2.
    pub order: u32,
    /// Whether the target stays where it is.
    pub is_still: bool,
}

impl<V: Elementwise> Pursuit<V> {
    /// Returns the target and the law of `system` at time `t` (s); `None` if the system follows nothing. The answer
    /// counts as an evaluation. A [follower](super::integrators::Family::Follower) steps by this answer alone.
    #[inline]
    pub fn of(system: &(impl System<Vector = V> + ?Sized), t: f64) -> Option<Self> {
        let mut pursuit = None;
        system.query(t, Query::Target(&mut pursuit));
        pursuit
    }
}

/// The part of an acceleration that an engine's joint and its damping replace. It is `-(K q + c v) - C v`, the same for
/// every coordinate, with the spring at rest at `q` = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EngineSettings {
    /// K, the stiffness of the joint per unit mass, in 1/s².
    pub stiffness: f64,
    /// c, the damping of the joint per unit mass, in 1/s.
    pub damping: f64,
    /// C, the damping setting of the body, in 1/s.
    pub drag: f64,
}

impl EngineSettings {
    /// No joint and no damping, so that everything is a force of user code.
    pub const NONE: Self = Self { stiffness: 0.0, damping: 0.0, drag: 0.0 };

    /// Returns the settings of `system` in a physics engine. Writes the remaining force per unit mass to `force`, which
    /// is the whole force if the system gives no settings. The call counts as an evaluation.
    #[inline]
    pub fn of<V: Elementwise>(
        system: &(impl System<Vector = V> + ?Sized),
        t: f64,
        state: &State<V>,
        force: &mut V,
    ) -> Self {
        let mut settings = Self::NONE;
        if !settings.ask(system, t, state, force) {
            system.acceleration(t, &state.q, &state.v, force);
        }
        settings
    }

    /// Writes the settings that `system` gives, and the remaining force to `force`. Returns whether it gives any.
    #[inline]
    pub(crate) fn ask<V: Elementwise>(
        &mut self,
        system: &(impl System<Vector = V> + ?Sized),
        t: f64,
        state: &State<V>,
        force: &mut V,
    ) -> bool {
        system.query(t, Query::Engine { state, settings: self, force })
    }

    /// Whether there is a joint.
    #[inline]
    pub fn has_spring(&self) -> bool {
        self.stiffness != 0.0 || self.damping != 0.0
    }

    /// Returns `D = 1 + h c + h² K`, the divisor of an implicit solve of a step of `h` (s).
    #[inline]
    pub fn resistance(&self, h: f64) -> f64 {
        1.0 + h * self.damping + h * h * self.stiffness
    }
}

/// The class of a kind of body, for methods that step only [some](super::integrators::Only) bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyClass {
    /// Moves by a force, which an engine holds for a tick, and a drag, which the engine integrates itself.
    Forced,
    /// A spring, which an engine represents as a joint.
    Joint,
    /// Moves by a force that an engine cannot express. The reason is a clause in lower case that follows a colon.
    NoEngine(&'static str),
    /// Meets walls, which an engine handles by a rule of its own. The reason why other engines step no such body is a
    /// clause in lower case that follows a colon.
    Ball(&'static str),
    /// Turns freely in space, which an engine steps by a map of its own.
    Spin,
    /// Follows a target by a rule. The reason why an engine cannot express the rule is a clause in lower case that
    /// follows a colon.
    Follower(&'static str),
}

impl BodyClass {
    /// Returns the reason why a physics engine cannot express the body; `None` if it can.
    pub const fn engine_refusal(self) -> Option<&'static str> {
        match self {
            Self::Forced | Self::Joint | Self::Spin | Self::Ball(_) => None,
            Self::NoEngine(why) | Self::Follower(why) => Some(why),
        }
    }
}

/// A system that counts evaluations. A clone continues from the same count.
#[derive(Clone, Debug)]
pub struct Counted<S> {
    /// The inner system.
    pub system: S,
    evaluations: Cell<u64>,
}

impl<S> Counted<S> {
    /// Wraps `system`, with its count at 0.
    pub fn new(system: S) -> Self {
        Self { system, evaluations: Cell::new(0) }
    }

    /// Returns the number of evaluations so far.
    pub fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }
}

impl<S: System> System for Counted<S> {
    type Vector = S::Vector;

    #[inline]
    fn coupling(&self) -> Coupling {
        self.system.coupling()
    }

    #[inline]
    fn generation(&self) -> u64 {
        self.system.generation()
    }

    #[inline]
    fn acceleration(&self, t: f64, q: &S::Vector, v: &S::Vector, a: &mut S::Vector) {
        self.evaluations.set(self.evaluations.get() + 1);
        self.system.acceleration(t, q, v, a);
    }

    #[inline]
    fn query(&self, t: f64, query: Query<'_, S::Vector>) -> bool {
        let is_answered = self.system.query(t, query);
        self.evaluations.set(self.evaluations.get() + u64::from(is_answered));
        is_answered
    }
}

/// One evaluation of the acceleration.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// The time in seconds.
    pub t: f64,
    /// The coordinates.
    pub q: Vec<f64>,
    /// The velocities.
    pub v: Vec<f64>,
    /// The computed acceleration.
    pub a: Vec<f64>,
}

/// A system that appends every evaluation to a log, which allocates.
pub(super) struct Logged<S> {
    pub(super) system: S,
    pub(super) log: Rc<RefCell<Vec<Evaluation>>>,
}

impl<S: System<Vector: Vector>> System for Logged<S> {
    type Vector = S::Vector;

    fn coupling(&self) -> Coupling {
        self.system.coupling()
    }

    fn acceleration(&self, t: f64, q: &S::Vector, v: &S::Vector, a: &mut S::Vector) {
        self.system.acceleration(t, q, v, a);
        let [q, v, a] = [q, v, a].map(|vector| vector.components().to_vec());
        self.log.borrow_mut().push(Evaluation { t, q, v, a });
    }

    /// Logs an answer as an evaluation. A slope or engine settings are logged at their state, and a target is logged as
    /// a state at rest on the target.
    fn query(&self, t: f64, query: Query<'_, S::Vector>) -> bool {
        match query {
            Query::Slope { state, .. } | Query::Engine { state, .. } => {
                let is_answered = self.system.query(t, query);
                if is_answered {
                    self.acceleration(t, &state.q, &state.v, &mut state.v.clone());
                }
                is_answered
            }
            Query::Target(pursuit) => {
                *pursuit = Pursuit::of(&self.system, t);
                if let Some(Pursuit { target, .. }) = pursuit {
                    let mut rest = target.clone();
                    rest.components_mut().fill(0.0);
                    self.acceleration(t, target, &rest, &mut rest.clone());
                }
                pursuit.is_some()
            }
            Query::Spin(_) => self.system.query(t, query),
        }
    }
}
