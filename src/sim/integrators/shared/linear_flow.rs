//! The flow of a linear equation, which is the exponential of the equation's matrix applied to a vector.
//!
//! The Taylor series acts on the vector. The step is cut into pieces, and a larger matrix needs more of them (Al-Mohy &
//! Higham, *Computing the action of the matrix exponential*, 2011). If there are too many pieces and the matrix is
//! small, scaling and squaring replaces the series. Both use products and sums only.

use crate::integrators::failure::{StepFailure, Stepped};
use crate::state::largest;
use crate::system::Coupling;

/// The degree of the Taylor polynomial. Over a piece of norm 1 the polynomial omits 1/19!, which is less than a unit of
/// round-off.
const DEGREE: u32 = 18;
/// The number of pieces beyond which scaling and squaring is cheaper.
const MAX_PIECES_IF_SMALL: f64 = 8.0;
/// The maximum number of pieces in a step. Without a limit, a step of a stiff net would never end.
const MAX_PIECES: f64 = 1000.0;
/// The number of equations in the largest system for scaling and squaring. Its three matrices have 28 kB.
const SMALL: usize = 32;

/// The number of terms in the series of a [`response`]. The omitted terms are below a unit of round-off.
const TERMS: usize = 12;
/// The largest root of a response's equation for which the series is summed. Longer times are reached by doubling from
/// there.
const SHORT: f64 = 0.25;

/// Returns the response of `x″ = y x + z x′` at time 1 to a push at time 0. The response is the displacement `s(1)`
/// from a unit of velocity, its integral, and the integral of that integral. It takes the place of the matrix
/// exponential for one coordinate.
///
/// The function uses products and sums only. It sums the series over a part of the time, and doubles the part until it
/// is the whole time. For a decaying motion, no term cancels another.
#[inline]
pub(in crate::integrators) fn response(y: f64, z: f64) -> [f64; 3] {
    let (mut y, mut z, mut doublings) = (y, z, 0);
    while z.abs() > SHORT || y.abs() > SHORT * SHORT {
        if !(y + z).is_finite() {
            return [f64::NAN; 3];
        }
        (y, z, doublings) = (y / 4.0, z / 2.0, doublings + 1);
    }
    // The series is s = Σ u / n!, with u = 1, z, z² + y … from n = 1.
    let (mut s1, mut s2) = (0.0, 0.0);
    let (mut u, mut last) = (1.0, 0.0);
    for [once, twice] in INVERSE_FACTORIALS {
        s1 += once * u;
        s2 += twice * u;
        (u, last) = (z * u + y * last, u);
    }
    let mut s = 1.0 + y * s2 + z * s1;
    for _ in 0..doublings {
        // These are the displacement from a unit of displacement, and the velocity from a unit of velocity, halfway.
        let (p, v) = (1.0 + y * s1, 1.0 + y * s1 + z * s);
        s2 = (s2 + s1 + s * (s1 - z * s2) + v * s2) / 8.0;
        s1 = (s1 + s * (s - z * s1) + v * s1) / 4.0;
        s = s * (p + v) / 2.0;
        (y, z) = (4.0 * y, 2.0 * z);
    }
    [s, s1, s2]
}

/// The numbers `1 / (n + 1)!` and `1 / (n + 2)!` from n = 1.
const INVERSE_FACTORIALS: [[f64; 2]; TERMS] = {
    let mut table = [[0.0; 2]; TERMS];
    let (mut n, mut factorial) = (0, 1.0);
    while n < TERMS {
        factorial *= (n + 2) as f64;
        table[n] = [1.0 / factorial, 1.0 / (factorial * (n + 3) as f64)];
        n += 1;
    }
    table
};

/// Scratch for the flow of a system of linear equations.
#[derive(Clone)]
pub(in crate::integrators) struct LinearFlow {
    term: Vec<f64>,
    next: Vec<f64>,
    squaring: Option<Box<Squaring>>,
}

impl LinearFlow {
    /// Returns scratch for `size` equations of coordinates with this coupling.
    pub(in crate::integrators) fn new(size: usize, coupling: Coupling) -> Self {
        let is_small = coupling != Coupling::Few && size <= SMALL;
        let squaring = is_small.then(|| Box::new(Squaring::new(size + 2)));
        Self { term: vec![0.0; size], next: vec![0.0; size], squaring }
    }

