//! A person's controls of a run: the run, its clock, the selected lane, and a body in hand.

use std::sync::Arc;

use glam::DVec2;

use super::compared::Compared;
use super::display::{Display, View};
use super::notices::Notices;
use super::run_before::RunBefore;
use super::run_beside::RunBeside;
use super::scene_list::SceneList;
use crate::measure::cloud::MAX_CLOUDS;
use crate::run::past::Past;
use crate::run::race::{Author, Entrant, Interpolation, JournalRow, Mode, Race};
use crate::run::{
    Menu, MenuIndex, RecordingError, Run, StartSettings, link, recording_among, recording_text,
};
use crate::scene::{Action, LaneId, LaneSpec, Scene};
use crate::sim::Clock;

/// Time for which a switch of the method or a change of the tick rate is recent, in seconds.
const SWITCHED_S: f64 = 1.5;

/// A run that a person controls.
pub struct Deck {
    pub(super) scene_list: SceneList,
    pub(super) run: Run,
    pub(super) clock: Clock,
    pub(super) running: bool,
    /// The body that the person holds in hand.
    pub(super) held: Option<HeldBody>,
    /// The body that the person pulls while time runs.
    pub(super) pulled: Option<PulledBody>,
    /// Whether the person holds the tick rate or another value of the run.
    pub(super) tick_rate_is_held: bool,
    /// The lane that is selected in a race. It stays selected through switches of its method.
    pub(super) selected: LaneId,
    /// Whether a person, a script or a verdict has selected the lane.
    pub(super) is_selected: bool,
    /// Number of menu methods that the person has met, which are all those up to the last that was active.
    met: usize,
    pub(super) dropped: u64,
    /// Actions of this run, with their ticks, that a change of a file has asked for.
    pub(super) of_files: Vec<(u64, Action)>,
    /// Number of scenes opened so far. A driver excludes the time that an opening takes.
    pub(super) openings: u64,
    /// Number of edits, and number of edits that are saved.
    pub(super) edits: u64,
    pub(super) saved_edits: u64,
    /// The recording to which the run was compared, if the two differ.
    pub(super) compared: Option<Box<Compared>>,
    /// The run before the last restart, if it had another tick rate or method.
    pub(super) run_before: Option<Box<RunBefore>>,
    /// The run as it goes on without the person's last change of the tick rate.
    pub(super) run_beside: Option<Box<RunBeside>>,
    /// The run that the person left for the guide, while a stop of the guide is on the stage.
    pub(super) left: Option<Box<LeftRun>>,
}

/// A run that a person left for the guide, and the person's view of it.
pub(super) struct LeftRun {
    pub(super) deck: Deck,
    pub(super) view: View,
    pub(super) display: Display,
}

impl Deck {
    /// Creates the controls of a run at its start, without a pause.
    pub(super) fn new(scene_list: SceneList, run: Run) -> Self {
        let clock = Clock::new(run.start().tick_hz());
        let selected = run.race().entrants()[0].id;
        Self {
            scene_list,
            run,
            clock,
            running: true,
            held: None,
            pulled: None,
            tick_rate_is_held: false,
            selected,
            is_selected: false,
            met: 0,
            dropped: 0,
            of_files: Vec::new(),
            openings: 0,
            edits: 0,
            saved_edits: 0,
            compared: None,
            run_before: None,
            run_beside: None,
            left: None,
        }
    }

    /// Returns the open scene, with the person's parameters and length.
    pub fn scene(&self) -> &Scene {
        &self.run.next().scene
    }

    /// Returns the scene as it was opened.
    pub fn scene_as_opened(&self) -> &Scene {
        &self.run.next().opened
    }

    /// Returns the run with its past and its future.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// Returns the run before the last restart, if it had another tick rate or method.
    pub fn run_before(&self) -> Option<&RunBefore> {
        self.run_before.as_deref()
    }

    /// Returns the time (s) from which plots draw the present run; before the start, unless that run goes on from the
    /// end of the [run before](Self::run_before).
    pub fn drawn_from_s(&self) -> f64 {
        let before =
            self.run_before().filter(|it| it.is_continued && it.until_s <= self.race().t());
        before.map_or(f64::NEG_INFINITY, |before| before.until_s)
    }

    /// Returns the lanes and the truth.
    pub fn race(&self) -> &Race {
        self.run.race()
    }

    /// Returns the recorded past of the lanes and the truth.
    pub fn past(&self) -> &Past {
        self.run.past()
    }

    /// Returns the methods of the [menu](crate::run::Menu). Digits and rows of the table refer to them.
    pub fn entries(&self) -> &[LaneSpec] {
        self.run().menu().specs()
    }

