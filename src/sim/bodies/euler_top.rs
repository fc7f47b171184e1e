//! The motion of a free rigid body in closed form: Jacobi's functions for the angular velocity, and one of Carlson's
//! integrals for the attitude. Jacobi, *Sur la rotation d'un corps* (1850); Carlson, *Numerical computation of real or
//! complex elliptic integrals* (1995); Bulirsch, *Numerical calculation of elliptic integrals and elliptic functions*
//! (1965).
//!
//! The axes are sorted so that ω circles the third. No difference of near numbers is left but S, which vanishes on the
//! separatrix and is taken in double-double.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec3};

use crate::double_double::DoubleDouble;
use crate::spin::{Spin, axes_by_moment, turn_by};

/// Returns the state `t` (s) after `from`, for these principal moments (kg m²).
pub(super) fn flow(moments: DVec3, from: &Spin, t: f64) -> Spin {
    let DVec3 { x: i1, y: i2, z: i3 } = moments;
    let DVec3 { x: w1, y: w2, z: w3 } = from.omega;
    // The cross product of ω and L, which rounds to something else than 0 where moments are equal.
    if [(i3 - i2) * w2 * w3, (i1 - i3) * w3 * w1, (i2 - i1) * w1 * w2] == [0.0; 3] {
        let turned = t * from.omega;
        let attitude = from.attitude * turn_by(turned);
        return Spin { turns: from.turns + turned, attitude, ..*from };
    }
    Top::new(moments, from.omega).after(from, t)
}

/// A free body whose angular velocity changes. The letters are those of the textbook, on the sorted axes.
struct Top {
    /// The axis that is sorted into each place, and the sign of the permutation, which makes it a rotation.
    order: [usize; 3],
    sign: f64,
    moments: [f64; 3],
    /// Amplitudes: ω = (a₁ cn u, g a₂ sn u, a₃ dn u).
    a: [f64; 3],
    g: f64,
    /// u grows by this rate, in 1/s.
    rate: f64,
    start: f64,
    functions: Jacobi,
    /// |L|, and r = b/a of the ellipse that L draws across the third axis.
    momentum: f64,
    r: f64,
    n: f64,
}

impl Top {
    fn new(moments: DVec3, omega: DVec3) -> Self {
        let mut order = axes_by_moment(moments);
        let s = {
            let part = |axis: usize, other: usize| {
                let (i, w) = (moments[axis], omega[axis]);
                DoubleDouble::sum(i, -moments[other]) * i * w * w
            };
            (part(order[2], order[1]) + part(order[0], order[1])).high
        };
        if s < 0.0 {
            order.reverse();
        }
        let swaps = [(0, 1), (0, 2), (1, 2)].iter().filter(|(i, j)| order[*i] > order[*j]).count();
        let sign = if swaps % 2 == 0 { 1.0 } else { -1.0 };
        let [i1, i2, i3] = order.map(|axis| moments[axis]);
        let [w1, w2, w3] = order.map(|axis| sign * omega[axis]);
        // Squares of the ratios of amplitudes.
        let [r12, r32] = [i2 * (i3 - i2) / (i1 * (i3 - i1)), i2 * (i2 - i1) / (i3 * (i3 - i1))];
        let a1 = (w1 * w1 + r12 * w2 * w2).sqrt();
        let a2 = (w2 * w2 + w1 * w1 / r12).sqrt();
        let a3 = (w3 * w3 + r32 * w2 * w2).sqrt().copysign(w3);
        let g = ((i3 - i1) * a3).signum();
        let most = (i3 - i2).abs() * i3 * a3 * a3;
        let functions = Jacobi::new(
            ((i2 - i1) / (i3 - i2) * i1 / i3 * a1 * a1 / (a3 * a3)).min(1.0),
            (s.abs() / most).min(1.0),
            w1 < 0.0,
        );
        let momentum = DVec3::new(i1 * w1, i2 * w2, i3 * w3).length();
        Self {
            order,
            sign,
            moments: [i1, i2, i3],
            a: [a1, a2, a3],
            g,
            rate: a3.abs() * ((i3 - i1) * (i3 - i2) / (i1 * i2)).sqrt(),
            start: functions.argument(g * w2 / a2, w1 / a1),
            functions,
            momentum,
            r: (i2 * (i3 - i1) / (i1 * (i3 - i2))).sqrt(),
            n: -i3 * (i2 - i1) / (i1 * (i3 - i2)),
        }
    }

