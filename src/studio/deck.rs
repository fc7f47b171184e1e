//! The deck from which a person steers: a run, the clock that drives it, the selected lane, and a body in hand.

use std::sync::Arc;

use glam::DVec2;

use super::compared::Compared;
use super::display::{Display, View};
use super::notices::Notices;
use super::scene_list::SceneList;
use crate::measure::cloud::MAX_CLOUDS;
use crate::run::past::Past;
use crate::run::race::{Author, Entrant, Interpolation, Mode, Race};
use crate::run::{Menu, RecordingError, Run, StartSettings, link, recording_among, recording_text};
use crate::scene::{Action, LaneId, LaneSpec, Scene};
use crate::sim::Clock;

/// A run in a person's hands.
pub struct Deck {
    pub(super) scene_list: SceneList,
    pub(super) run: Run,
    pub(super) clock: Clock,
    pub(super) running: bool,
    /// The body that the person holds.
    pub(super) held: Option<HeldBody>,
    /// The lane selected in a race: it stays selected, whatever method it is put under.
    pub(super) selected: LaneId,
    /// Whether a person, a script or a verdict has selected it.
    pub(super) is_selected: bool,
    /// How many methods of the menu a person has met: all up to the last that was active.
    met: usize,
    pub(super) dropped: u64,
    /// How many scenes were opened, of which a driver leaves the time out that it takes.
    pub(super) openings: u64,
    /// The number of edits, and how many of them a file has.
    pub(super) edits: u64,
    pub(super) saved_edits: u64,
    /// The recording that the run was compared with, if they differ.
    pub(super) compared: Option<Box<Compared>>,
    /// The run that a person left for the guide, while a stop's is on the stage.
    pub(super) left: Option<Box<LeftRun>>,
}

/// A run that a person left for the guide, and how it was looked at.
pub(super) struct LeftRun {
    pub(super) deck: Deck,
    pub(super) view: View,
    pub(super) display: Display,
}

