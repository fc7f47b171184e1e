//! The slowest whole tick rate at which something holds.

/// The rates that are searched, in Hz.
pub const RATES_HZ: std::ops::RangeInclusive<u32> = 1..=10_000;

/// Rates that have to hold above the slowest one found, each about 1.4 times the one before.
const CONFIRMATIONS: u32 = 2;

/// Searches [`RATES_HZ`], a rate at a time, for the slowest at which something holds.
///
/// It climbs a ladder of two rates an octave from the bottom until one holds and the next two do, then
/// halves the gap below. What it finds holds, and fails one hertz slower; neither stability nor error
/// need be monotone in the rate, and a gap between the rungs above it that failed would not be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct RateSearch {
    state: State,
}

#[derive(Clone, Debug, PartialEq)]
enum State {
    /// Trying this rung; `held` is the first of those that held in a row, `fails` the last that did not.
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
    /// A search that has tried nothing.
    pub fn new() -> Self {
        Self { state: State::Climbing { rung: 0, held: None, fails: 0 } }
    }

    /// The slowest rate that holds, or that none does; `None` while it is not known yet.
    pub fn found(&self) -> Option<Option<u32>> {
        match self.state {
            State::Found(hz) => Some(hz),
            _ => None,
        }
    }

    /// Tries one rate. Returns whether the search goes on.
    pub fn advance(&mut self, holds_at: impl FnOnce(u32) -> bool) -> bool {
        self.state = match self.state {
            State::Climbing { rung, held, fails } => {
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
                    _ if hz == *RATES_HZ.end() => State::Found(None),
                    _ => State::Climbing { rung: rung + 1, held, fails },
                }
            }
            State::Halving { fails, holds } => {
                let middle = fails.midpoint(holds);
                if holds_at(middle) { halving(fails, middle) } else { halving(middle, holds) }
            }
            State::Found(hz) => State::Found(hz),
        };
        self.found().is_none()
    }

    /// The whole search at once.
    pub fn run(mut holds_at: impl FnMut(u32) -> bool) -> Option<u32> {
        let mut search = Self::new();
        while search.advance(&mut holds_at) {}
        search.found().flatten()
    }
}

impl Default for RateSearch {
    fn default() -> Self {
        Self::new()
    }
}

fn halving(fails: u32, holds: u32) -> State {
    if holds - fails > 1 { State::Halving { fails, holds } } else { State::Found(Some(holds)) }
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
    fn the_slowest_rate_is_found_wherever_it_lies() {
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
    fn a_lucky_rate_alone_is_not_believed() {
        assert_eq!(RateSearch::run(|hz| hz == 3 || hz >= 100), Some(100));
    }
}