    fn after(&self, from: &Spin, t: f64) -> Spin {
        let ([i1, i2, _], [a1, a2, a3]) = (self.moments, self.a);
        let [u0, u] = [self.start, self.start + self.rate * t];
        let [before, now] = [u0, u].map(|u| self.functions.at(u));
        let p = self.functions.p(self.n, u) - self.functions.p(self.n, u0);
        let bend = self.momentum / self.rate * (1.0 / i2 - 1.0 / i1) * self.r * self.r;
        let phi = self.momentum * t / i1 + bend * p;
        let turn = self.frame(&before, 0.0).conjugate() * self.frame(&now, phi);
        let amplitudes = [a1, self.g * a2, a3];
        let along = |i: usize| amplitudes[i] / self.rate * (now.integrals[i] - before.integrals[i]);
        let unsorted = |sorted: [f64; 3]| {
            let mut v = DVec3::ZERO;
            for (axis, x) in self.order.into_iter().zip(sorted) {
                v[axis] = self.sign * x;
            }
            v
        };
        let v = unsorted([turn.x, turn.y, turn.z]);
        let attitude = from.attitude * DQuat::from_xyzw(v.x, v.y, v.z, turn.w);
        Spin {
            turns: from.turns + unsorted([along(0), along(1), along(2)]),
            omega: unsorted([a1 * now.cn, self.g * a2 * now.sn, a3 * now.dn]),
            attitude: attitude * (1.0 / attitude.length()),
        }
    }

    /// Returns the rotation by the angles φ, θ and ψ, from the body to the frame with L along z. The angle ψ goes on
    /// through whole turns, so that the quaternion keeps its sign.
    fn frame(&self, at: &Values, phi: f64) -> DQuat {
        let ([i1, i2, i3], [a1, a2, a3]) = (self.moments, self.a);
        let across = libm::hypot(i1 * a1 * at.cn, i2 * a2 * at.sn);
        let [sn, cn] = at.folded;
        let psi = libm::atan2(cn, self.g * self.r * sn) - self.g * PI * at.half_turns;
        let (sin, cos) = libm::sincos(libm::atan2(across, i3 * a3 * at.dn) / 2.0);
        let (sin_sum, cos_sum) = libm::sincos((phi + psi) / 2.0);
        let (sin_rest, cos_rest) = libm::sincos((phi - psi) / 2.0);
        DQuat::from_xyzw(sin * cos_rest, sin * sin_rest, cos * sin_sum, cos * cos_sum)
    }
}

/// Jacobi's functions of one parameter.
struct Jacobi {
    m: f64,
    /// 1 - m; 0 on the separatrix.
    m1: f64,
    /// K, a quarter of the period; infinite on the separatrix.
    quarter: f64,
    /// Whether cn is negative for ever, on the separatrix.
    is_behind: bool,
}

/// The functions at one argument.
struct Values {
    sn: f64,
    cn: f64,
    dn: f64,
    /// sn and cn of the argument less `half_turns` halves of the period.
    folded: [f64; 2],
    half_turns: f64,
    /// The integrals of cn, sn and dn.
    integrals: [f64; 3],
}

/// An argument beyond which sech is 0, below the range of `cosh`.
const FAR: f64 = 700.0;

impl Jacobi {
    fn new(m: f64, m1: f64, is_behind: bool) -> Self {
        let quarter = if m1 == 0.0 { f64::INFINITY } else { quarter(m1) };
        Self { m, m1, quarter, is_behind }
    }

