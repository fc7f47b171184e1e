//! A curve through points, which is straight between them and constant beyond them.

/// A curve through points in order of rising x. A curve without points is 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    points: Vec<[f64; 2]>,
}

impl Curve {
    /// Returns the curve through these points.
    ///
    /// # Panics
    /// If there are no points, or if their x do not rise.
    pub fn new(points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let points: Vec<_> = points.into_iter().collect();
        assert!(!points.is_empty(), "a curve without a point");
        assert!(points.is_sorted_by(|a, b| a[0] < b[0]), "x that do not rise: {points:?}");
        Self { points }
    }

    /// Returns the points.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Returns the value at `x`.
    #[inline]
    pub fn at(&self, x: f64) -> f64 {
        self.on(self.piece(x), x)
    }

    /// Returns the number of the piece at `x`, which is the number of points at or below `x`.
    #[inline]
    pub fn piece(&self, x: f64) -> i64 {
        self.points.partition_point(|point| point[0] <= x) as i64
    }

    /// Returns the points at the lower and the upper boundary of a piece.
    #[inline]
    fn ends(&self, piece: i64) -> (Option<[f64; 2]>, Option<[f64; 2]>) {
        let at = |index: i64| self.points.get(usize::try_from(index).ok()?).copied();
        (at(piece - 1), at(piece))
    }

    /// Returns the value of one piece at `x`, continued linearly beyond the boundaries of the piece.
    #[inline]
    pub fn on(&self, piece: i64, x: f64) -> f64 {
        match self.ends(piece) {
            (Some([x0, y0]), Some([x1, y1])) => y0 + (x - x0) / (x1 - x0) * (y1 - y0),
            (Some([_, y]), None) | (None, Some([_, y])) => y,
            (None, None) => 0.0,
        }
    }

    /// Returns the slope of one piece.
    pub(super) fn slope(&self, piece: i64) -> f64 {
        match self.ends(piece) {
            (Some([x0, y0]), Some([x1, y1])) => (y1 - y0) / (x1 - x0),
            _ => 0.0,
        }
    }

    /// Returns the signed distances of `x` to the lower and the upper boundary of a piece. A distance is negative
    /// beyond its boundary.
    pub fn distances(&self, piece: i64, x: f64) -> [f64; 2] {
        let (lower, upper) = self.ends(piece);
        [
            lower.map_or(f64::INFINITY, |[end, _]| above(x, end)),
            upper.map_or(f64::INFINITY, |[end, _]| below(x, end)),
        ]
    }
}

/// The rounding error of a value at a boundary, relative to the compared numbers. With a smaller number, a rounded
/// boundary would look like a crossing.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Returns the distance of `value` from the lower boundary `end`. The distance is negative if the value is below `end`
/// by more than rounding.
pub(super) fn above(value: f64, end: f64) -> f64 {
    value - end + ROUNDING * (value.abs() + end.abs())
}

/// Returns the distance of `value` from the upper boundary `end`. The distance is negative if the value is above `end`
/// by more than rounding.
pub(super) fn below(value: f64, end: f64) -> f64 {
    above(-value, -end)
}
