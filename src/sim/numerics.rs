//! Numerical procedures independent of bodies and methods: derivatives, bisection, golden sections,
//! least squares, and pseudo-random numbers.

use nalgebra::{DMatrix, DVector};

/// The offsets of the values for [`fourth_order`], in steps.
pub(super) const OFFSETS: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];

/// Returns the derivative by a central difference of fourth order, from the values at the [`OFFSETS`] with step `h`.
pub(super) fn fourth_order([far_behind, behind, ahead, far_ahead]: [f64; 4], h: f64) -> f64 {
    (8.0 * (ahead - behind) - far_ahead + far_behind) / (12.0 * h)
}

/// Bisects for the point at which a condition changes: `is_low` is true at `low` and false at `high`. Halves the
/// interval between them `halvings` times. Returns the ends of the remaining interval, `low` first; `low` may be
/// greater than `high`.
pub fn bisect(
    [mut low, mut high]: [f64; 2],
    halvings: u32,
    mut is_low: impl FnMut(f64) -> bool,
) -> [f64; 2] {
    for _ in 0..halvings {
        let middle = (low + high) / 2.0;
        if is_low(middle) { low = middle } else { high = middle }
    }
    [low, high]
}

/// Solves a problem of linear least squares. Returns the coefficients with which the sum of these columns is closest to
/// `right` in mean square. If several solutions are equally close, returns the one with the smallest sum of squares.
///
/// Returns `None` if there are fewer rows than columns, or if a number is not finite.
pub fn least_squares(columns: &[Vec<f64>], right: &[f64]) -> Option<Vec<f64>> {
    if right.len() < columns.len() {
        return None;
    }
    let matrix = DMatrix::from_fn(right.len(), columns.len(), |row, column| columns[column][row]);
    let numbers = || matrix.iter().chain(right);
    if !numbers().all(|x| x.is_finite()) {
        return None;
    }
    let found = matrix.clone().svd(true, true).solve(&DVector::from_column_slice(right), 1e-14);
    let found = found.ok().filter(|found| found.iter().all(|x| x.is_finite()))?;
    Some(found.iter().copied().collect())
}

/// Pseudo-random numbers, the same on every run for a nonzero seed, by Marsaglia's xorshift with 13, 7 and 17.
pub(super) struct XorShift(u64);

impl XorShift {
    /// Returns the sequence with this seed.
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns the next number, from -1 to below 1.
    pub(super) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Returns the place of the minimum of a function between two places by golden sections, to rounding, if there is only
/// one minimum between them.
pub fn golden_section(of: &impl Fn(f64) -> f64, [mut from, mut to]: [f64; 2]) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    for _ in 0..60 {
        let [left, right] = [to - GOLDEN * (to - from), from + GOLDEN * (to - from)];
        if of(left) < of(right) { to = right } else { from = left }
    }
    (from + to) / 2.0
}

#[cfg(test)]
mod tests {
    use super::least_squares;

    #[test]
    fn a_line_is_fitted_through_points_and_non_finite_ones_are_refused() {
        let columns = [vec![0.0, 1.0, 2.0, 3.0], vec![1.0; 4]];
        let found = least_squares(&columns, &[1.0, 3.1, 4.9, 7.0]).unwrap();
        assert!((found[0] - 1.98).abs() < 1e-12 && (found[1] - 1.03).abs() < 1e-12, "{found:?}");
        assert_eq!(least_squares(&columns, &[1.0, f64::NAN, 0.0, 0.0]), None);
        assert_eq!(least_squares(&[vec![1.0], vec![2.0]], &[1.0]), None);
    }
}
