//! Decides which methods can step a scene, and makes lanes of them.
//!
//! A method that cannot step a body is refused with the reason on its card, and never replaced, because results under
//! another method would mislead. Engines only appear where a scene names one, since they are no methods for a game to
//! implement.

use super::{Scene, SceneBody};
use crate::sim::bodies::incompatibility;
use crate::sim::integrators::{Family, METHODS, Method};
use crate::sim::{Impact, TickRate};
use crate::{Action, LaneSpec};

/// The reason why a method cannot step a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{method} does not step the body {body:?}: {reason}")]
pub struct Refusal {
    /// Id of the method.
    pub method: &'static str,
    /// Name of the first body that the method refuses.
    pub body: String,
    /// The reason, as written on the method's card.
    pub reason: &'static str,
}

impl Scene {
    /// Returns the reason why `method` cannot step this scene; `None` if it steps every body.
    pub fn refusal(&self, method: &Method) -> Option<Refusal> {
        self.bodies.iter().find_map(|SceneBody { name, kind, values, .. }| {
            let reason = incompatibility(method, kind, values)?;
            Some(Refusal { method: method.id, body: name.clone(), reason })
        })
    }

    /// Returns the methods of the table, in its order, and then the scene's own methods, if they step every body.
    /// Methods of libraries only appear if the scene names one of their family.
    pub fn fitting_methods(&self) -> impl Iterator<Item = &'static Method> {
        let is_shown = |method: &&Method| !method.is_of_library() || self.names(method.family);
        let all = METHODS.iter().chain(self.own_methods.iter().copied());
        all.filter(is_shown).filter(|method| self.refusal(method).is_none())
    }

    /// Returns the [methods that fit](Scene::fitting_methods) and are [for a game to implement](Method::is_for_games).
    pub fn methods_for_games(&self) -> impl Iterator<Item = &'static Method> {
        self.fitting_methods().filter(|method| method.is_for_games())
    }

    /// Returns the lanes of these methods in the given order, each method once. The scene's lanes keep their settings;
    /// a method without a lane gets a plain lane.
    pub fn lanes_of(&self, methods: &[&'static Method]) -> Vec<LaneSpec> {
        let mut lanes: Vec<LaneSpec> = Vec::new();
        for &method in methods {
            if lanes.iter().any(|lane| lane.method == method) {
                continue;
            }
            let listed = lanes.len();
            lanes.extend(self.lanes.iter().filter(|lane| lane.method == method));
            if lanes.len() == listed {
                lanes.push(self.plain_lane(method));
            }
        }
        lanes
    }

    /// Returns a plain lane of a method, with the rule for impacts that all lanes of the scene have, if it is one.
    pub fn plain_lane(&self, method: &'static Method) -> LaneSpec {
        let plain = LaneSpec::plain(method);
        let mut rules = self.lanes.iter().map(|lane| lane.impact).filter(|it| it.fits(method));
        match rules.next() {
            Some(first) if rules.all(|other| other == first) => plain.with_impact(first),
            _ => plain,
        }
    }

    /// Returns the scene with a lane for each of its own lanes, or of `methods` if there are any, under each of these
    /// rules for impacts.
    pub fn with_impacts(
        mut self,
        methods: &[&'static Method],
        impacts: &[&'static Impact],
    ) -> Self {
        let own = if methods.is_empty() { self.lanes.clone() } else { self.lanes_of(methods) };
        self.lanes.clear();
        for (lane, impact) in own.iter().flat_map(|lane| impacts.iter().map(move |it| (lane, it))) {
            let lane = LaneSpec { impact, ..*lane };
            if !self.lanes.contains(&lane) {
                self.lanes.push(lane);
            }
        }
        self.hint = None;
        self
    }

    /// Returns the scene at this tick rate. A rate other than the file's drops the hint and the checks, which assume
    /// the file's rate.
    pub fn at_tick_hz(self, tick_hz: impl Into<TickRate>) -> Self {
        let tick_hz = tick_hz.into();
        if tick_hz == self.tick_hz {
            return self;
        }
        Self { tick_hz, hint: None, checks: Vec::new(), ..self }
    }

    /// Returns the scene with the lanes of these methods if there are several. A single method leaves the lanes alone,
    /// except that an engine's method gets a lane. If the lanes change, the hint is dropped, because it is about the
    /// scene's own lanes.
    pub fn with_methods(mut self, methods: &[&'static Method]) -> Self {
        let own = self.lanes.clone();
        if methods.len() > 1 {
            self.lanes = self.lanes_of(methods);
        }
        methods.iter().for_each(|method| self.know_own(method));
        // Methods of libraries only appear in scenes that name one, so they need a lane.
        for &method in methods.iter().filter(|method| method.is_of_library()) {
            if self.lanes.iter().all(|lane| lane.method != method) {
                self.lanes.push(self.plain_lane(method));
            }
        }
        self.hint.take_if(|_| self.lanes != own);
        self
    }

    /// Adds a method in a person's own lines to the scene's [own](Scene::own_methods). The method replaces an earlier
    /// one with the same id, in the lanes too.
    pub fn know_own(&mut self, method: &'static Method) {
        if method.own_text().is_none() {
            return;
        }
        match self.own_methods.iter_mut().find(|own| own.id == method.id) {
            Some(own) => *own = method,
            None => self.own_methods.push(method),
        }
        let earlier = self.lanes.iter_mut().filter(|lane| lane.method.id == method.id);
        earlier.for_each(|lane| lane.method = method);
        self.opening_method =
            self.opening_method.map(|opens| if opens.id == method.id { method } else { opens });
    }

    /// Returns the lane with which the scene opens unless the user names a method.
    pub fn opening_lane(&self) -> &LaneSpec {
        let named = self.lanes.iter().find(|lane| Some(lane.method) == self.opening_method);
        named.or(self.lanes.first()).expect("a scene has a lane")
    }

    /// Returns the lanes that advice considers. For a scene with a source text, these are all its [methods for
    /// games](Scene::methods_for_games), with the substeps of their cards. For a body written in Rust, they are the
    /// scene's own lanes.
    pub fn advised_lanes(&self) -> Vec<LaneSpec> {
        match self.source {
            Some(_) => self.methods_for_games().map(|method| self.plain_lane(method)).collect(),
            None => self.lanes.clone(),
        }
    }

    /// Returns the methods of a family that step every body of this scene.
    pub fn methods_of(&self, family: Family) -> impl Iterator<Item = &'static Method> {
        let all = METHODS.iter().filter(move |method| method.family == family);
        all.filter(|method| self.refusal(method).is_none())
    }

    /// Whether a lane or a scripted action names a method of this family.
    fn names(&self, family: Family) -> bool {
        let mut lanes = self.lanes.iter().map(|lane| lane.method);
        let mut switches = self.script.iter().filter_map(|event| match &event.action {
            Action::Method(method) => Some(*method),
            Action::Lane { spec, .. } => Some(spec.method),
            _ => None,
        });
        lanes.any(|it| it.family == family) || switches.any(|it| it.family == family)
    }
}
