//! The times of the ticks of a run whose tick rate may change.

use crate::lab::action::Action;
use crate::lab::journal::JournalRow;

/// Converts between the ticks and the times of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeScale {
    /// In order; the first begins at tick 0.
    pieces: Vec<Piece>,
}

/// Consecutive ticks of one rate.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    tick: u64,
    t: f64,
    tick_hz: u32,
}

impl Piece {
    fn t(self, tick: u64) -> f64 {
        self.t + (tick - self.tick) as f64 / f64::from(self.tick_hz)
    }
}

impl TimeScale {
    /// The time scale of a run that starts at this tick rate and has this journal.
    pub(super) fn new(tick_hz: u32, journal: &[JournalRow]) -> Self {
        let mut pieces = vec![Piece { tick: 0, t: 0.0, tick_hz }];
        for row in journal {
            if let (Action::TickHz(tick_hz), Some(last)) = (&row.action, pieces.last()) {
                pieces.push(Piece { tick: row.tick, t: last.t(row.tick), tick_hz: *tick_hz });
            }
        }
        Self { pieces }
    }

    /// The time of a tick, in seconds.
    pub fn t(&self, tick: u64) -> f64 {
        let next = self.pieces.partition_point(|piece| piece.tick <= tick);
        self.pieces[next - 1].t(tick)
    }

    /// The tick nearest to a time in seconds; the first for all times before the start.
    pub fn nearest_tick(&self, t: f64) -> u64 {
        let next = self.pieces.partition_point(|piece| piece.t <= t).max(1);
        let piece = self.pieces[next - 1];
        let ticks = ((t - piece.t) * f64::from(piece.tick_hz)).round().max(0.0);
        let tick = piece.tick + ticks as u64;
        self.pieces.get(next).map_or(tick, |after| tick.min(after.tick))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Source;

    fn scale(changes: &[(u64, u32)]) -> TimeScale {
        let row = |&(tick, tick_hz): &(u64, u32)| JournalRow {
            tick,
            action: Action::TickHz(tick_hz),
            source: Source::Script,
        };
        TimeScale::new(60, &changes.iter().map(row).collect::<Vec<_>>())
    }

    #[test]
    fn time_goes_on_at_each_rate_from_where_the_rate_was_set() {
        let scale = scale(&[(60, 10), (70, 100), (70, 1000)]);
        for (tick, t) in [(0, 0.0), (30, 0.5), (60, 1.0), (65, 1.5), (70, 2.0), (570, 2.5)] {
            assert!((scale.t(tick) - t).abs() < 1e-12, "tick {tick}: {}", scale.t(tick));
            assert_eq!(scale.nearest_tick(t), tick);
        }
        assert_eq!(scale.nearest_tick(-3.0), 0);
        assert_eq!(scale.nearest_tick(0.991), 59);
        assert_eq!(scale.nearest_tick(1.06), 61);
    }
}
