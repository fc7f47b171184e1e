//! Logs the state of every lane at regular ticks and at the end, for the manifest.

use serde_json::{Map, Value};

use super::manifest::{LaneEnd, LaneMark, Mark};
use crate::run::METRICS;
use crate::run::race::{Observer, Race};
use crate::sim::Solver;
use crate::studio::Studio;

/// Default number of marks in a run. They locate a difference to within a few ticks, and keep the manifest of a race
/// below a megabyte.
const USUAL_MARKS: u64 = 500;

/// Returns the default number of ticks between two marks, for a run of `ticks` ticks.
pub(super) fn usual_stride(ticks: u64) -> u64 {
    ticks.div_ceil(USUAL_MARKS).max(1)
}

/// The marks of a run, from its start on.
#[derive(Debug)]
pub(super) struct StateLog {
    every: u64,
    marks: Vec<Mark>,
}

impl StateLog {
    /// Starts a log with a mark of the present state.
    pub(super) fn new(every: u64, race: &Race) -> Self {
        Self { every, marks: vec![mark(race)] }
    }

    /// Returns all marks. The last one is that of the present state.
    pub(super) fn close(mut self, race: &Race) -> Vec<Mark> {
        if self.marks.last().is_none_or(|last| last.tick != race.tick()) {
            self.marks.push(mark(race));
        }
        self.marks
    }
}

impl Observer for StateLog {
    fn ticked(&mut self, race: &Race) {
        if race.tick().is_multiple_of(self.every) {
            self.marks.push(mark(race));
        }
    }
}

fn mark(race: &Race) -> Mark {
    let lanes = race.entrants().iter().zip(race.lane_hashes()).map(|(entrant, hash)| {
        let bodies = entrant.lane.bodies().iter();
        LaneMark {
            hash: format!("{hash:016x}"),
            q: bodies.clone().map(|body| body.stepper.q().to_vec()).collect(),
            v: bodies.map(|body| body.stepper.v().to_vec()).collect(),
        }
    });
    Mark { tick: race.tick(), lanes: lanes.collect() }
}

/// Returns the state of each lane at the end, with its metrics against the truth.
pub(super) fn ends(studio: &Studio) -> Vec<LaneEnd> {
    let race = studio.race();
    let end = |(entrant, hash): (&crate::run::race::Entrant, u64)| {
        let lane = &entrant.lane;
        let bodies = lane.bodies().iter().zip(race.truth().bodies()).zip(&studio.scene().bodies);
        let bodies = bodies.map(|((body, truth), named)| {
            let mut entry = Map::from_iter([
                ("name".to_owned(), Value::from(&*named.name)),
                ("halted".to_owned(), body.halted().map(|halt| halt.tick).into()),
            ]);
            for metric in METRICS {
                let value = (metric.measure)(body, truth);
                entry.insert(metric.id.to_owned(), value.into());
            }
            entry
        });
        LaneEnd {
            method: method_id(lane.solver()).to_owned(),
            substeps: lane.substeps(),
            hash: format!("{hash:016x}"),
            halted: lane.halted().map(|halt| halt.tick),
            bodies: bodies.collect(),
        }
    };
    race.entrants().iter().zip(race.lane_hashes()).map(end).collect()
}

fn method_id(solver: Solver) -> &'static str {
    solver.method().map_or("exact", |method| method.id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn marks_are_made_at_the_start_at_each_stride_and_at_the_end() {
        for (every, expected) in [(1, vec![0, 1, 2, 3, 4, 5, 6, 7]), (3, vec![0, 3, 6, 7])] {
            let mut studio = Studio::new(Scene::built_in("harbour").unwrap());
            let mut state_log = StateLog::new(every, studio.race());
            studio.advance_in_time(7, 200_000_000, &mut || true, &mut state_log);
            let marks = state_log.close(studio.race());
            assert_eq!(marks.iter().map(|mark| mark.tick).collect::<Vec<_>>(), expected);
            let last = &marks.last().unwrap().lanes[0];
            assert_eq!(last.hash, format!("{:016x}", studio.race().state_hash()));
            assert_eq!(last.q.len(), studio.scene().bodies.len());
        }
    }

    #[test]
    fn the_usual_stride_makes_at_most_some_five_hundred_marks() {
        for (ticks, stride) in [(0, 1), (500, 1), (501, 2), (1200, 3), (1_000_000, 2000)] {
            assert_eq!(usual_stride(ticks), stride, "{ticks}");
        }
    }
}
