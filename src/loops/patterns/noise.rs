//! Noise that is the same on every platform.

/// A generator of whole numbers: Sebastiano Vigna's SplitMix64.
#[derive(Clone, Copy)]
pub(super) struct Noise(u64);

impl Noise {
    /// The generator at its start for a seed.
    pub(super) const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// A number from 0 to `most`, which is not negative, all equally likely.
    pub(super) fn up_to(&mut self, most: i64) -> i64 {
        let many = u128::from(most.unsigned_abs()) + 1;
        // The high half of the product lies in 0..many: no division, and a bias below 2⁻⁶⁴ · many.
        ((u128::from(self.bits()) * many) >> 64) as i64
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_generator_is_splitmix64() {
        let mut noise = Noise::new(1_234_567);
        let known = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973];
        assert_eq!([noise.bits(), noise.bits()], known);
    }

    #[test]
    fn numbers_cover_their_range_evenly() {
        let (mut noise, mut counts) = (Noise::new(1), [0; 5]);
        for _ in 0..5000 {
            counts[noise.up_to(4) as usize] += 1;
        }
        assert!(counts.iter().all(|count| (900..1100).contains(count)), "{counts:?}");
    }
}
