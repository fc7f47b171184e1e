//! The settings with which a run starts, which are a scene with a person's edits, and the chosen methods, lanes and
//! tick rate.
//!
//! A person's edit applies to the run and to the next start, so that a restart does not lose it. The script's effects
//! are left out, because each run performs the script again.

use std::sync::Arc;

use super::race::{Mode, PerformedAction, Race, Switch, lanes_that_race};
use super::{Menu, MenuIndex, Session};
use crate::scene::{
    Action, LaneId, LaneSpec, MAX_LANES, MAX_SECONDS, MIN_SECONDS, Scene, SceneBody, edited_values,
};
use crate::sim::TickRate;
use crate::sim::integrators::Method;

/// The settings of the next restart. They include a person's choices, but no effects of a script.
#[derive(Clone, Debug)]
pub struct StartSettings {
    /// The scene as it was opened.
    pub opened: Arc<Scene>,
    /// The scene with the person's parameters and length.
    pub scene: Arc<Scene>,
    /// The methods with the person's substeps and tolerances.
    pub list: Vec<LaneSpec>,
    /// Solo or a race.
    pub mode: Mode,
    /// Indices in `list` of a race's lanes.
    lanes: Vec<MenuIndex>,
    /// The methods to which a person has switched lanes of the race, which keep their entries until the restart. Each
    /// is with the lane's index.
    given: Vec<(usize, LaneSpec)>,
    /// Index in `list` of the solo method, which also joins a race.
    pub entry: MenuIndex,
    /// Tick rate at the start.
    pub tick_hz: TickRate,
    /// The lanes before equal cost was switched on; `None` while equal cost is off.
    pub lanes_before_equal_cost: Option<Vec<(LaneId, LaneSpec)>>,
}

