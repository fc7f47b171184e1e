//! How far two pictures of the same size differ, and how far those of two executors may.

/// The difference between two pictures of the same size. That of a pixel is the largest of its channels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PixelDifference {
    /// Numbers of pixels, indexed by their difference.
    pixels: [usize; 256],
}

impl PixelDifference {
    /// Compares the pixels for whose index, from the top left, `is_compared` is true. Both pictures have four channels
    /// per pixel.
    pub fn between(a: &[u8], b: &[u8], is_compared: impl Fn(usize) -> bool) -> Self {
        let mut pixels = [0; 256];
        if a == b {
            pixels[0] = (0..a.len() / 4).filter(|&pixel| is_compared(pixel)).count();
            return Self { pixels };
        }
        for (pixel, (a, b)) in a.chunks_exact(4).zip(b.chunks_exact(4)).enumerate() {
            if is_compared(pixel) {
                let channels = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
                pixels[usize::from(channels.max().unwrap_or(0))] += 1;
            }
        }
        Self { pixels }
    }

    /// Number of pixels that differ by more than this.
    pub fn beyond(&self, difference: u8) -> usize {
        self.pixels[usize::from(difference) + 1..].iter().sum()
    }

    /// The largest difference.
    pub fn worst(&self) -> u8 {
        self.pixels.iter().rposition(|&pixels| pixels > 0).unwrap_or(0) as u8
    }
}

/// The difference that a picture may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelLimits {
    /// The largest difference of a pixel, but for the strays.
    pub max_channel: u8,
    /// The largest share of pixels that differ by more than 1, in percent.
    pub max_pixels_percent: f64,
    /// Number of pixels in each begun hundred thousand that may differ by any amount.
    pub strays: usize,
}

impl PixelLimits {
    /// No difference.
    pub const EXACT: Self = Self { max_channel: 0, max_pixels_percent: 0.0, strays: 0 };

    /// For the same drawing by the processor and by a graphics device. Rounding adds up where translucent lines lie on
    /// each other, along all of a straight line. A device also rounds corners in its own way, so that now and then a
    /// pixel belongs to another triangle.
    pub const OF_EXECUTORS: Self = Self { strays: 1, ..Self::OF_LETTERS };

    /// For letters whose outlines are filled by other instructions.
    pub const OF_LETTERS: Self = Self { max_channel: 2, max_pixels_percent: 100.0, strays: 0 };

    /// Whether these bounds allow no difference at all.
    pub fn are_exact(&self) -> bool {
        self.max_channel == 0 && self.strays == 0
    }

    /// Whether a picture may differ by this.
    pub fn allow(&self, difference: &PixelDifference) -> bool {
        let pixels: usize = difference.pixels.iter().sum();
        let percent = 100.0 * difference.beyond(1) as f64 / pixels as f64;
        difference.beyond(self.max_channel) <= self.strays * pixels.div_ceil(100_000)
            && (difference.beyond(1) == 0 || percent <= self.max_pixels_percent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The difference of a black picture from one in which the first pixels differ by these amounts.
    fn difference(pixels: usize, by: &[u8]) -> PixelDifference {
        let black = vec![0; 4 * pixels];
        let mut other = black.clone();
        for (pixel, by) in by.iter().enumerate() {
            other[4 * pixel + 3] = *by;
        }
        PixelDifference::between(&black, &other, |_| true)
    }

    #[test]
    fn a_difference_of_one_level_in_one_pixel_is_detected() {
        let (none, one) = (difference(200, &[]), difference(200, &[1]));
        assert_eq!((none.beyond(0), none.worst()), (0, 0));
        assert_eq!((one.beyond(0), one.beyond(1), one.worst()), (1, 0, 1));
        assert!(PixelLimits::EXACT.allow(&none) && !PixelLimits::EXACT.allow(&one));
        assert!(PixelLimits::OF_EXECUTORS.allow(&one));
        let with_strays = PixelLimits { max_channel: 0, ..PixelLimits::OF_EXECUTORS };
        assert!(with_strays.allow(&one) && !with_strays.are_exact());
        assert!(PixelLimits::EXACT.are_exact() && !PixelLimits::OF_LETTERS.are_exact());
        let far = difference(200, &[1, 255]);
        assert_eq!((far.beyond(0), far.beyond(254), far.beyond(255), far.worst()), (2, 1, 0, 255));
    }

    #[test]
    fn limits_hold_for_shares_of_a_picture() {
        let limits = PixelLimits::OF_EXECUTORS;
        for (pixels, by, is_allowed) in [
            (10_000, vec![2; 900], true),
            (10_000, vec![4], true),
            (100_000, vec![4], true),
            (100_000, vec![3; 2], false),
            (100_001, vec![3; 2], true),
        ] {
            assert_eq!(limits.allow(&difference(pixels, &by)), is_allowed, "{by:?} of {pixels}");
        }
        assert!(PixelLimits::OF_LETTERS.allow(&difference(10, &[2; 10])));
        assert!(!PixelLimits::OF_LETTERS.allow(&difference(10, &[3])));
        let own = PixelLimits { max_channel: 3, max_pixels_percent: 0.4, strays: 0 };
        assert!(!own.allow(&difference(200, &[3])));
        assert!(own.allow(&difference(250, &[3])) && !own.allow(&difference(250, &[4])));
    }

    #[test]
    fn only_the_wanted_pixels_are_compared() {
        let (black, other) = ([0; 12], [[0; 4], [5; 4], [9; 4]].concat());
        let second = PixelDifference::between(&black, &other, |pixel| pixel == 1);
        assert_eq!((second.beyond(0), second.worst()), (1, 5));
    }
}
