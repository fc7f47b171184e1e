//! A person's controls for a run: the run, its clock, the selected lane, and a body in hand.

use std::sync::Arc;

use glam::DVec2;

use super::compared::Compared;
use super::display::{Display, View};
use super::notices::Notices;
use super::scene_list::SceneList;
use crate::measure::cloud::MAX_CLOUDS;
use crate::run::past::Past;
use crate::run::race::{Author, Entrant, Interpolation, Mode, Race};
use crate::run::{
    Menu, MenuIndex, RecordingError, Run, StartSettings, link, recording_among, recording_text,
};
use crate::scene::{Action, LaneId, LaneSpec, Scene};
use crate::sim::Clock;

/// A run under a person's control.
pub struct Deck {
    pub(super) scene_list: SceneList,
    pub(super) run: Run,
    pub(super) clock: Clock,
    pub(super) running: bool,
    /// The body that the person holds.
    pub(super) held: Option<HeldBody>,
    /// Whether the person holds the tick rate.
    pub(super) tick_rate_is_held: bool,
    /// Lane selected in a race; it stays selected through switches of method.
    pub(super) selected: LaneId,
    /// Whether a person, a script or a verdict has selected it.
    pub(super) is_selected: bool,
    /// Number of menu methods that the person has seen: all up to the last active one.
    met: usize,
    pub(super) dropped: u64,
    /// Number of scenes opened so far. A driver does not count the time of an opening.
    pub(super) openings: u64,
    /// Number of edits, and how many are saved.
    pub(super) edits: u64,
    pub(super) saved_edits: u64,
    /// The recording to which the run was compared, if they differ.
    pub(super) compared: Option<Box<Compared>>,
    /// The run that a person left for the guide, while a stop is on the stage.
    pub(super) left: Option<Box<LeftRun>>,
}

/// A run that a person left for the guide, with its view.
pub(super) struct LeftRun {
    pub(super) deck: Deck,
    pub(super) view: View,
    pub(super) display: Display,
}

impl Deck {
    /// A run at its start, not paused.
    pub(super) fn new(scene_list: SceneList, run: Run) -> Self {
        let clock = Clock::new(run.start().tick_hz());
        let selected = run.race().entrants()[0].id;
        Self {
            scene_list,
            run,
            clock,
            running: true,
            held: None,
            tick_rate_is_held: false,
            selected,
            is_selected: false,
            met: 0,
            dropped: 0,
            openings: 0,
            edits: 0,
            saved_edits: 0,
            compared: None,
            left: None,
        }
    }

    /// The open scene with the person's parameters and length.
    pub fn scene(&self) -> &Scene {
        &self.run.next().scene
    }

    /// The scene as it was opened.
    pub fn scene_as_opened(&self) -> &Scene {
        &self.run.next().opened
    }

    /// The run, its past and its future.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The lanes and the truth.
    pub fn race(&self) -> &Race {
        self.run.race()
    }

    /// The recorded past of the lanes and the truth.
    pub fn past(&self) -> &Past {
        self.run.past()
    }

    /// The methods to which digits and rows refer: those of the [menu](crate::run::Menu).
    pub fn entries(&self) -> &[LaneSpec] {
        self.run().menu().specs()
    }

    /// Name of the method with this menu index, with its settings if another entry has the same method.
    pub fn lane_name(&self, entry: MenuIndex) -> String {
        let spec = &self.entries()[entry];
        spec.distinct_name(spec.method.name, self.entries())
    }

    /// Number of menu methods to show at first: the scene's, and all up to the last active one.
    pub fn offered(&self) -> usize {
        let met = self.met.max(self.active() + 1);
        self.scene().lanes.len().max(met).min(self.entries().len())
    }

    /// Solo or race.
    pub fn mode(&self) -> Mode {
        self.race().mode()
    }

    /// Menu index of the solo method, or of the selected lane's in a race.
    pub fn active(&self) -> MenuIndex {
        self.entry(self.selected())
    }

    /// Menu index of a lane's method.
    pub fn entry(&self, entrant: &Entrant) -> MenuIndex {
        self.run().menu().entry(entrant.id)
    }

    /// The lane under the method with this menu index, if there is one.
    pub fn lane_of(&self, entry: MenuIndex) -> Option<&Entrant> {
        self.race().entrant(self.run().menu().lane(entry)?)
    }

    /// The lane in solo mode, or the selected lane in a race.
    pub fn selected(&self) -> &Entrant {
        let lanes = self.race().entrants();
        self.race().entrant(self.selected).unwrap_or(&lanes[0])
    }

