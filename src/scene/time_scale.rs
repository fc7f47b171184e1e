//! Converts between ticks and seconds in runs whose tick rate changes.
//!
//! Scripts are in seconds and runs in ticks. An action comes at the nearest tick, so that another rate moves it by half
//! a tick at most.

use super::action::Action;
use crate::sim::TickRate;

/// Tolerance in ticks for a time half-way between two ticks. Such a time goes to the later tick, although it may be off
/// by its last bit.
const TIE: f64 = 1e-6;

/// Converts between the ticks and the times of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeScale {
    /// The pieces in order. There is at least one.
    pieces: Vec<Piece>,
}

/// Consecutive ticks of one rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    pub(crate) tick: u64,
    pub(crate) t: f64,
    /// The rate.
    pub tick_hz: TickRate,
}

impl Piece {
    /// Creates the piece of the ticks from 0 on, at this rate.
    pub fn first(tick_hz: impl Into<TickRate>) -> Self {
        Self { tick: 0, t: 0.0, tick_hz: tick_hz.into() }
    }

    /// Creates the piece of the ticks from `tick` on, at another rate.
    pub fn then(self, tick: u64, tick_hz: TickRate) -> Self {
        Self { tick, t: self.t(tick), tick_hz }
    }

    /// Returns the time of a tick, in seconds.
    pub fn t(self, tick: u64) -> f64 {
        self.t + self.tick_hz.seconds(tick - self.tick)
    }

    /// Returns the fractional tick at a time in seconds; the first tick for all earlier times.
    fn tick_at(self, t: f64) -> f64 {
        self.tick as f64 + ((t - self.t) * f64::from(self.tick_hz)).max(0.0)
    }

    /// Returns the tick nearest to a time in seconds; the first tick for all earlier times.
    pub fn nearest_tick(self, t: f64) -> u64 {
        self.tick + nearest_tick(t - self.t, self.tick_hz)
    }

    /// Returns for each action of a script in seconds, in order, the tick before which it comes and the tick's time. It
    /// is the nearest tick at the rate in force, which the actions themselves may change.
    pub fn put_on_ticks<'a>(
        mut self,
        script: impl IntoIterator<Item = (f64, &'a Action)>,
    ) -> impl Iterator<Item = (u64, f64)> {
        script.into_iter().map(move |(at_s, action)| {
            let tick = self.nearest_tick(at_s);
            let t = self.t(tick);
            if let Some(tick_hz) = action.tick_hz() {
                self = self.then(tick, tick_hz);
            }
            (tick, t)
        })
    }
}

/// Returns the tick nearest to `seconds` after the first one; the first tick for all earlier times.
pub fn nearest_tick(seconds: f64, tick_hz: TickRate) -> u64 {
    (seconds * tick_hz.hz() + TIE).max(0.0).round() as u64
}

impl TimeScale {
    /// Creates the scale from `tick` on, which comes at `t` seconds. The rate is `tick_hz` at first. From each tick of
    /// `changes` on, in order, it is the rate paired with that tick.
    pub fn new(
        (tick, t): (u64, f64),
        tick_hz: TickRate,
        changes: impl IntoIterator<Item = (u64, TickRate)>,
    ) -> Self {
        let mut last = Piece { tick, t, tick_hz };
        let mut pieces = vec![last];
        for (tick, tick_hz) in changes {
            last = last.then(tick, tick_hz);
            pieces.push(last);
        }
        Self { pieces }
    }

    /// Returns the time of a tick, in seconds.
    pub fn t(&self, tick: u64) -> f64 {
        let next = self.pieces.partition_point(|piece| piece.tick <= tick);
        self.pieces[next - 1].t(tick)
    }

    /// Returns the first tick from which the two scales have different rates, and both rates.
    pub fn first_other_rate(&self, other: &Self) -> Option<(u64, [TickRate; 2])> {
        let pieces = self.pieces.iter().chain(&other.pieces);
        let rates = |tick: u64| [self, other].map(|scale| scale.rate_at(tick));
        let differ = pieces.map(|piece| (piece.tick, rates(piece.tick)));
        differ.filter(|(_, [own, other])| own != other).min_by_key(|(tick, _)| *tick)
    }

    fn rate_at(&self, tick: u64) -> TickRate {
        let next = self.pieces.partition_point(|piece| piece.tick <= tick).max(1);
        self.pieces[next - 1].tick_hz
    }

    /// Returns a tick and its time, for people: `tick 30 (0.500 s)`.
    pub fn moment(&self, tick: u64) -> String {
        format!("tick {tick} ({:.3} s)", self.t(tick))
    }

    /// Returns the fractional tick at a time in seconds; the first tick for all earlier times.
    pub fn tick_at(&self, t: f64) -> f64 {
        self.piece_at(t).tick_at(t)
    }

    /// Returns the tick nearest to a time in seconds; the first tick for all earlier times.
    pub fn nearest_tick(&self, t: f64) -> u64 {
        self.piece_at(t).nearest_tick(t)
    }

    fn piece_at(&self, t: f64) -> Piece {
        let next = self.pieces.partition_point(|piece| piece.t <= t).max(1);
        self.pieces[next - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    #[test]
    fn a_new_rate_continues_from_its_own_time() {
        let scale = TimeScale::new(
            (0, 0.0),
            60.into(),
            [(60, 10), (70, 100), (70, 1000)].map(|(tick, hz)| (tick, TickRate::whole(hz))),
        );
        for (tick, t) in [(0, 0.0), (30, 0.5), (60, 1.0), (65, 1.5), (70, 2.0), (570, 2.5)] {
            assert!((scale.t(tick) - t).abs() < 1e-12, "tick {tick}: {}", scale.t(tick));
            assert_eq!(scale.nearest_tick(t), tick);
        }
        assert_eq!(scale.nearest_tick(-3.0), 0);
        assert_eq!(scale.nearest_tick(0.991), 59);
        assert_eq!(scale.nearest_tick(1.06), 61);
    }

    /// Returns a scene at 1 Hz, at 100 Hz from tick 5 on, and at 2 Hz from tick 45 on.
    fn scene() -> Scene {
        let text = "title = 'x'\ntick_hz = 1\nseconds = 9\n[[spring]]\nmass_kg = 1\n\
                    stiffness_n_per_m = 1\n[[command]]\nat_s = 5\ntick_hz = 100\n\
                    [[command]]\nat_s = 5.4\ntick_hz = 2\n[[command]]\nat_s = 5.9\nkick = 1\n";
        Scene::parse("x.toml", text).unwrap()
    }

    #[test]
    fn a_script_acts_at_its_times_under_the_rates_it_sets() {
        let scene = scene();
        let script = || scene.script.iter().map(|row| (row.at_s, &row.action));
        let put = |tick_hz: u32| Piece::first(tick_hz).put_on_ticks(script()).collect::<Vec<_>>();
        assert_eq!(put(1), [(5, 5.0), (45, 5.4), (46, 5.9)]);
        // If another rate is set before the script sets its own, the actions do not move in time.
        assert_eq!(put(3), [(15, 5.0), (55, 5.4), (56, 5.9)]);
    }
}
