//! Linear equations without a matrix: BiCGSTAB(2) in storage allocated once. Sleijpen & Fokkema,
//! *BiCGstab(ℓ) for linear equations involving unsymmetric matrices with complex spectrum* (1993).
//!
//! The matrix is not symmetric where springs are damped, and indefinite where they are compressed, which
//! rules out conjugate gradients; that of several stages has complex eigenvalues, at which BiCGSTAB stalls;
//! GMRES keeps a vector for each iteration, and these vectors are in every snapshot. Written out because
//! nalgebra-sparse has no solver for such a matrix, and faer is many times the size of this layer and chooses
//! its sums by the processor: ours have the same bits everywhere.

use super::stages::{Stages, largest};
use crate::sim::state::{State, Vector};
use crate::sim::system::System;

/// The most products of matrix and vector in one step of a method. A soft net needs tens and a stiff one
/// hundreds; without a limit, equations that have no solution would never end.
const MOST_PRODUCTS: u32 = 12_000;
/// Products in one iteration.
const PRODUCTS: u32 = 4;
/// The relative residual of the linear equations of a descent.
const DESCENT_TOLERANCE: f64 = 1e-2;
/// The relative difference for slopes of a force without a formula: the square root of round-off.
const DIFFERENCE: f64 = 1.5e-8;

/// Solves `X - ∂a/∂A X = b` for the accelerations at `S` stages.
#[derive(Clone)]
pub(in crate::sim::integrators) struct Krylov<V, const S: usize> {
    matrix: Matrix<V, S>,
    x: [V; S],
    r: [V; S],
    shadow: [V; S],
    u: [V; S],
    v: [V; S],
    s: [V; S],
    w: [V; S],
    t: [V; S],
}

/// The matrix: the forces linearised at the stages.
#[derive(Clone)]
struct Matrix<V, const S: usize> {
    stages: Stages<S>,
    at: [State<V>; S],
    /// Products left in this step.
    left: u32,
    /// The direction in which a slope is taken, and the slope.
    along: State<V>,
    slope: V,
    /// For slopes by differences: a displaced state, and the forces there.
    moved: State<V>,
    forces: V,
}

impl<V: Vector, const S: usize> Krylov<V, S> {
    pub(in crate::sim::integrators) fn new(like: &V) -> Self {
        let state = || State { q: like.clone(), v: like.clone() };
        let vectors = || std::array::from_fn(|_| like.clone());
        let matrix = Matrix {
            stages: Stages { t: [0.0; S], alpha: [[0.0; S]; S], beta: [[0.0; S]; S] },
            at: std::array::from_fn(|_| state()),
            left: 0,
            along: state(),
            slope: like.clone(),
            moved: state(),
            forces: like.clone(),
        };
        let [x, r, shadow, u, v, s, w, t] = [(); 8].map(|()| vectors());
        Self { matrix, x, r, shadow, u, v, s, w, t }
    }

    /// Memory in bytes.
    pub(in crate::sim::integrators) fn heap_bytes(&self) -> usize {
        size_of::<Self>() + (6 + 10 * S) * self.matrix.slope.heap_bytes()
    }

    pub(in crate::sim::integrators) fn begin_step(&mut self) {
        self.matrix.left = MOST_PRODUCTS;
    }

    /// Whether the step has no products left.
    pub(in crate::sim::integrators) fn is_spent(&self) -> bool {
        self.matrix.left < PRODUCTS
    }

    /// Linearises the forces at the stages with the accelerations `a`.
    pub(in crate::sim::integrators) fn linearise(
        &mut self,
        stages: &Stages<S>,
        known: &[State<V>; S],
        a: &[V; S],
    ) {
        self.matrix.stages = *stages;
        for i in 0..S {
            stages.place(i, known, a, &mut self.matrix.at[i]);
        }
    }

