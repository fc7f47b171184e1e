//! A run as a value: it changes by [actions](Action) and ticks only, and a copy goes on alike to the bit.

use std::sync::Arc;

use super::action::Action;
use super::journal::Journal;
use super::race::{Acted, Mode, Observer, Race};
use super::scene::Scene;

mod recording;
mod time_scale;
mod timeline;

pub use recording::RecordingTooLong;
pub use time_scale::TimeScale;
pub use timeline::{Event, EventKind, SNAPSHOT_BYTES, Timeline};

/// A scene being run. It knows no clock, no picture and nobody who looks at it.
#[derive(Clone)]
pub struct Session {
    scene: Arc<Scene>,
    race: Race,
    /// The race at its start, without a journal: what a recording begins with.
    start: Box<Race>,
}

impl Session {
    /// The race of all the scene's lanes, at its start, with the scene's script.
    ///
    /// ```
    /// use regatta::lab::{Action, Scene, Session};
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
        let race = Race::of(&scene);
        Self::new(scene, race)
    }

    /// A run at its start.
    pub(super) fn new(scene: Arc<Scene>, race: Race) -> Self {
        let mut start = race.clone();
        start.set_journal(Journal::default());
        Self { scene, race, start: Box::new(start) }
    }

    /// The scene at its start with one lane, that of the method on place `entry` of the scene's
    /// [list](Scene::method_list), which the scene's script may put under other methods.
    pub fn solo(scene: Arc<Scene>, entry: usize) -> Self {
        let race = Race::solo(&scene, scene.method_list(), entry);
        Self::new(scene, race)
    }

    /// The same run at its start, with nothing to do.
    fn at_start(&self) -> Self {
        let race = (*self.start).clone();
        Self { scene: Arc::clone(&self.scene), race, start: self.start.clone() }
    }

    /// The scene, as it was opened.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }
    /// The lanes and the truth.
    pub fn race(&self) -> &Race {
        &self.race
    }
    /// Whether there is one lane, which is switched from method to method, or one for each method.
    pub fn mode(&self) -> Mode {
        self.race.mode()
    }
    /// What was done and is to be done.
    pub fn journal(&self) -> &Journal {
        self.race.journal()
    }

    /// Goes on by another journal than its own, which has the same rows up to here: one that this run's copy wrote, or
    /// that was read from a file.
    pub fn follow(&mut self, journal: Journal) {
        self.race.set_journal(journal);
    }

    /// Does something at the present tick, after what the journal has for it. From here on the journal has only what
    /// the script does; what was done by hand later is taken back. Returns whether it changed anything: what changes
    /// nothing is not in the journal.
    pub fn act(&mut self, action: Action) -> bool {
        self.act_seen(action, &mut ()) != Acted::Nothing
    }

    pub(super) fn act_seen(&mut self, action: Action, observer: &mut impl Observer) -> Acted {
        self.race.act(action, observer)
    }

    /// Does what the journal has for this tick, and steps to the next. Never allocates, but for what is done.
    pub fn tick(&mut self) {
        self.race.step();
    }

    /// As [`Session::tick`], before the eyes of an observer.
    pub fn tick_seen(&mut self, observer: &mut impl Observer) {
        self.race.step_seen(observer);
    }

    /// So many ticks.
    pub fn run(&mut self, ticks: u64) {
        self.race.run(ticks);
    }
}
