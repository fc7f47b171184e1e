//! Logs the state of every lane at regular ticks and at the end, for the manifest.

use serde_json::{Map, Value, json};

use crate::run::race::{Entrant, Observer, Race};
use crate::run::{self, MAX_CHECKS, METRICS, RecordingError};
use crate::scene::{Check, MAX_FILE_BYTES, Scene};
use crate::studio::Studio;

/// Default number of marks in a run. They locate a difference to within a few ticks, and keep the manifest of a race
/// below a megabyte.
const USUAL_MARKS: u64 = 500;

/// Bytes of a check in a scene file, at most.
const CHECK_BYTES: usize = 90;

/// Returns the default number of ticks between two marks, for a run of `ticks` ticks.
pub(super) fn usual_stride(ticks: u64) -> u64 {
    ticks.div_ceil(USUAL_MARKS).max(1)
}

/// The states of a run's lanes, from its start on.
#[derive(Debug)]
pub(super) struct StateLog {
    every: u64,
    checks: Vec<Check>,
}

impl StateLog {
    /// Starts a log with the present state.
    pub(super) fn new(every: u64, race: &Race) -> Self {
        Self { every, checks: checks(race).collect() }
    }

    /// Returns all states. The last ones are the present ones.
    pub(super) fn close(mut self, race: &Race) -> Vec<Check> {
        if self.checks.last().is_none_or(|last| last.tick != race.tick()) {
            self.checks.extend(checks(race));
        }
        self.checks
    }
}

impl Observer for StateLog {
    fn ticked(&mut self, race: &Race) {
        if race.tick().is_multiple_of(self.every) {
            self.checks.extend(checks(race));
        }
    }
}

fn checks(race: &Race) -> impl Iterator<Item = Check> {
    let lanes = race.entrants().iter().zip(race.lane_hashes());
    lanes.map(|(entrant, hash)| Check { tick: race.tick(), lane: entrant.id, hash })
}

/// Returns the text of `scene` with those of the `checks` after its own for which a scene file has room. Those of the
/// last tick stay.
pub(super) fn recording_text(scene: &Scene, checks: &[Check]) -> Result<String, RecordingError> {
    let mut scene = scene.clone();
    let room = MAX_FILE_BYTES.saturating_sub(scene.to_saved_toml().len()) / CHECK_BYTES;
    let every = checks.len().div_ceil(room.clamp(1, MAX_CHECKS)).max(1);
    let ticks = checks.chunk_by(|one, next| one.tick == next.tick).rev().step_by(every);
    let kept: Vec<&[Check]> = ticks.collect();
    scene.checks.extend(kept.into_iter().rev().flatten());
    run::recording_text(&scene)
}

/// Returns the state of each lane at the end, with its metrics against the truth.
pub(super) fn ends(studio: &Studio) -> Vec<Value> {
    let race = studio.race();
    let end = |(entrant, hash): (&Entrant, u64)| {
        let lane = &entrant.lane;
        let bodies = lane.bodies().iter().zip(race.truth().bodies()).zip(&studio.scene().bodies);
        let bodies = bodies.map(|((body, truth), named)| {
            let metrics =
                METRICS.iter().map(|metric| (metric.id, (metric.measure)(body, truth).into()));
            let mut entry = Map::from_iter(metrics.map(|(id, value)| (id.to_owned(), value)));
            entry.insert("name".into(), Value::from(&*named.name));
            entry.insert("halted".into(), body.halted().map(|halt| halt.tick).into());
            entry
        });
        json!({
            "method": lane.solver().method().map_or("exact", |method| method.id),
            "substeps": lane.substeps(),
            "hash": format!("{hash:016x}"),
            "halted": lane.halted().map(|halt| halt.tick),
            "bodies": bodies.collect::<Vec<_>>(),
        })
    };
    race.entrants().iter().zip(race.lane_hashes()).map(end).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::LaneId;

    #[test]
    fn states_are_logged_at_the_start_at_each_stride_and_at_the_end() {
        for (every, expected) in [(1, vec![0, 1, 2, 3, 4, 5, 6, 7]), (3, vec![0, 3, 6, 7])] {
            let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
            let mut state_log = StateLog::new(every, studio.race());
            studio.advance_in_time(7, 200_000_000, &mut || true, &mut state_log);
            let checks = state_log.close(studio.race());
            assert_eq!(checks.iter().map(|check| check.tick).collect::<Vec<_>>(), expected);
            assert_eq!(Some(checks.last().unwrap().hash), studio.race().lane_hashes().next());
        }
    }

    #[test]
    fn a_recording_holds_as_many_states_as_a_scene_file_and_always_the_last() {
        let scene = Scene::built_in("harbour").unwrap();
        let check =
            |n: u64| Check { tick: n / 2, lane: LaneId::of_index((n % 2) as usize), hash: n };
        for count in [2, 100, 100_000] {
            let checks: Vec<Check> = (0..count).map(check).collect();
            let text = recording_text(&scene, &checks).unwrap();
            let kept = Scene::parse("x", &text).unwrap().checks;
            assert_eq!(kept[kept.len() - 2..], checks[checks.len() - 2..]);
            assert!(kept.is_sorted_by_key(|check| check.tick));
            assert!(kept.len() == checks.len() || (4_000..=MAX_CHECKS).contains(&kept.len()));
        }
    }

    #[test]
    fn the_usual_stride_makes_at_most_some_five_hundred_marks() {
        for (ticks, stride) in [(0, 1), (500, 1), (501, 2), (1200, 3), (1_000_000, 2000)] {
            assert_eq!(usual_stride(ticks), stride, "{ticks}");
        }
    }
}
