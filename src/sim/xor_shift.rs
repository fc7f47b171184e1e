//! Numbers that look random and are the same on every run: Marsaglia's xorshift with 13, 7 and 17.

/// A sequence of such numbers, from a seed that is not 0.
pub(super) struct XorShift(u64);

impl XorShift {
    /// The sequence of this seed.
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// From -1 to below 1.
    pub(super) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
