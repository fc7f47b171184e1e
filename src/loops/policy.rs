//! The policy of a game loop, which decides on the steps of each frame, and its card.

use super::time_base::TimeBase;
use crate::run::race::Interpolation;
use crate::sim::law::LoopText;

/// The steps of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// Number of steps, all of the same length.
    pub count: u32,
    /// Simulated time of all steps together.
    pub span: i128,
    /// Real time that is dropped: it will never be simulated.
    pub dropped: i128,
    /// Number of ticks that the engine reports, if it makes another number.
    pub returned: Option<u32>,
}

impl Steps {
    /// Returns one step of this length, or none if the length is 0.
    pub fn one(span: i128) -> Self {
        Self { count: u32::from(span > 0), span, ..Self::default() }
    }
}

/// The fate of ticks beyond the maximum of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Excess {
    /// Their time is never simulated.
    #[default]
    Drop,
    /// Later frames make them.
    Keep,
}

/// The duration that a long frame counts with. Times are in nanoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LongFrame {
    /// Every frame counts with at most this duration.
    Clamp(i64),
    /// A frame longer than `over` counts as `by`.
    Replace {
        /// Longest frame that counts in full.
        over: i64,
        /// Duration that a longer frame counts with.
        by: i64,
    },
    /// A frame longer than this counts as the last one that was not.
    Last(i64),
}

/// Limits on the work in a frame. With `None` the policy's own limit applies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameLimits {
    /// Maximum number of ticks or steps, for a policy that [limits them](PolicyCard::has_max_ticks).
    pub max_ticks: Option<u32>,
    /// Maximum frame duration in milliseconds; the excess is dropped.
    pub max_frame_ms: Option<u32>,
    /// The fate of ticks beyond the maximum.
    pub excess: Excess,
    /// The treatment of long frames, before any other limit.
    pub long_frame: Option<LongFrame>,
    /// Cost of a tick in milliseconds, for loops that count it.
    pub cost_ms: Option<u32>,
}

/// A game loop's decisions and memory. Times are in the unit of a [`TimeBase`].
pub trait Policy: Send {
    /// Decides on the steps of a frame. `duration` is the duration of the last frame as a game would measure it, and
    /// never negative.
    fn frame(&mut self, duration: i128) -> Steps;

    /// Decides on the steps of a frame like [`frame`](Self::frame), with its duration in milliseconds as a game reads
    /// it.
    fn frame_in_ms(&mut self, duration: i128, _ms: f64) -> Steps {
        self.frame(duration)
    }

    /// Returns the length of a tick, if the policy has its own.
    fn tick(&self) -> Option<i128> {
        None
    }

    /// Returns the time since the last tick, for drawing between ticks; 0 for a policy without ticks.
    fn owed(&self) -> i128 {
        0
    }

    /// Returns a copy of the policy with its memory.
    fn boxed_clone(&self) -> Box<dyn Policy>;
}

impl Clone for Box<dyn Policy> {
    fn clone(&self) -> Self {
        self.boxed_clone()
    }
}

/// The source code of a loop in one language, to copy into a game.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Snippet {
    /// The language: `rust`, `c++` or `c#`.
    pub language: &'static str,
    /// The source code.
    pub source: &'static str,
}

/// Description of a policy.
///
/// In formulas H is the tick, dt the duration of the last frame, R the refresh of the display, and α the fraction of
/// a tick that is owed.
#[derive(Debug)]
pub struct PolicyCard {
    /// Name of the policy on the command line, `kebab-case`.
    pub id: &'static str,
    /// Name of the policy for people.
    pub name: &'static str,
    /// Rule of the policy in one line.
    pub formula: &'static str,
    /// Constants of the policy; empty if there are none.
    pub constants: &'static str,
    /// Response of the policy to a frame of no or negative time, and to one of ten seconds.
    pub odd_frames: &'static str,
    /// Engines and games that use the policy.
    pub users: &'static str,
    /// Source that describes the policy.
    pub source: &'static str,
    /// Interpolation of the picture between ticks.
    pub drawing: Interpolation,
    /// Whether the picture shows a copy of the bodies that is stepped to the moment to show and then discarded.
    pub has_render_tick: bool,
    /// Whether every step is a whole tick, so that the physics is the same to the bit at any frame rate.
    pub has_fixed_tick: bool,
    /// Whether the picture flutters between no tick and two if the clock rounds, at the tick rate of the display.
    pub needs_exact_clock: bool,
    /// Whether the policy limits the ticks in a frame, so that a person can set the limit.
    pub has_max_ticks: bool,
    /// Whether `regatta loop` compares the policy by default.
    pub is_usual: bool,
    /// Source code to copy into a game.
    pub snippets: &'static [Snippet],
    /// The engine whose loop this is, or lines of a person's own.
    pub engine: Option<Engine>,
    pub(super) build: Build,
}

/// An engine or library, as far as its loop is concerned.
#[derive(Clone, Copy, Debug)]
pub struct Engine {
    /// Version of the engine.
    pub version: &'static str,
    /// A sentence on what to beware of.
    pub caveat: &'static str,
    /// What to set.
    pub advice: &'static str,
    /// The lines of the loop.
    pub text: &'static str,
}

/// How a policy is made.
#[derive(Clone, Copy, Debug)]
pub(super) enum Build {
    Rust(fn(TimeBase, FrameLimits) -> Box<dyn Policy>),
    Lines(&'static LoopText),
    /// The moments of a log, in milliseconds.
    Replay(&'static [f64]),
}

impl PolicyCard {
    /// Whether the loop replays a log.
    pub fn is_log(&self) -> bool {
        matches!(self.build, Build::Replay(_))
    }

    /// Whether the loop is lines, which may be given times below 0.
    pub fn is_lines(&self) -> bool {
        matches!(self.build, Build::Lines(_))
    }

    /// Returns the name of the interpolation between ticks, for people.
    pub fn drawing_name(&self) -> &'static str {
        if self.has_render_tick { "a copy stepped on" } else { self.drawing.name() }
    }

    /// Whether the picture can lie beyond the last tick. The bodies are then drawn as if nothing acted on them in the
    /// meantime.
    pub fn draws_ahead(&self) -> bool {
        self.has_render_tick || self.drawing == Interpolation::Extrapolated
    }
}

impl PartialEq for PolicyCard {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}
