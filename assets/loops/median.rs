//! One step a frame, of the duration that frames typically have; what it is off is made up for bit by bit.
//!
//! `world.step(game_loop.frame(duration_ns)); world.draw();`

/// A step comes nearer to the mean by this part each frame.
const EASING: i64 = 4;
/// A frame pays back this part of the debt.
const PAYING_BACK: i64 = 16;

/// The loop.
pub struct GameLoop {
    last_ns: [i64; 11],
    eased_ns: i64,
    /// The time that has not been simulated yet; negative where more has been.
    debt_ns: i64,
}

impl GameLoop {
    /// The loop before its first frame, which is expected to be as long as a refresh of the display.
    pub fn new(refresh_ns: i64) -> Self {
        Self { last_ns: [refresh_ns; 11], eased_ns: refresh_ns, debt_ns: 0 }
    }

    /// The length in seconds of the step to make; `duration_ns` is the duration of the last frame. A step of 0 need
    /// not be made.
    pub fn frame(&mut self, duration_ns: i64) -> f64 {
        // A clock that went back counts as no time.
        let duration_ns = duration_ns.max(0);
        self.last_ns.rotate_left(1);
        self.last_ns[10] = duration_ns;
        let mut sorted = self.last_ns;
        sorted.sort_unstable();
        // Without the two shortest and the two longest.
        let mean_ns = sorted[2..9].iter().sum::<i64>() / 7;
        self.eased_ns += (mean_ns - self.eased_ns) / EASING;
        let step_ns = (self.eased_ns + self.debt_ns / PAYING_BACK).max(0);
        self.debt_ns += duration_ns - step_ns;
        step_ns as f64 / 1e9
    }
}
