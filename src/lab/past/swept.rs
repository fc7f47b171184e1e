//! What a coordinate passes over between two samples: a swing that is faster than the samples shows in it.

/// The least and the greatest value of a coordinate since the sample before, that of the sample itself included.
#[derive(Clone, Copy, Debug)]
pub struct Swept {
    /// The least value.
    pub least: f64,
    /// The greatest value.
    pub greatest: f64,
}

/// To the bit.
impl PartialEq for Swept {
    fn eq(&self, other: &Self) -> bool {
        let bits = |swept: &Self| [swept.least, swept.greatest].map(f64::to_bits);
        bits(self) == bits(other)
    }
}

impl Swept {
    /// No value yet.
    pub(super) const NOTHING: Self = Self { least: f64::INFINITY, greatest: f64::NEG_INFINITY };

    /// One value alone.
    pub(super) fn at(q: f64) -> Self {
        Self { least: q, greatest: q }
    }

    /// With one more value.
    pub(super) fn and(self, q: f64) -> Self {
        Self { least: self.least.min(q), greatest: self.greatest.max(q) }
    }

    /// The least and the greatest value.
    pub fn ends(self) -> [f64; 2] {
        [self.least, self.greatest]
    }
}
