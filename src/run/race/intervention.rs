//! A person's edits to a run, and the scene with these edits applied.

use std::sync::Arc;

use super::journal::{Author, JournalRow};
use super::{BodyStart, Checkpoints, Race, RunStart};
use crate::scene::{Action, Scene, Scripted, nearest_tick};

/// The edits by a person and the script up to the present tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Interventions {
    /// Checkpoint from which the scene starts. `None` stands for the run's start.
    start: Option<Arc<RunStart>>,
    /// Last actions on the throttle, on the rudder and on each parameter.
    settings: Vec<Action>,
}

impl Interventions {
    /// Returns the edits in `race` since its checkpoint for verdicts. A parameter that the script set counts like a
    /// person's edit. The script's throttle, rudder and state changes are part of the judged motion.
    pub(crate) fn in_race(race: &Race, checkpoints: &Checkpoints) -> Self {
        let mut settings: Vec<Action> = Vec::new();
        let is_in_force = |row: &&JournalRow| {
            row.author == Author::Person || matches!(row.action, Action::Set { .. })
        };
        for row in race.journal().rows()[..race.done()].iter().filter(is_in_force).rev() {
            let acts_on_bodies =
                matches!(row.action, Action::Throttle(_) | Action::Rudder(_) | Action::Set { .. });
            let control = row.action.control();
            if acts_on_bodies && settings.iter().all(|later| later.control() != control) {
                settings.push(row.action.clone());
            }
        }
        Self { start: checkpoints.of_verdicts.clone(), settings }
    }

    /// Returns the edits for a start right after the last edit, so that no later settings remain.
    pub(crate) fn after_last_edit(checkpoints: &Checkpoints) -> Self {
        Self { start: checkpoints.of_clouds.clone(), settings: Vec::new() }
    }

    /// Returns the time (s) of the run at which the [edited scene](Self::applied_to) starts.
    pub(crate) fn starts_at_s(&self) -> f64 {
        self.start.as_ref().map_or(0.0, |start| start.t)
    }

    /// Returns the run as a scene that starts at the checkpoint. Edited parameters have their last values from the
    /// beginning, and so do a throttle and a rudder set by hand. The script no longer sets any of these.
    pub(crate) fn applied_to(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        let mut at_start = Vec::new();
        if let Some(start) = &self.start {
            scene.tick_hz = start.tick_hz;
            scene.script.iter_mut().for_each(|scripted| scripted.at_s -= start.t);
            scene.script.retain(|to_come| nearest_tick(to_come.at_s, start.tick_hz) > 0);
            at_start.push(Action::Throttle(start.throttle));
            at_start.push(Action::Rudder(start.rudder));
            for (body, BodyStart { values, q, v }) in start.bodies.iter().enumerate() {
                scene.bodies[body].values.clone_from(values);
                at_start.push(Action::Place { body, q: q.clone(), v: v.clone() });
            }
        }
        for setting in &self.settings {
            scene.script.retain(|scripted| scripted.action.control() != setting.control());
            match *setting {
                Action::Set { body, parameter, value } => {
                    scene.bodies[body].values[parameter] = value;
                }
                _ => at_start.push(setting.clone()),
            }
        }
        let at_start = at_start.into_iter().map(|action| Scripted { at_s: 0.0, action });
        scene.script.splice(0..0, at_start);
        scene
    }
}
