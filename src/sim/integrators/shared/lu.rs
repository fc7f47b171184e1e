//! LU factorisation of a dense or a banded matrix with partial pivoting, in storage allocated once.
//!
//! The factorisation is written out because nalgebra allocates in every factorisation of dynamic size and has none for
//! bands. faer would be many times the size of this layer.

/// A square matrix, which [`Lu::factor`] replaces by its triangular factors.
#[derive(Clone)]
pub(super) struct Lu {
    size: usize,
    /// The largest distance of a band's entry from the diagonal; `None` if all entries are stored.
    band: Option<usize>,
    /// Number of rows stored per column. For a band, the rows start twice the reach above the diagonal, because
    /// pivoting moves entries that far. Some of these rows may lie outside the matrix.
    height: usize,
    /// The stored entries, column by column.
    entries: Vec<f64>,
    /// The row swapped with each row in turn.
    swaps: Vec<usize>,
}

impl Lu {
    /// Returns a matrix of `size` rows whose entries lie at most `reach` from the diagonal. All entries are stored if a
    /// band would not be smaller.
    pub(super) fn new(size: usize, reach: usize) -> Self {
        let band = Some(reach).filter(|reach| 3 * reach + 1 < size);
        let height = band.map_or(size, |reach| 3 * reach + 1);
        Self { size, band, height, entries: vec![0.0; size * height], swaps: vec![0; size] }
    }

    /// Returns the stored entries of column `j` from this row on.
    #[inline]
    fn column_from(&mut self, j: usize, row: usize) -> &mut [f64] {
        let (diagonal, _) = self.stored(j, self.band);
        &mut self.entries[j * self.height..][..self.height][diagonal + row - j..]
    }

    /// Factors the matrix. A singular matrix gives solutions that are not finite. Common bands get code of their own.
    #[inline]
    pub(super) fn factor(&mut self) {
        match self.band {
            None => self.eliminate(None),
            Some(1) => self.eliminate(Some(1)),
            Some(3) => self.eliminate(Some(3)),
            band => self.eliminate(band),
        }
    }

    /// Overwrites the right-hand side `x` with the solution.
    #[inline]
    pub(super) fn solve(&self, x: &mut [f64]) {
        match self.band {
            None => self.substitute(x, None),
            Some(1) => self.substitute(x, Some(1)),
            Some(3) => self.substitute(x, Some(3)),
            band => self.substitute(x, band),
        }
    }

    /// Returns the index of the diagonal in the stored entries of column `j`, and the end of the rows that may have
    /// entries below it.
    #[inline(always)]
    fn stored(&self, j: usize, band: Option<usize>) -> (usize, usize) {
        match band {
            Some(reach) => (2 * reach, (j + reach + 1).min(self.size)),
            None => (j, self.size),
        }
    }

