//! Kepler's problem, solved: where a body is on its ellipse, parabola or hyperbola after a while.
//!
//! One formula for all three, in the universal variable `s`, of which time is `dt = r ds`. Stiefel &
//! Scheifele, *Linear and Regular Celestial Mechanics* (1971); Wisdom & Hernandez, *Fast and accurate
//! Kepler via universal variables* (2015).

use std::f64::consts::TAU;

use glam::DVec2;

use crate::sim::State;

/// The most steps towards the root before it is polished; Newton's method takes some five, halving
/// the open path's bracket at worst sixty.
const MOST_STEPS: u32 = 200;

/// So near the root, Newton's method doubles the digits at every step, and needs no bracket.
const NEAR: f64 = 1e-5;

/// Stumpff's functions `Gₖ = sᵏ cₖ(β s²)`, with `G₀″ = -β G₀`: for β = 1 they are cos s, sin s,
/// 1 - cos s, s - sin s.
struct Stumpff {
    g1: f64,
    g2: f64,
    g3: f64,
}

impl Stumpff {
    fn new(beta: f64, s: f64) -> Self {
        let z = beta * s * s;
        if z.abs() <= 4.0 {
            // Series, where the closed forms would cancel: Σ (-z)ⁿ 2 / (2n + 2)! and Σ (-z)ⁿ 6 / (2n + 3)!;
            // the first terms left out are below 1e-19.
            let (mut c2, mut c3) = (1.0, 1.0);
            for n in (1..13).rev() {
                let n = 2.0 * f64::from(n);
                c2 = 1.0 - z * c2 / ((n + 1.0) * (n + 2.0));
                c3 = 1.0 - z * c3 / ((n + 2.0) * (n + 3.0));
            }
            let (g2, g3) = (s * s * c2 / 2.0, s * s * s * c3 / 6.0);
            return Self { g1: s - beta * g3, g2, g3 };
        }
        let w = beta.abs().sqrt();
        let x = w * s;
        let (sin, sin_half, left) = if beta > 0.0 {
            let sin = libm::sin(x);
            (sin, libm::sin(x / 2.0), x - sin)
        } else {
            let sinh = libm::sinh(x);
            (sinh, libm::sinh(x / 2.0), sinh - x)
        };
        Self { g1: sin / w, g2: 2.0 * sin_half * sin_half / (w * w), g3: left / (w * w * w) }
    }
}

/// The state `dt` seconds after `from`, about a centre at the origin that pulls with `mu` / r².
///
/// Good to some 1e-14 of its size for each radian gone round. On a fly-by from r away at speed v, times
/// cancel, and it is worse by the factor r v² / `mu`.
pub(super) fn flow(mu: f64, dt: f64, from: &State<DVec2>) -> State<DVec2> {
    if dt == 0.0 {
        return from.clone();
    }
    let State { q, v } = *from;
    let r0 = libm::hypot(q.x, q.y);
    let eta = q.dot(v);
    // Twice the binding energy; positive on an ellipse.
    let beta = 2.0 * mu / r0 - v.dot(v);
    let dt = match period(mu, beta) {
        Some(period) => libm::remainder(dt, period),
        None => dt,
    };
    // Kepler's equation: what passes by the universal variable s, less dt, and how fast it passes.
    let late = |s: f64| {
        let Stumpff { g1, g2, g3 } = Stumpff::new(beta, s);
        let time = r0 * g1 + eta * g2 + mu * g3 - dt;
        (time, r0 + eta * g1 + (mu - beta * r0) * g2)
    };
    let s = root(late, beta, dt / r0, dt);

    let Stumpff { g1, g2, .. } = Stumpff::new(beta, s);
    let r = r0 + eta * g1 + (mu - beta * r0) * g2;
    // Lagrange's coefficients.
    let (f, g) = (1.0 - mu * g2 / r0, r0 * g1 + eta * g2);
    let (f_dot, g_dot) = (-mu * g1 / (r * r0), 1.0 - mu * g2 / r);
    State { q: f * q + g * v, v: f_dot * q + g_dot * v }
}

/// How long a round takes, in seconds, for a body bound by `beta` / 2 for each kilogram.
pub(super) fn period(mu: f64, beta: f64) -> Option<f64> {
    let period = TAU * mu / (beta * beta.sqrt());
    (beta > 0.0 && period.is_finite()).then_some(period)
}

/// The `s` at which `late` is 0. It rises with `s` from `-dt` at 0: its slope is the distance from the
/// centre.
fn root(late: impl Fn(f64) -> (f64, f64), beta: f64, guess: f64, dt: f64) -> f64 {
    let sign = dt.signum();
    // What overflows is far beyond.
    let is_beyond = |time: f64| time.is_nan() || time * sign >= 0.0;
    // Less than a round; on an open path as far as it takes.
    let mut far = if beta > 0.0 { sign * TAU / beta.sqrt() } else { guess };
    while beta <= 0.0 && !is_beyond(late(far).0) {
        far *= 2.0;
    }
    let mut near = 0.0;
    let is_between =
        |s: f64, near: f64, far: f64| (s - near) * sign > 0.0 && (far - s) * sign > 0.0;
    let mut s = if is_between(guess, near, far) { guess } else { far / 2.0 };
    let mut last_step = (far - near).abs();
    for _ in 0..MOST_STEPS {
        let (time, distance) = late(s);
        if is_beyond(time) {
            far = s;
        } else {
            near = s;
        }
        // Newton's step where it is half the last or less; far out on a hyperbola it would creep.
        let newton = time / distance;
        let is_fast = is_between(s - newton, near, far) && 2.0 * newton.abs() <= last_step;
        let next = if is_fast { s - newton } else { near + (far - near) / 2.0 };
        last_step = (next - s).abs();
        s = next;
        if is_fast && last_step <= NEAR * s.abs() {
            break;
        }
    }
    for _ in 0..2 {
        let (time, distance) = late(s);
        s -= time / distance;
    }
    s
}
