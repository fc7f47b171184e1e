//! The equation of motion `q″ = a(t, q, v)`.

use std::cell::{Cell, RefCell};

use super::engine_settings::EngineSettings;
use super::state::{Elementwise, State, Vector};

/// An equation of motion of second order, `q″ = a(t, q, v)`.
///
/// It stays second order because symplectic methods need the split into `q` and `v`.
pub trait System {
    /// The body's natural coordinates. The [`Vector`] of one body is stepped by every method, and what is merely
    /// [`Elementwise`] by those that do not look across components.
    type Vector: Elementwise;

    /// Overwrites `a` with the acceleration at time `t` (s). Uses only `+ - × ÷ √` and `libm`.
    fn acceleration(&self, t: f64, q: &Self::Vector, v: &Self::Vector, a: &mut Self::Vector);

    /// Overwrites `d` with the derivative `(v, a)` of the state: one evaluation.
    #[inline]
    fn derivative(&self, t: f64, state: &State<Self::Vector>, d: &mut State<Self::Vector>) {
        d.q.assign(&state.v);
        self.acceleration(t, &state.q, &state.v, &mut d.v);
    }

    /// Overwrites `slope` with the derivative of the acceleration at `state` in the direction `along`, if the
    /// system has a formula for it. Returns whether it has; an implicit method takes differences if not. It
    /// costs about as much as an evaluation, and [`Counted`] counts it as one.
    #[inline]
    fn acceleration_slope(
        &self,
        _t: f64,
        _state: &State<Self::Vector>,
        _along: &State<Self::Vector>,
        _slope: &mut Self::Vector,
    ) -> bool {
        false
    }

    /// What the body follows at time `t` (s), which counts as an evaluation; `None` if it follows nothing. A
    /// [follower](super::integrators::Family::Follower) steps by this alone.
    #[inline]
    fn pursuit(&self, _t: f64) -> Option<Pursuit<Self::Vector>> {
        None
    }

    /// The body as a physics engine sees it: the joint and damping settings it integrates itself. Writes the remaining
    /// force per unit mass to `force`. It counts as an evaluation. `None` if the body cannot be expressed so.
    #[inline]
    fn engine_settings(
        &self,
        t: f64,
        state: &State<Self::Vector>,
        force: &mut Self::Vector,
    ) -> Option<EngineSettings> {
        self.acceleration(t, &state.q, &state.v, force);
        Some(EngineSettings::NONE)
    }

    /// Which coordinates act on which, for every system of the type.
    #[inline]
    fn coupling() -> Coupling
    where
        Self: Sized,
    {
        Coupling::All
    }

    /// Reports that a method left out `h` (s) of a step, as a method that does not [keep
    /// time](super::integrators::Method::keeps_time) does. It does not affect the motion; [`Counted`]
    /// sums it.
    #[inline]
    fn skipped(&self, _h: f64) {}
}

/// Which coordinates and velocities the acceleration of a coordinate depends on. Implicit methods choose their linear
/// algebra by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coupling {
    /// Any: the whole Jacobian is factored.
    All,
    /// Those whose index differs by at most this: the Jacobian is a band, and is factored.
    Band(usize),
    /// Few, at any index: equations are solved by iteration, without a matrix.
    Few,
}

impl Coupling {
    /// How far from the diagonal the entries of a Jacobian of `size` rows lie; `None` if it is not to be formed.
    #[inline]
    pub(super) fn reach(self, size: usize) -> Option<usize> {
        match self {
            Self::All => Some(size - 1),
            Self::Band(reach) => Some(reach.min(size - 1)),
            Self::Few => None,
        }
    }
}

/// A system behind a pointer: what methods do with it is compiled once for each type of vector.
impl<V: Elementwise> System for Box<dyn System<Vector = V>> {
    type Vector = V;

    fn acceleration(&self, t: f64, q: &V, v: &V, a: &mut V) {
        (**self).acceleration(t, q, v, a);
    }

    fn acceleration_slope(
        &self,
        t: f64,
        state: &State<V>,
        along: &State<V>,
        slope: &mut V,
    ) -> bool {
        (**self).acceleration_slope(t, state, along, slope)
    }

    fn pursuit(&self, t: f64) -> Option<Pursuit<V>> {
        (**self).pursuit(t)
    }

    fn engine_settings(&self, t: f64, state: &State<V>, force: &mut V) -> Option<EngineSettings> {
        (**self).engine_settings(t, state, force)
    }

    fn skipped(&self, h: f64) {
        (**self).skipped(h);
    }
}

