//! A scene's script by time, gone through once.

use std::sync::Arc;

use crate::scene::{Action, Scene};

/// The actions of a script that are still to be done.
#[derive(Clone)]
pub(super) struct TimedScript {
    /// By time in seconds.
    rows: Arc<[(f64, Action)]>,
    done: usize,
}

impl TimedScript {
    /// All of a scene's script.
    pub(super) fn new(scene: &Scene) -> Self {
        let rows = scene.timed_script().map(|(t, action)| (t, action.clone()));
        Self { rows: rows.collect(), done: 0 }
    }

    /// The next action that is due by `t` (s), with its time.
    pub(super) fn next_due(&mut self, t: f64) -> Option<(f64, Action)> {
        let due = self.rows.get(self.done).filter(|(at, _)| *at <= t).cloned();
        self.done += usize::from(due.is_some());
        due
    }
}
