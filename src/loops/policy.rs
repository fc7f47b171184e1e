//! The card of a game loop's policy, and the steps on which it decides.

use std::sync::Arc;

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

/// Description of a policy.
///
/// In formulas H is the tick, dt the duration of the last frame, R the refresh of the display, and α the fraction of
/// a tick that is owed.
#[derive(Clone, Debug)]
pub struct PolicyCard {
    /// Name of the policy on the command line, `kebab-case`.
    pub id: String,
    /// Name of the policy for people.
    pub name: String,
    /// Rule of the policy in one line.
    pub formula: String,
    /// Constants of the policy; empty if there are none.
    pub constants: String,
    /// Response of the policy to a frame of no or negative time, and to one of ten seconds.
    pub odd_frames: String,
    /// Engines and games that use the policy.
    pub users: String,
    /// Source that describes the policy.
    pub source: String,
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
    /// The engine whose loop this is, or lines of a person's own.
    pub engine: Option<Engine>,
    pub(super) build: Build,
}

/// An engine or library, as far as its loop is concerned.
#[derive(Clone, Debug)]
pub struct Engine {
    /// Version of the engine.
    pub version: String,
    /// A sentence on what to beware of.
    pub caveat: String,
    /// What to set.
    pub advice: String,
}

/// The name of a picture of a copy, for people.
pub(super) const RENDER_TICK: &str = "a copy stepped on";

/// How a policy is made.
#[derive(Clone, Debug)]
pub(super) enum Build {
    Lines(Arc<LoopText>),
    /// The moments of a log, in milliseconds.
    Replay(Arc<[f64]>),
}

impl PolicyCard {
    /// Whether the loop replays a log.
    pub fn is_log(&self) -> bool {
        matches!(self.build, Build::Replay(_))
    }

    /// Returns the lines of the loop; `None` for a log.
    pub fn lines(&self) -> Option<&str> {
        match &self.build {
            Build::Lines(lines) => Some(lines.source()),
            Build::Replay(_) => None,
        }
    }

    /// Whether the loop is that of an engine or of a person, which may be given times below 0.
    pub fn is_from_outside(&self) -> bool {
        self.engine.is_some()
    }

    /// Returns the name of the interpolation between ticks, for people.
    pub fn drawing_name(&self) -> &'static str {
        if self.has_render_tick { RENDER_TICK } else { self.drawing.name() }
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
