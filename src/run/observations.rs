//! All that follows a race while it runs, and is no part of its bits: the menu, the checkpoints and the drawn past.

use super::Menu;
use super::past::{Past, PastMark};
use super::race::{Done, Observer, Race, Starts};

/// The menu, the checkpoints and the drawn past of a race.
pub struct Observations {
    menu: Menu,
    starts: Starts,
    past: Past,
}

/// The observations at some tick, to which they can be [rewound](Observations::rewind).
#[derive(Clone, Debug)]
pub(super) struct ObservationsMark {
    menu: Menu,
    starts: Starts,
    past: PastMark,
}

impl ObservationsMark {
    /// Its heap memory in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        self.menu.heap_bytes() + self.starts.heap_bytes() + self.past.heap_bytes()
    }
}

impl Observations {
    /// Observations from the present of `race` on, with a drawn past of `span_s` seconds of the coordinates that plots show
    /// unless a person chooses others.
    pub fn new(race: &Race, span_s: f64) -> Self {
        let menu = Menu::new(race);
        Self { past: Past::new(race, span_s, &menu), starts: Starts::default(), menu }
    }

    /// Like [`Observations::new`], of the coordinates with these indices, one for each body.
    pub(super) fn of_coordinates(
        race: &Race,
        span_s: f64,
        coordinates: impl Iterator<Item = usize>,
    ) -> Self {
        let menu = Menu::new(race);
        let past = Past::of_coordinates(race, span_s, &menu, coordinates);
        Self { past, starts: Starts::default(), menu }
    }

    /// The methods from which a person picks.
    pub fn menu(&self) -> &Menu {
        &self.menu
    }

    /// The checkpoints from which verdicts and clouds restart.
    pub(super) fn starts(&self) -> &Starts {
        &self.starts
    }

    /// The drawn past.
    pub fn past(&self) -> &Past {
        &self.past
    }

    /// Adds the present of `race` to the drawn past, even if no sample is due. Never allocates.
    pub fn show_present(&mut self, race: &Race) {
        self.past.show_present(race, &self.menu);
    }

    pub(super) fn mark(&self) -> ObservationsMark {
        let Self { menu, starts, past } = self;
        ObservationsMark { menu: menu.clone(), starts: starts.clone(), past: past.mark() }
    }

    /// Whether a run repeated from the mark `from` will be drawn at `mark` as it was drawn then.
    pub(super) fn fills(&self, from: &ObservationsMark, mark: &ObservationsMark) -> bool {
        self.past.fills(&from.past, &mark.past)
    }

    /// Goes back to a mark, or forward to one in the recorded future: that of the present of `race`.
    pub(super) fn rewind(&mut self, mark: &ObservationsMark, race: &Race) {
        self.menu = mark.menu.clone();
        self.starts = mark.starts.clone();
        self.past.rewind(&mark.past, race);
    }

    /// Drops the recorded future.
    pub(super) fn forget_future(&mut self) {
        self.past.forget_future();
    }
}

impl Observer for Observations {
    fn before(&mut self, race: &Race, done: &Done) {
        self.past.before(race, &self.menu, done);
    }

    fn after(&mut self, race: &Race, done: &Done) {
        self.menu.follow(race, done);
        self.starts.after(race, done);
        self.past.after(race, &self.menu, done);
    }

    fn ticked(&mut self, race: &Race) {
        self.past.ticked(race, &self.menu);
    }
}
