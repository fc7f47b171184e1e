//! A run as a scene: its start, its actions, and its states as checks.

use super::Session;
use crate::lab::action::Action;
use crate::lab::race::{Mode, Observer, Race};
use crate::lab::scene::{Check, LARGEST_FILE, LEAST_SECONDS, Scene, Scripted};

/// The most checks of a recording, so that its file is not too large to read. A long run has fewer than one per second.
const MOST_CHECKS: usize = 8_000;

/// The tolerance in seconds for the end of a second: times may be off by their last bits.
const ON_TIME_S: f64 = 1e-6;

/// Why a run cannot be recorded.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RecordingError {
    /// It is too long to be read as a scene.
    #[error(
        "this run has so many actions that its file would be {bytes} bytes long, and a scene file may be at most {LARGEST_FILE}; record a shorter run"
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
        if let Some(what) = self.scene.in_rust() {
            return Err(RecordingError::InRust { what: what.to_owned() });
        }
        let text = self.recording(end).to_toml();
        let bytes = text.len();
        if bytes > LARGEST_FILE { Err(RecordingError::TooLong { bytes }) } else { Ok(text) }
    }

    /// A scene whose race repeats this run to the bit, from its start to tick `end`: as long as that, or as the scene if no
    /// tick has been made; with its initial parameters, lanes and
    /// rate, all its actions as script, and a [`Check`] of every lane at every second and at the end. A recorded race
    /// [opens as a race](Scene::opens_as_race). Repeats the run to make the checks.
    ///
    /// An action that names a method without a lane is recorded as a switch of its lane, so that it takes effect in a race
    /// too.
    pub fn recording(&self, end: u64) -> Scene {
        let mut race = self.start().clone();
        let lanes: Vec<usize> = race.entrants().iter().map(|e| e.lane_number).collect();
        let specs = race.entrants().iter().map(|entrant| race.list()[entrant.entry]);
        let mut scene = Scene {
            lanes: specs.collect(),
            tick_hz: race.tick_hz(),
            opening_method: None,
            equal_cost: false,
            opens_as_race: race.mode() == Mode::Race,
            script: Vec::new(),
            checks: Vec::new(),
            ..(*self.scene).clone()
        };
        race.set_journal(self.journal().clone());

        let mut recorder = ScriptRecorder { lanes, script: Vec::new() };
        let (mut next_s, mut checks) = (1.0, Vec::new());
        while race.tick() < end {
            race.step_seen(&mut recorder);
            let (tick, t) = (race.tick(), race.t() + ON_TIME_S);
            if t >= next_s && tick < end {
                checks.push((tick, recorder.hashes(&race)));
                next_s = libm::floor(t) + 1.0;
            }
        }
        let every = (checks.len() * recorder.lanes.len()).div_ceil(MOST_CHECKS).max(1);
        let kept = checks.into_iter().skip(every - 1).step_by(every);
        let at_end = (end, recorder.hashes(&race));
        // The actions at the last tick come after its checks.
        race.catch_up(&mut recorder);
        for (tick, hashes) in kept.chain([at_end]) {
            let check = |(lane, hash)| Check { tick, lane, hash };
            scene.checks.extend(hashes.into_iter().map(check));
        }
        scene.script = recorder.script;
        if end > 0 {
            scene.seconds = race.t().max(LEAST_SECONDS);
        }
        scene
    }
}

/// Records the actions on a race as the script of a scene.
struct ScriptRecorder {
    /// The lane numbers at the start. In the scene they are counted from 1.
    lanes: Vec<usize>,
    script: Vec<Scripted>,
}

impl ScriptRecorder {
    fn lane(&self, number: usize) -> usize {
        let place = self.lanes.iter().position(|lane| *lane == number);
        place.expect("a lane is there from the start") + 1
    }

    /// The hash of each lane that is still in the race, with its number in the scene.
    fn hashes(&self, race: &Race) -> Vec<(usize, u64)> {
        let lanes = race.entrants().iter().map(|entrant| self.lane(entrant.lane_number));
        lanes.zip(race.lane_hashes()).collect()
    }
}

impl Observer for ScriptRecorder {
    fn before(&mut self, race: &Race, action: &Action) {
        let action = match (race.switch_asked(action), action) {
            (Some((place, spec)), _) => {
                Action::Lane { lane: self.lane(race.entrants()[place].lane_number), spec }
            }
            (None, Action::Solo { lane }) => Action::Solo { lane: self.lane(*lane) },
            (None, other) => other.clone(),
        };
        self.script.push(Scripted { tick: race.tick(), action });
    }
}