/// What a body follows at one moment, and how fast.
#[derive(Clone, Debug, PartialEq)]
pub struct Pursuit<V> {
    /// The target, in the units of the coordinates.
    pub target: V,
    /// The rate k of a law of first order or ω of one of second order, per second; positive.
    pub rate: f64,
    /// The order of the law: 1 or 2.
    pub order: u32,
    /// Whether the target stays where it is.
    pub is_still: bool,
}

/// A system that counts evaluations and skipped time. A clone continues from the same counts.
#[derive(Clone, Debug)]
pub struct Counted<S> {
    /// The system counted.
    pub system: S,
    evaluations: Cell<u64>,
    lost_time: Cell<f64>,
}

/// What methods did with a system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counts {
    /// Evaluations of the acceleration.
    pub evaluations: u64,
    /// The time in seconds that methods left out of their steps.
    pub lost_time: f64,
}

impl<S> Counted<S> {
    /// Wraps `system`, with all counts at zero.
    pub fn new(system: S) -> Self {
        Self { system, evaluations: Cell::new(0), lost_time: Cell::new(0.0) }
    }

    /// The counts so far.
    pub fn counts(&self) -> Counts {
        Counts { evaluations: self.evaluations.get(), lost_time: self.lost_time.get() }
    }

    /// Evaluations so far.
    pub fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }
}

impl<S: System> System for Counted<S> {
    type Vector = S::Vector;

    #[inline]
    fn coupling() -> Coupling {
        S::coupling()
    }

    #[inline]
    fn acceleration(&self, t: f64, q: &S::Vector, v: &S::Vector, a: &mut S::Vector) {
        self.evaluations.set(self.evaluations.get() + 1);
        self.system.acceleration(t, q, v, a);
    }

    #[inline]
    fn acceleration_slope(
        &self,
        t: f64,
        state: &State<S::Vector>,
        along: &State<S::Vector>,
        slope: &mut S::Vector,
    ) -> bool {
        let is_known = self.system.acceleration_slope(t, state, along, slope);
        self.evaluations.set(self.evaluations.get() + u64::from(is_known));
        is_known
    }

    #[inline]
    fn pursuit(&self, t: f64) -> Option<Pursuit<S::Vector>> {
        let pursuit = self.system.pursuit(t)?;
        self.evaluations.set(self.evaluations.get() + 1);
        Some(pursuit)
    }

    #[inline]
    fn engine_settings(
        &self,
        t: f64,
        state: &State<S::Vector>,
        force: &mut S::Vector,
    ) -> Option<EngineSettings> {
        self.evaluations.set(self.evaluations.get() + 1);
        self.system.engine_settings(t, state, force)
    }

    #[inline]
    fn skipped(&self, h: f64) {
        self.lost_time.set(self.lost_time.get() + h);
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
    /// The acceleration found.
    pub a: Vec<f64>,
}

/// A system that keeps every evaluation, in order. It allocates.
pub struct Recorded<'a, V: Vector> {
    system: &'a dyn System<Vector = V>,
    evaluations: RefCell<Vec<Evaluation>>,
}

impl<'a, V: Vector> Recorded<'a, V> {
    /// Wraps `system`, with nothing recorded.
    pub fn new(system: &'a dyn System<Vector = V>) -> Self {
        Self { system, evaluations: RefCell::default() }
    }

    /// What was recorded.
    pub fn into_evaluations(self) -> Vec<Evaluation> {
        self.evaluations.into_inner()
    }
}

impl<V: Vector> System for Recorded<'_, V> {
    type Vector = V;

    fn acceleration(&self, t: f64, q: &V, v: &V, a: &mut V) {
        self.system.acceleration(t, q, v, a);
        let [q, v, a] = [q, v, a].map(|vector| vector.components().to_vec());
        self.evaluations.borrow_mut().push(Evaluation { t, q, v, a });
    }

    /// Not kept: it finds no acceleration.
    fn acceleration_slope(
        &self,
        t: f64,
        state: &State<V>,
        along: &State<V>,
        slope: &mut V,
    ) -> bool {
        self.system.acceleration_slope(t, state, along, slope)
    }

    /// Kept as an evaluation.
    fn engine_settings(&self, t: f64, state: &State<V>, force: &mut V) -> Option<EngineSettings> {
        self.acceleration(t, &state.q, &state.v, force);
        self.system.engine_settings(t, state, force)
    }

    /// Kept as an evaluation at rest in the target.
    fn pursuit(&self, t: f64) -> Option<Pursuit<V>> {
        let pursuit = self.system.pursuit(t)?;
        let mut rest = pursuit.target.clone();
        rest.components_mut().fill(0.0);
        self.acceleration(t, &pursuit.target, &rest, &mut rest.clone());
        Some(pursuit)
    }
}
