//! Where a condition changes, found by halving an interval.

/// Halves the interval from `low`, which `is_low`, to `high`, which is not, so many times. Returns the ends of what is
/// left, in that order; `low` may be the greater.
pub(crate) fn bisect(
    [mut low, mut high]: [f64; 2],
    halvings: u32,
    mut is_low: impl FnMut(f64) -> bool,
) -> [f64; 2] {
    for _ in 0..halvings {
        let middle = (low + high) / 2.0;
        if is_low(middle) { low = middle } else { high = middle }
    }
    [low, high]
}