    #[inline(always)]
    fn eliminate(&mut self, band: Option<usize>) {
        let Self { size, height, .. } = *self;
        for k in 0..size {
            let (diagonal, end) = self.stored(k, band);
            let below = end - k;
            let right = band.map_or(size, |reach| 2 * reach);
            let (done, rest) = self.entries.split_at_mut((k + 1) * height);
            let column = &mut done[k * height + diagonal..][..below];
            let mut largest = 0;
            for row in 1..below {
                if column[row].abs() > column[largest].abs() {
                    largest = row;
                }
            }
            self.swaps[k] = k + largest;
            // The swap is behind a branch that is seldom taken, because a swap in memory would delay each column.
            if largest > 0 {
                column.swap(0, largest);
            }
            let pivot = column[0];
            for below in &mut column[1..] {
                *below /= pivot;
            }
            for (j, right) in (k + 1..).zip(rest.chunks_exact_mut(height)).take(right) {
                let above = band.map_or(k, |reach| 2 * reach + k - j);
                let right = &mut right[above..][..below];
                if largest > 0 {
                    right.swap(0, largest);
                }
                let factor = right[0];
                // A band that pivoting has not widened has few nonzero factors.
                if factor != 0.0 {
                    for (entry, below) in right[1..].iter_mut().zip(&column[1..]) {
                        *entry -= factor * below;
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn substitute(&self, x: &mut [f64], band: Option<usize>) {
        for (k, column) in self.entries.chunks_exact(self.height).enumerate() {
            let (diagonal, end) = self.stored(k, band);
            if self.swaps[k] != k {
                x.swap(k, self.swaps[k]);
            }
            let solved = x[k];
            for (x, below) in x[k + 1..end].iter_mut().zip(&column[diagonal + 1..]) {
                *x -= solved * below;
            }
        }
        for (k, column) in self.entries.chunks_exact(self.height).enumerate().rev() {
            let (diagonal, _) = self.stored(k, band);
            x[k] /= column[diagonal];
            let (solved, above) = (x[k], diagonal.min(k));
            for (x, above) in x[k - above..k].iter_mut().zip(&column[diagonal - above..]) {
                *x -= solved * above;
            }
        }
    }
}

/// The factored equations of several stages of `n` coordinates each. The unknowns of the [`Lu`] are ordered stage by
/// stage, or coordinate by coordinate if that order keeps the band narrow.
#[derive(Clone)]
pub(super) struct StageLu {
    pub(super) lu: Lu,
    n: usize,
    /// The largest distance between two coordinates that act on each other.
    reach: usize,
    /// The distances between the unknowns of neighbouring coordinates and of neighbouring stages.
    strides: [usize; 2],
    /// The right-hand side in the order of the unknowns; empty if that order is stage by stage.
    ordered: Vec<f64>,
}

impl StageLu {
    pub(super) fn new(stages: usize, n: usize, reach: usize) -> Self {
        let is_interleaved = stages > 1 && reach + 1 < n;
        Self {
            lu: Lu::new(stages * n, stages * (reach + 1) - 1),
            n,
            reach,
            strides: if is_interleaved { [stages, 1] } else { [1, n] },
            ordered: vec![0.0; if is_interleaved { stages * n } else { 0 }],
        }
    }

    /// Returns a distance between two coordinates from which on they act on different coordinates.
    #[inline]
    pub(super) fn independent_stride(&self) -> usize {
        (2 * self.reach + 1).min(self.n)
    }

    /// Clears the matrix before it is filled, because swaps of the last factorisation leave entries outside the band.
    #[inline]
    pub(super) fn clear_matrix(&mut self) {
        self.lu.entries.fill(0.0);
    }

    /// Stores the `slopes` at stage `i` as entries of `I - slopes`. The slopes are along coordinate `first` at stage
    /// `s`, and along all coordinates some [strides](Self::independent_stride) from it, each in its own column. Calls
    /// `see` with each slope and its row of the matrix ordered stage by stage.
    #[inline]
    pub(super) fn add_slopes(
        &mut self,
        [s, first]: [usize; 2],
        i: usize,
        slopes: &[f64],
        see: &mut impl FnMut(usize, f64),
    ) {
        let (reach, apart, [stride, _]) = (self.reach, self.independent_stride(), self.strides);
        // The loop is written by hand, because `step_by` divides.
        let mut j = first;
        while j < self.n {
            let rows = j.saturating_sub(reach)..(j + reach + 1).min(self.n);
            let (index, row) = (self.index(s, j), self.index(i, rows.start));
            let column = self.lu.column_from(index, row);
            let mut entry = 0;
            for row in rows {
                column[entry] = -slopes[row];
                entry += stride;
                see(i * self.n + row, slopes[row]);
            }
            if i == s {
                self.lu.column_from(index, index)[0] += 1.0;
            }
            j += apart;
        }
    }

    #[inline]
    fn index(&self, stage: usize, j: usize) -> usize {
        self.strides[0] * j + self.strides[1] * stage
    }

    /// Overwrites the right-hand side `x`, stage by stage, with the solution.
    #[inline]
    pub(super) fn solve(&mut self, x: &mut [f64]) {
        if self.ordered.is_empty() {
            return self.lu.solve(x);
        }
        let Self { lu, n, strides: [stages, _], ordered, .. } = self;
        for (stage, x) in x.chunks_exact(*n).enumerate() {
            let entries = ordered[stage..].iter_mut().step_by(*stages);
            entries.zip(x).for_each(|(entry, x)| *entry = *x);
        }
        lu.solve(ordered);
        for (stage, x) in x.chunks_exact_mut(*n).enumerate() {
            let entries = ordered[stage..].iter().step_by(*stages);
            entries.zip(x).for_each(|(entry, x)| *x = *entry);
        }
    }
}

#[cfg(all(test, feature = "lab"))]
mod tests {
    use super::{Lu, StageLu};
    use crate::numerics::XorShift;

    #[test]
    fn a_matrix_that_needs_its_rows_swapped_is_solved() {
        let columns = [
            [0.0, 2.0, 4.0, 1.0],
            [1.0, 1.0, 0.0, 3.0],
            [3.0, 0.0, 1.0, 1.0],
            [2.0, 5.0, 1.0, 0.0],
        ];
        let wanted = [1.0, -2.0, 3.0, 0.5];
        let mut lu = Lu::new(4, 3);
        let mut x = [0.0; 4];
        for (j, column) in columns.iter().enumerate() {
            lu.column_from(j, 0).copy_from_slice(column);
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
        let mut lu = Lu::new(2, 1);
        lu.column_from(0, 0).copy_from_slice(&[1.0, 2.0]);
        lu.column_from(1, 0).copy_from_slice(&[2.0, 4.0]);
        lu.factor();
        let mut x = [1.0, 1.0];
        lu.solve(&mut x);
        assert!(x.iter().all(|x| !x.is_finite()), "{x:?}");
    }

    #[test]
    fn a_band_has_the_factors_of_the_same_matrix_in_full() {
        for reach in [1, 2, 3] {
            let (size, mut random) = (12, XorShift::new(5));
            let (mut band, mut full) = (Lu::new(size, reach), Lu::new(size, size));
            let b: Vec<f64> = (0..size).map(|_| random.next()).collect();
            // The matrices are factored twice, to test for leftovers of the first factors.
            for _ in 0..2 {
                band.entries.fill(0.0);
                full.entries.fill(0.0);
                for j in 0..size {
                    for row in j.saturating_sub(reach)..(j + reach + 1).min(size) {
                        // The diagonal is small, so that rows are swapped.
                        let entry = if row == j { 1e-3 } else { random.next() };
                        band.column_from(j, row)[0] = entry;
                        full.column_from(j, row)[0] = entry;
                    }
                }
                let [x, wanted] = [&mut band, &mut full].map(|matrix| {
                    let mut x = b.clone();
                    matrix.factor();
                    matrix.solve(&mut x);
                    x
                });
                assert_eq!(x, wanted, "{reach}");
            }
        }
    }

    #[test]
    fn row_swaps_of_one_matrix_do_not_affect_the_next() {
        // The larger matrix is stored as a band, and the smaller one is stored whole.
        for n in [4, 9] {
            let mut matrix = StageLu::new(1, n, 1);
            let [once, again] = [(); 2].map(|()| {
                matrix.clear_matrix();
                for first in 0..matrix.independent_stride() {
                    // The diagonal of `I - slopes` is small, so that rows are swapped.
                    let slope = |row: usize| if row % 3 == first { 0.999 } else { -1.0 };
                    let slopes: Vec<f64> = (0..n).map(slope).collect();
                    matrix.add_slopes([0, first], 0, &slopes, &mut |_, _| ());
                }
                let mut x = vec![1.0; n];
                matrix.lu.factor();
                matrix.solve(&mut x);
                x
            });
            assert_eq!(once, again, "{n}");
        }
    }
}
