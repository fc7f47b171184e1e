//! Who watches a race: one loop of ticks serves all that is to be known of it.

use super::Race;
use crate::lab::action::Action;
use crate::lab::lane::TakenUp;

/// Someone who watches a race and changes nothing about it.
pub trait Observer {
    /// Something is about to be done that will change the race.
    fn before(&mut self, _race: &Race, _action: &Action) {}
    /// It was done. Bodies that had halted and go on for it are `taken_up`.
    fn after(&mut self, _race: &Race, _action: &Action, _taken_up: &[TakenUp]) {}
    /// A tick was made.
    fn ticked(&mut self, _race: &Race) {}
}

/// Nobody.
impl Observer for () {}

impl<A: Observer, B: Observer> Observer for (&mut A, &mut B) {
    fn before(&mut self, race: &Race, action: &Action) {
        self.0.before(race, action);
        self.1.before(race, action);
    }
    fn after(&mut self, race: &Race, action: &Action, taken_up: &[TakenUp]) {
        self.0.after(race, action, taken_up);
        self.1.after(race, action, taken_up);
    }
    fn ticked(&mut self, race: &Race) {
        self.0.ticked(race);
        self.1.ticked(race);
    }
}
