//! A person's edits to a run, and the scene with these edits applied.
//!
//! A verdict is on the present settings, because a person edits to see their effect. So an edited parameter has its
//! last value from the beginning of the judged scene, and the script no longer sets it.

use std::sync::Arc;

use super::journal::{Author, JournalRow};
use super::run_start::{BodyStart, LaneStart, RunStart};
use super::{Checkpoints, Race};
use crate::scene::{Action, LaneId, Scene, Scripted, nearest_tick};

/// The edits by a person and the script up to the present tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interventions {
    /// Checkpoint from which the scene starts. `None` stands for the run's start.
    start: Option<Arc<RunStart>>,
    /// Last actions on the throttle, on the rudder and on each parameter.
    settings: Vec<Action>,
}

impl Interventions {
    /// Returns the edits in `race` since its checkpoint for verdicts. A parameter that the script set counts like a
    /// person's edit. The script's throttle and rudder are part of the judged motion.
    pub fn in_race(race: &Race, checkpoints: &Checkpoints) -> Self {
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

    /// Like [`Self::in_race`], since the checkpoint for advice.
    pub fn for_advice(race: &Race, checkpoints: &Checkpoints) -> Self {
        Self { start: checkpoints.of_advice.clone(), ..Self::in_race(race, checkpoints) }
    }

    /// Whether the run was not changed since these edits were noted.
    pub fn are_last(&self, checkpoints: &Checkpoints) -> bool {
        self.start == checkpoints.of_verdicts
    }

    /// Returns the edits for a start right after the last edit, so that no later settings remain.
    pub fn after_last_edit(checkpoints: &Checkpoints) -> Self {
        Self { start: checkpoints.of_clouds.clone(), settings: Vec::new() }
    }

    /// Returns the time (s) of the run at which the [edited scene](Self::applied_to) starts.
    pub fn starts_at_s(&self) -> f64 {
        self.start.as_ref().map_or(0.0, |start| start.t)
    }

    /// Returns the run as a scene that starts at the checkpoint. Edited parameters have their last values from the
    /// beginning, and so do a throttle and a rudder set by hand. The script no longer sets any of these.
    pub fn applied_to(&self, scene: &Scene) -> Scene {
        self.started(scene, &[])
    }

    /// Whether a lane was not in the true state at the checkpoint.
    pub fn differ_in(&self, lane: LaneId) -> bool {
        self.lane(lane).is_some()
    }

    fn lane(&self, lane: LaneId) -> Option<&LaneStart> {
        self.start.as_ref()?.lanes.iter().find(|start| start.id == lane)
    }

    /// Like [`Self::applied_to`], from the state that a lane had at the checkpoint.
    pub fn applied_to_lane(&self, scene: &Scene, lane: LaneId) -> Scene {
        self.started(scene, self.lane(lane).map_or(&[], |lane| &lane.bodies))
    }

    fn started(&self, scene: &Scene, lane: &[Option<[Box<[f64]>; 2]>]) -> Scene {
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
                let of_lane = lane.get(body).and_then(Option::as_ref);
                let [q, v] = of_lane.map_or([q, v], |[q, v]| [q, v]).map(Clone::clone);
                at_start.push(Action::Place { body, q, v });
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