    /// Returns the name of the method with this menu index. If another entry has the same method, the name includes the
    /// settings.
    pub fn lane_name(&self, entry: MenuIndex) -> String {
        let name = |entry: MenuIndex| {
            let spec = &self.entries()[entry];
            spec.distinct_name(spec.method.name, self.entries())
        };
        match self.switched(entry) {
            Some((to, _)) => format!("{} → {}", name(entry), name(to)),
            None => name(entry),
        }
    }

    /// Returns the settings of the lane with this menu index, or if there is no lane, those of the menu.
    pub fn spec(&self, entry: MenuIndex) -> LaneSpec {
        self.lane_of(entry).map_or(self.entries()[entry], |lane| lane.spec)
    }

    /// Returns the menu index of the method to which the lane of a race with this menu index was switched, and the time
    /// (s) of the switch. Returns `None` if the lane has the method of its entry.
    pub fn switched(&self, entry: MenuIndex) -> Option<(MenuIndex, f64)> {
        let Entrant { id, spec, .. } = self.lane_of(entry)?;
        if spec.method == self.entries()[entry].method {
            return None;
        }
        let to = self.entries().iter().position(|listed| listed.method == spec.method)?;
        let race = self.race();
        let is_it = |action: &Action| match action {
            Action::Lane { lane, spec: by } => lane == id && by.method == spec.method,
            _ => false,
        };
        let mut rows = race.journal().rows()[..race.done()].iter().rev();
        let tick = rows.find(|row| is_it(&row.action))?.tick;
        Some((to, self.run.times().t(tick)))
    }

    /// Returns the menu index of the method from which a lane was switched within the last moment. Returns `None` if
    /// its last switch is longer ago.
    pub fn switched_from(&self, lane: &Entrant) -> Option<MenuIndex> {
        let race = self.race();
        let switch = |row: &JournalRow| match &row.action {
            Action::Lane { lane: id, spec } if *id == lane.id => Some((row.tick, *spec)),
            _ => None,
        };
        let mut switches = race.journal().rows()[..race.done()].iter().rev().filter_map(switch);
        let (tick, to) = switches.next()?;
        let before = || self.run.start().entrant(lane.id).map(|entrant| entrant.spec);
        let from = switches.next().map(|(_, spec)| spec).or_else(before)?;
        let is_recent = race.t() - self.run.times().t(tick) <= SWITCHED_S;
        (is_recent && from.method != to.method)
            .then(|| self.entries().iter().position(|listed| listed.method == from.method))?
    }

    /// Returns the number of menu methods to show at first. They are the scene's methods, and all up to the last that
    /// was active.
    pub fn offered(&self) -> usize {
        let met = self.met.max(self.active() + 1);
        self.scene().lanes.len().max(met).min(self.entries().len())
    }

    /// Returns whether the run is solo or a race.
    pub fn mode(&self) -> Mode {
        self.race().mode()
    }

    /// Returns the menu index of the method in solo mode, or of the selected lane's method in a race.
    pub fn active(&self) -> MenuIndex {
        self.entry(self.selected())
    }

    /// Returns the menu index of a lane's method.
    pub fn entry(&self, entrant: &Entrant) -> MenuIndex {
        self.run().menu().entry(entrant.id)
    }

    /// Returns the lane that flies the method with this menu index, if there is one.
    pub fn lane_of(&self, entry: MenuIndex) -> Option<&Entrant> {
        self.race().entrant(self.run().menu().lane(entry)?)
    }

    /// Returns the only lane in solo mode, or the selected lane of a race.
    pub fn selected(&self) -> &Entrant {
        let lanes = self.race().entrants();
        self.race().entrant(self.selected).unwrap_or(&lanes[0])
    }

    /// Returns the lane that a pick of this menu index selects. In solo mode it is the only lane.
    pub(super) fn lane_to_pick(&self, entry: MenuIndex) -> Option<LaneId> {
        let picked = match self.mode() {
            Mode::Solo => self.race().entrants().first().filter(|_| entry < self.entries().len()),
            Mode::Race => self.lane_of(entry),
        };
        picked.map(|lane| lane.id)
    }

    /// Returns the clock.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Whether the run is not paused.
    pub fn running(&self) -> bool {
        self.running
    }

    /// Whether time runs, which it does if the run is not paused and neither a body nor the tick rate is in hand.
    pub fn time_runs(&self) -> bool {
        self.running && self.held.is_none() && !self.tick_rate_is_held
    }

