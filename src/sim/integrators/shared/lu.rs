//! LU factorisation of a dense or a banded matrix with partial pivoting, in storage allocated once.
//!
//! Written out because nalgebra allocates in every factorisation of dynamic size and has none for bands, and faer
//! would be many times the size of this layer.

use std::ops::Range;

/// A square matrix, replaced by its triangular factors in [`Lu::factor`].
#[derive(Clone)]
pub(super) struct Lu {
    size: usize,
    /// How far from the diagonal an entry may lie.
    reach: usize,
    /// The rows that are stored of a column: pivoting moves entries up to twice the reach above the diagonal.
    height: usize,
    /// Column by column.
    entries: Vec<f64>,
    /// The row that was swapped with each row in turn.
    swaps: Vec<usize>,
}

impl Lu {
    /// A matrix of `size` rows whose entries lie at most `reach` from the diagonal: all of them where that is no
    /// less than `size - 1`.
    pub(super) fn new(size: usize, reach: usize) -> Self {
        let reach = reach.min(size.saturating_sub(1));
        let height = size.min(3 * reach + 1);
        Self { size, reach, height, entries: vec![0.0; size * height], swaps: vec![0; size] }
    }

    /// Memory on the heap, in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        size_of_val(&self.entries[..]) + size_of_val(&self.swaps[..])
    }

    /// Overwrites column `j` with zeros. Returns the rows in which it may have entries, and these entries.
    #[inline]
    fn clear_column(&mut self, j: usize) -> (Range<usize>, &mut [f64]) {
        let Self { size, reach, height, .. } = *self;
        let rows = j.saturating_sub(reach)..(j + reach + 1).min(size);
        let first = first(j, reach, size, height);
        let column = &mut self.entries[j * height..][..height];
        column.fill(0.0);
        (rows.clone(), &mut column[rows.start - first..rows.end - first])
    }

    /// What is stored of column `j` from this row on.
    #[inline]
    fn column_from(&mut self, j: usize, row: usize) -> &mut [f64] {
        let first = first(j, self.reach, self.size, self.height);
        &mut self.entries[j * self.height..][..self.height][row - first..]
    }

    /// Factors the matrix. A singular matrix gives solutions that are not finite.
    #[inline]
    pub(super) fn factor(&mut self) {
        match self.band() {
            None => self.eliminate(None),
            Some(1) => self.eliminate(Some(1)),
            Some(3) => self.eliminate(Some(3)),
            band => self.eliminate(band),
        }
    }

    /// Overwrites the right-hand side `x` with the solution.
    #[inline]
    pub(super) fn solve(&self, x: &mut [f64]) {
        match self.band() {
            None => self.substitute(x, None),
            Some(1) => self.substitute(x, Some(1)),
            Some(3) => self.substitute(x, Some(3)),
            band => self.substitute(x, band),
        }
    }

    /// The reach of a band, whose common values are compiled for themselves; `None` where all is stored.
    #[inline]
    fn band(&self) -> Option<usize> {
        (self.height < self.size).then_some(self.reach)
    }

    /// The first row that is stored of column `j`, and the end of the rows that may have entries below the diagonal.
    #[inline(always)]
    fn stored(&self, j: usize, band: Option<usize>) -> (usize, usize) {
        let Self { size, height, .. } = *self;
        match band {
            Some(reach) => (first(j, reach, size, height), (j + reach + 1).min(size)),
            None => (0, size),
        }
    }

    #[inline(always)]
    fn eliminate(&mut self, band: Option<usize>) {
        let (size, height) = (self.size, self.height);
        for k in 0..size {
            let (start, end) = self.stored(k, band);
            let below = end - k;
            let right = match band {
                Some(reach) => 2 * reach,
                None => size,
            };
            let (done, rest) = self.entries.split_at_mut((k + 1) * height);
            let column = &mut done[k * height + k - start..][..below];
            let mut largest = 0;
            for row in 1..below {
                if column[row].abs() > column[largest].abs() {
                    largest = row;
                }
            }
            self.swaps[k] = k + largest;
            column.swap(0, largest);
            let pivot = column[0];
            for below in &mut column[1..] {
                *below /= pivot;
            }
            for (j, right) in (k + 1..).zip(rest.chunks_exact_mut(height)).take(right) {
                let start = match band {
                    Some(reach) => first(j, reach, size, height),
                    None => 0,
                };
                let right = &mut right[k - start..][..below];
                right.swap(0, largest);
                let factor = right[0];
                // Few entries of a band that pivoting has not widened.
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
            let (start, end) = self.stored(k, band);
            x.swap(k, self.swaps[k]);
            let solved = x[k];
            for (x, below) in x[k + 1..end].iter_mut().zip(&column[k - start + 1..]) {
                *x -= solved * below;
            }
        }
        for (k, column) in self.entries.chunks_exact(self.height).enumerate().rev() {
            let (start, _) = self.stored(k, band);
            x[k] /= column[k - start];
            let solved = x[k];
            for (x, above) in x[start..k].iter_mut().zip(column) {
                *x -= solved * above;
            }
        }
    }
}