impl StartSettings {
    /// Returns the settings of an unedited scene, which opens solo under its opening method.
    pub fn of(scene: Scene) -> Self {
        let scene = Scene { lanes: lanes_that_race(&scene), equal_cost: false, ..scene };
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
            given: Vec::new(),
            lanes_before_equal_cost: None,
            scene,
        }
    }

    /// Creates the settings with which this run began.
    pub(crate) fn of_session(session: &Session) -> Self {
        let menu = Menu::new(session.race());
        let lanes = entries(session.race(), &menu);
        Self {
            mode: session.mode(),
            entry: lanes[0],
            lanes,
            list: menu.specs().to_vec(),
            tick_hz: session.race().tick_hz(),
            ..Self::of((**session.scene()).clone())
        }
    }

    /// Adds a person's own method to the race, in place of one with the same id, and selects it. Returns whether the
    /// race has room for the method's lane.
    pub fn race_own(&mut self, method: &'static Method) -> bool {
        let spec = LaneSpec::plain(method);
        let known = self.list.iter().position(|listed| listed.method.id == method.id);
        if known.is_none() && self.scene.lanes.len() >= MAX_LANES {
            return false;
        }
        self.know_own(method);
        for scene in [&mut self.opened, &mut self.scene] {
            if scene.lanes.iter().all(|lane| lane.method != method) {
                Arc::make_mut(scene).lanes.push(spec);
            }
        }
        let entry = known.unwrap_or(self.list.len());
        match known {
            Some(entry) => self.list[entry] = spec,
            None => self.list.push(spec),
        }
        if !self.lanes.contains(&entry) {
            self.lanes.push(entry);
        }
        (self.entry, self.mode, self.lanes_before_equal_cost) = (entry, Mode::Race, None);
        true
    }

    /// Puts a person's own method in place of an earlier one with the same id.
    pub fn know_own(&mut self, method: &'static Method) {
        for scene in [&mut self.opened, &mut self.scene] {
            Arc::make_mut(scene).know_own(method);
        }
        let specs = self.list.iter_mut().chain(self.given.iter_mut().map(|(_, spec)| spec));
        specs.filter(|spec| spec.method.id == method.id).for_each(|spec| spec.method = method);
    }

    /// Replaces the scene by its changed form, with lanes of the same methods by id. The rate of the new scene applies
    /// if nobody has chosen a rate.
    pub fn reload(&mut self, scene: Scene) {
        if self.tick_hz == self.scene.tick_hz {
            self.tick_hz = scene.tick_hz;
        }
        for spec in self.list.iter_mut().chain(self.given.iter_mut().map(|(_, spec)| spec)) {
            let changed = scene.own_methods.iter().find(|own| own.id == spec.method.id);
            spec.method = changed.copied().unwrap_or(spec.method);
        }
        self.opened = scene.into();
        self.scene = Arc::clone(&self.opened);
    }

    /// Leaves only the methods with these ids in the race. The first is also the solo method.
    pub fn race_only(&mut self, ids: &[&str]) {
        let listed = |id: &&str| self.list.iter().position(|spec| spec.method.id == *id);
        self.lanes = ids.iter().filter_map(listed).collect();
        self.entry = self.lanes.first().copied().unwrap_or(self.entry);
    }

    /// Returns the run at its start.
    pub(crate) fn session(&self) -> Session {
        let race = match self.mode {
            Mode::Solo => Race::solo(&self.scene, self.list.clone(), self.entry),
            Mode::Race => {
                let other = (!self.lanes.contains(&self.entry)).then_some(self.entry);
                let lanes = self.lanes.iter().copied().chain(other);
                let lanes = lanes.map(|entry| self.list[entry]);
                Race::with_methods(&self.scene, self.list.clone(), lanes)
            }
        };
        let race = race.at_rate(self.tick_hz).with_script(&self.scene.script);
        Session::new(Arc::clone(&self.scene), race)
    }

    /// Whether the run starts as the scene was opened, apart from its mode and its solo method.
    pub(crate) fn is_as_opened(&self) -> bool {
        let bodies = self.scene.bodies.iter().zip(&self.opened.bodies);
        self.tick_hz == self.opened.tick_hz
            && bodies.clone().all(|(own, opened)| own.values == opened.values)
    }

    /// Whether both settings have the same length, parameters and methods.
    pub(crate) fn has_same_values(&self, other: &Self) -> bool {
        let bodies = self.scene.bodies.iter().zip(&other.scene.bodies);
        self.scene.seconds == other.scene.seconds
            && bodies.clone().all(|(own, other)| own.values == other.values)
            && (&self.list, &self.given) == (&other.list, &other.given)
    }

    /// Sets the scene's length (s), if the length is in the allowed range. Returns whether the length changed.
    pub fn set_seconds(&mut self, seconds: f64) -> bool {
        let changes =
            (MIN_SECONDS..=MAX_SECONDS).contains(&seconds) && seconds != self.scene.seconds;
        if changes {
            Arc::make_mut(&mut self.scene).seconds = seconds;
        }
        changes
    }

    /// Sets a parameter that acts at the start, if the value is in range and fits the other values. Returns whether the
    /// parameter changed.
    pub fn set(&mut self, body: usize, parameter: usize, value: f64) -> bool {
        let SceneBody { kind, values, .. } = &self.scene.bodies[body];
        if values[parameter] != value
            && let Ok(values) = edited_values(kind, values, parameter, value)
        {
            Arc::make_mut(&mut self.scene).bodies[body].values = values;
            return true;
        }
        false
    }

    /// Applies a person's action in `race` to the next restart.
    pub(super) fn apply_edit(&mut self, done: &PerformedAction, race: &Race, menu: &Menu) {
        match done.action {
            Action::TickHz(_) => self.tick_hz = race.tick_hz(),
            Action::Set { body, parameter, value } => {
                Arc::make_mut(&mut self.scene).bodies[body].values[parameter] = value;
            }
            _ => {}
        }
        let Some(Switch { index, spec, .. }) = done.switch else { return };
        self.list = menu.specs().to_vec();
        if race.mode() == Mode::Race
            && let Some(&entry) = self.lanes.get(index)
        {
            self.given.retain(|(lane, _)| *lane != index);
            self.given.extend((self.list[entry] != spec).then_some((index, spec)));
        }
    }

    /// Gives each lane the entry of the method that it was switched to, because a new run has a new menu.
    pub(super) fn settle(&mut self) {
        for (lane, spec) in std::mem::take(&mut self.given) {
            let entry = self.entry_for(lane, spec);
            if self.entry == self.lanes[lane] {
                self.entry = entry;
            }
            self.lanes[lane] = entry;
        }
    }

    /// Returns the index in the list at which a lane finds `spec`: an entry equal to it, or else one of the same method
    /// that no other lane has, or else a new one.
    fn entry_for(&mut self, lane: usize, spec: LaneSpec) -> MenuIndex {
        let others = || self.lanes.iter().enumerate().filter(|(other, _)| *other != lane);
        let is_free = |entry: &MenuIndex| others().all(|(_, other)| other != entry);
        let own = |entry: &MenuIndex| self.list[*entry].method == spec.method && is_free(entry);
        let equal = self.list.iter().position(|listed| *listed == spec);
        let entry = equal.or_else(|| (0..self.list.len()).find(own)).unwrap_or(self.list.len());
        match self.list.get_mut(entry) {
            Some(listed) => *listed = spec,
            None => self.list.push(spec),
        }
        entry
    }
}

/// Returns the menu index of each lane's method.
fn entries(race: &Race, menu: &Menu) -> Vec<MenuIndex> {
    race.entrants().iter().map(|entrant| menu.entry(entrant.id)).collect()
}