    /// The lane that a pick of this menu index selects; in solo mode, the only one.
    pub(super) fn lane_to_pick(&self, entry: MenuIndex) -> Option<LaneId> {
        let picked = match self.mode() {
            Mode::Solo => self.race().entrants().first().filter(|_| entry < self.entries().len()),
            Mode::Race => self.lane_of(entry),
        };
        picked.map(|lane| lane.id)
    }

    /// The clock.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Whether the run is not paused.
    pub fn running(&self) -> bool {
        self.running
    }

    /// Whether time runs: the run is not paused, and neither a body nor the tick rate is in hand.
    pub fn time_runs(&self) -> bool {
        self.running && self.held.is_none() && !self.tick_rate_is_held
    }

    /// Whether the person holds the tick rate, by the last [`ViewCommand::HoldTickRate`](super::ViewCommand).
    pub fn is_tick_rate_held(&self) -> bool {
        self.tick_rate_is_held
    }

    /// Simulated time (s) including the pending part of a tick. It advances evenly with real time, while the race
    /// advances by ticks.
    pub fn time_with_owed_s(&self) -> f64 {
        self.race().t() + self.clock.tick_hz().seconds_of(self.clock.alpha())
    }

    /// Ticks dropped since the scene was opened or restarted.
    pub fn dropped_ticks(&self) -> u64 {
        self.dropped
    }

    /// Number of scenes opened or read again so far.
    pub fn openings(&self) -> u64 {
        self.openings
    }

    /// The scenes of the list.
    pub fn scene_list(&self) -> &SceneList {
        &self.scene_list
    }

    /// The open scene's name on the list.
    pub fn scene_name(&self) -> String {
        let listed = self.scene_list.open().and_then(|index| self.scene_list.names().nth(index));
        listed.unwrap_or_else(|| self.scene().name.clone())
    }

    /// The recording to which the run was [compared](super::show_comparison). `None` if there was none, if they are
    /// equal, or if another run has begun.
    pub fn compared(&self) -> Option<&Compared> {
        self.compared.as_deref()
    }

    /// Moves the compared recording to the tick of the run.
    pub(super) fn follow_with_compared(&mut self) {
        if let Some(compared) = &mut self.compared {
            compared.go_to(self.run.race().tick());
        }
    }

    /// Whether a person has acted after the start, so that a restart would run differently.
    pub(crate) fn was_changed_on_the_way(&self) -> bool {
        let race = self.race();
        let rows = &race.journal().rows()[..race.done()];
        rows.iter().any(|row| row.tick > 0 && row.author == Author::Person)
    }

    /// Whether the verdicts describe another run than the one on the screen, which has changed since.
    pub fn is_judged_apart(&self) -> bool {
        self.run().checkpoints().was_changed_since_judged(self.race())
    }

    /// Menu indices of the lanes with a cloud: all, or with very many lanes, the first ones and the selected one.
    pub(super) fn clouded_lanes(&self) -> impl Iterator<Item = usize> {
        let lanes = self.race().entrants();
        let selected = lanes.iter().position(|lane| self.entry(lane) == self.active()).unwrap_or(0);
        let last = selected.max(MAX_CLOUDS - 1);
        let is_shown = move |index: &usize| *index + 1 < MAX_CLOUDS || *index == last;
        (0..lanes.len()).filter(is_shown).map(|index| self.entry(&lanes[index]))
    }

    /// Evaluations in the next tick under the method with this menu index. Takes its lane, or else switches a copy of
    /// the selected one.
    pub fn evaluations_of_next_tick(&self, entry: MenuIndex) -> u64 {
        let (race, spec) = (self.race(), &self.entries()[entry]);
        let mut lane = self.lane_of(entry).unwrap_or(self.selected()).lane.clone();
        if self.lane_of(entry).is_none() {
            lane.switch(spec.solver(), spec.substeps, race.t(), race.truth());
        }
        let before = lane.evaluations();
        lane.tick(race.tick(), race.t(), race.tick_hz().step_s());
        lane.evaluations() - before
    }

    /// File name of a recording.
    pub fn recording_file_name(&self) -> String {
        format!("regatta-{}-recording.toml", self.scene().name)
    }

    /// The run up to the last tick reached, as the text of a scene file.
    ///
    /// # Errors
    /// As [`Session::recording_text`](crate::run::Session::recording_text).
    pub fn recording(&self) -> Result<String, RecordingError> {
        recording_text(&self.recorded())
    }