    /// Largest acceleration at the first stage when neighbours are displaced by ±`distance`: an estimate of the
    /// stiffest mode.
    pub(super) fn largest_change(&mut self, system: &dyn System<Vector = V>, distance: f64) -> f64 {
        let Matrix { at, along, slope, stages, .. } = &mut self.matrix;
        along.v.components_mut().fill(0.0);
        for (i, x) in along.q.components_mut().iter_mut().enumerate() {
            *x = if i / 2 % 2 == 0 { distance } else { -distance };
        }
        if !system.acceleration_slope(stages.t[0], &at[0], along, slope) {
            self.matrix.take_difference(system, 0);
        }
        largest(self.matrix.slope.components().iter())
    }

    /// Overwrites the right-hand side `b` with the solution, to a residual of `tolerance` times `b`, or as
    /// near as the products left allow.
    pub(in crate::sim::integrators) fn solve(
        &mut self,
        system: &dyn System<Vector = V>,
        tolerance: f64,
        b: &mut [f64],
    ) {
        for (r, b) in self.r.iter_mut().flat_map(V::components_mut).zip(b.iter()) {
            *r = *b;
        }
        self.x.iter_mut().for_each(|x| x.components_mut().fill(0.0));
        let enough = tolerance * dot(&self.r, &self.r).sqrt();
        self.iterate(system, enough);
        for (b, x) in b.iter_mut().zip(self.x.iter().flat_map(V::components)) {
            *b = *x;
        }
    }

    /// Overwrites the residual `b` with a direction down the energy whose gradient it is: the solution by
    /// conjugate gradients, as far as the energy curves upwards (Steihaug, *The conjugate gradient method and
    /// trust regions in large scale optimization*, 1983). Returns whether it does so along all that was tried.
    pub(super) fn descend(&mut self, system: &dyn System<Vector = V>, b: &mut [f64]) -> bool {
        let Self { matrix, x, r, u: p, v: product, .. } = self;
        for (r, b) in r.iter_mut().flat_map(V::components_mut).zip(b.iter()) {
            *r = *b;
        }
        x.iter_mut().for_each(|x| x.components_mut().fill(0.0));
        assign(p, r);
        let mut size = dot(r, r);
        let enough = DESCENT_TOLERANCE * DESCENT_TOLERANCE * size;
        let mut curves_upwards = true;
        while matrix.left >= PRODUCTS && size > enough {
            matrix.multiply(system, p, product);
            let curvature = dot(p, product);
            if curvature <= 0.0 || curvature.is_nan() {
                curves_upwards = false;
                break;
            }
            let alpha = size / curvature;
            add(x, alpha, p);
            add(r, -alpha, product);
            let next = dot(r, r);
            assign_sum(p, r, next / size);
            size = next;
        }
        // Of an energy that curves downwards at once, the steepest direction.
        if dot(x, x) == 0.0 {
            assign(x, r);
        }
        for (b, x) in b.iter_mut().zip(x.iter().flat_map(V::components)) {
            *b = *x;
        }
        curves_upwards
    }

