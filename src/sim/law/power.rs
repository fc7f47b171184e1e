//! Powers of several numbers at once, with the bits of [`libm::pow`]: its operations in its order, without its branches.
//! What these are for, such as a result that overflows, is left to it.
//!
//! After FreeBSD's `e_pow.c`, Copyright (C) 2004 by Sun Microsystems, Inc. All rights reserved. Permission to use, copy,
//! modify, and distribute this software is freely granted, provided that this notice is preserved.

use std::array::from_fn;
use std::f64::consts::LN_2;

/// The numbers to the power of one exponent each.
#[inline(always)]
pub(super) fn powers<const W: usize>(x: &[f64; W], y: &[f64; W]) -> [f64; W] {
    let exponent = y[0];
    if exponent == 2.0 && *y == [2.0; W] {
        return from_fn(|i| x[i] * x[i]);
    }
    let Some(usual) = Exponent::of(exponent).filter(|_| *y == [exponent; W]) else {
        return from_fn(|i| libm::pow(x[i], y[i]));
    };
    let (mut powers, mut are_usual) = ([0.0; W], [0_u64; W]);
    for i in 0..W {
        (powers[i], are_usual[i]) = usual.of_base(x[i]);
    }
    if are_usual.iter().fold(1, |all, is_usual| all & is_usual) == 0 {
        for i in 0..W {
            if are_usual[i] == 0 {
                powers[i] = libm::pow(x[i], exponent);
            }
        }
    }
    powers
}

/// An exponent for which `pow` has no branch of its own.
#[derive(Clone, Copy)]
struct Exponent {
    y: f64,
    /// Its leading half.
    high: f64,
    /// The sign bit if the power of a negative number is negative.
    odd: u64,
    /// The least bits of a base, without its sign bit moved to the right, that has no power; the sign bit if none has.
    refused: u64,
}

const SIGN: u64 = 1 << 63;
const MANTISSA: u64 = (1 << 52) - 1;
const ONE: u64 = 0x3ff << 52;
/// The smallest normal number, and infinity.
const NORMAL: u64 = 1 << 52;
const INFINITE: u64 = 0x7ff << 52;

/// The largest exponent for which the logarithm is not found in another way.
const MAX_EXPONENT: f64 = 2147483648.0;
/// Results beyond this power of two may overflow or underflow.
const MAX_LOG: f64 = 1000.0;

/// Adding it to the bits of a small whole number makes a number that is larger by [`SHIFT`].
const SHIFT_BITS: u64 = 0x4338 << 48;
const SHIFT: f64 = 6755399441055744.0;

impl Exponent {
    fn of(y: f64) -> Option<Self> {
        let has_branch = [1.0, 0.5, 0.0].contains(&y.abs());
        let is_usual = y.abs() < MAX_EXPONENT && !has_branch;
        let is_whole = y as i64 as f64 == y;
        let odd = if is_whole && y as i64 & 1 == 1 { SIGN } else { 0 };
        let refused = if is_whole { u64::MAX } else { SIGN };
        is_usual.then(|| Self { y, high: high(y), odd, refused })
    }

