//! Searches for the limit of a property: in strides until it fails, then by bisection.

/// The number of substeps tried at this place of the sequence 1, 2, 3, 4, 6, 8, 12 … 64.
pub(super) fn tried_substeps(place: u32) -> u32 {
    match place {
        0 => 1,
        odd if odd % 2 == 1 => 2 << (odd / 2),
        even => 3 << (even / 2 - 1),
    }
}

/// The lowest rate in Hz, going down from `hz`, at which `holds` is still true; it is true at `hz`. Each stride is the
/// rate divided by `strides`; after the first failure the gap is bisected.
pub(super) fn slowest_down(hz: u32, strides: u32, mut holds: impl FnMut(u32) -> bool) -> u32 {
    let (mut held, mut failed) = (hz, 0);
    while held > 1 {
        let next = held - (held / strides).max(1);
        if !holds(next) {
            failed = next;
            break;
        }
        held = next;
    }
    while held - failed > 1 {
        let middle = failed.midpoint(held);
        if holds(middle) { held = middle } else { failed = middle }
    }
    held
}

/// The furthest of the places 1 to `last` at which `holds` is still true; it is true at 0. Strides double, so that little
/// is tried far beyond the limit, and then the gap is bisected.
pub(super) fn furthest(last: usize, mut holds: impl FnMut(usize) -> bool) -> usize {
    let (mut held, mut failed) = (0, last + 1);
    let mut stride = 1;
    while failed - held > 1 {
        let is_climbing = failed == last + 1;
        let place = if is_climbing { (held + stride).min(last) } else { held.midpoint(failed) };
        if holds(place) {
            held = place
        } else {
            failed = place
        }
        stride *= 2;
    }
    held
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_numbers_of_substeps_are_tried_per_octave_up_to_the_most_that_are_advised() {
        let tried: Vec<u32> = (0..).map(tried_substeps).take_while(|&n| n <= 64).collect();
        assert_eq!(tried, [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64]);
    }

    #[test]
    fn the_slowest_rate_is_found_down_from_any_rate() {
        for strides in [6, 60] {
            for from in [1, 2, 3, 60, 61, 1000] {
                for limit in 1..=from {
                    let mut tried = 0;
                    let found = slowest_down(from, strides, |hz| {
                        tried += 1;
                        assert!((1..from).contains(&hz), "{hz} Hz, down from {from}");
                        hz >= limit
                    });
                    assert_eq!(found, limit, "down from {from} Hz");
                    assert!(tried < 8 * strides, "{tried} rates");
                }
            }
        }
        // A gap of 3 Hz is seen where the strides are as short.
        assert_eq!(slowest_down(60, 60, |hz| !(40..43).contains(&hz)), 43);
        assert_eq!(slowest_down(150, 60, |hz| !(110..113).contains(&hz)), 113);
    }

    #[test]
    fn the_furthest_place_is_found_without_going_far_beyond() {
        let last = 96;
        for limit in 0..=last {
            let mut tried = Vec::new();
            let found = furthest(last, |place| {
                tried.push(place);
                place <= limit
            });
            assert_eq!(found, limit);
            assert!(tried.len() < 16, "{tried:?}");
            assert!(tried.iter().all(|&place| (1..=last).contains(&place)), "{tried:?}");
            assert!(tried.iter().all(|&place| place <= 2 * limit + 1), "{limit}: {tried:?}");
        }
    }
}