    /// Returns the argument with these sn and cn.
    fn argument(&self, sn: f64, cn: f64) -> f64 {
        if self.m1 == 0.0 {
            return if cn == 0.0 { 0.0 } else { libm::asinh(sn / cn.abs()) };
        }
        let u = sn * carlson_f(cn * cn, self.m1 + self.m * cn * cn, 1.0);
        if cn >= 0.0 { u } else { (2.0 * self.quarter).copysign(sn) - u }
    }

    /// Divides the argument into halves of the period and the rest.
    fn fold(&self, u: f64) -> (f64, f64) {
        let half_turns = libm::rint(u / (2.0 * self.quarter));
        (half_turns, u - 2.0 * self.quarter * half_turns)
    }

    fn at(&self, u: f64) -> Values {
        if self.m1 == 0.0 {
            return self.on_separatrix(u);
        }
        let (half_turns, rest) = self.fold(u);
        let folded = sn_cn_dn(rest, self.m1);
        let [sn, cn, dn] = folded;
        let sign = if half_turns % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let root = self.m.sqrt();
        let integrals = match root {
            0.0 => [sign * sn, -sign * cn, u],
            _ => [
                libm::atan2(root * sign * sn, dn) / root,
                -libm::asinh(root / self.m1.sqrt() * sign * cn) / root,
                PI * half_turns + libm::atan2(sn, cn),
            ],
        };
        Values { sn: sign * sn, cn: sign * cn, dn, folded: [sn, cn], half_turns, integrals }
    }

    fn on_separatrix(&self, u: f64) -> Values {
        let sech = if u.abs() > FAR { 0.0 } else { 1.0 / libm::cosh(u) };
        let sign = if self.is_behind { -1.0 } else { 1.0 };
        let (sn, cn, angle) = (libm::tanh(u), sign * sech, libm::atan(libm::sinh(u)));
        let log_cosh = u.abs() - std::f64::consts::LN_2 + libm::log1p(libm::exp(-2.0 * u.abs()));
        let integrals = [sign * angle, log_cosh, angle];
        Values { sn, cn, dn: sech, folded: [sn, cn], half_turns: 0.0, integrals }
    }

    /// Returns the integral of `sn²/(1 - n sn²)` from 0 to u, for n ≤ 0.
    fn p(&self, n: f64, u: f64) -> f64 {
        if self.m1 == 0.0 {
            let (t, k) = (libm::tanh(u), (-n).sqrt());
            let angle = if k > 0.0 { libm::atan(k * t) / k } else { t };
            return (u - angle) / (1.0 - n);
        }
        let (half_turns, rest) = self.fold(u);
        let of_half = 2.0 * half_turns * carlson_j(0.0, self.m1, 1.0, 1.0 - n) / 3.0;
        let [sn, cn, dn] = sn_cn_dn(rest, self.m1);
        of_half + sn * sn * sn * carlson_j(cn * cn, dn * dn, 1.0, 1.0 - n * sn * sn) / 3.0
    }
}