    /// Advances `x` by `x' = A x + b + t c` from `t = 0` to 1. `product` must overwrite its second argument with `A`
    /// times its first, and `norm` must bound the largest row sum of `A`.
    ///
    /// # Errors
    /// [`StepFailure::TooManySubsteps`] if a large matrix needs too many pieces.
    pub(in crate::integrators) fn advance(
        &mut self,
        x: &mut [f64],
        b: &[f64],
        c: &[f64],
        norm: f64,
        product: &mut dyn FnMut(&[f64], &mut [f64]),
    ) -> Stepped {
        if !norm.is_finite() {
            x.fill(f64::NAN);
            return Ok(());
        }
        let pieces = libm::ceil(norm).max(1.0);
        if let Some(squaring) = &mut self.squaring
            && pieces > MAX_PIECES_IF_SMALL
        {
            squaring.advance(x, b, c, norm, product);
            return Ok(());
        }
        if pieces > MAX_PIECES {
            return Err(StepFailure::TooManySubsteps { limit: MAX_PIECES as u32 });
        }
        let Self { term, next, .. } = self;
        let part = 1.0 / pieces;
        for piece in 0..pieces as u32 {
            let t = f64::from(piece) * part;
            product(x, term);
            for ((term, b), c) in term.iter_mut().zip(b).zip(c) {
                *term = part * (*term + b + t * c);
            }
            for k in 2..=DEGREE {
                x.iter_mut().zip(&*term).for_each(|(x, term)| *x += term);
                product(term, next);
                // The part of the force that grows with time enters once.
                let grown = if k == 2 { part } else { 0.0 };
                for ((term, next), c) in term.iter_mut().zip(&*next).zip(c) {
                    *term = part / f64::from(k) * (next + grown * c);
                }
                if largest(&*term) == 0.0 {
                    break;
                }
            }
            x.iter_mut().zip(&*term).for_each(|(x, term)| *x += term);
        }
        Ok(())
    }
}

/// Scaling and squaring of the matrix that acts on `(x, t, 1)`.
#[derive(Clone)]
struct Squaring {
    size: usize,
    /// The scaled matrix, the exponential and a product, column by column.
    matrices: [Vec<f64>; 3],
}

impl Squaring {
    fn new(size: usize) -> Self {
        Self { size, matrices: [(); 3].map(|()| vec![0.0; size * size]) }
    }

    fn advance(
        &mut self,
        x: &mut [f64],
        b: &[f64],
        c: &[f64],
        norm: f64,
        product: &mut dyn FnMut(&[f64], &mut [f64]),
    ) {
        let Self { size, matrices: [scaled, power, next] } = self;
        let (size, n) = (*size, x.len());
        scaled.fill(0.0);
        let (mut halvings, mut part) = (0, 1.0);
        while norm * part > 1.0 {
            (halvings, part) = (halvings + 1, part / 2.0);
        }
        // The columns of A are its products with the unit vectors.
        let unit = &mut next[..n];
        unit.fill(0.0);
        for j in 0..n {
            unit[j] = 1.0;
            product(unit, &mut scaled[j * size..][..n]);
            unit[j] = 0.0;
        }
        scaled[n * size..][..n].copy_from_slice(c);
        scaled[(n + 1) * size..][..n].copy_from_slice(b);
        scaled[(n + 1) * size + n] = 1.0;
        scaled.iter_mut().for_each(|entry| *entry *= part);

        // The polynomial is evaluated by Horner's rule, as I + M (I + M/2 (I + M/3 …)).
        power.fill(0.0);
        (0..size).for_each(|i| power[i * size + i] = 1.0);
        for k in (1..=DEGREE).rev() {
            multiply(size, scaled, power, next);
            next.iter_mut().for_each(|entry| *entry /= f64::from(k));
            (0..size).for_each(|i| next[i * size + i] += 1.0);
            std::mem::swap(power, next);
        }
        for _ in 0..halvings {
            multiply(size, power, power, next);
            std::mem::swap(power, next);
        }
        let sum = &mut next[..n];
        sum.copy_from_slice(&power[(n + 1) * size..][..n]);
        for (x, column) in x.iter().zip(power.chunks_exact(size)) {
            sum.iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry * x);
        }
        x.copy_from_slice(sum);
    }
}

