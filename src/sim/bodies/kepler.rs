//! The closed form of Kepler's problem, which gives the state on an ellipse, parabola or hyperbola after a given time.
//!
//! One formula serves all three curves, in the universal variable `s` with `dt = r ds`. Stiefel & Scheifele, *Linear
//! and Regular Celestial Mechanics* (1971); Wisdom & Hernandez, *Fast and accurate Kepler via universal variables*
//! (2015).
//!
//! On an ellipse `s` is counted from the initial state. On an open path `s` is counted from the periapsis. Counted from
//! the start of a fly-by, at distance r and speed v, the formula would lose a factor of (r v² / μ)² to cancellation.
//! Times and positions are kept in [`DoubleDouble`] until the result is rounded.

use std::f64::consts::TAU;

use glam::DVec2;

use crate::State;
use crate::double_double::{DoubleDouble, TWO_PI};

/// The maximum number of steps to the root before it is refined. Bisection of a bracket down to the last digit needs
/// fewer.
const MAX_STEPS: u32 = 200;

/// The maximum number of doublings of the bracket of an open path, enough to go from the smallest number beyond the
/// largest.
const MAX_DOUBLINGS: u32 = 2100;

/// The distance from the root, relative to the root, within which Newton's method needs no bracket, because it doubles
/// the digits at every step.
const NEAR: f64 = 1e-5;

/// The maximum number of Newton steps in double-double arithmetic. Near a collision the root is triple, and each step
/// leaves two thirds of the error.
const MAX_REFINEMENTS: u32 = 80;

/// The relative size of a step after which the root is accepted.
const REFINED_TO: f64 = 1e-30;

/// The `r v² / μ` above which the path is straight to the precision of [`DoubleDouble`].
const UNBENT: f64 = 1e60;

/// Stumpff's functions `Gₖ = sᵏ cₖ(β s²)`, with `G₀″ = -β G₀`. For β = 1 they are cos s, sin s, 1 - cos s, s - sin s.
struct Stumpff {
    g1: f64,
    g2: f64,
    g3: f64,
}