    /// The run up to the last tick reached as a scene, together with the methods on the menu.
    pub fn recorded(&self) -> Scene {
        let menu = Menu::new(self.run.start());
        let start = menu.entry(self.run.start().entrants()[0].id) + 1;
        let offered = start.max(self.scene().lanes.len());
        recording_among(self.run.recording(), &menu.specs()[..offered])
    }

    /// The link to the run up to the last tick reached, with the methods on the menu. An unchanged built-in scene is
    /// linked by name.
    ///
    /// # Errors
    /// As [`Session::recording_text`](crate::run::Session::recording_text).
    pub fn link(&self) -> Result<String, RecordingError> {
        if let Some(named) = link::link_by_name(self.run.session()) {
            return Ok(named);
        }
        let recording = self.recorded();
        // A link holds only runs that fit into a scene file.
        recording_text(&recording)?;
        link::link_to_run(&recording)
            .map_err(|_| RecordingError::TooLong { bytes: recording.to_toml().len() })
    }

    /// Sets the memory limit (bytes) for rewinding the run; see [`Run`].
    pub fn set_rewind_bytes(&mut self, bytes: usize) {
        self.run.set_limit(bytes);
    }

    /// Notes that a file holds all edits so far.
    pub fn note_saved(&mut self) {
        self.saved_edits = self.edits;
    }

    /// Clears the undo stack: all edits so far become part of the start.
    pub fn forget_changes(&mut self) {
        self.run.forget_changes();
        self.note_saved();
    }

    /// Selects the lane under the method with which a solo run starts.
    pub(super) fn select_entry_of_start(&mut self) {
        let picked = self.lane_to_pick(self.run.next().entry);
        self.selected = picked.unwrap_or(self.race().entrants()[0].id);
    }

    /// Runs time from the moment shown at rest.
    pub(super) fn run_on(&mut self, interpolation: Interpolation) {
        // If bodies are drawn a tick late, the present tick appears only when the next one is due.
        match interpolation {
            Interpolation::Raw | Interpolation::Extrapolated => self.clock.restart(),
            Interpolation::Linear | Interpolation::Hermite | Interpolation::Monotone => {
                self.clock.fill();
            }
        }
    }

    /// Edits a setting of the next start. `set` returns whether it changed anything.
    pub(super) fn set_start(&mut self, what: &str, set: impl FnOnce(&mut StartSettings) -> bool) {
        self.edits += u64::from(self.run.set_next(what, set));
    }

    /// Applies `change` to the run, and returns its result with the parts of a notice about it.
    pub(super) fn with_notices<T>(
        &mut self,
        change: impl FnOnce(&mut Run, &mut Notices<'_>) -> T,
    ) -> (T, Vec<String>) {
        let scene = Arc::clone(&self.run.next().scene);
        let mut notices = Notices::new(&scene);
        let done = self.run.race().done();
        let changed = change(&mut self.run, &mut notices);
        let told = notices.parts;
        self.clock.set_tick_hz(self.race().tick_hz());
        self.select_as_scripted(done);
        self.met = self.met.max(self.active() + 1);
        (changed, told)
    }

    /// In a race, selects the lane whose method the script named after the first `done` rows of the journal.
    fn select_as_scripted(&mut self, done: usize) {
        let race = self.run.race();
        if race.mode() == Mode::Solo || race.done() <= done {
            return;
        }
        for row in &race.journal().rows()[done..race.done()] {
            let Action::Method(method) = row.action else { continue };
            let lane = race.entrants().iter().find(|e| e.spec.method == method);
            if let Some(lane) = lane {
                self.selected = lane.id;
                self.is_selected = true;
            }
        }
    }

    /// The body that the person holds, if any.
    pub fn held(&self) -> Option<&HeldBody> {
        self.held.as_ref()
    }
}

/// A body that the pointer holds in place. Time stands still until its release. Otherwise the body would move
/// meanwhile, and the lanes of a race would diverge before they start from the new state.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldBody {
    /// Lane in whose cell it is held.
    pub lane: LaneId,
    /// Index of the body in the scene.
    pub body: usize,
    /// Coordinates at its release.
    pub q: Box<[f64]>,
    /// Velocities at its release.
    pub v: Box<[f64]>,
    /// Place of the pointer, in metres.
    pub hand: DVec2,
    /// Place (m) of the held point of the body: as near to the pointer as the body can be.
    pub handle: DVec2,
}