/// Computes `product = a b`, column by column.
fn multiply(size: usize, a: &[f64], b: &[f64], product: &mut [f64]) {
    for (column, b) in product.chunks_exact_mut(size).zip(b.chunks_exact(size)) {
        column.fill(0.0);
        for (b, a) in b.iter().zip(a.chunks_exact(size)) {
            column.iter_mut().zip(a).for_each(|(sum, a)| *sum += a * b);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Coupling::{All, Few};

    /// Solves `x' = A x + b + t c` for the matrix `[[0, w], [-w, -d]]`, from 0.
    fn flow(
        coupling: Coupling,
        [w, d]: [f64; 2],
        b: [f64; 2],
        c: [f64; 2],
    ) -> Result<[f64; 2], StepFailure> {
        let mut x = [0.0; 2];
        let norm = w.abs() + d.abs();
        let product = |x: &[f64], y: &mut [f64]| {
            y.copy_from_slice(&[w * x[1], -w * x[0] - d * x[1]]);
        };
        LinearFlow::new(2, coupling).advance(&mut x, &b, &c, norm, &mut { product })?;
        Ok(x)
    }

    fn near(found: [f64; 2], wanted: [f64; 2], size: f64) {
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-13 * size, "{found}, not {wanted}");
        }
    }

    #[test]
    fn a_push_rotates_by_sine_and_cosine_in_pieces_and_by_squaring() {
        for (coupling, w) in [(Few, 0.6), (Few, 40.0), (All, 0.6), (All, 40.0)] {
            let found = flow(coupling, [w, 0.0], [0.0, w], [0.0, 0.0]).unwrap();
            near(found, [1.0 - libm::cos(w), libm::sin(w)], 40.0);
            // For a growing push, x = t - sin(wt)/w, x' = (1 - cos(wt))/w.
            let found = flow(coupling, [w, 0.0], [0.0; 2], [0.0, w]).unwrap();
            near(found, [1.0 - libm::sin(w) / w, (1.0 - libm::cos(w)) / w], 40.0);
        }
    }

    #[test]
    fn a_decay_much_faster_than_the_step_ends_at_its_limit() {
        let found = flow(All, [0.0, 1e9], [0.0, 1e9], [0.0; 2]).unwrap();
        near(found, [0.0, 1.0], 1e3);
        let failure = flow(Few, [0.0, 1e9], [0.0, 1e9], [0.0; 2]);
        assert_eq!(failure, Err(StepFailure::TooManySubsteps { limit: 1000 }));
    }

    #[test]
    fn the_response_matches_oscillation_decay_and_growth() {
        // The displacement is s = e^(αt) sin(ωt)/ω with z = 2α and y = -α² - ω², and its integrals from the equation.
        for alpha in [0.0, -0.3, -4.0, 0.5] {
            for w in [1e-3, 0.2, 1.7, 30.0] {
                let (y, z) = (-alpha * alpha - w * w, 2.0 * alpha);
                let (sin, cos, e) = (libm::sin(w), libm::cos(w), libm::exp(alpha));
                let found = response(y, z);
                let (s, v) = (e * sin / w, e * (cos + alpha * sin / w));
                let s1 = (v - 1.0 - z * s) / y;
                let wanted = [s, s1, (s - 1.0 - z * s1) / y];
                // The tolerance leaves room for the cancellation in `wanted`, whose integrals come from the equation.
                for (i, (found, wanted)) in found.into_iter().zip(wanted).enumerate() {
                    let room = 1e-14 * (1.0 + w) * [1.0, 1.0 / y.abs(), 1.0 / (y * y)][i];
                    assert!(
                        (found - wanted).abs() < room,
                        "{y}, {z}: {i} is {found}, not {wanted}"
                    );
                }
            }
        }
        // For decay alone, from very slow to very fast, s = (e^z - 1)/z.
        for z in [-1e-9, -0.1, -3.0, -50.0, -1e9] {
            let [s, s1, s2] = response(0.0, z);
            let wanted = libm::expm1(z) / z;
            assert!((s / wanted - 1.0).abs() < 1e-14, "{z}: {s}, not {wanted}");
            if z <= -3.0 {
                let (once, twice) = ((s - 1.0) / z, ((s - 1.0) / z - 0.5) / z);
                assert!((s1 / once - 1.0).abs() < 1e-14, "{z}: {s1}, not {once}");
                assert!((s2 / twice - 1.0).abs() < 1e-13, "{z}: {s2}, not {twice}");
            }
        }
        assert!(response(f64::NAN, 0.0)[0].is_nan() && response(0.0, f64::INFINITY)[0].is_nan());
    }

    #[test]
    fn an_undefined_matrix_gives_no_finite_result() {
        let found = flow(All, [f64::NAN, 0.0], [1.0; 2], [0.0; 2]).unwrap();
        assert!(found.iter().all(|x| x.is_nan()));
    }
}
