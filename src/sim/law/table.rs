//! A curve through points: straight between them, level beyond them.

pub(super) use crate::sim::parameter::MOST_POINTS;

/// The points, in rising order of x; two or more.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Table {
    points: Vec<[f64; 2]>,
}

impl Table {
    pub(super) fn new(points: Vec<[f64; 2]>) -> Self {
        Self { points }
    }

    /// The piece at `x`: the number of points at or below it.
    #[inline]
    pub(super) fn piece(&self, x: f64) -> i64 {
        self.points.partition_point(|point| point[0] <= x) as i64
    }

    /// The points at the lower and the upper boundary of a piece.
    #[inline]
    pub(super) fn ends(&self, piece: i64) -> (Option<[f64; 2]>, Option<[f64; 2]>) {
        let at = |index: i64| self.points.get(usize::try_from(index).ok()?).copied();
        (at(piece - 1), at(piece))
    }

    /// The value by one piece, continued linearly beyond its boundaries.
    #[inline]
    pub(super) fn on(&self, piece: i64, x: f64) -> f64 {
        match self.ends(piece) {
            (Some([x0, y0]), Some([x1, y1])) => y0 + (x - x0) / (x1 - x0) * (y1 - y0),
            (Some([_, y]), None) | (None, Some([_, y])) => y,
            (None, None) => f64::NAN,
        }
    }

    /// The bits of the points, by which equal tables are found.
    pub(super) fn bits(&self) -> Vec<[u64; 2]> {
        self.points.iter().map(|point| point.map(f64::to_bits)).collect()
    }

    /// The slope of one piece.
    pub(super) fn slope(&self, piece: i64) -> f64 {
        match self.ends(piece) {
            (Some([x0, y0]), Some([x1, y1])) => (y1 - y0) / (x1 - x0),
            _ => 0.0,
        }
    }
}
