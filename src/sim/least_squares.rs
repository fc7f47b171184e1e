//! Linear least squares.

use nalgebra::{DMatrix, DVector};

/// The coefficients with which the sum of these columns comes nearest to `right`, in the mean of squares. Columns that
/// depend on others get the smallest coefficients that do.
///
/// `None` if there are fewer rows than columns, or if a number is not finite.
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

#[cfg(test)]
mod tests {
    use super::least_squares;

    #[test]
    fn a_line_is_found_among_points_and_numbers_that_are_none_are_refused() {
        let columns = [vec![0.0, 1.0, 2.0, 3.0], vec![1.0; 4]];
        let found = least_squares(&columns, &[1.0, 3.1, 4.9, 7.0]).unwrap();
        assert!((found[0] - 1.98).abs() < 1e-12 && (found[1] - 1.03).abs() < 1e-12, "{found:?}");
        assert_eq!(least_squares(&columns, &[1.0, f64::NAN, 0.0, 0.0]), None);
        assert_eq!(least_squares(&[vec![1.0], vec![2.0]], &[1.0]), None);
    }
}
