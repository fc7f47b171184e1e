//! What a run begins with: a scene as a person has edited it, and the methods, lanes and tick rate that were chosen.

use std::sync::Arc;

use super::action::Action;
use super::equal_cost;
use super::lane_spec::LaneSpec;
use super::race::{Mode, Race};
use super::scene::{LEAST_SECONDS, MOST_SECONDS, Scene, SceneBody, edited_values};
use super::session::Session;

/// What a restart begins with: what a person chose stays, what a script did is not in it.
#[derive(Clone, Debug)]
pub(super) struct Start {
    /// The scene as it was opened.
    pub(super) opened: Arc<Scene>,
    /// The same with the parameters and the length that the person has set.
    pub(super) scene: Arc<Scene>,
    /// The methods, with the substeps and tolerances that the person has given them.
    pub(super) list: Vec<LaneSpec>,
    pub(super) mode: Mode,
    /// The methods of the lanes of a race, by their places on the list.
    lanes: Vec<usize>,
    /// The method flown in solo, which is in a race too, by its place on the list.
    pub(super) entry: usize,
    pub(super) tick_hz: u32,
}

impl Start {
    /// Of a scene as it is written, solo, under the method that it opens with.
    pub(super) fn of(scene: Scene) -> Self {
        let scene =
            Scene { lanes: equal_cost::lanes_that_race(&scene), equal_cost: false, ..scene };
        let opens_with = |spec: &LaneSpec| Some(spec.method) == scene.opening_method;
        let entry = scene.lanes.iter().position(opens_with).unwrap_or(0);
        let scene = Arc::new(scene);
        Self {
            opened: Arc::clone(&scene),
            list: scene.method_list(),
            lanes: (0..scene.lanes.len()).collect(),
            mode: Mode::Solo,
            entry,
            tick_hz: scene.tick_hz,
            scene,
        }
    }

    /// The run at its start.
    pub(super) fn session(&self) -> Session {
        let race = match self.mode {
            Mode::Solo => Race::solo(&self.scene, self.list.clone(), self.entry),
            Mode::Race => {
                let other = (!self.lanes.contains(&self.entry)).then_some(self.entry);
                let lanes = self.lanes.iter().copied().chain(other);
                Race::among(&self.scene, self.list.clone(), lanes)
            }
        };
        Session::new(Arc::clone(&self.scene), race.at_rate(self.tick_hz))
    }

    /// Makes the scene this long, in seconds, if a scene can be.
    pub(super) fn set_seconds(&mut self, seconds: f64) {
        if (LEAST_SECONDS..=MOST_SECONDS).contains(&seconds) && seconds != self.scene.seconds {
            Arc::make_mut(&mut self.scene).seconds = seconds;
        }
    }

    /// Sets a parameter that acts at the start, where it is in its range and fits the others.
    pub(super) fn set(&mut self, body: usize, parameter: usize, value: f64) {
        let SceneBody { kind, values, .. } = &self.scene.bodies[body];
        if values[parameter] != value
            && let Ok(values) = edited_values(kind, values, parameter, value)
        {
            Arc::make_mut(&mut self.scene).bodies[body].values = values;
        }
    }

    /// Takes notice of what a person did in `race`: it holds after a restart too.
    pub(super) fn keep(&mut self, action: &Action, race: &Race) {
        match *action {
            Action::TickHz(_) => self.tick_hz = race.tick_hz(),
            Action::Set { body, parameter, value } => {
                Arc::make_mut(&mut self.scene).bodies[body].values[parameter] = value;
            }
            Action::Method(_)
            | Action::Lane { .. }
            | Action::Substeps { .. }
            | Action::Tolerance { .. } => {
                self.list.copy_from_slice(race.list());
                if race.mode() == Mode::Race {
                    let entries = race.entrants().iter().map(|entrant| entrant.entry);
                    self.lanes.iter_mut().zip(entries).for_each(|(lane, entry)| *lane = entry);
                }
            }
            _ => {}
        }
    }
}