/// The first row that is stored of column `j`.
#[inline]
fn first(j: usize, reach: usize, size: usize, height: usize) -> usize {
    j.saturating_sub(2 * reach).min(size - height)
}

/// The factored equations of several stages of `n` coordinates each: an [`Lu`] whose unknowns are ordered stage by
/// stage, or coordinate by coordinate where that keeps the band narrow.
#[derive(Clone)]
pub(super) struct StageLu {
    lu: Lu,
    n: usize,
    /// How far from each other two coordinates that act on each other are.
    reach: usize,
    /// The distance between the unknowns of neighbouring coordinates, and of neighbouring stages.
    strides: [usize; 2],
    /// The right-hand side in the order of the unknowns, where that is not stage by stage.
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

    /// Memory on the heap, in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        self.lu.heap_bytes() + size_of_val(&self.ordered[..])
    }

    /// Coordinates this far apart, and farther, act on different ones.
    #[inline]
    pub(super) fn apart(&self) -> usize {
        (2 * self.reach + 1).min(self.n)
    }

    /// The coordinates on which coordinate `j` acts.
    #[inline]
    pub(super) fn rows(&self, j: usize) -> Range<usize> {
        j.saturating_sub(self.reach)..(j + self.reach + 1).min(self.n)
    }

    /// Begins the column of coordinate `j` at stage `s`.
    #[inline]
    pub(super) fn begin_column(&mut self, s: usize, j: usize) {
        // All of a dense column is going to be put.
        if self.lu.band().is_some() {
            self.lu.clear_column(self.index(s, j));
        }
    }

    /// Puts the `slopes` at stage `i`, in the [rows](Self::rows) of coordinate `j`, into its column at stage `s`, as
    /// entries of `I - slopes`.
    #[inline]
    pub(super) fn put(&mut self, [s, j]: [usize; 2], i: usize, slopes: &[f64]) {
        let (index, row) = (self.index(s, j), self.index(i, j.saturating_sub(self.reach)));
        let column = self.lu.column_from(index, row);
        let entries = column.iter_mut().step_by(self.strides[0]);
        entries.zip(slopes).for_each(|(entry, slope)| *entry = -slope);
        if i == s {
            self.lu.column_from(index, index)[0] += 1.0;
        }
    }

    #[inline]
    fn index(&self, stage: usize, j: usize) -> usize {
        self.strides[0] * j + self.strides[1] * stage
    }

    #[inline]
    pub(super) fn factor(&mut self) {
        self.lu.factor();
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
    use super::Lu;
    use crate::sim::xor_shift::XorShift;

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
            lu.clear_column(j).1.copy_from_slice(column);
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
        lu.clear_column(0).1.copy_from_slice(&[1.0, 2.0]);
        lu.clear_column(1).1.copy_from_slice(&[2.0, 4.0]);
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
            // Twice, for what the first factors leave behind.
            for _ in 0..2 {
                for j in 0..size {
                    let (rows, column) = band.clear_column(j);
                    let (_, whole) = full.clear_column(j);
                    for (row, entry) in rows.zip(column) {
                        // A small diagonal, so that rows are swapped.
                        *entry = if row == j { 1e-3 } else { random.next() };
                        whole[row] = *entry;
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
}
