//! A recording run again, past the hashes that it holds.

use std::sync::Arc;

use super::Session;
use super::race::Observer;
use crate::scene::{Check, Scene};

/// A check, and the state of its lane as the race reached it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// Its index among the scene's checks.
    pub row: usize,
    /// The simulated time, in seconds.
    pub t: f64,
    /// The hash of its lane; `None` where the lane has left the race.
    pub hash: Option<u64>,
}

/// The race of a scene, run past all its checks in the order of their ticks.
pub struct Replay {
    session: Session,
    /// The checks that are not reached, the next one last.
    rows: Vec<usize>,
}

impl Replay {
    /// At the start of the race.
    pub fn new(scene: Arc<Scene>) -> Self {
        let mut rows: Vec<usize> = (0..scene.checks.len()).rev().collect();
        rows.sort_by_key(|&row| std::cmp::Reverse(scene.checks[row].tick));
        Self { session: Session::racing(scene), rows }
    }

    /// The scene with its checks.
    pub fn scene(&self) -> &Arc<Scene> {
        self.session.scene()
    }

    /// Whether all checks are reached.
    pub fn is_over(&self) -> bool {
        self.rows.is_empty()
    }

    /// Goes on to the next check, seen by an observer, for at most this many ticks. Returns `None` if it is further, or if
    /// the last is reached.
    pub fn go_on(&mut self, ticks: u64, observer: &mut dyn Observer) -> Option<Reached> {
        let row = *self.rows.last()?;
        let Check { tick, lane, .. } = self.session.scene().checks[row];
        let now = self.session.race().tick();
        let end = tick.min(now.saturating_add(ticks));
        (now..end).for_each(|_| self.session.tick(observer));
        if end < tick {
            return None;
        }
        self.rows.pop();
        let race = self.session.race();
        Some(Reached { row, t: race.t(), hash: race.lane_hash(lane) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_slices_it_reaches_every_check_of_its_recording_with_the_same_hash() {
        let mut session = Session::racing(Scene::built_in("harbour").unwrap().into());
        session.run(100);
        let recording = session.recording(100);
        let mut replay = Replay::new(recording.clone().into());
        let mut reached = Vec::new();
        let mut slices = 0;
        while !replay.is_over() {
            reached.extend(replay.go_on(7, &mut ()));
            slices += 1;
        }
        assert!(slices > 14 && reached.len() == recording.checks.len());
        assert!(reached.iter().all(|it| it.hash == Some(recording.checks[it.row].hash)));
        assert!(reached.is_sorted_by_key(|it| recording.checks[it.row].tick));
    }
}
