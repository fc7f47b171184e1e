//! Time in, whole ticks out, exactly: the heart of every loop with a fixed timestep.

/// The longest real time for which one frame catches up, in milliseconds: 15 ticks at 60 Hz. With a longer one a slow
/// machine falls further behind each frame; with a shorter one a hitch shows as slow motion.
pub const MAX_FRAME_MS: u32 = 250;

/// The ticks that a frame has to simulate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Due {
    /// Ticks to step now.
    pub ticks: u32,
    /// Ticks dropped because the frame was longer than the cap: the simulation falls behind real time.
    pub dropped: u64,
}

/// Time that has passed and is less than a tick.
///
/// It is an integer in a unit that the caller chooses so that a tick is a whole number of them: nothing is ever rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Accumulator {
    owed: i128,
}

impl Accumulator {
    /// The time that has passed since the last tick was due.
    pub fn owed(&self) -> i128 {
        self.owed
    }

    /// Adds `time`, which is not negative, and takes out the ticks of length `tick` that are due. Those beyond `most` are
    /// dropped.
    pub fn advance(&mut self, time: i128, tick: i128, most: u32) -> Due {
        self.owed += time;
        let whole = u64::try_from(self.owed / tick).expect("a frame is at most 2^63 ns");
        self.owed %= tick;
        let ticks = u64::from(most).min(whole);
        Due { ticks: ticks as u32, dropped: whole - ticks }
    }

    /// Sets the owed time to one unit below a tick of length `tick`.
    pub fn fill(&mut self, tick: i128) {
        self.owed = tick - 1;
    }

    /// Forgets the time owed.
    pub fn clear(&mut self) {
        self.owed = 0;
    }
}

/// The most ticks in a frame: those of `longest_ms`, and at least one. `tick_hz_percent` is the tick rate in Hz times the
/// speed in percent.
pub(crate) fn max_ticks(tick_hz_percent: u64, longest_ms: u32) -> u32 {
    let most = (tick_hz_percent * u64::from(longest_ms)).div_ceil(100 * 1000);
    u32::try_from(most.max(1)).expect("at most 10 000 Hz at a hundredfold speed")
}