    /// The iteration by its textbook letters: `x` the solution, `r` the residual, `u` a direction, and `v`,
    /// `s`, `w` and `t` their products.
    fn iterate(&mut self, system: &dyn System<Vector = V>, enough: f64) {
        let Self { matrix, x, r, shadow, u, v, s, w, t, .. } = self;
        assign(shadow, r);
        u.iter_mut().for_each(|u| u.components_mut().fill(0.0));
        let (mut rho, mut alpha, mut omega2) = (1.0, 0.0, 1.0);
        let is_done = |r: &[V; S]| {
            let size = dot(r, r).sqrt();
            size <= enough || size.is_nan()
        };
        while matrix.left >= PRODUCTS && !is_done(r) {
            rho *= -omega2;
            let mut next = dot(r, shadow);
            let mut beta = alpha * next / rho;
            rho = next;
            assign_sum(u, r, -beta);
            matrix.multiply(system, u, v);
            alpha = rho / dot(v, shadow);
            add(r, -alpha, v);
            add(x, alpha, u);
            if is_done(r) {
                return;
            }
            matrix.multiply(system, r, s);

            next = dot(s, shadow);
            beta = alpha * next / rho;
            rho = next;
            assign_sum(v, s, -beta);
            matrix.multiply(system, v, w);
            alpha = rho / dot(w, shadow);
            assign_sum(u, r, -beta);
            add(r, -alpha, v);
            add(s, -alpha, w);
            add(x, alpha, u);
            if is_done(r) {
                return;
            }
            matrix.multiply(system, s, t);

            // The residual is made as small as can be along its two products.
            let (along, across, both) = (dot(s, s), dot(s, t), dot(t, t));
            let first = dot(r, s);
            let apart = both - across * across / along;
            // Where all point one way, as in equal bodies apart, the first product alone ends it.
            if apart <= 0.0 {
                add(x, first / along, r);
                return;
            }
            omega2 = (dot(r, t) - across * first / along) / apart;
            let omega1 = (first - across * omega2) / along;
            add(x, omega1, r);
            add(x, omega2, s);
            add(r, -omega1, s);
            add(r, -omega2, t);
            add(u, -omega1, v);
            add(u, -omega2, w);
        }
    }
}

impl<V: Vector, const S: usize> Matrix<V, S> {
    /// Overwrites `y` with the product of the matrix and `x`.
    fn multiply(&mut self, system: &dyn System<Vector = V>, x: &[V; S], y: &mut [V; S]) {
        self.left -= 1;
        for i in 0..S {
            let Self { stages, at, along, slope, .. } = self;
            along.q.components_mut().fill(0.0);
            along.v.components_mut().fill(0.0);
            for ((alpha, beta), x) in stages.alpha[i].iter().zip(&stages.beta[i]).zip(x) {
                along.q.add_scaled(*alpha, x);
                along.v.add_scaled(*beta, x);
            }
            if !system.acceleration_slope(stages.t[i], &at[i], along, slope) {
                self.take_difference(system, i);
            }
            y[i].assign_sum(&x[i], -1.0, &self.slope);
        }
    }

    /// The slope of the force at stage `i` by a difference, for a force without a formula for it.
    fn take_difference(&mut self, system: &dyn System<Vector = V>, i: usize) {
        let Self { stages, at, along, slope, moved, forces, .. } = self;
        let size = |state: &State<V>| {
            largest(state.q.components().iter()).max(largest(state.v.components().iter()))
        };
        let part = DIFFERENCE * size(&at[i]).max(1.0) / size(along).max(f64::MIN_POSITIVE);
        moved.assign_sum(&at[i], part, along);
        system.acceleration(stages.t[i], &moved.q, &moved.v, slope);
        system.acceleration(stages.t[i], &at[i].q, &at[i].v, forces);
        for (slope, force) in slope.components_mut().iter_mut().zip(forces.components()) {
            *slope = (*slope - force) / part;
        }
    }
}

fn assign<V: Vector, const S: usize>(to: &mut [V; S], from: &[V; S]) {
    to.iter_mut().zip(from).for_each(|(to, from)| to.assign(from));
}

/// `to = x + times to`
fn assign_sum<V: Vector, const S: usize>(to: &mut [V; S], x: &[V; S], times: f64) {
    for (to, x) in to.iter_mut().zip(x) {
        for (to, x) in to.components_mut().iter_mut().zip(x.components()) {
            *to = x + times * *to;
        }
    }
}

fn add<V: Vector, const S: usize>(to: &mut [V; S], times: f64, x: &[V; S]) {
    to.iter_mut().zip(x).for_each(|(to, x)| to.add_scaled(times, x));
}

/// The inner product, summed in order.
fn dot<V: Vector, const S: usize>(a: &[V; S], b: &[V; S]) -> f64 {
    let mut sum = 0.0;
    for (a, b) in a.iter().zip(b) {
        for (a, b) in a.components().iter().zip(b.components()) {
            sum += a * b;
        }
    }
    sum
}
