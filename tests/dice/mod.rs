//! Random numbers from a seed that is printed: SplitMix64. `REGATTA_SEED` sets another seed.

pub(crate) struct Dice(u64);

impl Dice {
    /// A generator for the test with this number: each test has a sequence of its own.
    pub(crate) fn new(test: u64) -> Self {
        let seed = std::env::var("REGATTA_SEED").ok().and_then(|seed| seed.parse().ok());
        let seed = seed.unwrap_or(20_261_120);
        println!("seed {seed}");
        Self(seed ^ test << 32)
    }

    /// From 0 to below 1.
    pub(crate) fn part(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// From 0 to below `end`.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        (self.part() * end as f64) as usize
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.part() * (high - low)
    }
}
