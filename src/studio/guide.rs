//! The guide: the chapter in stops. Each stop opens a scene, asks for a prediction and for a key, and answers when the
//! person has done it. And the hints under the stage, which lead on after the scene's own.
//!
//! What the stops claim is measured by `tests/library/guide.rs`.

use super::display::Display;
use super::instrument::Instrument;
use super::key::Key;
use crate::run::past::Quantity;
use crate::run::race::{Interpolation, Mode, Race};
use crate::scene::{LaneSpec, Scene};
use crate::sim::integrators::Method;

mod hints;
mod stops;

pub(super) use hints::Hints;
pub use stops::STOPS;

/// A stop of the guide.
#[derive(Debug)]
pub struct Stop {
    /// What it is about.
    pub title: &'static str,
    /// The built-in scene that it opens.
    pub scene: &'static str,
    /// The method that it opens the scene with, by its id.
    pub method: &'static str,
    /// Ticks per second.
    pub tick_hz: u32,
    /// Solo or a race.
    pub mode: Mode,
    /// The instrument that it opens, in which the answer is seen.
    pub instrument: Instrument,
    /// The quantity that *Motion* shows, and whose error *Error* shows.
    pub quantity: Quantity,
    /// What happens here, and the question. Keys stand between backticks.
    pub question: &'static str,
    /// The predictions to choose from.
    pub choices: &'static [&'static str],
    /// The right one, by its index.
    pub right: usize,
    /// Which key to press.
    pub task: &'static str,
    /// The keys that do the task.
    pub keys: &'static [Key],
    /// When it is done.
    pub goal: Goal,
    /// What the person has seen.
    pub answer: &'static str,
}

/// What a person has to bring about at a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// The lane flies this method.
    Method(&'static str),
    /// The ticks have at least this rate, in Hz.
    TickHzFrom(u32),
    /// The ticks have at most this rate, in Hz.
    TickHzTo(u32),
    /// Time runs at this many percent of real time or more.
    SpeedFrom(u32),
    /// Time stands still after the start.
    Paused,
    /// Time stands still at this tick or a later one. Such a stop opens paused, and a person steps to the tick.
    SteppedTo(u64),
    /// This instrument is shown.
    Instrument(Instrument),
    /// The loop lab is open.
    LoopLab,
    /// All methods race.
    Race,
    /// Bodies are drawn so between ticks.
    Interpolation(Interpolation),
}

/// What a studio is doing, as far as a goal or a hint asks.
pub(super) struct Situation<'a> {
    pub(super) scene: &'a Scene,
    pub(super) race: &'a Race,
    /// The menu, and the index on it of the method of the selected lane.
    pub(super) menu: &'a [LaneSpec],
    pub(super) active: usize,
    /// Whether all parameters have the values that the scene was opened with.
    pub(super) has_own_values: bool,
    /// Whether the run is what it would be from its start: nobody has changed it on the way.
    pub(super) is_from_the_start: bool,
    pub(super) speed_percent: u32,
    /// Whether a person has paused it.
    pub(super) is_paused: bool,
    pub(super) is_in_loop_lab: bool,
    pub(super) display: &'a Display,
}

impl Situation<'_> {
    /// The method of the selected lane.
    fn method(&self) -> &'static Method {
        self.menu[self.active].method
    }
}

impl Goal {
    pub(super) fn is_met(self, now: &Situation<'_>) -> bool {
        match self {
            Goal::Method(id) => now.method().id == id,
            Goal::TickHzFrom(hz) => now.race.tick_hz() >= hz,
            Goal::TickHzTo(hz) => now.race.tick_hz() <= hz,
            Goal::SpeedFrom(percent) => now.speed_percent >= percent,
            Goal::Paused => now.is_paused && now.race.tick() > 0,
            Goal::SteppedTo(tick) => now.is_paused && now.race.tick() >= tick,
            Goal::Instrument(wanted) => now.display.instrument == wanted,
            Goal::LoopLab => now.is_in_loop_lab,
            Goal::Race => now.race.mode() == Mode::Race,
            Goal::Interpolation(wanted) => now.display.interpolation == wanted,
        }
    }
}

/// A person's way through the stops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tour {
    stop: usize,
    guess: Option<usize>,
    is_done: bool,
}

impl Tour {
    /// At this stop, with nothing done there.
    pub(super) fn at(stop: usize) -> Self {
        Self { stop: stop.min(STOPS.len() - 1), guess: None, is_done: false }
    }

    /// The stop.
    pub fn stop(&self) -> &'static Stop {
        &STOPS[self.stop]
    }
    /// The stop's index, from 0.
    pub fn index(&self) -> usize {
        self.stop
    }
    /// The prediction, by its index among the choices.
    pub fn guess(&self) -> Option<usize> {
        self.guess
    }
    /// Whether the task is done.
    pub fn is_done(&self) -> bool {
        self.is_done
    }

    /// Whether it waits for a prediction.
    pub fn is_asking(&self) -> bool {
        self.guess.is_none() && !self.is_done
    }

    pub(super) fn predict(&mut self, choice: usize) {
        if !self.is_done && choice < self.stop().choices.len() {
            self.guess = Some(choice);
        }
    }

    /// Notes that the task is done if it is: of a stop that asks for `Home`, once the run has begun as it is now. Once done,
    /// it stays so.
    pub(super) fn look(&mut self, now: &Situation<'_>) {
        let is_begun = now.is_from_the_start || !self.stop().keys.contains(&Key::Home);
        self.is_done |= is_begun && self.stop().goal.is_met(now);
    }
}
