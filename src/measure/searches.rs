//! Searches for the limit of a property.
//!
//! A limit of the rate is approached from the side on which the property holds, and the first failure ends the search.
//! A property may hold again beyond a failure, at a resonance for example, but a game should not rely on that.

use super::criterion::MAX_STIFFER;

/// Returns the number of substeps with this index in the sequence 1, 2, 3, 4, 6, 8, 12 … 64.
pub(super) fn tried_substeps(index: u32) -> u32 {
    match index {
        0 => 1,
        odd if odd % 2 == 1 => 2 << (odd / 2),
        even => 3 << (even / 2 - 1),
    }
}

/// Stiffness factors to try, to two digits. Each is at most a tenth above the one before.
pub(super) const FACTORS: [f64; 30] = [
    1.0,
    1.1,
    1.2,
    1.3,
    1.4,
    1.5,
    1.6,
    1.7,
    1.8,
    1.9,
    2.0,
    2.2,
    2.4,
    2.6,
    2.8,
    3.0,
    3.3,
    3.6,
    3.9,
    4.2,
    4.6,
    5.0,
    5.5,
    6.0,
    6.6,
    7.2,
    7.9,
    8.6,
    9.4,
    MAX_STIFFER,
];

/// Number of subdivisions of a stride between two factors, for a stride at whose ends the results are borderline.
pub(super) const PARTS_OF_STRIDE: usize = 5;

/// Number of factors, including those within strides.
pub(super) const FINE_FACTORS: usize = PARTS_OF_STRIDE * (FACTORS.len() - 1) + 1;

/// Returns the factor with this index, counting [`PARTS_OF_STRIDE`] per stride.
pub(super) fn fine_factor(index: usize) -> f64 {
    let (stride, part) = (index / PARTS_OF_STRIDE, index % PARTS_OF_STRIDE);
    if part == 0 {
        return FACTORS[stride];
    }
    let part = part as f64 / PARTS_OF_STRIDE as f64;
    FACTORS[stride] + part * (FACTORS[stride + 1] - FACTORS[stride])
}

/// A search for the lowest rate, down from a rate at which a property holds. Each stride is the rate divided by
/// `strides`, and the last stride is searched hertz by hertz. No rate tried above the result has failed.
pub(super) struct RatesDown {
    /// Lowest rate in Hz up to now at which the property holds.
    pub(super) held_hz: u32,
    strides: u32,
    /// Highest rate in Hz at which the property fails.
    failed_hz: Option<u32>,
}

impl RatesDown {
    pub(super) fn from(hz: u32, strides: u32) -> Self {
        Self { held_hz: hz, strides, failed_hz: None }
    }

    pub(super) fn next(&self) -> Option<u32> {
        let stride =
            if self.failed_hz.is_some() { 1 } else { (self.held_hz / self.strides).max(1) };
        let next = self.held_hz.checked_sub(stride)?;
        (next > self.failed_hz.unwrap_or(0)).then_some(next)
    }

    /// Records whether the property holds at a rate.
    pub(super) fn note(&mut self, hz: u32, holds: bool) {
        if holds {
            self.held_hz = hz;
        } else {
            self.failed_hz = Some(hz);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_substep_counts_are_tried_per_octave_up_to_the_advised_maximum() {
        let tried: Vec<u32> = (0..).map(tried_substeps).take_while(|&n| n <= 64).collect();
        assert_eq!(tried, [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64]);
    }

    fn slowest_down(hz: u32, strides: u32, mut holds: impl FnMut(u32) -> bool) -> u32 {
        let mut search = RatesDown::from(hz, strides);
        while let Some(next) = search.next() {
            search.note(next, holds(next));
        }
        search.held_hz
    }

    #[test]
    fn the_slowest_rate_is_found_down_from_any_rate() {
        for strides in [6, 60] {
            for from in [1, 2, 3, 60, 61, 1000] {
                for limit in 1..=from {
                    let mut tried = 0;
                    let found = slowest_down(from, strides, |hz| {
                        tried += 1;
                        assert!((1..from).contains(&hz), "{hz} Hz, down from {from}");
                        hz >= limit
                    });
                    assert_eq!(found, limit, "down from {from} Hz");
                    assert!(tried < 8 * strides + from / strides, "{tried} rates");
                }
            }
        }
        // The search finds a gap of 3 Hz if its strides are as short.
        assert_eq!(slowest_down(60, 60, |hz| !(40..43).contains(&hz)), 43);
        assert_eq!(slowest_down(150, 60, |hz| !(110..113).contains(&hz)), 113);
        // The last stride ends at a failure, and a gap within that stride is found, too.
        assert_eq!(slowest_down(60, 6, |hz| hz > 44 && hz != 47), 48);
    }

    #[test]
    fn fine_factors_divide_the_strides_and_end_with_the_last() {
        assert_eq!((fine_factor(0), fine_factor(FINE_FACTORS - 1)), (1.0, MAX_STIFFER));
        let fine: Vec<f64> = (0..FINE_FACTORS).map(fine_factor).collect();
        assert!(fine.windows(2).all(|pair| (1.0..1.03).contains(&(pair[1] / pair[0]))), "{fine:?}");
        assert!(FACTORS.iter().enumerate().all(|(i, &it)| fine[i * PARTS_OF_STRIDE] == it));
    }

    #[test]
    fn factors_rise_by_a_tenth_and_print_in_three_characters() {
        assert_eq!((FACTORS[0], FACTORS[FACTORS.len() - 1]), (1.0, MAX_STIFFER));
        let (small, large) = FACTORS.split_at(11);
        assert!(small.windows(2).all(|pair| (pair[1] - pair[0] - 0.1).abs() < 1e-9));
        assert!(large.windows(2).all(|pair| pair[1] > pair[0] && pair[1] / pair[0] < 1.101));
        assert!(FACTORS.iter().all(|factor| factor.to_string().len() <= 3), "{FACTORS:?}");
    }
}
