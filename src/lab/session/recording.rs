//! A run as a scene: what it began with, what was done, and what it came to.

use super::Session;
use crate::lab::action::Action;
use crate::lab::race::{Observer, Race};
use crate::lab::scene::{Check, LARGEST_FILE, LEAST_SECONDS, Scene, Scripted};

/// The most checks of a recording: with more, its file would be too large to read. They are then made more rarely than
/// every second.
const MOST_CHECKS: usize = 8_000;

/// A second that has passed but for this part of it has passed, in seconds: times may be off by their last bits.
const ON_TIME_S: f64 = 1e-6;

/// A recording that no program would read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "so much was done in this run that its file would hold {bytes} bytes, and a scene file may hold {LARGEST_FILE}; record a shorter run"
)]
pub struct RecordingTooLong {
    /// What its file would hold.
    pub bytes: usize,
}

impl Session {
    /// The text of the [recording](Session::recording) to tick `end`.
    ///
    /// # Errors
    /// If it is too long for a scene file.
    pub fn recording_text(&self, end: u64) -> Result<String, RecordingTooLong> {
        let text = self.recording(end).to_toml();
        let bytes = text.len();
        if bytes > LARGEST_FILE { Err(RecordingTooLong { bytes }) } else { Ok(text) }
    }

    /// A scene whose race is this run from its start to tick `end`, done again to the bit: with the parameters, lanes
    /// and rate of its start, all that was done as its script, and a [`Check`] of every lane in every second and at the
    /// end. Runs all of it again.
    ///
    /// What the script does to a lane by its method's name alone is written as done to that lane, so that it is done
    /// in a race too.
    pub fn recording(&self, end: u64) -> Scene {
        let mut run = self.at_start();
        let lanes: Vec<usize> = run.race.entrants().iter().map(|e| e.lane_number).collect();
        let specs = run.race.entrants().iter().map(|entrant| run.race.list()[entrant.entry]);
        let mut scene = Scene {
            lanes: specs.collect(),
            tick_hz: run.race.tick_hz(),
            opening_method: None,
            equal_cost: false,
            script: Vec::new(),
            checks: Vec::new(),
            hint: None,
            ..(*self.scene).clone()
        };
        run.race.set_journal(self.journal().clone());

        let mut writer = Writer { lanes, script: Vec::new() };
        let (mut next_s, mut checks) = (1.0, Vec::new());
        while run.race.tick() < end {
            run.race.step_seen(&mut writer);
            let (tick, t) = (run.race.tick(), run.race.t() + ON_TIME_S);
            if t >= next_s && tick < end {
                checks.push((tick, writer.hashes(&run.race)));
                next_s = libm::floor(t) + 1.0;
            }
        }
        let every = (checks.len() * writer.lanes.len()).div_ceil(MOST_CHECKS).max(1);
        let kept = checks.into_iter().skip(every - 1).step_by(every);
        let at_end = (end, writer.hashes(&run.race));
        // What was done as the end was reached, after what was checked there.
        run.race.catch_up(&mut writer);
        for (tick, hashes) in kept.chain([at_end]) {
            let check = |(lane, hash)| Check { tick, lane, hash };
            scene.checks.extend(hashes.into_iter().map(check));
        }
        scene.script = writer.script;
        scene.seconds = run.race.t().max(LEAST_SECONDS);
        scene
    }
}

/// Writes down what is done to a race, as the race of a scene has it.
struct Writer {
    /// The numbers of the lanes at the start: in the scene they are counted from 1.
    lanes: Vec<usize>,
    script: Vec<Scripted>,
}

impl Writer {
    fn lane(&self, number: usize) -> usize {
        let place = self.lanes.iter().position(|lane| *lane == number);
        place.expect("a lane is there from the start") + 1
    }

    /// The hash of each lane that is still there, with its number in the scene.
    fn hashes(&self, race: &Race) -> Vec<(usize, u64)> {
        let lanes = race.entrants().iter().map(|entrant| self.lane(entrant.lane_number));
        lanes.zip(race.lane_hashes()).collect()
    }
}

impl Observer for Writer {
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
