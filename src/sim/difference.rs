//! Difference quotients. The caller chooses the step, and argues it.

/// Overwrites the values `ahead` with their differences from those `behind`, per unit of the `distance` between the two.
#[inline]
pub(super) fn quotient(ahead: &mut [f64], behind: &[f64], distance: f64) {
    for (ahead, behind) in ahead.iter_mut().zip(behind) {
        *ahead = (*ahead - behind) / distance;
    }
}

/// Where [`fourth_order`] takes values, in steps.
#[cfg(feature = "lab")]
pub(super) const OFFSETS: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];

/// The derivative by a central difference of fourth order, from the values at [`OFFSETS`] of a step `h`.
#[cfg(feature = "lab")]
pub(super) fn fourth_order([far_behind, behind, ahead, far_ahead]: [f64; 4], h: f64) -> f64 {
    (8.0 * (ahead - behind) - far_ahead + far_behind) / (12.0 * h)
}
