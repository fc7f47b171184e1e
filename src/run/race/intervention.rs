//! The changes to a run by which it is told, and the scene that a run so changed continues.

use std::sync::Arc;

use super::journal::{Author, JournalRow};
use super::{BodyStart, Race, RunStart, Starts};
use crate::scene::{Action, Scene, Scripted, nearest_tick};

/// What a person and the script have changed in a run by its present tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Interventions {
    /// From where the run is told, unless it is from its start.
    start: Option<Arc<RunStart>>,
    /// The last action on the throttle, on the rudder and on each parameter.
    settings: Vec<Action>,
}

impl Interventions {
    /// The changes in `race`, whose run is told from `starts`, by which it is judged. A parameter that the script has set is in
    /// force like one that a person has set; what the script does to throttle, rudder and state is part of the motion that
    /// is judged.
    pub(crate) fn in_race(race: &Race, starts: &Starts) -> Self {
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
        Self { start: starts.judged.clone(), settings }
    }

    /// All changes: the run is told from right after the last one on.
    pub(crate) fn all(starts: &Starts) -> Self {
        Self { start: starts.cloud.clone(), settings: Vec::new() }
    }

    /// The time of the run at which the scene begins that it is [applied to](Self::applied_to), in seconds.
    pub(crate) fn starts_at_s(&self) -> f64 {
        self.start.as_ref().map_or(0.0, |start| start.t)
    }

    /// The run as a scene of its own, from where it is told.
    /// Parameters that have been set, and a throttle and a rudder that were set by hand, have their last values from the
    /// beginning, and the script does not set them.
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