impl Deck {
    /// A run at its start, which is running.
    pub(super) fn new(scene_list: SceneList, run: Run) -> Self {
        let clock = Clock::new(run.start().tick_hz());
        let selected = run.race().entrants()[0].id;
        Self {
            scene_list,
            run,
            clock,
            running: true,
            held: None,
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

    /// The open scene with the parameters and the length that a person has set.
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

    /// The methods that digits and rows refer to: those of the [menu](crate::run::Menu).
    pub fn entries(&self) -> &[LaneSpec] {
        self.run().menu().specs()
    }

    /// The name of the method with this index on the menu, told apart from others of the same method.
    pub fn lane_name(&self, entry: usize) -> String {
        let spec = &self.entries()[entry];
        spec.distinct_name(spec.method.name, self.entries())
    }

    /// How many methods of the menu a person meets at first: the scene's, and all up to the last that was active.
    pub fn offered(&self) -> usize {
        let met = self.met.max(self.active() + 1);
        self.scene().lanes.len().max(met).min(self.entries().len())
    }

    /// Solo or race.
    pub fn mode(&self) -> Mode {
        self.race().mode()
    }

    /// The method in solo mode, or of the selected lane in a race, by its index on the menu.
    pub fn active(&self) -> usize {
        self.entry(self.selected())
    }

    /// The method of a lane, by its index on the menu.
    pub fn entry(&self, entrant: &Entrant) -> usize {
        self.run().menu().entry(entrant.id)
    }

    /// The lane under the method with this index on the menu, if one flies it.
    pub fn flown(&self, entry: usize) -> Option<&Entrant> {
        self.race().entrant(self.run().menu().lane(entry)?)
    }

    /// The lane in solo mode, or the selected lane in a race.
    pub fn selected(&self) -> &Entrant {
        let lanes = self.race().entrants();
        self.race().entrant(self.selected).unwrap_or(&lanes[0])
    }

    /// The lane that a pick of this index of the menu selects: in solo mode the only one.
    pub(super) fn picked(&self, entry: usize) -> Option<LaneId> {
        let picked = match self.mode() {
            Mode::Solo => self.race().entrants().first().filter(|_| entry < self.entries().len()),
            Mode::Race => self.flown(entry),
        };
        picked.map(|lane| lane.id)
    }

    /// The clock.
    pub fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Whether it is not paused.
    pub fn running(&self) -> bool {
        self.running
    }

    /// Whether time runs: it is not paused, and no body is in hand.
    pub fn time_runs(&self) -> bool {
        self.running && self.held.is_none()
    }

    /// The simulated time in seconds with the owed part of a tick. It advances evenly with real time, while the race
    /// advances by ticks.
    pub fn time_with_owed_s(&self) -> f64 {
        self.race().t() + self.clock.tick_hz().seconds_of(self.clock.alpha())
    }

    /// Ticks dropped since the scene was opened or restarted.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// The scenes that were opened, or read again, in place of others.
    pub fn openings(&self) -> u64 {
        self.openings
    }

    /// The scenes that can be opened.
    pub fn scene_list(&self) -> &SceneList {
        &self.scene_list
    }

    /// The open scene's name on the list.
    pub fn scene_name(&self) -> String {
        let listed = self.scene_list.open().and_then(|index| self.scene_list.names().nth(index));
        listed.unwrap_or_else(|| self.scene().name.clone())
    }

    /// The recording that the run was [compared](super::show_comparison) with; `None` if none was or both are equal, or if
    /// another run has begun.
    pub fn compared(&self) -> Option<&Compared> {
        self.compared.as_deref()
    }

    /// Takes a recording that the run is compared with to the tick of the run.
    pub(super) fn follow_with_compared(&mut self) {
        if let Some(compared) = &mut self.compared {
            compared.go_to(self.run.race().tick());
        }
    }

    /// Whether a person has acted since the start, so that the run from the start is another.
    pub(crate) fn was_changed_on_the_way(&self) -> bool {
        let race = self.race();
        let rows = &race.journal().rows()[..race.done()];
        rows.iter().any(|row| row.tick > 0 && row.author == Author::Person)
    }

    /// Whether the run on the screen is another than the judged one: it was changed since on its way.
    pub fn is_judged_apart(&self) -> bool {
        self.run().starts().was_changed_since_judged(self.race())
    }

    /// The indices on the list of the lanes that have a cloud: all, or the first and the selected one of very many.
    pub(super) fn clouded_lanes(&self) -> impl Iterator<Item = usize> {
        let lanes = self.race().entrants();
        let selected = lanes.iter().position(|lane| self.entry(lane) == self.active()).unwrap_or(0);
        let last = selected.max(MAX_CLOUDS - 1);
        let is_shown = move |index: &usize| *index + 1 < MAX_CLOUDS || *index == last;
        (0..lanes.len()).filter(is_shown).map(|index| self.entry(&lanes[index]))
    }

    /// The evaluations in the next tick under the method with this index on the menu: of its lane, or else of the selected
    /// one if that is put under it.
    pub fn evaluations_of_next_tick(&self, entry: usize) -> u64 {
        let (race, spec) = (self.race(), &self.entries()[entry]);
        let mut lane = self.flown(entry).unwrap_or(self.selected()).lane.clone();
        if self.flown(entry).is_none() {
            lane.switch(spec.solver(), spec.substeps, race.t(), race.truth());
        }
        let before = lane.evaluations();
        lane.tick(race.tick(), race.t(), race.tick_hz().step_s());
        lane.evaluations() - before
    }

    /// The file name of a recording.
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

    /// The run up to the last tick reached as a scene, with the methods that stand on the menu beside it.
    pub fn recorded(&self) -> Scene {
        let menu = Menu::new(self.run.start());
        let start = menu.entry(self.run.start().entrants()[0].id) + 1;
        let offered = start.max(self.scene().lanes.len());
        recording_among(self.run.recording(), &menu.specs()[..offered])
    }

    /// The link to the run up to the last tick reached, with the methods that stand beside it: by name if nobody has changed it.
    ///
    /// # Errors
    /// As [`Session::recording_text`](crate::run::Session::recording_text).
    pub fn link(&self) -> Result<String, RecordingError> {
        if let Some(named) = link::naming(self.run.session()) {
            return Ok(named);
        }
        let recording = self.recorded();
        // What no file can hold, no link can.
        recording_text(&recording)?;
        link::to(&recording)
            .map_err(|_| RecordingError::TooLong { bytes: recording.to_toml().len() })
    }

    /// Sets the memory in bytes that a run may take to be rewound; see [`Run`].
    pub fn set_rewind_bytes(&mut self, bytes: usize) {
        self.run.set_limit(bytes);
    }

    /// Notes that a file has what a person did in the run so far.
    pub fn note_saved(&mut self) {
        self.saved_edits = self.edits;
    }

    /// Makes what was done so far part of the start, so that none of it can be undone.
    pub fn forget_changes(&mut self) {
        self.run.forget_changes();
        self.note_saved();
    }

    /// Selects the lane under the method with which a solo run starts.
    pub(super) fn select_entry_of_start(&mut self) {
        let picked = self.picked(self.run.next().entry);
        self.selected = picked.unwrap_or(self.race().entrants()[0].id);
    }

    /// Lets time run on from the moment that was shown at rest.
    pub(super) fn run_on(&mut self, interpolation: Interpolation) {
        // Where bodies are drawn a tick late, the tick reached is shown when the next one is due.
        match interpolation {
            Interpolation::Raw | Interpolation::Extrapolated => self.clock.restart(),
            Interpolation::Linear | Interpolation::Hermite | Interpolation::Monotone => {
                self.clock.fill();
            }
        }
    }

    /// Changes a setting of the next start by hand. `set` returns whether it changed anything.
    pub(super) fn set_start(&mut self, what: &str, set: impl FnOnce(&mut StartSettings) -> bool) {
        self.edits += u64::from(self.run.set_next(what, set));
    }

    /// Applies `change` to the run, and returns its result with the parts of a notice about it, if there is one.
    pub(super) fn watched<T>(
        &mut self,
        change: impl FnOnce(&mut Run, &mut Notices<'_>) -> T,
    ) -> (T, Vec<String>) {
        let scene = Arc::clone(&self.run.next().scene);
        let mut notices = Notices::new(&scene);
        let done = self.run.race().done();
        let changed = change(&mut self.run, &mut notices);
        let told = notices.told;
        self.clock.set_tick_hz(self.race().tick_hz());
        self.select_as_scripted(done);
        self.met = self.met.max(self.active() + 1);
        (changed, told)
    }

    /// In a race, selects the lane of the method that the script named after the first `done` rows of the journal.
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

/// A body that the pointer holds in a place. Time stands still until it is released: otherwise the body would move on
/// meanwhile, and the lanes of a race would diverge before they start from the new state.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldBody {
    /// The lane in whose cell it is held.
    pub lane: LaneId,
    /// The body's index in the scene.
    pub body: usize,
    /// The coordinates with which it would be released.
    pub q: Box<[f64]>,
    /// The velocities with which it would be released.
    pub v: Box<[f64]>,
    /// The place of the pointer, in metres.
    pub hand: DVec2,
    /// The place of the held point of the body, in metres: as near to the pointer as the body can be.
    pub handle: DVec2,
}
