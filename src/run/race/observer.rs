//! Observers of a race: one tick loop serves all who need to know what happens in it.

use super::Race;
use super::journal::Author;
use super::lane::Resumed;
use crate::scene::Action;

/// Receives what happens in a race, and does not change it.
pub trait Observer {
    /// An action is about to change the race.
    fn before(&mut self, _race: &Race, _action: &Action) {}
    /// The action was performed. `resumed` are the halted bodies that go on because of it.
    fn after(&mut self, _race: &Race, _action: &Action, _taken_up: &[Resumed]) {}
    /// An action of the journal was performed, by whom it says, whether or not it has changed the race.
    fn acted(&mut self, _race: &Race, _action: &Action, _author: Author) {}
    /// A tick was completed.
    fn ticked(&mut self, _race: &Race) {}
}

/// Ignores everything.
impl Observer for () {}

impl<A: Observer, B: Observer> Observer for (&mut A, &mut B) {
    fn before(&mut self, race: &Race, action: &Action) {
        self.0.before(race, action);
        self.1.before(race, action);
    }
    fn after(&mut self, race: &Race, action: &Action, resumed: &[Resumed]) {
        self.0.after(race, action, resumed);
        self.1.after(race, action, resumed);
    }
    fn acted(&mut self, race: &Race, action: &Action, author: Author) {
        self.0.acted(race, action, author);
        self.1.acted(race, action, author);
    }
    fn ticked(&mut self, race: &Race) {
        self.0.ticked(race);
        self.1.ticked(race);
    }
}
