//! The guide leads through the chapter in stops. Each stop opens a scene and asks for a prediction and for a key. When
//! the person has done the task, the stop shows its answer. Outside the guide, hints under the stage show the next
//! steps.
//!
//! `tests/library/guide.rs` checks the claims of the stops by measurement.

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
    /// The topic of the stop.
    pub title: &'static str,
    /// Name of the built-in scene that the stop opens.
    pub scene: &'static str,
    /// Id of the method under which the stop opens the scene.
    pub method: &'static str,
    /// Tick rate, in Hz.
    pub tick_hz: u32,
    /// Whether the stop is solo or a race.
    pub mode: Mode,
    /// The instrument that the stop opens. It shows the answer.
    pub instrument: Instrument,
    /// The quantity that *Motion* shows, and whose error *Error* shows.
    pub quantity: Quantity,
    /// The situation and the question. Keys stand between backticks.
    pub question: &'static str,
    /// The predictions to choose from.
    pub choices: &'static [&'static str],
    /// Index of the right prediction.
    pub right: usize,
    /// The task, with the key that performs it.
    pub task: &'static str,
    /// The keys that perform the task.
    pub keys: &'static [Key],
    /// The state in which the task is done.
    pub goal: Goal,
    /// The explanation that appears when the task is done.
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

/// The state of a studio on which goals and hints depend.
pub(super) struct HintContext<'a> {
    pub(super) scene: &'a Scene,
    pub(super) race: &'a Race,
    /// The methods of the menu, and the index among them of the selected lane's method.
    pub(super) menu: &'a [LaneSpec],
    pub(super) active: usize,
    /// Whether all parameters have the values that they had when the scene was opened.
    pub(super) has_own_values: bool,
    /// Whether nobody has changed the run on the way. If so, a restart would run alike.
    pub(super) is_from_the_start: bool,
    pub(super) speed_percent: u32,
    /// Whether a person has paused the run.
    pub(super) is_paused: bool,
    pub(super) is_in_loop_lab: bool,
    /// Whether the stage has bands, which digits show and take away.
    pub(super) has_bands: bool,
    /// Whether the selected lane has lost a body.
    pub(super) is_lost: bool,
    pub(super) display: &'a Display,
}

impl HintContext<'_> {
    /// Returns the method of the selected lane.
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
    /// Creates the progress at this stop, before the prediction and the task.
    pub(super) fn at(stop: usize) -> Self {
        Self { stop: stop.min(STOPS.len() - 1), guess: None, is_done: false }
    }

    /// Returns the present stop.
    pub fn stop(&self) -> &'static Stop {
        &STOPS[self.stop]
    }
    /// Returns the index of the stop, from 0.
    pub fn index(&self) -> usize {
        self.stop
    }
    /// Returns the person's prediction, as an index among the choices.
    pub fn guess(&self) -> Option<usize> {
        self.guess
    }
    /// Whether the person has done the task.
    pub fn is_done(&self) -> bool {
        self.is_done
    }

    /// Whether the stop waits for a prediction.
    pub fn is_asking(&self) -> bool {
        self.guess.is_none()
    }

    pub(super) fn predict(&mut self, choice: usize) {
        if !self.is_done && choice < self.stop().choices.len() {
            self.guess = Some(choice);
        }
    }

    /// Marks the task as done if its goal is met. If the stop asks for `Home`, the run must also be unchanged since its
    /// start. A task that is done once stays done.
    pub(super) fn check_goal(&mut self, now: &HintContext<'_>) {
        let is_begun = now.is_from_the_start || !self.stop().keys.contains(&Key::Home);
        self.is_done |= is_begun && self.stop().goal.is_met(now);
    }
}