/// Returns K of the parameter 1 - m1, by the mean of Gauss.
fn quarter(m1: f64) -> f64 {
    let (mut a, mut b) = (1.0_f64, m1.sqrt());
    while (a - b).abs() > 1e-15 * a {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    FRAC_PI_2 / ((a + b) / 2.0)
}

/// Steps of the descending transformation, of which six reach rounding for the largest m below 1.
const MAX_DESCENT: usize = 16;

/// Returns sn, cn and dn within half a period of 0, for m1 > 0.
fn sn_cn_dn(u: f64, m1: f64) -> [f64; 3] {
    let mut levels = [[0.0; 2]; MAX_DESCENT];
    let (mut a, mut b, mut c, mut depth) = (1.0_f64, m1, 1.0, 0);
    for level in &mut levels {
        b = b.sqrt();
        *level = [a, b];
        (depth, c) = (depth + 1, 0.5 * (a + b));
        // The next step would be below rounding.
        if (a - b).abs() <= 1e-9 * a {
            break;
        }
        b *= a;
        a = c;
    }
    let (sin, cos) = libm::sincos(c * u);
    if sin == 0.0 {
        return [sin, cos, 1.0];
    }
    let (mut a, mut dn) = (cos / sin, 1.0);
    c *= a;
    for [m, n] in levels[..depth].iter().rev() {
        a *= c;
        c *= dn;
        dn = (n + a) / (m + a);
        a = c / m;
    }
    let sn = (1.0 / (c * c + 1.0).sqrt()).copysign(sin);
    [sn, c * sn, dn]
}

/// The relative spread of the arguments below which the series of degree 5 or 6 is exact to rounding.
const NEAR: f64 = 1e-3;

/// Steps of an integral of Carlson's, each of which brings the arguments four times as near. More are never needed but
/// by arguments that are not numbers.
const MAX_DUPLICATIONS: u32 = 1000;

/// Returns Carlson's R_F.
fn carlson_f(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    for _ in 0..MAX_DUPLICATIONS {
        let a = (x + y + z) / 3.0;
        let [dx, dy] = [1.0 - x / a, 1.0 - y / a];
        let dz = -dx - dy;
        if dx.abs().max(dy.abs()).max(dz.abs()) < NEAR {
            let (e2, e3) = (dx * dy - dz * dz, dx * dy * dz);
            let series = 1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0
                - 3.0 * e2 * e3 / 44.0
                - 5.0 * e2 * e2 * e2 / 208.0
                + 3.0 * e3 * e3 / 104.0;
            return series / a.sqrt();
        }
        let [sx, sy, sz] = [x, y, z].map(f64::sqrt);
        let l = sx * sy + sy * sz + sz * sx;
        [x, y, z] = [x, y, z].map(|x| (x + l) / 4.0);
    }
    f64::NAN
}

/// Returns Carlson's R_C, for y > 0.
fn carlson_c(mut x: f64, mut y: f64) -> f64 {
    for _ in 0..MAX_DUPLICATIONS {
        let a = (x + 2.0 * y) / 3.0;
        let s = (y - a) / a;
        if s.abs() < NEAR {
            let series = [159.0 / 208.0, 9.0 / 22.0, 0.375, 1.0 / 7.0, 0.3];
            let sum = series.into_iter().fold(0.0, |sum, term| sum * s + term);
            return (1.0 + s * s * sum) / a.sqrt();
        }
        let l = 2.0 * x.sqrt() * y.sqrt() + y;
        (x, y) = ((x + l) / 4.0, (y + l) / 4.0);
    }
    f64::NAN
}

/// Returns Carlson's R_J, for p > 0.
fn carlson_j(mut x: f64, mut y: f64, mut z: f64, mut p: f64) -> f64 {
    let (mut sum, mut part) = (0.0, 1.0);
    for _ in 0..MAX_DUPLICATIONS {
        let a = (x + y + z + 2.0 * p) / 5.0;
        let [dx, dy, dz] = [x, y, z].map(|x| 1.0 - x / a);
        let dp = (-dx - dy - dz) / 2.0;
        if dx.abs().max(dy.abs()).max(dz.abs()).max(dp.abs()) < NEAR {
            let e2 = dx * dy + dx * dz + dy * dz - 3.0 * dp * dp;
            let e3 = dx * dy * dz + 2.0 * e2 * dp + 4.0 * dp * dp * dp;
            let e4 = (2.0 * dx * dy * dz + e2 * dp + 3.0 * dp * dp * dp) * dp;
            let e5 = dx * dy * dz * dp * dp;
            let series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0
                - 3.0 * e4 / 22.0
                - 9.0 * e2 * e3 / 52.0
                + 3.0 * e5 / 26.0
                - e2 * e2 * e2 / 16.0
                + 3.0 * e3 * e3 / 40.0
                + 3.0 * e2 * e4 / 20.0;
            return sum + part * series / (a * a.sqrt());
        }
        let [sx, sy, sz] = [x, y, z].map(f64::sqrt);
        let l = sx * sy + sy * sz + sz * sx;
        let alpha = p * (sx + sy + sz) + sx * sy * sz;
        sum += 3.0 * part * carlson_c(alpha * alpha, p * (p + l) * (p + l));
        [x, y, z, p] = [x, y, z, p].map(|x| (x + l) / 4.0);
        part /= 4.0;
    }
    f64::NAN
}
