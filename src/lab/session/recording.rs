//! A run as a scene: its start, its actions, and its states as checks.

use std::sync::Arc;

use super::Session;
use crate::lab::action::Action;
use crate::lab::lane_id::LaneId;
use crate::lab::link;
use crate::lab::race::{Journal, Mode, Observer, Race};
use crate::lab::scene::{AuthorText, Check, MAX_FILE_BYTES, MIN_SECONDS, Scene, Scripted};

/// The most checks of a recording, so that its file is not too large to read. A long run has fewer than one per second.
const MAX_CHECKS: usize = 8_000;

/// The tolerance in seconds for the end of a second: times may be off by their last bits.
const ON_TIME_S: f64 = 1e-6;

/// Why a run cannot be recorded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RecordingError {
    /// It is too long to be read as a scene.
    #[error(
        "this run has so many actions that its file would be {bytes} bytes long, and a scene file may be at most {MAX_FILE_BYTES}; record a shorter run"
    )]
    TooLong {
        /// The size of its file.
        bytes: usize,
    },
    /// It has a body or a method that is written in Rust.
    #[error("{what} is written in Rust, and a scene file cannot hold it; compare hashes instead")]
    InRust {
        /// The name of the body, or the id of the method.
        what: String,
    },
}

impl Session {
    /// The text of the [recording](Session::recording) to tick `end`.
    ///
    /// # Errors
    /// If it is too long for a scene file, or if a file cannot say what it is of.
    pub fn recording_text(&self, end: u64) -> Result<String, RecordingError> {
        Recorder::default().text(&self.to_record(end), &|| false)
    }

    /// A scene whose race repeats this run to the bit, from its start to tick `end`: as long as that, or as the scene if no
    /// tick has been made; with its initial parameters, lanes and
    /// rate, all its actions as script, and a [`Check`] of every lane at every second and at the end. A recorded race
    /// [opens as a race](Scene::opens_as_race). Repeats the run to make the checks.
    ///
    /// An action that names a method without a lane is recorded as a switch of its lane, so that it takes effect in a race
    /// too.
    pub fn recording(&self, end: u64) -> Scene {
        self.to_record(end).scene()
    }

    /// The [link] to the [recording](Session::recording) to tick `end`.
    ///
    /// # Errors
    /// If no text can say what the run is of.
    pub fn link(&self, end: u64) -> Result<String, RecordingError> {
        match self.scene.in_rust() {
            Some(what) => Err(RecordingError::InRust { what: what.to_owned() }),
            None => Ok(link::to(&self.recording(end))),
        }
    }

    /// What a recording to tick `end` is made of.
    pub(in crate::lab) fn to_record(&self, end: u64) -> RunToRecord {
        let (identity, scene) = (Arc::clone(&self.identity), Arc::clone(&self.scene));
        let (start, journal) = (self.start.clone(), self.journal().clone());
        RunToRecord { identity, scene, start, journal, end }
    }
}

/// A run to its last tick, for a [`Recorder`]. Two of one run are equal if they have the same recording.
#[derive(Clone)]
pub struct RunToRecord {
    identity: Arc<()>,
    scene: Arc<Scene>,
    start: Box<Race>,
    journal: Journal,
    end: u64,
}

impl RunToRecord {
    /// As [`Session::recording`].
    pub fn scene(&self) -> Scene {
        let mut repeated = Repeated::new(self);
        repeated.advance(self.end, &|| false);
        repeated.scene(self)
    }

    fn is_of_run_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.identity, &other.identity)
    }
}

impl PartialEq for RunToRecord {
    fn eq(&self, other: &Self) -> bool {
        self.is_of_run_of(other) && self.end == other.end && self.journal == other.journal
    }
}

/// Makes the recordings of a run as it grows. Each repeats only what is new since the last, if what came before is the
/// same.
#[derive(Default)]
pub struct Recorder {
    last: Option<(RunToRecord, Repeated, AuthorText)>,
}

impl Recorder {
    /// The text of the [recording](Session::recording) of a run, or of the part of it before `stop` says so.
    ///
    /// # Errors
    /// As [`Session::recording_text`].
    pub fn text(
        &mut self,
        run: &RunToRecord,
        stop: &dyn Fn() -> bool,
    ) -> Result<String, RecordingError> {
        if let Some(what) = run.scene.in_rust() {
            return Err(RecordingError::InRust { what: what.to_owned() });
        }
        let known = self.last.take();
        let known = known.filter(|(last, repeated, _)| repeated.is_part_of(last, run));
        let (mut repeated, author) = match known {
            Some((_, repeated, author)) => (repeated, author),
            None => (Repeated::new(run), AuthorText::of(&run.scene)),
        };
        repeated.race.set_journal(run.journal.clone());
        repeated.advance(run.end, stop);
        let text = author.save(&repeated.scene(run));
        self.last = Some((run.clone(), repeated, author));
        let bytes = text.len();
        if bytes > MAX_FILE_BYTES { Err(RecordingError::TooLong { bytes }) } else { Ok(text) }
    }
}

/// A run that is repeated to be recorded.
struct Repeated {
    race: Race,
    recorder: ScriptRecorder,
    /// The ticks of the checks so far, with the hash of each lane.
    checks: Vec<(u64, Vec<(LaneId, u64)>)>,
    /// When the next is due, in seconds.
    next_s: f64,
}

impl Repeated {
    /// A run at its start.
    fn new(run: &RunToRecord) -> Self {
        let mut race = (*run.start).clone();
        race.set_journal(run.journal.clone());
        let lanes = race.entrants().iter().map(|e| e.id).collect();
        let recorder = ScriptRecorder { lanes, script: Vec::new() };
        Self { race, recorder, checks: Vec::new(), next_s: 1.0 }
    }

