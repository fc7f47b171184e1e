//! The closed form of the damped oscillator `x″ = -ω² x - 2 α x′`, which is a spring or a mode of a chain.

use crate::State;

/// Returns the exact state `dt` seconds after `from`, for `omega2` = ω² > 0 and `alpha` = α ≥ 0. The oscillator may be
/// underdamped, critical or overdamped.
pub(super) fn flow(omega2: f64, alpha: f64, dt: f64, from: &State<f64>) -> State<f64> {
    let State { q: x, v } = *from;
    let w2 = omega2 - alpha * alpha;
    let u = w2 * dt * dt;
    if u <= -NEAR_CRITICAL {
        // The slow and the fast exponential are computed separately. As hyperbolic functions they would overflow, and
        // cancel in the velocity.
        let w = (-w2).sqrt();
        let (slow, fast) = (omega2 / (alpha + w), alpha + w);
        let slow_part = (fast * x + v) * libm::exp(-slow * dt) / (2.0 * w);
        let fast_part = (slow * x + v) * libm::exp(-fast * dt) / (2.0 * w);
        return State { q: slow_part - fast_part, v: fast * fast_part - slow * slow_part };
    }
    // The result is e^(-alpha t) (x C + (v + alpha x) S), with C = cos(w t) and S = sin(w t) / w.
    let (c, s) = if u < NEAR_CRITICAL {
        let (c, s) = near_critical(u);
        (c, s * dt)
    } else {
        let w = w2.sqrt();
        (libm::cos(w * dt), libm::sin(w * dt) / w)
    };
    let decay = libm::exp(-alpha * dt);
    State {
        q: decay * (x * c + (v + alpha * x) * s),
        v: decay * (v * c - (omega2 * x + alpha * v) * s),
    }
}

/// Returns bounds on the rounding errors of the coordinate and of the velocity that [`flow`] returns.
pub(super) fn flow_error(omega2: f64, alpha: f64, dt: f64, from: &State<f64>) -> [f64; 2] {
    let [x, v] = [from.q, from.v].map(f64::abs);
    let dt = dt.abs();
    let w2 = omega2 - alpha * alpha;
    let (w, most) = (w2.abs().sqrt(), omega2 + alpha * alpha);
    if w2 * dt * dt <= -NEAR_CRITICAL {
        let (slow, fast) = (omega2 / (alpha + w), alpha + w);
        // This is the error of w, and so of both rates, from the rounding of w².
        let moved = most / w;
        let part = |rate: f64, moved: f64, size: f64| {
            let rounding = f64::EPSILON * (8.0 + 4.0 * (rate + moved) * dt);
            rounding * size * libm::exp(-rate * dt) / (2.0 * w)
        };
        let worse = 1.0 + moved / w;
        let slow_part = part(slow, slow / fast * moved, fast * x + v);
        let fast_part = part(fast, moved, slow * x + v);
        return [worse * (slow_part + fast_part), worse * (slow * slow_part + fast * fast_part)];
    }
    // This is the error of the phase from the rounding of w².
    let phase = most * dt * dt / (w * dt).max(1.0);
    let rounding = f64::EPSILON * (8.0 + 4.0 * (alpha * dt + phase)) * libm::exp(-alpha * dt);
    let s = if w * dt > 1.0 { 1.0 / w } else { dt };
    [rounding * (x + (v + alpha * x) * s), rounding * (v + (omega2 * x + alpha * v) * s)]
}

/// The `|w t|²` below which the flow is computed as a series. With a much smaller limit, `sin(w t) / w` would lose
/// digits near the limit. With a larger one, the series would need more terms.
const NEAR_CRITICAL: f64 = 1e-3;

/// Computes `cos √u` and `sin √u / √u` by their Taylor series in `u`, which hold for both signs of `u`. For |u| <
/// [`NEAR_CRITICAL`] the first omitted term is below 1e-19.
fn near_critical(u: f64) -> (f64, f64) {
    let c = 1.0 - u / 2.0 * (1.0 - u / 12.0 * (1.0 - u / 30.0 * (1.0 - u / 56.0)));
    let s = 1.0 - u / 6.0 * (1.0 - u / 20.0 * (1.0 - u / 42.0 * (1.0 - u / 72.0)));
    (c, s)
}
