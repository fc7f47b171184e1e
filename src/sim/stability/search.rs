//! A search for the slowest whole tick rate that passes a test.

/// The rates to search, in Hz.
pub const RATES_HZ: std::ops::RangeInclusive<u32> = 1..=10_000;

/// Number of rungs above the first passing one that must pass too. Each is about 1.4 times the one before.
const CONFIRMATIONS: u32 = 2;

/// Searches [`RATES_HZ`], one rate per call, for the slowest that passes a test.
///
/// It climbs a ladder of two rates per octave until one rung and the next two pass, then bisects the gap below. The
/// rate found passes, and the rate one hertz slower fails. Neither stability nor error need be monotone in the rate:
/// the search misses a failing gap between the rungs above.
#[derive(Clone, Debug, PartialEq)]
pub struct RateSearch {
    state: SearchState,
}

#[derive(Clone, Debug, PartialEq)]
enum SearchState {
    /// Trying this rung. `held` is the first of the rungs in a row that passed, with the number of confirmations;
    /// `fails` is the last rate that failed.
    Climbing {
        rung: u32,
        held: Option<(u32, u32)>,
        fails: u32,
    },
    Halving {
        fails: u32,
        holds: u32,
    },
    Found(Option<u32>),
}

impl RateSearch {
    /// A search before its first rate.
    pub fn new() -> Self {
        Self { state: SearchState::Climbing { rung: 0, held: None, fails: 0 } }
    }

    /// The slowest rate that passes, or `Some(None)` if none does; `None` while the search continues.
    pub fn slowest_rate(&self) -> Option<Option<u32>> {
        match self.state {
            SearchState::Found(hz) => Some(hz),
            _ => None,
        }
    }

    /// Tries one rate. Returns whether the search continues.
    pub fn advance(&mut self, holds_at: impl FnOnce(u32) -> bool) -> bool {
        self.state = match self.state {
            SearchState::Climbing { rung, held, fails } => {
                let hz = rate(rung);
                let (held, fails) = match (holds_at(hz), held) {
                    (true, Some((first, times))) => (Some((first, times + 1)), fails),
                    (true, None) => (Some((hz, 0)), fails),
                    (false, _) => (None, hz),
                };
                match held {
                    Some((first, times)) if times == CONFIRMATIONS || hz == *RATES_HZ.end() => {
                        halving(fails, first)
                    }
                    _ if hz == *RATES_HZ.end() => SearchState::Found(None),
                    _ => SearchState::Climbing { rung: rung + 1, held, fails },
                }
            }
            SearchState::Halving { fails, holds } => {
                let middle = fails.midpoint(holds);
                if holds_at(middle) { halving(fails, middle) } else { halving(middle, holds) }
            }
            SearchState::Found(hz) => SearchState::Found(hz),
        };
        self.slowest_rate().is_none()
    }

    /// Runs the whole search.
    pub fn run(mut holds_at: impl FnMut(u32) -> bool) -> Option<u32> {
        let mut search = Self::new();
        while search.advance(&mut holds_at) {}
        search.slowest_rate().flatten()
    }
}

impl Default for RateSearch {
    fn default() -> Self {
        Self::new()
    }
}

fn halving(fails: u32, holds: u32) -> SearchState {
    if holds - fails > 1 {
        SearchState::Halving { fails, holds }
    } else {
        SearchState::Found(Some(holds))
    }
}

/// The rungs: 1, 2, 3, 4, 6, 8, 12 … 8192, and the fastest rate.
fn rate(rung: u32) -> u32 {
    let hz = match rung {
        0 => 1,
        odd if odd % 2 == 1 => 2 << (odd / 2),
        even => 3 << (even / 2 - 1),
    };
    hz.min(*RATES_HZ.end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slowest_rate_is_found_anywhere() {
        for limit in (1..300).chain([4096, 8191, 8192, 8193, 9999, 10_000]) {
            let mut tried = 0;
            let found = RateSearch::run(|hz| {
                tried += 1;
                hz >= limit
            });
            assert_eq!(found, Some(limit));
            assert!(tried < 45, "{tried} rates for {limit}");
        }
        assert_eq!(RateSearch::run(|_| false), None);
    }

    #[test]
    fn an_isolated_passing_rate_is_rejected() {
        assert_eq!(RateSearch::run(|hz| hz == 3 || hz >= 100), Some(100));
    }
}
