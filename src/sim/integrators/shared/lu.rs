//! LU factorisation with partial pivoting, in storage allocated once.
//!
//! Written out because nalgebra allocates in every factorisation of dynamic size, and faer would be
//! many times the size of this layer.

/// A square matrix, replaced by its triangular factors in [`Lu::factor`].
#[derive(Clone)]
pub(super) struct Lu {
    size: usize,
    /// Column by column.
    entries: Vec<f64>,
    /// The row that was swapped with each row in turn.
    swaps: Vec<usize>,
}

impl Lu {
    pub(super) fn new(size: usize) -> Self {
        Self { size, entries: vec![0.0; size * size], swaps: vec![0; size] }
    }

    /// Memory on the heap, in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        size_of_val(&self.entries[..]) + size_of_val(&self.swaps[..])
    }

    /// A column of the matrix, to be filled before factoring.
    pub(super) fn column_mut(&mut self, j: usize) -> &mut [f64] {
        &mut self.entries[j * self.size..][..self.size]
    }

    /// Factors the matrix. A singular matrix gives solutions that are not finite.
    pub(super) fn factor(&mut self) {
        let Self { size, entries, swaps } = self;
        for k in 0..*size {
            let (known, rest) = entries.split_at_mut((k + 1) * *size);
            let column = &mut known[k * *size..];
            let mut largest = k;
            for row in k + 1..*size {
                if column[row].abs() > column[largest].abs() {
                    largest = row;
                }
            }
            swaps[k] = largest;
            column.swap(k, largest);
            let pivot = column[k];
            for below in &mut column[k + 1..] {
                *below /= pivot;
            }
            for right in rest.chunks_exact_mut(*size) {
                right.swap(k, largest);
                let factor = right[k];
                // The matrices of chains are sparse.
                if factor != 0.0 {
                    for (entry, below) in right[k + 1..].iter_mut().zip(&column[k + 1..]) {
                        *entry -= factor * below;
                    }
                }
            }
        }
    }

    /// Overwrites the right-hand side `x` with the solution.
    pub(super) fn solve(&self, x: &mut [f64]) {
        for (k, column) in self.entries.chunks_exact(self.size).enumerate() {
            x.swap(k, self.swaps[k]);
            let known = x[k];
            for (x, below) in x[k + 1..].iter_mut().zip(&column[k + 1..]) {
                *x -= known * below;
            }
        }
        for (k, column) in self.entries.chunks_exact(self.size).enumerate().rev() {
            x[k] /= column[k];
            let known = x[k];
            for (x, above) in x[..k].iter_mut().zip(column) {
                *x -= known * above;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Lu;

    #[test]
    fn a_matrix_that_needs_its_rows_swapped_is_solved() {
        let columns = [
            [0.0, 2.0, 4.0, 1.0],
            [1.0, 1.0, 0.0, 3.0],
            [3.0, 0.0, 1.0, 1.0],
            [2.0, 5.0, 1.0, 0.0],
        ];
        let wanted = [1.0, -2.0, 3.0, 0.5];
        let mut lu = Lu::new(4);
        let mut x = [0.0; 4];
        for (j, column) in columns.iter().enumerate() {
            lu.column_mut(j).copy_from_slice(column);
            for (x, entry) in x.iter_mut().zip(column) {
                *x += entry * wanted[j];
            }
        }
        lu.factor();
        lu.solve(&mut x);
        for (found, wanted) in x.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-14, "{x:?}");
        }
    }

    #[test]
    fn a_singular_matrix_gives_nothing_finite() {
        let mut lu = Lu::new(2);
        lu.column_mut(0).copy_from_slice(&[1.0, 2.0]);
        lu.column_mut(1).copy_from_slice(&[2.0, 4.0]);
        lu.factor();
        let mut x = [1.0, 1.0];
        lu.solve(&mut x);
        assert!(x.iter().all(|x| !x.is_finite()), "{x:?}");
    }
}
