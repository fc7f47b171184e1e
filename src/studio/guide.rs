//! The guide: the chapter in stops. Each stop opens a scene, asks for a prediction and for a key, and shows its
//! answer when the person has done the task. After the scene's own hint, further hints under the stage show the next
//! steps.
//!
//! `tests/library/guide.rs` measures the claims of the stops.

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
    /// The topic.
    pub title: &'static str,
    /// The built-in scene that it opens.
    pub scene: &'static str,
    /// Id of the method with which it opens the scene.
    pub method: &'static str,
    /// Ticks per second.
    pub tick_hz: u32,
    /// Solo or a race.
    pub mode: Mode,
    /// The instrument that it opens, which shows the answer.
    pub instrument: Instrument,
    /// The quantity in *Motion*, and of the error in *Error*.
    pub quantity: Quantity,
    /// The situation and the question. Keys stand between backticks.
    pub question: &'static str,
    /// The predictions to choose from.
    pub choices: &'static [&'static str],
    /// Index of the right one.
    pub right: usize,
    /// The task, with its key.
    pub task: &'static str,
    /// The keys that perform the task.
    pub keys: &'static [Key],
    /// When the task is done.
    pub goal: Goal,
    /// The explanation afterwards.
    pub answer: &'static str,
}

/// The state that ends a stop's task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// The lane uses this method.
    Method(&'static str),
    /// The tick rate is at least this, in Hz.
    TickHzFrom(u32),
    /// The tick rate is at most this, in Hz.
    TickHzTo(u32),
    /// The speed is at least this, in percent of real time.
    SpeedFrom(u32),
    /// Time stands still after the start.
    Paused,
    /// Time stands still at this tick or a later one. Such a stop opens paused, and a person steps to the tick.
    SteppedTo(u64),
    /// The display shows this instrument.
    Instrument(Instrument),
    /// The loop lab is open.
    LoopLab,
    /// All methods race.
    Race,
    /// Bodies are drawn with this interpolation between ticks.
    Interpolation(Interpolation),
}

/// The state of a studio that goals and hints depend on.
pub(super) struct HintContext<'a> {
    pub(super) scene: &'a Scene,
    pub(super) race: &'a Race,
    /// The menu, and the index on it of the selected lane's method.
    pub(super) menu: &'a [LaneSpec],
    pub(super) active: usize,
    /// Whether all parameters have the values of the scene as opened.
    pub(super) has_own_values: bool,
    /// Whether nobody has changed the run on the way, so that a restart would run alike.
    pub(super) is_from_the_start: bool,
    pub(super) speed_percent: u32,
    /// Whether a person has paused it.
    pub(super) is_paused: bool,
    pub(super) is_in_loop_lab: bool,
    pub(super) display: &'a Display,
}

impl HintContext<'_> {
    /// The method of the selected lane.
    fn method(&self) -> &'static Method {
        self.menu[self.active].method
    }
}

impl Goal {
    pub(super) fn is_met(self, now: &HintContext<'_>) -> bool {
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

/// A person's progress through the stops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tour {
    stop: usize,
    guess: Option<usize>,
    is_done: bool,
}

impl Tour {
    /// At this stop, before the prediction and the task.
    pub(super) fn at(stop: usize) -> Self {
        Self { stop: stop.min(STOPS.len() - 1), guess: None, is_done: false }
    }

    /// The present stop.
    pub fn stop(&self) -> &'static Stop {
        &STOPS[self.stop]
    }
    /// Index of the stop, from 0.
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

    /// Whether the stop waits for a prediction.
    pub fn is_asking(&self) -> bool {
        self.guess.is_none() && !self.is_done
    }

    pub(super) fn predict(&mut self, choice: usize) {
        if !self.is_done && choice < self.stop().choices.len() {
            self.guess = Some(choice);
        }
    }

    /// Marks the task as done if its goal is met. If the stop asks for `Home`, the run must also be unchanged since
    /// its start. A task once done stays done.
    pub(super) fn check_goal(&mut self, now: &HintContext<'_>) {
        let is_begun = now.is_from_the_start || !self.stop().keys.contains(&Key::Home);
        self.is_done |= is_begun && self.stop().goal.is_met(now);
    }
}
