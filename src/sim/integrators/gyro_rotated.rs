//! Turns the momentum by the part of the angular velocity that moves it, so that its length and almost the energy stay.

use super::prelude::*;

pub(super) const CARD: Method = Method {
    id: "gyro-rotated",
    name: "Rotated momentum",
    about: "explicit, keeps L in space, and almost the energy; exact for a symmetric top",
    order: 1,
    order_with_drag: 1,
    evaluation_cost: 2,
    source: "J. Jakubowski, avian#993, position form (2026)",
    formula: &[
        "k = ω × L, j = k · I⁻¹k / |k|², Ω = ω − j L",
        "L′ = exp(−h Ω) L, ω′ = I⁻¹L′",
        "turn by h Ω, then by h j L′",
    ],
    ..GYRO
};

/// Rotated momentum, by the [formula](Method::formula) on its card.
#[derive(Clone)]
pub struct GyroRotated;

impl GyroRule for GyroRotated {
    fn step(h: f64, moments: DVec3, omega: DVec3) -> Turned {
        let (around, along, momentum) = circling(h, moments, omega);
        Ok((momentum / moments, turn_by(h * around) * turn_by(h * along * momentum)))
    }
}

/// Returns Ω and j of the formula, and L at the end of a step of `h` (s).
pub(super) fn circling(h: f64, moments: DVec3, omega: DVec3) -> (DVec3, f64, DVec3) {
    let momentum = moments * omega;
    let k = omega.cross(momentum);
    let (square, least) = (k.length_squared(), omega.length_squared() * momentum.length_squared());
    // A spin about an axis has a k of rounding only. The guard is relative: a coin's k is small in any unit.
    let is_still = square <= f64::EPSILON * f64::EPSILON * least;
    let along = if is_still { 0.0 } else { k.dot(k / moments) / square };
    let around = omega - along * momentum;
    (around, along, seen_from(turn_by(h * around), momentum))
}
