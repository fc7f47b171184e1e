//! A run as a value, which only [actions](Action) and ticks change. A copy continues identically to the bit.
//!
//! Nothing else may change it: no clock, no frame and no viewer. Undo, recordings and links all repeat a run from its
//! start and its actions, and rely on the same bits.

use std::sync::Arc;

use super::race::{Journal, Mode, Observer, Race};
use crate::MenuIndex;
use crate::scene::{Action, Scene};

/// A running scene, without a clock, a picture or a viewer.
#[derive(Clone)]
pub struct Session {
    scene: Arc<Scene>,
    pub(super) race: Race,
    /// The race at its start without a journal, from which a recording begins.
    start: Box<Race>,
}

impl Session {
    /// Creates the race of all the scene's lanes, at its start, with the scene's script.
    ///
    /// ```
    /// use regatta_run::Session;
    /// use regatta_scene::{Action, Scene};
    ///
    /// let scene = Scene::built_in("spring").expect("a built-in scene");
    /// let mut session = Session::racing(scene.into());
    /// session.run(60);
    /// let mut copy = session.clone();
    /// session.act(Action::Kick(1.0));
    /// session.run(60);
    /// copy.act(Action::Kick(1.0));
    /// copy.run(60);
    /// assert_eq!(copy.race().state_hash(), session.race().state_hash());
    /// ```
    pub fn racing(scene: Arc<Scene>) -> Self {
        let race = Race::of_scene(&scene);
        Self::new(scene, race)
    }

    pub(crate) fn new(scene: Arc<Scene>, race: Race) -> Self {
        let mut start = race.clone();
        start.set_journal(Journal::default());
        Self { scene, race, start: Box::new(start) }
    }

    /// Creates a run of the scene from its start with one lane, under the method with index `entry` in the scene's
    /// [list](Scene::method_list). The scene's script may switch the method.
    pub fn solo(scene: Arc<Scene>, entry: MenuIndex) -> Self {
        let race = Race::solo(&scene, scene.method_list(), entry).with_script(&scene.script);
        Self::new(scene, race)
    }

    /// Returns the same run before its first tick, with all its actions pending.
    pub fn before_its_first_tick(&self) -> Self {
        let mut race = self.start().clone();
        race.set_journal(self.journal().clone());
        Self { race, ..self.clone() }
    }

    /// Returns the race at its start, before any action, without its journal.
    pub(super) fn start(&self) -> &Race {
        &self.start
    }

    /// Returns the scene, as it was opened.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }
    /// Returns the lanes and the truth.
    pub fn race(&self) -> &Race {
        &self.race
    }
    /// Whether the run is solo or a race.
    pub fn mode(&self) -> Mode {
        self.race.mode()
    }
    /// Returns the performed and the pending actions.
    pub fn journal(&self) -> &Journal {
        self.race.journal()
    }

    /// Replaces the journal by one with the same rows up to the present, from a copy of this run or from a file.
    pub fn follow(&mut self, journal: Journal) {
        self.race.set_journal(journal);
    }

    /// Performs an action at the present tick, after the journal's actions there. Removes later actions by hand from
    /// the journal, but not the script's. Returns whether the action changed anything; if not, the journal omits it.
    pub fn act(&mut self, action: Action) -> bool {
        self.race.act(action, &mut ()).is_some()
    }

    /// Performs the journal's actions at this tick, steps to the next tick, and notifies the observer. Allocates for
    /// actions only.
    pub fn tick(&mut self, observer: &mut dyn Observer) {
        self.race.step(observer);
    }

    /// Makes `ticks` ticks.
    pub fn run(&mut self, ticks: u64) {
        self.race.run(ticks);
    }
}
