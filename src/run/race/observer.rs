//! Observers of a race, and the actions that they see. One tick loop serves all of them.

use super::Race;
use super::journal::Author;
use super::lane::Resumed;
use crate::scene::{Action, Control, LaneId, LaneSpec};

/// An action as a race performs it. The race works out its effect once; whoever has to follow reads it here.
#[derive(Clone, Debug, PartialEq)]
pub struct Done {
    /// The action.
    pub action: Action,
    /// Who performs it.
    pub author: Author,
    /// The lane that it puts under another method, other substeps or another tolerance.
    pub switch: Option<Switch>,
    /// The halted bodies that go on because of it; none before it is performed.
    pub resumed: Vec<Resumed>,
    /// The control that a person has taken from the script by it; observers do not see it.
    pub(crate) released: Option<Control>,
}

/// A lane that is put under another method, other substeps or another tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switch {
    /// Its index among the entrants.
    pub index: usize,
    /// The lane.
    pub lane: LaneId,
    /// Its method, substeps and tolerance from now on.
    pub spec: LaneSpec,
}

impl Done {
    /// An action that switches no lane, or that is not performed yet.
    pub(super) fn new(action: Action, author: Author, switch: Option<Switch>) -> Self {
        Self { action, author, switch, resumed: Vec::new(), released: None }
    }
}

/// Receives what happens in a race, and does not change it.
pub trait Observer {
    /// An action is about to change the race.
    fn before(&mut self, _race: &Race, _done: &Done) {}
    /// The action has changed the race.
    fn after(&mut self, _race: &Race, _done: &Done) {}
    /// A tick was completed.
    fn ticked(&mut self, _race: &Race) {}
}

/// Ignores everything.
impl Observer for () {}

impl<A: Observer + ?Sized, B: Observer + ?Sized> Observer for (&mut A, &mut B) {
    fn before(&mut self, race: &Race, done: &Done) {
        self.0.before(race, done);
        self.1.before(race, done);
    }
    fn after(&mut self, race: &Race, done: &Done) {
        self.0.after(race, done);
        self.1.after(race, done);
    }
    fn ticked(&mut self, race: &Race) {
        self.0.ticked(race);
        self.1.ticked(race);
    }
}
