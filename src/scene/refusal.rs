//! Which methods a scene takes and refuses, and why, and the lanes that it has of them.

use super::{Scene, SceneBody};
use crate::scene::{Action, LaneSpec};
use crate::sim::TickRate;
use crate::sim::bodies::incompatibility;
use crate::sim::integrators::{Family, METHODS, Method};

/// Why a method cannot step a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{method} does not step the body {body:?}: {reason}")]
pub struct Refusal {
    /// The method's id.
    pub method: &'static str,
    /// The name of the first body that it refuses.
    pub body: String,
    /// Why, as on the method's card.
    pub reason: &'static str,
}

impl Scene {
    /// Why `method` cannot step this scene; `None` if it steps every body.
    pub fn refusal(&self, method: &Method) -> Option<Refusal> {
        self.bodies.iter().find_map(|SceneBody { name, kind, values, .. }| {
            let reason = incompatibility(method, kind, values)?;
            Some(Refusal { method: method.id, body: name.clone(), reason })
        })
    }

    /// The methods of the table that step every body of this scene, in its order, and then the scene's own. Those of engines
    /// are among them only if the scene names one.
    pub fn fitting_methods(&self) -> impl Iterator<Item = &'static Method> {
        let is_shown = |method: &&Method| !method.is_engine() || self.names_an_engine();
        let all = METHODS.iter().chain(self.own_methods.iter().copied());
        all.filter(is_shown).filter(|method| self.refusal(method).is_none())
    }

    /// The [methods that fit](Scene::fitting_methods) and are [for a game to implement](Method::is_for_games).
    pub fn methods_for_games(&self) -> impl Iterator<Item = &'static Method> {
        self.fitting_methods().filter(|method| method.is_for_games())
    }

    /// The lanes of these methods, substeps and all, in the order named, each once; a plain lane for a method that the scene
    /// does not list.
    pub fn lanes_of(&self, methods: &[&'static Method]) -> Vec<LaneSpec> {
        let mut lanes: Vec<LaneSpec> = Vec::new();
        for &method in methods {
            if lanes.iter().any(|lane| lane.method == method) {
                continue;
            }
            let listed = lanes.len();
            lanes.extend(self.lanes.iter().filter(|lane| lane.method == method));
            if lanes.len() == listed {
                lanes.push(LaneSpec::plain(method));
            }
        }
        lanes
    }

    /// The scene at this tick rate. Its hint, which is of the rate of its file, goes with another.
    pub fn at_tick_hz(self, tick_hz: impl Into<TickRate>) -> Self {
        let tick_hz = tick_hz.into();
        let hint = self.hint.filter(|_| tick_hz == self.tick_hz);
        Self { tick_hz, hint, ..self }
    }

    /// The scene with the lanes of these methods, if there are several; one alone joins the others. Its hint, which is of its
    /// own lanes, goes with others.
    pub fn with_methods(mut self, methods: &[&'static Method]) -> Self {
        let own = self.lanes.clone();
        if methods.len() > 1 {
            self.lanes = self.lanes_of(methods);
        }
        methods.iter().for_each(|method| self.know_own(method));
        // The methods of engines are on the list of no scene that does not name one.
        for &method in methods.iter().filter(|method| method.is_engine()) {
            if self.lanes.iter().all(|lane| lane.method != method) {
                self.lanes.push(LaneSpec::plain(method));
            }
        }
        self.hint.take_if(|_| self.lanes != own);
        self
    }

    /// Adds a method to the scene's [own](Scene::own_methods) if it is one by a person's lines. It takes the place of one of
    /// its id.
    pub(crate) fn know_own(&mut self, method: &'static Method) {
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

    /// The lane that the scene opens with if no method is named.
    pub fn opening_lane(&self) -> &LaneSpec {
        let named = self.lanes.iter().find(|lane| Some(lane.method) == self.opening_method);
        named.or(self.lanes.first()).expect("a scene has a lane")
    }

    /// The lanes that advice is on: those of a body that is written in Rust, and of any other scene each of the
    /// [methods for games](Scene::methods_for_games), with its card's substeps.
    pub fn advised_lanes(&self) -> Vec<LaneSpec> {
        match self.source {
            Some(_) => self.methods_for_games().map(LaneSpec::plain).collect(),
            None => self.lanes.clone(),
        }
    }

    /// The methods of a family that step every body of this scene.
    pub fn methods_of(&self, family: Family) -> impl Iterator<Item = &'static Method> {
        let all = METHODS.iter().filter(move |method| method.family == family);
        all.filter(|method| self.refusal(method).is_none())
    }

    /// Whether a lane or an action of the script is under the method of an engine.
    fn names_an_engine(&self) -> bool {
        let mut lanes = self.lanes.iter().map(|lane| lane.method);
        let mut switches = self.script.iter().filter_map(|event| match &event.action {
            Action::Method(method) => Some(*method),
            Action::Lane { spec, .. } => Some(spec.method),
            _ => None,
        });
        lanes.any(Method::is_engine) || switches.any(Method::is_engine)
    }
}