    /// Whether what was repeated of the run `last` is a part of `run`, too.
    fn is_part_of(&self, last: &RunToRecord, run: &RunToRecord) -> bool {
        let (done, tick) = (self.race.done(), self.race.tick());
        let [before, now] = [&last.journal, &run.journal].map(|journal| journal.rows());
        let is_same = || now.len() >= done && now[..done] == before[..done];
        let is_later = || now[done..].first().is_none_or(|next| next.tick >= tick);
        last.is_of_run_of(run) && tick <= run.end && is_same() && is_later()
    }

    /// Repeats the run to tick `end`, or until `stop` says so.
    fn advance(&mut self, end: u64, stop: &dyn Fn() -> bool) {
        while self.race.tick() < end && !stop() {
            self.race.step_seen(&mut self.recorder);
            let (tick, t) = (self.race.tick(), self.race.t() + ON_TIME_S);
            if t >= self.next_s {
                self.checks.push((tick, self.recorder.hashes(&self.race)));
                self.next_s = libm::floor(t) + 1.0;
            }
        }
    }

    /// The recording of the run so far.
    fn scene(&self, run: &RunToRecord) -> Scene {
        let end = self.race.tick();
        let start = &run.start;
        let at_start = start.entrants().iter();
        let mut scene = Scene {
            lanes: at_start.map(|entrant| entrant.spec).collect(),
            tick_hz: start.tick_hz(),
            opening_method: None,
            equal_cost: false,
            opens_as_race: start.mode() == Mode::Race,
            script: Vec::new(),
            checks: Vec::new(),
            ..(*run.scene).clone()
        };
        let before_end: Vec<_> = self.checks.iter().filter(|(tick, _)| *tick < end).collect();
        let every = (before_end.len() * self.recorder.lanes.len()).div_ceil(MAX_CHECKS).max(1);
        let kept = before_end.into_iter().skip(every - 1).step_by(every);
        let at_end = (end, self.recorder.hashes(&self.race));
        for (tick, hashes) in kept.chain([&at_end]) {
            let check = |&(lane, hash): &(LaneId, u64)| Check { tick: *tick, lane, hash };
            scene.checks.extend(hashes.iter().map(check));
        }
        // The actions at the last tick come after its checks, and may still be followed by others.
        let (mut race, mut recorder) = (self.race.clone(), self.recorder.clone());
        race.catch_up(&mut recorder);
        scene.script = recorder.script;
        if end > 0 {
            scene.seconds = race.t().max(MIN_SECONDS);
        }
        scene
    }
}

/// Records the actions on a race as the script of a scene.
#[derive(Clone)]
struct ScriptRecorder {
    /// The lanes at the start. In the scene they are counted from 1.
    lanes: Vec<LaneId>,
    script: Vec<Scripted>,
}

impl ScriptRecorder {
    /// Which lane of the scene this lane of the run is.
    fn lane(&self, id: LaneId) -> LaneId {
        let index = self.lanes.iter().position(|lane| *lane == id);
        LaneId::of_index(index.expect("a lane is there from the start"))
    }

    /// The hash of each lane that is still in the race.
    fn hashes(&self, race: &Race) -> Vec<(LaneId, u64)> {
        let lanes = race.entrants().iter().map(|entrant| self.lane(entrant.id));
        lanes.zip(race.lane_hashes()).collect()
    }
}

impl Observer for ScriptRecorder {
    fn before(&mut self, race: &Race, action: &Action) {
        let action = match (race.switch_asked(action), action) {
            (Some((index, spec)), _) => {
                Action::Lane { lane: self.lane(race.entrants()[index].id), spec }
            }
            (None, Action::Solo { lane }) => Action::Solo { lane: self.lane(*lane) },
            (None, other) => other.clone(),
        };
        self.script.push(Scripted { at_s: race.t(), action });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_grows_is_recorded_as_if_it_were_recorded_at_once() {
        let mut session = Session::racing(Scene::built_in("harbour").unwrap().into());
        let mut recorder = Recorder::default();
        let mut grown = |session: &Session, end| {
            let text = recorder.text(&session.to_record(end), &|| false);
            assert_eq!(text, session.recording_text(end), "to tick {end}");
        };
        grown(&session, 0);
        for (ticks, action) in [
            (59, None),
            (1, Some(Action::Kick(2.0))),
            (0, Some(Action::TickHz(30))),
            (40, Some(Action::Kick(-1.0))),
        ] {
            session.run(ticks);
            session.act(Action::Throttle(0.5));
            grown(&session, session.race().tick());
            action.map(|action| session.act(action));
            grown(&session, session.race().tick());
        }
        // The past is changed: another future.
        let mut other = session.before_its_first_tick();
        other.run(30);
        other.act(Action::Kick(1.0));
        other.run(100);
        grown(&other, 130);
        grown(&other, 90);
        grown(&session, 100);
    }

    #[test]
    fn a_recording_that_is_stopped_goes_on_where_it_was() {
        let mut session = Session::racing(Scene::built_in("spring").unwrap().into());
        session.run(100);
        let mut recorder = Recorder::default();
        let ticks = std::cell::Cell::new(0);
        let stop = || ticks.replace(ticks.get() + 1) == 70;
        assert_eq!(recorder.text(&session.to_record(100), &stop), session.recording_text(70));
        let text = recorder.text(&session.to_record(100), &|| false);
        assert_eq!(text, session.recording_text(100));
    }
}
