//! Observers of a race, and the actions that they see. One tick loop serves all of them.

use super::Race;
use super::journal::Author;
use super::lane::Resumed;
use crate::scene::{Action, Control, LaneId, LaneSpec};

/// An action as a race performs it. The race computes the action's effect once, for all observers.
#[derive(Clone, Debug, PartialEq)]
pub struct PerformedAction {
    /// The action.
    pub action: Action,
    /// The author of the action.
    pub author: Author,
    /// The lane that the action puts under another method, other substeps or another tolerance.
    pub switch: Option<Switch>,
    /// Halted bodies that resume because of the action; empty before the race performs it.
    pub resumed: Vec<Resumed>,
    /// The control that a person took from the script by this action; observers do not see it.
    pub released: Option<Control>,
}

/// A lane that changes to another method, other substeps or another tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch {
    /// Index of the lane among the entrants.
    pub index: usize,
    /// Number of the lane.
    pub lane: LaneId,
    /// New method, substeps and tolerance of the lane.
    pub spec: LaneSpec,
}

impl PerformedAction {
    /// Creates the record of an action before the race performs it.
    pub(super) fn new(action: Action, author: Author, switch: Option<Switch>) -> Self {
        Self { action, author, switch, resumed: Vec::new(), released: None }
    }
}

/// Follows a race without changing it.
pub trait Observer {
    /// Runs before an action changes the race.
    fn before(&mut self, _race: &Race, _done: &PerformedAction) {}
    /// Runs after the action has changed the race.
    fn after(&mut self, _race: &Race, _done: &PerformedAction) {}
    /// Runs after each tick.
    fn ticked(&mut self, _race: &Race) {}
}

/// Ignores everything.
impl Observer for () {}

impl<A: Observer + ?Sized, B: Observer + ?Sized> Observer for (&mut A, &mut B) {
    fn before(&mut self, race: &Race, done: &PerformedAction) {
        self.0.before(race, done);
        self.1.before(race, done);
    }
    fn after(&mut self, race: &Race, done: &PerformedAction) {
        self.0.after(race, done);
        self.1.after(race, done);
    }
    fn ticked(&mut self, race: &Race) {
        self.0.ticked(race);
        self.1.ticked(race);
    }
}