    /// The power and 1; 0 in place of 1 if [`libm::pow`] must find it.
    #[inline(always)]
    fn of_base(self, x: f64) -> (f64, u64) {
        let all = x.to_bits();
        let bits = all & !SIGN;
        let is_base = (NORMAL..INFINITE).contains(&bits) & (all < self.refused);

        // The base as 2^n ax, and the nearer of 1 and 3/2.
        let part = (bits >> 32) & 0xfffff;
        let is_large = u64::from(part >= 0xbb67a);
        let is_middle = (part > 0x3988e) & (part < 0xbb67a);
        let n = (bits >> 52).wrapping_sub(0x3ff).wrapping_add(is_large);
        let ax_bits = ((bits & MANTISSA) | ONE) - (is_large << 52);
        let ax = f64::from_bits(ax_bits);
        let near = if is_middle { 1.5 } else { 1.0 };
        let near_log_high = if is_middle { 0.5849624872207642 } else { 0.0 };
        let near_log_low = if is_middle { 1.350039202129749e-08 } else { 0.0 };

        // s = (ax - near) / (ax + near) in two halves.
        let u = ax - near;
        let v = 1.0 / (ax + near);
        let ss = u * v;
        let s_h = high(ss);
        let sum = ((ax_bits >> 33) | 0x2000_0000) + 0x0008_0000 + (u64::from(is_middle) << 18);
        let t_h = f64::from_bits(sum << 32);
        let t_l = ax - (t_h - near);
        let s_l = v * ((u - s_h * t_h) - s_h * t_l);

        // The logarithm of ax.
        let s2 = ss * ss;
        let mut r = s2
            * s2
            * (0.5999999999999946
                + s2 * (0.4285714285785502
                    + s2 * (0.33333332981837743
                        + s2 * (0.272728123808534
                            + s2 * (0.23066074577556175 + s2 * 0.20697501780033842)))));
        r += s_l * (s_h + ss);
        let s2 = s_h * s_h;
        let t_h = high(3.0 + s2 + r);
        let t_l = r - ((t_h - 3.0) - s2);
        let u = s_h * t_h;
        let v = s_l * t_h + t_l * ss;
        let p_h = high(u + v);
        let p_l = v - (p_h - u);
        let z_h = 0.9617967009544373 * p_h;
        let z_l = -7.028461650952758e-09 * p_h + p_l * 0.9617966939259756 + near_log_low;

        // The logarithm to base 2 of the base in two halves.
        let t = whole(n);
        let t1 = high(((z_h + z_l) + near_log_high) + t);
        let t2 = z_l - (((t1 - t) - near_log_high) - z_h);

        // That of the power.
        let Self { y, high: y1, .. } = self;
        let p_l = (y - y1) * t1 + y * t2;
        let p_h = y1 * t1;
        let z = p_l + p_h;
        let is_usual = is_base & (z.abs() < MAX_LOG);

        // The nearest whole number to it.
        let log = z.to_bits() >> 32;
        let size = log & 0x7fff_ffff;
        let is_half = size > 0x3fe0_0000;
        let k = (size >> 20).wrapping_sub(0x3fe) & 63;
        let rounded = size + (0x0010_0000 >> k);
        let k = (rounded >> 20).wrapping_sub(0x3ff) & 63;
        let cut = (rounded & !(0x000f_ffff >> k)) | (log & 0x8000_0000);
        let count = ((rounded & 0x000f_ffff) | 0x0010_0000) >> (20_u64.wrapping_sub(k) & 63);
        let is_negative = log >> 31;
        let n = (count ^ is_negative.wrapping_neg()).wrapping_add(is_negative);
        let n = if is_half { n } else { 0 };
        let p_h = p_h - f64::from_bits(if is_half { cut << 32 } else { 0 });

        // Two to the power of the rest.
        let t = high(p_l + p_h);
        let u = t * 0.6931471824645996;
        let v = (p_l - (t - p_h)) * LN_2 + t * -1.904654299957768e-09;
        let z = u + v;
        let w = v - (z - u);
        let t = z * z;
        let t1 = z - t
            * (0.16666666666666602
                + t * (-0.0027777777777015593
                    + t * (6.613756321437934e-05
                        + t * (-1.6533902205465252e-06 + t * 4.1381367970572385e-08))));
        let r = (z * t1) / (t1 - 2.0) - (w + z * w);
        let power = 1.0 - (r - z);
        let bits = power.to_bits().wrapping_add(n << 52) | (all & self.odd);
        (f64::from_bits(bits), u64::from(is_usual))
    }
}

/// The leading half of a number.
#[inline(always)]
fn high(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & !0xffff_ffff)
}

/// A small whole number in two's complement as a number.
#[inline(always)]
fn whole(n: u64) -> f64 {
    f64::from_bits(SHIFT_BITS.wrapping_add(n)) - SHIFT
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::xor_shift::XorShift;

    #[test]
    fn powers_have_the_bits_of_those_one_by_one() {
        let exponents = [
            3.0,
            2.5,
            -2.0,
            -1.5,
            4.0,
            7.0,
            1.4,
            -0.7,
            63.0,
            100.3,
            2.0,
            1.0,
            -1.0,
            0.5,
            -0.5,
            0.0,
            1e-5,
            1e9,
            2147483647.0,
            1e10,
            1e300,
            f64::INFINITY,
            f64::NAN,
        ];
        let bases = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            1.5,
            1.224744871391589,
            1.7320508075688772,
            0.9999999999999999,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
            5e-324,
            -1e-310,
            f64::MAX,
            f64::MIN_POSITIVE,
        ];
        let mut dice = XorShift::new(1);
        let mut differ = Vec::new();
        for round in 0..3000 {
            let y =
                if round % 2 == 0 { 8.0 * dice.next() } else { exponents[round % exponents.len()] };
            let x: [f64; 8] = from_fn(|i| match (round + i) % 5 {
                0 => bases[(round + i) % bases.len()],
                1 => 1.0 + 1e-6 * dice.next(),
                2 => 100.0 * dice.next().abs(),
                3 => libm::exp(700.0 * dice.next()),
                _ => 4.0 * dice.next(),
            });
            for (x, found) in x.into_iter().zip(powers(&x, &[y; 8])) {
                let wanted = libm::pow(x, y);
                if found.to_bits() != wanted.to_bits() && !(found.is_nan() && wanted.is_nan()) {
                    differ.push(format!("{x:e}^{y:e} is {wanted:e} and not {found:e}"));
                }
            }
        }
        assert!(differ.is_empty(), "{} of them: {}", differ.len(), differ[0]);
        assert_eq!(powers(&[3.0; 2], &[2.0, 3.0]), [9.0, libm::pow(3.0, 3.0)]);
    }
}
