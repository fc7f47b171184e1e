//! The equation of motion `q″ = a(t, q, v)`, its state, and coordinate vectors.

use std::cell::{Cell, RefCell};

use super::engine_settings::EngineSettings;

/// A coordinate vector, with the operations that methods use.
///
/// `f64` is for bodies of one coordinate, [`glam::DVec2`] and [`glam::DVec3`] for motion in a plane or
/// in space, `Vec<f64>` for many coordinates. A method is written once over this trait; it compiles to
/// registers for the small types and to loops for `Vec`.
pub trait Vector: Clone + Send + 'static {
    /// Whether each component's acceleration depends on few others. Implicit methods then solve their
    /// equations by iteration; else they factor the whole Jacobian.
    const IS_SPARSE: bool = false;

    /// Copies `from`, which has as many components. Never allocates.
    fn assign(&mut self, from: &Self);
    /// `self += h x`, rounded after the product and after the sum.
    fn add_scaled(&mut self, h: f64, x: &Self);
    /// `v += k a`, then `q += h v`: a kick and the drift after it.
    #[inline]
    fn kick_and_drift(k: f64, a: &Self, v: &mut Self, h: f64, q: &mut Self) {
        v.add_scaled(k, a);
        q.add_scaled(h, v);
    }
    /// `self += h1 x1 + h2 x2 …`, term by term in this order, each rounded after the product and after the
    /// sum.
    #[inline]
    fn add_terms<const N: usize>(&mut self, terms: [(f64, &Self); N]) {
        for (h, x) in terms {
            self.add_scaled(h, x);
        }
    }
    /// `self = x + h d`, rounded after the product and after the sum, for an `x` with as many components.
    /// Never allocates.
    #[inline]
    fn assign_sum(&mut self, x: &Self, h: f64, d: &Self) {
        self.assign(x);
        self.add_scaled(h, d);
    }
    /// `self = h x`, for an `x` with as many components. Never allocates.
    #[inline]
    fn assign_scaled(&mut self, h: f64, x: &Self) {
        for (component, x) in self.components_mut().iter_mut().zip(x.components()) {
            *component = h * x;
        }
    }
    /// The components in order.
    fn components(&self) -> &[f64];
    /// Memory on the heap, in bytes.
    fn heap_bytes(&self) -> usize {
        0
    }
    /// The components in order, mutable.
    fn components_mut(&mut self) -> &mut [f64];
}

impl Vector for f64 {
    #[inline]
    fn assign(&mut self, from: &Self) {
        *self = *from;
    }
    #[inline]
    fn add_scaled(&mut self, h: f64, x: &Self) {
        *self += h * x;
    }
    fn components(&self) -> &[f64] {
        std::slice::from_ref(self)
    }
    fn components_mut(&mut self) -> &mut [f64] {
        std::slice::from_mut(self)
    }
}

macro_rules! glam_vector {
    ($($Vector:ty),+) => {$(
        impl Vector for $Vector {
            #[inline]
            fn assign(&mut self, from: &Self) {
                *self = *from;
            }
            #[inline]
            fn add_scaled(&mut self, h: f64, x: &Self) {
                *self += h * *x;
            }
            fn components(&self) -> &[f64] {
                self.as_ref()
            }
            fn components_mut(&mut self) -> &mut [f64] {
                self.as_mut()
            }
        }
    )+};
}
glam_vector!(glam::DVec2, glam::DVec3);

impl Vector for Vec<f64> {
    #[inline]
    fn assign(&mut self, from: &Self) {
        self.copy_from_slice(from);
    }
    #[inline]
    fn add_scaled(&mut self, h: f64, x: &Self) {
        for (component, x) in self.iter_mut().zip(x) {
            *component += h * x;
        }
    }
    /// Both in one pass.
    #[inline]
    fn kick_and_drift(k: f64, a: &Self, v: &mut Self, h: f64, q: &mut Self) {
        for ((a, v), q) in a.iter().zip(v).zip(q) {
            *v += k * a;
            *q += h * *v;
        }
    }
    /// All terms in one pass.
    #[inline]
    fn add_terms<const N: usize>(&mut self, terms: [(f64, &Self); N]) {
        let terms = terms.map(|(h, x)| (h, &x[..self.len()]));
        for (i, component) in self.iter_mut().enumerate() {
            for (h, x) in terms {
                *component += h * x[i];
            }
        }
    }
    #[inline]
    fn assign_sum(&mut self, x: &Self, h: f64, d: &Self) {
        for ((component, x), d) in self.iter_mut().zip(x).zip(d) {
            *component = x + h * d;
        }
    }
    fn components(&self) -> &[f64] {
        self
    }
    fn heap_bytes(&self) -> usize {
        size_of_val(&self[..])
    }
    fn components_mut(&mut self) -> &mut [f64] {
        self
    }
}

/// Coordinates and velocities. Also their time derivative `(v, a)`.
#[derive(Clone, Debug, PartialEq)]
pub struct State<V> {
    /// Coordinates, in metres or radians.
    pub q: V,
    /// Velocities, per second.
    pub v: V,
}

impl<V: Vector> State<V> {
    /// Copies `from`. Never allocates.
    #[inline]
    pub fn assign(&mut self, from: &Self) {
        self.q.assign(&from.q);
        self.v.assign(&from.v);
    }

    /// `self += h1 x1 + h2 x2 …` in both halves.
    #[inline]
    pub fn add_terms<const N: usize>(&mut self, terms: [(f64, &Self); N]) {
        self.q.add_terms(terms.map(|(h, x)| (h, &x.q)));
        self.v.add_terms(terms.map(|(h, x)| (h, &x.v)));
    }

    /// `self = x + h d` in both halves. Never allocates.
    #[inline]
    pub fn assign_sum(&mut self, x: &Self, h: f64, d: &Self) {
        self.q.assign_sum(&x.q, h, &d.q);
        self.v.assign_sum(&x.v, h, &d.v);
    }

    /// `self += h x` in both halves.
    #[inline]
    pub fn add_scaled(&mut self, h: f64, x: &Self) {
        self.q.add_scaled(h, &x.q);
        self.v.add_scaled(h, &x.v);
    }
}

/// An equation of motion of second order, `q″ = a(t, q, v)`.
///
/// It stays second order because symplectic methods need the split into `q` and `v`.
pub trait System {
    /// The body's natural coordinates.
    type Vector: Vector;

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
    /// costs about as much as an evaluation, and counts as one.
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

    /// Reports that a method left out `h` (s) of a step, as a method that does not [keep
    /// time](super::integrators::Method::keeps_time) does. It does not affect the motion; [`Counted`]
    /// sums it.
    #[inline]
    fn skipped(&self, _h: f64) {}
}

/// A system behind a pointer: what methods do with it is compiled once for each type of vector.
impl<V: Vector> System for Box<dyn System<Vector = V>> {
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

    /// Not kept: it is no evaluation.
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
