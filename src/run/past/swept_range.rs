//! The range of a coordinate between two samples, which shows a swing that is faster than the samples.

/// The least and the greatest value of a coordinate from the sample before to this sample.
#[derive(Clone, Copy, Debug)]
pub struct SweptRange {
    /// The least value.
    pub least: f64,
    /// The greatest value.
    pub greatest: f64,
}

/// Compares bits.
impl PartialEq for SweptRange {
    fn eq(&self, other: &Self) -> bool {
        let bits = |swept: &Self| [swept.least, swept.greatest].map(f64::to_bits);
        bits(self) == bits(other)
    }
}

impl SweptRange {
    /// The empty range.
    pub(super) const NOTHING: Self = Self { least: f64::INFINITY, greatest: f64::NEG_INFINITY };

    /// The range of one value.
    pub(super) fn at(q: f64) -> Self {
        Self { least: q, greatest: q }
    }

    /// The range extended by `q`.
    pub(super) fn and(self, q: f64) -> Self {
        Self { least: self.least.min(q), greatest: self.greatest.max(q) }
    }

    /// The least and the greatest value.
    pub fn ends(self) -> [f64; 2] {
        [self.least, self.greatest]
    }
}
