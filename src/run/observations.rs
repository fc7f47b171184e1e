//! Everything that follows a race without being part of its state: the menu, the checkpoints and the drawn past.
//!
//! They stay outside the race, so that a copy or a hash of a race has only the data that its physics needs. A snapshot
//! holds a mark of the drawn past in place of the samples, because a repetition of the ticks restores them.

use super::Menu;
use super::past::{Past, PastMark};
use super::race::{Checkpoints, Observer, PerformedAction, Race};

/// The menu, the checkpoints and the drawn past of a race.
pub struct Observations {
    menu: Menu,
    checkpoints: Checkpoints,
    past: Past,
}

/// The observations at some tick, for [rewinding](Observations::rewind).
#[derive(Clone, Debug)]
pub(super) struct ObservationsMark {
    menu: Menu,
    checkpoints: Checkpoints,
    past: PastMark,
}

impl ObservationsMark {
    /// Returns the heap memory of the mark in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        self.menu.heap_bytes() + self.checkpoints.heap_bytes() + self.past.heap_bytes()
    }
}

impl Observations {
    /// Creates observations from the present of `race` on. The drawn past covers `span_s` seconds of the coordinates
    /// that plots show by default.
    pub fn new(race: &Race, span_s: f64) -> Self {
        let menu = Menu::new(race);
        Self { past: Past::new(race, span_s, &menu), checkpoints: Checkpoints::default(), menu }
    }

    /// Like [`Observations::new`], with the coordinate to record for each body.
    pub(super) fn of_coordinates(
        race: &Race,
        span_s: f64,
        coordinates: impl Iterator<Item = usize>,
    ) -> Self {
        let menu = Menu::new(race);
        let past = Past::of_coordinates(race, span_s, &menu, coordinates);
        Self { past, checkpoints: Checkpoints::default(), menu }
    }

    /// Returns the menu of methods from which a person picks.
    pub fn menu(&self) -> &Menu {
        &self.menu
    }

    /// Returns the checkpoints from which verdicts and clouds restart.
    pub(super) fn checkpoints(&self) -> &Checkpoints {
        &self.checkpoints
    }

    /// Returns the drawn past.
    pub fn past(&self) -> &Past {
        &self.past
    }

    /// Extends the drawn past to the present of `race`, even if no sample is due. Never allocates.
    pub fn show_present(&mut self, race: &Race) {
        self.past.show_present(race, &self.menu);
    }

    pub(super) fn mark(&self) -> ObservationsMark {
        let Self { menu, checkpoints, past } = self;
        ObservationsMark { menu: menu.clone(), checkpoints: checkpoints.clone(), past: past.mark() }
    }

    /// Whether a repetition from the mark `from` restores the drawn past at `mark`.
    pub(super) fn fills(&self, from: &ObservationsMark, mark: &ObservationsMark) -> bool {
        self.past.fills(&from.past, &mark.past)
    }

    /// Rewinds to a mark of the present of `race`. The mark may also lie in the recorded future.
    pub(super) fn rewind(&mut self, mark: &ObservationsMark, race: &Race) {
        self.menu = mark.menu.clone();
        self.checkpoints = mark.checkpoints.clone();
        self.past.rewind(&mark.past, race);
    }

    /// Drops the recorded future.
    pub(super) fn forget_future(&mut self) {
        self.past.forget_future();
    }
}

impl Observer for Observations {
    fn before(&mut self, race: &Race, done: &PerformedAction) {
        self.past.before(race, &self.menu, done);
    }

    fn after(&mut self, race: &Race, done: &PerformedAction) {
        self.menu.follow(race, done);
        self.checkpoints.after(race, done);
        self.past.after(race, &self.menu, done);
    }

    fn ticked(&mut self, race: &Race) {
        self.past.ticked(race, &self.menu);
    }
}