impl Stumpff {
    fn new(beta: f64, s: f64) -> Self {
        let z = beta * s * s;
        if z.abs() <= 4.0 {
            // Here the closed forms would cancel, and the series serve instead: Σ (-z)ⁿ 2 / (2n + 2)! and Σ (-z)ⁿ 6 /
            // (2n + 3)!. The first omitted terms are below 1e-19.
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

/// Stumpff's functions in double-double arithmetic, with `G₀`.
struct PreciseStumpff {
    g0: DoubleDouble,
    g1: DoubleDouble,
    g2: DoubleDouble,
    g3: DoubleDouble,
}

impl PreciseStumpff {
    fn new(beta: DoubleDouble, s: DoubleDouble) -> Self {
        let mut halvings = 0;
        let mut part = 1.0;
        while (beta.high * (part * s.high) * (part * s.high)).abs() > 0.25 && halvings < 1000 {
            halvings += 1;
            part /= 2.0;
        }
        let s = s.scaled(part);
        let z = beta * s * s;
        // The first omitted terms are below 1e-33.
        let (mut c2, mut c3) = (DoubleDouble::ONE, DoubleDouble::ONE);
        for n in (1..13).rev() {
            let n = 2.0 * f64::from(n);
            c2 = DoubleDouble::ONE - z * c2 / ((n + 1.0) * (n + 2.0));
            c3 = DoubleDouble::ONE - z * c3 / ((n + 2.0) * (n + 3.0));
        }
        let (mut g2, mut g3) = (s * s * c2 / 2.0, s * s * s * c3 / 6.0);
        let (mut g0, mut g1) = (DoubleDouble::ONE - beta * g2, s - beta * g3);
        for _ in 0..halvings {
            g3 = (g3 + g1 * g2).scaled(2.0);
            g2 = (g1 * g1).scaled(2.0);
            g1 = (g0 * g1).scaled(2.0);
            g0 = DoubleDouble::ONE - beta * g2;
        }
        Self { g0, g1, g2, g3 }
    }
}

/// The initial state, in units where the distance from the centre is about 1 to 2 and the gravitational parameter is 1
/// to 8.
struct Path {
    mu: DoubleDouble,
    q: [DoubleDouble; 2],
    v: [DoubleDouble; 2],
    /// Distance from the centre.
    r: DoubleDouble,
    /// The product q · v.
    eta: DoubleDouble,
    /// Twice the binding energy per kilogram; positive on an ellipse.
    beta: DoubleDouble,
}

/// A position and a velocity.
type PositionAndVelocity = ([DoubleDouble; 2], [DoubleDouble; 2]);

/// Returns the state `dt` seconds after `from`, about a centre at the origin with acceleration `mu` / r².
///
/// The result is not finite if the path starts at the centre or hits it.
pub(super) fn flow(mu: f64, dt: f64, from: &State<DVec2>) -> State<DVec2> {
    if dt == 0.0 {
        return *from;
    }
    let reach = from.q.x.abs().max(from.q.y.abs());
    if reach == 0.0 || !from.q.is_finite() || !from.v.is_finite() {
        return State { q: DVec2::NAN, v: DVec2::NAN };
    }
    // The units are powers of two, so that scaling is exact. Each factor is applied by itself, so that none overflows.
    let metre = libm::ilogb(reach);
    let second = (3 * metre - libm::ilogb(mu)).div_euclid(2);
    let by = |x: f64, power: i32| DoubleDouble::from(libm::scalbn(x, power));
    let path = Path::new(
        by(mu, 2 * second - 3 * metre),
        from.q.to_array().map(|x| by(x, -metre)),
        from.v.to_array().map(|v| by(v, second - metre)),
    );
    let (q, v) = path.after(by(dt, -second));
    let [x, y] = q.map(|x| libm::scalbn(x.high, metre));
    let [vx, vy] = v.map(|v| libm::scalbn(v.high, metre - second));
    State { q: DVec2::new(x, y), v: DVec2::new(vx, vy) }
}

impl Path {
    fn new(mu: DoubleDouble, q: [DoubleDouble; 2], v: [DoubleDouble; 2]) -> Self {
        let r = dot(q, q).sqrt();
        let beta = mu.scaled(2.0) / r - dot(v, v);
        Self { mu, q, v, r, eta: dot(q, v), beta }
    }

    fn after(&self, dt: DoubleDouble) -> PositionAndVelocity {
        let kinetic = self.r * dot(self.v, self.v);
        if kinetic.high > UNBENT * self.mu.high {
            let [x, y] = [0, 1].map(|i| self.q[i] + self.v[i] * dt);
            return ([x, y], self.v);
        }
        if self.beta.high > 0.0 { self.on_an_ellipse(dt) } else { self.on_an_open_path(dt) }
    }

    /// Computes the state by Lagrange's coefficients from the initial state.
    fn on_an_ellipse(&self, dt: DoubleDouble) -> PositionAndVelocity {
        let Self { mu, q, v, r: r0, eta, beta } = *self;
        let period = TWO_PI * mu / (beta * beta.sqrt());
        let rounds = libm::rint(dt.high / period.high);
        // A motion never completes a period that overflows.
        let dt = if rounds == 0.0 || !period.high.is_finite() { dt } else { dt - period * rounds };
        let slow = mu - beta * r0;
        let kepler = |s: f64| {
            let Stumpff { g1, g2, g3 } = Stumpff::new(beta.high, s);
            let time = r0.high * g1 + eta.high * g2 + mu.high * g3 - dt.high;
            (time, r0.high + eta.high * g1 + slow.high * g2)
        };
        let s = root(kepler, beta.high, dt.high / r0.high, dt.high);
        let s = refined(s, |s| {
            let PreciseStumpff { g1, g2, g3, .. } = PreciseStumpff::new(beta, s);
            (r0 * g1 + eta * g2 + mu * g3 - dt, r0 + eta * g1 + slow * g2)
        });

        let PreciseStumpff { g1, g2, .. } = PreciseStumpff::new(beta, s);
        let r = r0 + eta * g1 + slow * g2;
        let (f, g) = (DoubleDouble::ONE - mu * g2 / r0, r0 * g1 + eta * g2);
        let (f_dot, g_dot) = (-(mu * g1 / (r * r0)), DoubleDouble::ONE - mu * g2 / r);
        ([0, 1].map(|i| f * q[i] + g * v[i]), [0, 1].map(|i| f_dot * q[i] + g_dot * v[i]))
    }

    /// Computes the state from the periapsis, where nothing cancels because all terms of Kepler's equation have the
    /// same sign.
    fn on_an_open_path(&self, dt: DoubleDouble) -> PositionAndVelocity {
        let Self { mu, q, v, eta, beta, .. } = *self;
        let momentum = q[0] * v[1] - q[1] * v[0];
        let size = momentum / mu;
        let e = (DoubleDouble::ONE - beta * (size * size)).sqrt();
        let nearest = momentum * momentum / (mu * (DoubleDouble::ONE + e));
        let pull = mu * e;
        // Computes the state in the frame whose x axis points to the periapsis.
        let place = |s: DoubleDouble| {
            let PreciseStumpff { g0, g1, g2, .. } = PreciseStumpff::new(beta, s);
            let r = nearest + pull * g2;
            ([nearest - mu * g2, momentum * g1], [-(mu * g1 / r), momentum * g0 / r])
        };

        // The initial state is where q · v = pull G₁.
        let w = (-beta.high).sqrt();
        let reach = eta.high / pull.high;
        let begin = if w * reach.abs() > 1e-8 { libm::asinh(w * reach) / w } else { reach };
        let begin = refined(begin, |s| {
            let PreciseStumpff { g0, g1, .. } = PreciseStumpff::new(beta, s);
            (pull * g1 - eta, pull * g0)
        });
        let PreciseStumpff { g1, g3, .. } = PreciseStumpff::new(beta, begin);
        let time = nearest * g1 + mu * g3 + dt;
        let kepler = |s: f64| {
            let Stumpff { g1, g2, g3 } = Stumpff::new(beta.high, s);
            (nearest.high * g1 + mu.high * g3 - time.high, nearest.high + pull.high * g2)
        };
        let guess = time.high / (nearest.high + self.r.high);
        let end = refined(root(kepler, beta.high, guess, time.high), |s| {
            let PreciseStumpff { g1, g2, g3, .. } = PreciseStumpff::new(beta, s);
            (nearest * g1 + mu * g3 - time, nearest + pull * g2)
        });

        // The result is rotated by the angle of the initial state.
        let ([x0, y0], _) = place(begin);
        let size = x0 * x0 + y0 * y0;
        let cos = (q[0] * x0 + q[1] * y0) / size;
        let sin = (q[1] * x0 - q[0] * y0) / size;
        let turned = |[x, y]: [DoubleDouble; 2]| [x * cos - y * sin, x * sin + y * cos];
        let (q, v) = place(end);
        (turned(q), turned(v))
    }
}

fn dot(a: [DoubleDouble; 2], b: [DoubleDouble; 2]) -> DoubleDouble {
    a[0] * b[0] + a[1] * b[1]
}

/// Returns the root near `s` of an increasing function, whose value and slope `f` returns. The search is Newton's
/// method in double-double arithmetic, from a root `s` accurate to `f64`.
fn refined(s: f64, f: impl Fn(DoubleDouble) -> (DoubleDouble, DoubleDouble)) -> DoubleDouble {
    let mut s = DoubleDouble::from(s);
    let mut last = f64::INFINITY;
    for _ in 0..MAX_REFINEMENTS {
        let (value, slope) = f(s);
        // An `f64` step is accurate enough. At the rounding level of `f`, steps grow again.
        let step = (value.high / slope.high).abs();
        if step <= REFINED_TO * s.high.abs() || step >= last || step.is_nan() {
            break;
        }
        s = s - (value.high / slope.high).into();
        last = step;
    }
    s
}

/// Returns the orbital period in seconds, for a binding energy of `beta` / 2 per kilogram; `None` on an open path.
pub(super) fn period(mu: f64, beta: f64) -> Option<f64> {
    let period = TAU * mu / (beta * beta.sqrt());
    (beta > 0.0 && period.is_finite()).then_some(period)
}

/// Returns the `s` at which the time that `late` returns is 0. That time is `-dt` at `s` = 0 and increases with `s`.
/// Its slope, which `late` returns too, is the distance from the centre.
fn root(late: impl Fn(f64) -> (f64, f64), beta: f64, guess: f64, dt: f64) -> f64 {
    // `dt` is too small to be halved.
    if guess == 0.0 {
        return 0.0;
    }
    let sign = dt.signum();
    // An overflow means that `s` is far beyond the root.
    let is_beyond = |time: f64| time.is_nan() || time * sign >= 0.0;
    // On an ellipse, the root is less than one period away. On an open path, `far` is doubled until it is beyond the
    // root.
    let mut far = if beta > 0.0 { sign * TAU / beta.sqrt() } else { guess };
    for _ in 0..MAX_DOUBLINGS {
        if beta > 0.0 || is_beyond(late(far).0) {
            break;
        }
        far *= 2.0;
    }
    let mut near = 0.0;
    let is_between =
        |s: f64, near: f64, far: f64| (s - near) * sign > 0.0 && (far - s) * sign > 0.0;
    let mut s = if is_between(guess, near, far) { guess } else { far / 2.0 };
    let mut last_step = (far - near).abs();
    for _ in 0..MAX_STEPS {
        let (time, distance) = late(s);
        if is_beyond(time) {
            far = s;
        } else {
            near = s;
        }
        // Newton's step is taken if it is at most half of the last step. Otherwise the bracket is bisected, because
        // Newton's method converges slowly far out on a hyperbola.
        let newton = time / distance;
        let is_fast = is_between(s - newton, near, far) && 2.0 * newton.abs() <= last_step;
        let next = if is_fast { s - newton } else { near + (far - near) / 2.0 };
        last_step = (next - s).abs();
        s = next;
        if is_fast && last_step <= NEAR * s.abs() {
            break;
        }
    }
    s
}
