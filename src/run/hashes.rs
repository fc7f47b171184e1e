//! The hashes of a run, noted once a second as its ticks are first made.

use super::race::Race;
use crate::scene::LaneId;

/// The most hashes that are noted: more than a recording keeps as checks.
const MAX_NOTED: usize = 32_000;

/// The tolerance in seconds for the end of a second: times may be off by their last bits.
const ON_TIME_S: f64 = 1e-6;

/// The hash of each lane of a run at a tick.
#[derive(Clone)]
pub(super) struct Hashes {
    pub(super) tick: u64,
    /// The second that has begun last.
    second: f64,
    pub(super) of_lanes: Vec<(LaneId, u64)>,
}

impl Hashes {
    pub(super) fn of(race: &Race) -> Self {
        let ids = race.entrants().iter().map(|entrant| entrant.id);
        let second = libm::floor(race.t() + ON_TIME_S);
        Self { tick: race.tick(), second, of_lanes: ids.zip(race.lane_hashes()).collect() }
    }
}

/// Notes the hashes of a race at a tick that it has just made first, once a second; of a long run, at fewer.
pub(super) fn note_hashes(hashes: &mut Vec<Hashes>, race: &Race) {
    let last = hashes.last().map_or(0.0, |last| last.second);
    if race.t() + ON_TIME_S < last + 1.0 {
        return;
    }
    hashes.push(Hashes::of(race));
    if hashes.len() * race.entrants().len() > MAX_NOTED {
        let mut is_odd = false;
        hashes.retain(|_| {
            is_odd = !is_odd;
            !is_odd
        });
    }
}