    /// Whether the person holds the tick rate or another value of the run, according to the last
    /// [`ViewCommand::HoldTickRate`](super::ViewCommand).
    pub fn is_tick_rate_held(&self) -> bool {
        self.tick_rate_is_held
    }

    /// Returns the simulated time (s) with the pending part of a tick. It advances evenly with real time, while the
    /// race advances tick by tick.
    pub fn time_with_owed_s(&self) -> f64 {
        self.race().t() + self.clock.tick_hz().seconds_of(self.clock.alpha())
    }

    /// Returns the number of ticks dropped since the scene was opened or restarted.
    pub fn dropped_ticks(&self) -> u64 {
        self.dropped
    }

    /// Returns the number of times that a scene was opened or read again.
    pub fn openings(&self) -> u64 {
        self.openings
    }

    /// Returns the list of scenes.
    pub fn scene_list(&self) -> &SceneList {
        &self.scene_list
    }

    /// Returns the name that the open scene has on the list.
    pub fn scene_name(&self) -> String {
        let listed = self.scene_list.open().and_then(|index| self.scene_list.names().nth(index));
        listed.unwrap_or_else(|| self.scene().name.clone())
    }

    /// Returns the recording to which the run was [compared](super::show_comparison). Returns `None` if there was none,
    /// if the two are equal, or if another run has begun.
    pub fn compared(&self) -> Option<&Compared> {
        self.compared.as_deref()
    }

    /// Returns the solo run as it goes on without the person's last change of the tick rate. Returns `None` if the rate
    /// was not changed, or if the person has acted otherwise since.
    pub fn run_beside(&self) -> Option<&RunBeside> {
        self.run_beside.as_deref()
    }

    /// Keeps the run before a change of the tick rate beside the run. Further changes within a moment belong to it.
    pub(super) fn keep_beside(&mut self, before: Race) {
        let is_recent =
            |it: &RunBeside| (0.0..=SWITCHED_S).contains(&(before.t() - it.begins_at_s()));
        let is_same = self.run_beside.as_deref().is_some_and(is_recent);
        if before.mode() == Mode::Solo && before.tick() > 0 && !is_same {
            self.run_beside = Some(RunBeside::new(before).into());
        }
        let tick_hz = self.race().tick_hz();
        self.run_beside.take_if(|it| it.tick_hz() == tick_hz);
    }

    /// Moves the runs that are shown beside the run to its displayed moment (s).
    pub(super) fn follow_with_compared(&mut self, shown_s: f64) {
        if let Some(beside) = &mut self.run_beside {
            beside.go_to(shown_s);
        }
        if let Some(compared) = &mut self.compared {
            compared.go_to(shown_s);
        }
    }

    /// Ends the comparison with a recording. Returns whether there was one.
    pub(super) fn close_comparison(&mut self) -> bool {
        self.compared.take().is_some()
    }

    /// Whether a person has acted after the start of the run. If so, a restart would run differently.
    pub(crate) fn was_changed_on_the_way(&self) -> bool {
        let race = self.race();
        let rows = &race.journal().rows()[..race.done()];
        rows.iter().any(|row| row.tick > 0 && row.author == Author::Person)
    }

    /// Returns the menu indices of the lanes with a cloud. They are all lanes, or if there are too many, the first ones
    /// and the selected one.
    pub(super) fn clouded_lanes(&self) -> impl Iterator<Item = usize> {
        let lanes = self.race().entrants();
        let selected = lanes.iter().position(|lane| self.entry(lane) == self.active()).unwrap_or(0);
        let last = selected.max(MAX_CLOUDS - 1);
        let is_shown = move |index: &usize| *index + 1 < MAX_CLOUDS || *index == last;
        (0..lanes.len()).filter(is_shown).map(|index| self.entry(&lanes[index]))
    }

    /// Returns the number of evaluations in the next tick under the method with this menu index. If no lane flies the
    /// method, a copy of the selected lane is switched to it.
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

    /// Returns the name of the file for a recording.
    pub fn recording_file_name(&self) -> String {
        format!("regatta-{}-recording.toml", self.scene().name)
    }

    /// Returns the run up to the last tick reached as the text of a scene file.
    ///
    /// # Errors
    /// As [`Session::recording_text`](crate::run::Session::recording_text).
    pub fn recording(&self) -> Result<String, RecordingError> {
        recording_text(&self.recorded())
    }

    /// Returns the run up to the last tick reached as a scene, with the methods on the menu.
    pub fn recorded(&self) -> Scene {
        let menu = Menu::new(self.run.start());
        let start = menu.entry(self.run.start().entrants()[0].id) + 1;
        let offered = start.max(self.scene().lanes.len());
        recording_among(self.run.recording(), &menu.specs()[..offered])
    }

