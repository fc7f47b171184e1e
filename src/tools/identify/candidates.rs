//! The candidates for the origin of a log: the methods of the table, each with several numbers of substeps, and forms.

use std::fmt;

use super::forms::forms;
use super::logged::LoggedBody;
use crate::sim::integrators::{JointMode, METHODS, Method};

/// How a method applies the body's spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpringForm {
    /// The method applies the spring as a part of the acceleration. This is also the value if there is no spring.
    Acceleration,
    /// The method applies the spring as an engine's joint in this mode, or in an equivalent mode.
    Joint(&'static JointMode),
    /// The method applies the spring as a force of user code, which is read once a tick and held through the tick.
    HeldForce,
}

/// A method with its settings, as a lane would name them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The method.
    pub method: &'static Method,
    /// Number of substeps per tick.
    pub substeps: u32,
    /// How the method applies the spring.
    pub spring: SpringForm,
}

/// Writes the id, the substeps and the way in which the method applies the spring. This way is left out if it is the
/// engine's first one.
impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ×{}", self.method.id, self.substeps)?;
        self.spring_label().map_or(Ok(()), |told| write!(f, ", {told}"))
    }
}

/// Numbers of substeps that people set in engines.
const USUAL_OF_ENGINES: &[u32] = &[1, 2, 4, 8, 16];
/// Numbers of substeps that people set for a method of their own.
const USUAL: &[u32] = &[1, 2, 4];
const MAX_SUBSTEPS: u32 = 16;

/// Twice the log-odds against an engine that holds a spring's force through the tick.
const HELD_RARITY: f64 = 12.0;
/// Twice the log-odds against an engine with a usual number of substeps other than its default.
const CHANGED_ENGINE_RARITY: f64 = 8.0;
/// Twice the log-odds against substeps in a method that a game implements itself.
const CHANGED_METHOD_RARITY: f64 = 20.0;
/// Twice the log-odds against a step by hand that no method takes.
const FORM_RARITY: f64 = 14.0;
/// Twice the log-odds against a number of substeps that few people set.
const UNUSUAL_SUBSTEPS_RARITY: f64 = 24.0;

impl Candidate {
    /// Whether people set this number of substeps, which is a small power of 2, or the method's default.
    fn is_usual(&self) -> bool {
        let usual = if self.method.is_engine() { USUAL_OF_ENGINES } else { USUAL };
        usual.contains(&self.substeps) || self.substeps == self.method.default_substeps
    }

    /// Returns a label of the way in which the spring is applied, unless it is the engine's first way. The label is
    /// `force held` if a joint was possible, or the id of the joint's mode.
    pub fn spring_label(&self) -> Option<&'static str> {
        match self.spring {
            SpringForm::HeldForce if !self.method.holds_force() => Some("force held"),
            SpringForm::Joint(mode) if mode.is_explicit => Some(mode.id),
            _ => None,
        }
    }

    /// Whether the game applies the spring as a force of its own, and not as a joint of the engine.
    pub fn is_held(&self) -> bool {
        self.spring == SpringForm::HeldForce
    }

    /// Whether the candidate has its method's default substeps, and is not a listing of the book.
    fn is_as_set(&self) -> bool {
        self.substeps == self.method.default_substeps && !self.method.is_as_printed()
    }

    /// Returns the penalty on the deviance for rare settings, which is twice the log-odds that something else made a
    /// log.
    pub(super) fn rarity(&self) -> f64 {
        let is_rare = self.is_held() && !self.method.holds_force();
        let held = if is_rare { HELD_RARITY } else { 0.0 };
        let set = match (self.is_as_set(), self.is_usual(), self.method.is_engine()) {
            (true, ..) => 0.0,
            (false, true, true) => CHANGED_ENGINE_RARITY,
            (false, true, false) => CHANGED_METHOD_RARITY,
            (false, false, _) => UNUSUAL_SUBSTEPS_RARITY,
        };
        held + set + if self.method.own_text().is_some() { FORM_RARITY } else { 0.0 }
    }

    /// Returns the sort key of equivalent candidates. Default engines come first, then usual substeps, the engine's
    /// first way to apply the spring, and other engines.
    pub(super) fn preference(&self) -> (bool, bool, bool, bool, u32, usize) {
        let is_as_set = self.method.is_engine() && self.is_as_set();
        let is_told = self.spring_label().is_some();
        let index = METHODS.iter().position(|method| method.id == self.method.id);
        let index = index.unwrap_or(METHODS.len());
        (!is_as_set, !self.is_usual(), is_told, !self.method.is_engine(), self.substeps, index)
    }
}

/// Returns the ways to apply the body's spring under which the method moves differently. For an engine these are its
/// first joint of each kind, explicit or not, and a held force.
fn spring_forms(method: &Method, body: &LoggedBody) -> Vec<SpringForm> {
    if method.holds_force() {
        return vec![SpringForm::HeldForce];
    }
    if !method.is_engine() || !body.has_spring() {
        return vec![SpringForm::Acceleration];
    }
    let modes = method.engine.map_or(&[][..], |engine| engine.modes);
    let first = |is_explicit| modes.iter().find(|mode| mode.is_explicit == is_explicit);
    let joints = [false, true].into_iter().filter_map(first).map(SpringForm::Joint);
    joints.chain([SpringForm::HeldForce]).collect()
}

/// Returns all candidates for a body. If the body's spring is unknown, only candidates with usual substeps are
/// returned.
pub(super) fn candidates(body: &LoggedBody) -> Vec<Candidate> {
    let mut all = Vec::new();
    let stepped = METHODS.iter().filter(|method| method.tolerance.is_none());
    for method in stepped.filter(|method| method.only.is_none() || method.is_engine()) {
        for spring in spring_forms(method, body) {
            let of = |substeps| Candidate { method, substeps, spring };
            all.extend((1..=MAX_SUBSTEPS).map(of));
        }
    }
    all.retain(|candidate| body.spring.is_some() || candidate.is_usual());
    let form = |method: &&'static Method| Candidate {
        method,
        substeps: 1,
        spring: SpringForm::Acceleration,
    };
    all.extend(forms().iter().map(form));
    all
}
