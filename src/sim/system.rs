//! The equation of motion `q″ = a(t, q, v)`, its state, and the vectors both are made of.

use std::cell::Cell;

/// A coordinate vector: what a method needs of it, and nothing else.
///
/// `f64` serves bodies of one coordinate, [`glam::DVec2`] and [`glam::DVec3`] those that move in a
/// plane or in space, `Vec<f64>` those with many. A method is written once, over this trait, and
/// compiles to registers for the small ones and to loops for the large.
pub trait Vector: Clone + Send + 'static {
    /// Becomes equal to `from`, which has as many components. Never allocates.
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
    /// The memory that it takes beyond its own size, in bytes.
    fn heap_bytes(&self) -> usize {
        0
    }
    /// The components in order, to be written.
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

/// Coordinates and their velocities; also their derivatives, `(v, a)`, which add to it.
#[derive(Clone, Debug, PartialEq)]
pub struct State<V> {
    /// Coordinates, in metres or radians.
    pub q: V,
    /// Velocities, per second.
    pub v: V,
}

impl<V: Vector> State<V> {
    /// Becomes equal to `from`. Never allocates.
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
/// It is kept in second order because the symplectic methods need the split into `q` and `v`.
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

    /// Takes notice that a method leaves out `h` (s) of the time that it was asked to advance, as only one does
    /// that does not [keep time](super::integrators::Method::keeps_time). It changes no motion: [`Counted`] adds
    /// it up.
    #[inline]
    fn skipped(&self, _h: f64) {}
}

/// Counts what methods do with a system, whichever they are: a copy goes on from the same counts.
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
    /// Evaluations of the acceleration: the cost, measured and not taken on the method's word.
    pub evaluations: u64,
    /// Seconds that methods were asked to advance and left out.
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
    fn skipped(&self, h: f64) {
        self.lost_time.set(self.lost_time.get() + h);
    }
}
