//! What a game loop decides each frame, and what is known of the rule by which it does.

use super::time_base::TimeBase;
use crate::run::race::Interpolation;

/// The steps of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// How many, all of the same length.
    pub count: u32,
    /// The simulated time of all of them together.
    pub span: i128,
    /// The real time that is given up: it will never be simulated.
    pub dropped: i128,
}

impl Steps {
    /// One step of this length, or none if it is 0.
    pub fn one(span: i128) -> Self {
        Self { count: u32::from(span > 0), span, dropped: 0 }
    }
}

/// The most that a loop simulates in a frame, where that is set and not the rule's own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameLimits {
    /// Ticks, or steps of a rule that [has a most](PolicyCard::has_max_ticks).
    pub max_ticks: Option<u32>,
    /// The longest frame in milliseconds; what a frame is longer is given up.
    pub max_frame_ms: Option<u32>,
}

/// The rule of a game loop, with its memory. Times are in the unit of a [`TimeBase`].
pub trait Policy: Send {
    /// Decides what a frame simulates. It sees what a game sees: the duration of the last frame, never negative.
    fn frame(&mut self, duration: i128) -> Steps;

    /// The time since the last tick, by which a picture is drawn between ticks; 0 under a rule that has no ticks.
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

/// A loop written out in a language, to be taken into a game.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Snippet {
    /// The language: `rust`, `c++` or `c#`.
    pub language: &'static str,
    /// The source.
    pub source: &'static str,
}

/// What is known of a rule.
///
/// In formulas H is the tick, dt the duration of the last frame, R the refresh of the display, and α the owed part of a
/// tick.
#[derive(Debug)]
pub struct PolicyCard {
    /// Its name on the command line, `kebab-case`.
    pub id: &'static str,
    /// Its name for people.
    pub name: &'static str,
    /// The rule in one line.
    pub formula: &'static str,
    /// Its constants; empty where it has none.
    pub constants: &'static str,
    /// What a frame of no time or less, and one of ten seconds, do.
    pub odd_frames: &'static str,
    /// Who uses it.
    pub users: &'static str,
    /// Where it is described.
    pub source: &'static str,
    /// How the picture is drawn between ticks.
    pub drawing: Interpolation,
    /// Whether it is drawn so of a copy that was stepped on to the moment to show, and is dropped.
    pub has_render_tick: bool,
    /// Whether every step is a whole tick, so that the physics is the same to the bit at any frame rate.
    pub has_fixed_tick: bool,
    /// Whether its ticks in a frame have a most, which can be set.
    pub has_max_ticks: bool,
    /// Whether `regatta loop` compares it where none is named.
    pub is_usual: bool,
    /// The loop, to be taken into a game.
    pub snippets: &'static [Snippet],
    pub(super) build: fn(TimeBase, FrameLimits) -> Box<dyn Policy>,
}

impl PolicyCard {
    /// How the picture is drawn between ticks, for people.
    pub fn drawn(&self) -> &'static str {
        if self.has_render_tick { "a copy stepped on" } else { self.drawing.name() }
    }

    /// Whether a moment is drawn that is beyond the last tick. It is drawn as if nothing would act on the bodies until then.
    pub fn draws_ahead(&self) -> bool {
        self.has_render_tick || self.drawing == Interpolation::Extrapolated
    }
}

impl PartialEq for PolicyCard {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}
