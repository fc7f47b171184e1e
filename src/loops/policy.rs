//! The policy of a game loop: its decision for each frame, and its card.

use super::time_base::TimeBase;
use crate::run::race::Interpolation;

/// The steps of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// Number of steps, all of the same length.
    pub count: u32,
    /// Simulated time of all steps together.
    pub span: i128,
    /// Real time that is dropped: it will never be simulated.
    pub dropped: i128,
}

impl Steps {
    /// One step of this length, or none if it is 0.
    pub fn one(span: i128) -> Self {
        Self { count: u32::from(span > 0), span, dropped: 0 }
    }
}

/// Limits on the work in a frame. `None` keeps the policy's own limit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameLimits {
    /// Maximum number of ticks, or of steps, for a policy that [limits them](PolicyCard::has_max_ticks).
    pub max_ticks: Option<u32>,
    /// Maximum frame duration in milliseconds; the excess is dropped.
    pub max_frame_ms: Option<u32>,
}

/// The decisions of a game loop, with its memory. Times are in the unit of a [`TimeBase`].
pub trait Policy: Send {
    /// Decides on the steps of a frame. `duration` is the duration of the last frame, never negative, as a game would
    /// measure it.
    fn frame(&mut self, duration: i128) -> Steps;

    /// Time since the last tick, for drawing between ticks; 0 for a policy without ticks.
    fn owed(&self) -> i128 {
        0
    }

    /// A copy with its memory.
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
    /// Its name on the command line, `kebab-case`.
    pub id: &'static str,
    /// Its name for people.
    pub name: &'static str,
    /// Its rule in one line.
    pub formula: &'static str,
    /// Its constants; empty if it has none.
    pub constants: &'static str,
    /// Its response to a frame of no or negative time, and to one of ten seconds.
    pub odd_frames: &'static str,
    /// Engines and games that use it.
    pub users: &'static str,
    /// Source that describes it.
    pub source: &'static str,
    /// Interpolation of the picture between ticks.
    pub drawing: Interpolation,
    /// Whether the picture shows a copy that is stepped to the moment to show, then discarded.
    pub has_render_tick: bool,
    /// Whether every step is a whole tick, so that the physics is the same to the bit at any frame rate.
    pub has_fixed_tick: bool,
    /// Whether it limits the ticks in a frame, so that the limit can be set.
    pub has_max_ticks: bool,
    /// Whether `regatta loop` compares it by default.
    pub is_usual: bool,
    /// Source code to copy into a game.
    pub snippets: &'static [Snippet],
    pub(super) build: fn(TimeBase, FrameLimits) -> Box<dyn Policy>,
}

impl PolicyCard {
    /// Name of the interpolation between ticks, for people.
    pub fn drawing_name(&self) -> &'static str {
        if self.has_render_tick { "a copy stepped on" } else { self.drawing.name() }
    }

    /// Whether the picture can lie beyond the last tick. It is then drawn as if nothing acted on the bodies in the
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
