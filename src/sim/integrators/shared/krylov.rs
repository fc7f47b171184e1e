//! Solves linear equations without a matrix, by BiCGSTAB(2) in storage allocated once. Sleijpen & Fokkema, *BiCGstab(ℓ)
//! for linear equations involving unsymmetric matrices with complex spectrum* (1993).
//!
//! The matrix is not symmetric for damped springs, and indefinite for compressed ones, which rules out conjugate
//! gradients. The matrix of several stages has complex eigenvalues, at which BiCGSTAB stalls. GMRES keeps a vector for
//! each iteration, and these vectors would be in every snapshot. The solver is written out because nalgebra-sparse has
//! no solver for such a matrix. faer is many times the size of this layer and chooses its sums by the processor, while
//! ours have the same bits everywhere.

use crate::state::largest;

/// The maximum number of products of matrix and vector in one step of a method. A soft net needs tens and a stiff net
/// hundreds. If there were no limit, the iteration on equations without a solution would never end.
const MAX_PRODUCTS: u32 = 12_000;
/// Number of products per iteration.
const PRODUCTS: u32 = 4;
/// The relative residual of the linear equations of a descent.
const DESCENT_TOLERANCE: f64 = 1e-2;
/// Right-hand sides below this size are scaled up. At this size, the fourth power of a residual at a tolerance of 1e-10
/// is still a normal number, and products of inner products are of that order.
const TINY: f64 = f64::from_bits((1023 - 200) << 52);

/// A matrix, as a function that overwrites its second argument with the product of the matrix and the first.
pub(super) type Matrix<'a> = dyn FnMut(&[f64], &mut [f64]) + 'a;

/// Scratch of the iterations.
#[derive(Clone)]
pub(super) struct Krylov {
    /// Number of products left in this step.
    products_left: u32,
    pub(super) x: Vec<f64>,
    r: Vec<f64>,
    shadow: Vec<f64>,
    u: Vec<f64>,
    v: Vec<f64>,
    s: Vec<f64>,
    w: Vec<f64>,
    t: Vec<f64>,
}

impl Krylov {
    pub(super) fn new(size: usize) -> Self {
        let [x, r, shadow, u, v, s, w, t] = [(); 8].map(|()| vec![0.0; size]);
        Self { products_left: 0, x, r, shadow, u, v, s, w, t }
    }

    pub(super) fn begin_step(&mut self) {
        self.products_left = MAX_PRODUCTS;
    }

    /// Whether the step has no products left.
    pub(super) fn is_spent(&self) -> bool {
        self.products_left < PRODUCTS
    }

    /// Overwrites the right-hand side `b` with the solution. The residual is at most `tolerance` times the length of
    /// `b`, unless no products are left.
    pub(super) fn solve(&mut self, matrix: &mut Matrix<'_>, tolerance: f64, b: &mut [f64]) {
        let unit = unit(b);
        self.r.iter_mut().zip(&*b).for_each(|(r, b)| *r = b / unit);
        self.x.fill(0.0);
        let enough = tolerance * dot(&self.r, &self.r).sqrt();
        self.iterate(matrix, enough);
        b.iter_mut().zip(&self.x).for_each(|(b, x)| *b = x * unit);
    }

    /// Overwrites the residual `b` with a descent direction of the energy. The residual is the negative gradient of
    /// that energy. The direction is the solution by conjugate gradients, for as long as the energy curves upwards
    /// (Steihaug, *The conjugate gradient method and trust regions in large scale optimization*, 1983). Returns whether
    /// the energy curved upwards along every direction tried.
    pub(super) fn descend(&mut self, matrix: &mut Matrix<'_>, b: &mut [f64]) -> bool {
        let Self { products_left, x, r, u: p, v: product, .. } = self;
        let unit = unit(b);
        r.iter_mut().zip(&*b).for_each(|(r, b)| *r = b / unit);
        x.fill(0.0);
        p.copy_from_slice(r);
        let mut size = dot(r, r);
        let enough = DESCENT_TOLERANCE * DESCENT_TOLERANCE * size;
        let mut curves_upwards = true;
        while *products_left >= PRODUCTS && size > enough {
            *products_left -= 1;
            matrix(p, product);
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
        // If the energy curves downwards at once, the result is the steepest direction.
        if dot(x, x) == 0.0 {
            x.copy_from_slice(r);
        }
        b.iter_mut().zip(&*x).for_each(|(b, x)| *b = x * unit);
        curves_upwards
    }

    /// Runs the iteration with its textbook letters. `x` is the solution, `r` the residual, and `u` a direction; `v`,
    /// `s`, `w` and `t` are products of these with the matrix.
    fn iterate(&mut self, matrix: &mut Matrix<'_>, enough: f64) {
        let Self { products_left, x, r, shadow, u, v, s, w, t } = self;
        let mut multiply = |products_left: &mut u32, x: &[f64], y: &mut [f64]| {
            *products_left -= 1;
            matrix(x, y);
        };
        shadow.copy_from_slice(r);
        u.fill(0.0);
        let (mut rho, mut alpha, mut omega2) = (1.0, 0.0, 1.0);
        let is_done = |r: &[f64]| {
            let size = dot(r, r).sqrt();
            size <= enough || size.is_nan()
        };
        while *products_left >= PRODUCTS && !is_done(r) {
            rho *= -omega2;
            let mut next = dot(r, shadow);
            let mut beta = alpha * next / rho;
            rho = next;
            assign_sum(u, r, -beta);
            multiply(products_left, u, v);
            alpha = rho / dot(v, shadow);
            add(r, -alpha, v);
            add(x, alpha, u);
            if is_done(r) {
                return;
            }
            multiply(products_left, r, s);

            next = dot(s, shadow);
            beta = alpha * next / rho;
            rho = next;
            assign_sum(v, s, -beta);
            multiply(products_left, v, w);
            alpha = rho / dot(w, shadow);
            assign_sum(u, r, -beta);
            add(r, -alpha, v);
            add(s, -alpha, w);
            add(x, alpha, u);
            if is_done(r) {
                return;
            }
            multiply(products_left, s, t);

            // This minimises the residual along its two products with the matrix.
            let (along, across, both) = (dot(s, s), dot(s, t), dot(t, t));
            let first = dot(r, s);
            let apart = both - across * across / along;
            // If both products are parallel, as for equal separate bodies, the first product alone suffices.
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

/// Computes `to = x + times to`.
fn assign_sum(to: &mut [f64], x: &[f64], times: f64) {
    to.iter_mut().zip(x).for_each(|(to, x)| *to = x + times * *to);
}

/// Computes `to += times x`.
pub(super) fn add(to: &mut [f64], times: f64, x: &[f64]) {
    to.iter_mut().zip(x).for_each(|(to, x)| *to += times * x);
}

/// Returns the length of a vector, computed so that squares do not underflow.
pub(super) fn length(x: &[f64]) -> f64 {
    let unit = unit(x);
    unit * x.iter().fold(0.0, |sum, x| sum + (x / unit) * (x / unit)).sqrt()
}

/// Returns a power of 2, so that dividing by it is exact. The power is near the largest component if that is
/// [tiny](TINY), and 1 otherwise.
fn unit(x: &[f64]) -> f64 {
    let largest = largest(x);
    if largest >= TINY || largest.is_nan() {
        return 1.0;
    }
    f64::from_bits(largest.to_bits() & f64::INFINITY.to_bits()).max(f64::MIN_POSITIVE)
}

/// Returns the inner product, summed in order.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + a * b)
}