    /// Returns the link to the run up to the last tick reached, with the methods on the menu. The link to an unchanged
    /// built-in scene has only its name.
    ///
    /// # Errors
    /// As [`Session::recording_text`](crate::run::Session::recording_text).
    pub fn link(&self) -> Result<String, RecordingError> {
        if let Some(named) = link::link_by_name(self.run.session()) {
            return Ok(named);
        }
        let recording = self.recorded();
        // A link may contain only a run that fits into a scene file.
        recording_text(&recording)?;
        link::link_to_run(&recording)
            .map_err(|_| RecordingError::TooLong { bytes: recording.to_toml().len() })
    }

    /// Sets the memory limit (bytes) for rewinding the run, as described at [`Run`].
    pub fn set_rewind_bytes(&mut self, bytes: usize) {
        self.run.set_limit(bytes);
    }

    /// Notes that all edits so far are saved in a file.
    pub fn note_saved(&mut self) {
        self.saved_edits = self.edits;
    }

    /// Clears the undo stack, so that all edits so far become part of the start.
    pub fn forget_changes(&mut self) {
        self.run.forget_changes();
        self.note_saved();
    }

    /// Selects the lane under the method with which a solo run starts.
    pub(super) fn select_entry_of_start(&mut self) {
        let picked = self.lane_to_pick(self.run.next().entry);
        self.selected = picked.unwrap_or(self.race().entrants()[0].id);
    }

    /// Lets time run on from the moment that was shown at rest.
    pub(super) fn run_on(&mut self, interpolation: Interpolation) {
        // The present tick appears only when the next one is due if bodies are drawn a tick late, so the clock starts
        // with a full tick.
        match interpolation {
            Interpolation::Raw | Interpolation::Extrapolated => self.clock.restart(),
            Interpolation::Linear | Interpolation::Hermite | Interpolation::Monotone => {
                self.clock.fill();
            }
        }
    }

    /// Edits a setting of the next start. `set` returns whether it changed the setting.
    pub(super) fn set_start(&mut self, what: &str, set: impl FnOnce(&mut StartSettings) -> bool) {
        self.edits += u64::from(self.run.set_next(what, set));
    }

    /// Applies `change` to the run. Returns its result, and the parts of a notice about it.
    pub(super) fn with_notices<T>(
        &mut self,
        change: impl FnOnce(&mut Run, &mut Notices<'_>) -> T,
    ) -> (T, Vec<String>) {
        let scene = Arc::clone(&self.run.next().scene);
        let mut notices = Notices::new(&scene);
        let done = self.run.race().done();
        let changed = change(&mut self.run, &mut notices);
        let parts = notices.parts;
        self.clock.set_tick_hz(self.race().tick_hz());
        self.select_as_scripted(done);
        self.met = self.met.max(self.active() + 1);
        (changed, parts)
    }

    /// Selects the lane of a race whose method the script selected in the rows of the journal after the first `done`.
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

    /// The body that the person pulls, if any.
    pub fn pulled(&self) -> Option<&PulledBody> {
        self.pulled.as_ref()
    }

    /// Lets go of a held or a pulled body. Returns whether there was one.
    pub(super) fn let_go(&mut self) -> bool {
        let had_pulled = self.pulled.take().is_some();
        self.held.take().is_some() || had_pulled
    }

    /// The body that the person holds, if any.
    pub fn held(&self) -> Option<&HeldBody> {
        self.held.as_ref()
    }
}

/// A body that the pointer holds in place. Time stands still until the person releases it. Otherwise the body would
/// move meanwhile, and the lanes of a race would diverge before they start from the new state.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldBody {
    /// Lane in whose cell the body is held.
    pub lane: LaneId,
    /// Index of the body in the scene.
    pub body: usize,
    /// Coordinates that the body will have when it is released.
    pub q: Box<[f64]>,
    /// Velocities that the body will have when it is released.
    pub v: Box<[f64]>,
    /// Place of the pointer, in metres.
    pub hand: DVec2,
    /// Place (m) of the point at which the body is held. It is as near to the pointer as the body can be.
    pub handle: DVec2,
}

/// A body on a spring to the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulledBody {
    /// Lane in whose cell it is pulled. The other lanes and the truth get the same impulses.
    pub lane: LaneId,
    /// Index of the body in the scene.
    pub body: usize,
    /// Index of the pulled handle among the body's handles.
    pub handle: usize,
    /// Place (m) to which the spring pulls the handle.
    pub to: DVec2,
    /// Place of the pointer, in metres.
    pub hand: DVec2,
}
