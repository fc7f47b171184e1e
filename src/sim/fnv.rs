//! A hash of numbers that is the same on every platform and in every release.

/// The state of a 64-bit FNV-1a hash over little-endian words.
pub struct Fnv(pub u64);

impl Default for Fnv {
    /// Returns the hash of nothing.
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    /// Adds a number by its bits, with -0 as 0.
    pub fn number(&mut self, value: f64) {
        self.word(if value == 0.0 { 0 } else { value.to_bits() });
    }

    /// Adds a word, byte by byte.
    pub fn word(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}
