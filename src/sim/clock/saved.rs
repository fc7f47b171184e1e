//! A clock in a saved game.

use super::{Clock, TickRate};

/// A clock as serde writes it. The owed time has a high and a low half, because few formats have numbers of 128 bits.
#[derive(serde::Deserialize, serde::Serialize)]
pub(super) struct SavedClock {
    tick_hz: String,
    speed_percent: u32,
    max_frame_ms: u32,
    owed: [u64; 2],
}

impl From<Clock> for SavedClock {
    fn from(clock: Clock) -> Self {
        let Clock { tick_hz, speed_percent, max_frame_ms, accumulator } = clock;
        let owed = accumulator.owed();
        let owed = [(owed >> 64) as u64, owed as u64];
        Self { tick_hz: tick_hz.to_string(), speed_percent, max_frame_ms, owed }
    }
}

impl TryFrom<SavedClock> for Clock {
    type Error = String;

    fn try_from(saved: SavedClock) -> Result<Self, String> {
        let SavedClock { tick_hz, speed_percent, max_frame_ms, owed: [high, low] } = saved;
        let mut clock = Clock::new(tick_hz.parse::<TickRate>()?);
        clock.set_speed_percent(speed_percent);
        clock.set_max_frame_ms(max_frame_ms);
        clock.accumulator.owed = i128::from(high) << 64 | i128::from(low);
        let is_below_a_tick = (0..clock.tick()).contains(&clock.accumulator.owed);
        is_below_a_tick.then_some(clock).ok_or_else(|| "a clock owes less than a tick".to_owned())
    }
}
