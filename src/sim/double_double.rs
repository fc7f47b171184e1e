//! Double-double arithmetic. A number is the unevaluated sum of two `f64`, of which the second is at most half a unit
//! in the last place of the first.
//!
//! The closed forms and the reference solution use this arithmetic where plain `f64` would lose digits to cancellation.
//! It uses only `+ - × ÷ √` and no fused multiply-add, so that the bits are the same on every platform. Dekker, *A
//! floating-point technique for extending the available precision* (1971); Joldes, Muller & Popescu, *Tight and
//! rigorous error bounds for basic building blocks of double-word arithmetic* (2017).

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The number `high + low`. Products of magnitudes from 1e-140 to 1e140 neither overflow nor lose their lower half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct DoubleDouble {
    pub(super) high: f64,
    pub(super) low: f64,
}

/// The number 2π.
pub(super) const TWO_PI: DoubleDouble =
    DoubleDouble { high: std::f64::consts::TAU, low: 2.449_293_598_294_706_4e-16 };

impl DoubleDouble {
    /// Returns the exact sum.
    pub(super) fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let b_there = high - a;
        Self { high, low: (a - (high - b_there)) + (b - b_there) }
    }

    /// Returns the exact sum, for `b` no larger in magnitude than `a`.
    fn quick_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    /// Returns the exact product.
    pub(super) fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
        Self { high, low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 }
    }
}

/// Functions that only the closed forms of bodies need.
impl DoubleDouble {
    pub(super) const ONE: Self = Self { high: 1.0, low: 0.0 };

    pub(super) fn sqrt(self) -> Self {
        if self.high == 0.0 {
            return self;
        }
        let root = self.high.sqrt();
        let rest = self - Self::product(root, root);
        Self::quick_sum(root, rest.high / (2.0 * root))
    }

    /// Multiplies the number by a power of two.
    pub(super) fn scaled(self, power_of_two: f64) -> Self {
        Self { high: self.high * power_of_two, low: self.low * power_of_two }
    }
}

/// Returns the upper and the lower half of a number's digits (Veltkamp).
fn halves(x: f64) -> (f64, f64) {
    let far = 134_217_729.0 * x;
    let upper = far - (far - x);
    (upper, x - upper)
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let sum = Self::quick_sum(high.high, high.low + low.high);
        Self::quick_sum(sum.high, low.low + sum.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        Self::quick_sum(product.high, product.low + cross)
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        let product = Self::product(self.high, other);
        Self::quick_sum(product.high, product.low + self.low * other)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first;
        let second = rest.high / other.high;
        let rest = rest - other * second;
        Self::quick_sum(first, second) + Self::from(rest.high / other.high)
    }
}

impl Div<f64> for DoubleDouble {
    type Output = Self;
    fn div(self, other: f64) -> Self {
        let first = self.high / other;
        let rest = self - Self::product(first, other);
        Self::quick_sum(first, rest.high / other)
    }
}

#[cfg(all(test, feature = "lab"))]
mod tests {
    use super::*;

    fn third() -> DoubleDouble {
        DoubleDouble::ONE / 3.0
    }

    fn assert_small(rest: DoubleDouble, most: f64) {
        assert!(rest.high.abs() <= most, "{rest:?}");
    }

    #[test]
    fn a_sum_keeps_digits_that_f64_drops() {
        let sum = DoubleDouble::from(1e16) + 1.0.into() + 1e-10.into() - 1e16.into();
        assert_eq!(sum.high, 1.0 + 1e-10);
        assert_ne!(1e16 + 1.0 + 1e-10 - 1e16, 1.0 + 1e-10);
    }

    #[test]
    fn a_product_of_two_numbers_is_exact() {
        let (a, b) = (1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
        assert_eq!(
            DoubleDouble::product(a, b),
            DoubleDouble { high: 1.0, low: -f64::EPSILON * f64::EPSILON }
        );
    }

    #[test]
    fn quotients_and_roots_undo_products_to_twice_the_digits() {
        assert_small(third() * 3.0 - DoubleDouble::ONE, 1e-31);
        assert_ne!(third().low, 0.0);
        let x = third() + TWO_PI;
        assert_small(x / third() * third() - x, 1e-30);
        assert_small((x * x).sqrt() - x, 1e-30);
        assert_small((x.scaled(-0.25) * -4.0) - x, 0.0);
        assert_eq!(DoubleDouble::from(0.0).sqrt().high, 0.0);
    }

    #[test]
    fn two_pi_is_right_to_both_halves() {
        // Machin's formula is π = 16 atan 1/5 - 4 atan 1/239.
        let atan_of_inverse = |n: f64| {
            let (mut power, mut sum) = (DoubleDouble::ONE / n, DoubleDouble::from(0.0));
            for k in 0..25 {
                sum = sum + power / f64::from(2 * k + 1);
                power = -(power / n / n);
            }
            sum
        };
        let pi = atan_of_inverse(5.0) * 16.0 - atan_of_inverse(239.0) * 4.0;
        assert_small(pi * 2.0 - TWO_PI, 1e-30);
    }
}
