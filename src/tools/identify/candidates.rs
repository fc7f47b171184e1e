//! What may have made a log: the methods of the table, each under several counts of substeps.

use std::fmt;

use super::logged::LoggedBody;
use crate::sim::integrators::{JointMode, METHODS, Method};

/// How a method is told of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpringAs {
    /// As a part of the acceleration; also where there is no spring.
    Acceleration,
    /// As a joint of an engine, in this way or one that does the same.
    Joint(&'static JointMode),
    /// As a force of user code, which is read once a tick and held through it.
    HeldForce,
}

/// A method with what a lane would say of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The method.
    pub method: &'static Method,
    /// Its substeps.
    pub substeps: u32,
    /// How it is told of the spring.
    pub spring: SpringAs,
}

/// Its id, its substeps, and how it is told of the spring where that is not the engine's first way.
impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ×{}", self.method.id, self.substeps)?;
        self.told().map_or(Ok(()), |told| write!(f, ", {told}"))
    }
}

/// The substeps that people set of an engine.
const USUAL_OF_ENGINES: &[u32] = &[1, 2, 4, 8, 16];
/// The substeps that people set of a method of their own.
const USUAL: &[u32] = &[1, 2, 4];
/// The most substeps that are tried.
const MAX_SUBSTEPS: u32 = 16;

/// Twice the logarithm of the odds against a spring's force that is held in an engine.
const HELD_RARITY: f64 = 12.0;
/// Twice the logarithm of the odds against an engine that is not set by default.
const CHANGED_ENGINE_RARITY: f64 = 8.0;
/// Twice the logarithm of the odds against substeps of a method that a game implements itself.
const CHANGED_METHOD_RARITY: f64 = 20.0;
/// Twice the logarithm of the odds against a count of substeps that few set.
const UNUSUAL_SUBSTEPS_RARITY: f64 = 24.0;

impl Candidate {
    /// Whether people set this count of substeps: a power of 2, not too high, or what the engine has by default.
    fn is_usual(&self) -> bool {
        let usual = if self.method.is_engine() { USUAL_OF_ENGINES } else { USUAL };
        usual.contains(&self.substeps) || self.substeps == self.method.default_substeps
    }

    /// How the engine is told of the spring, if not in its first way: words for a force that is held where it could be a
    /// joint, or the mode of the joint.
    pub fn told(&self) -> Option<&'static str> {
        match self.spring {
            SpringAs::HeldForce if !self.method.holds_force() => Some("force held"),
            SpringAs::Joint(mode) if mode.is_explicit => Some(mode.id),
            _ => None,
        }
    }

    /// Whether the game applies the spring as a force of its own, and not as a joint of the engine.
    pub fn is_held(&self) -> bool {
        self.spring == SpringAs::HeldForce
    }

    /// Whether it has its method's default substeps, and is not a listing of the book.
    fn is_as_set(&self) -> bool {
        self.substeps == self.method.default_substeps && !self.method.is_as_printed()
    }

    /// What is added to twice the logarithm of the likelihood that something else made a log.
    pub(super) fn rarity(&self) -> f64 {
        let is_rare = self.is_held() && !self.method.holds_force();
        let held = if is_rare { HELD_RARITY } else { 0.0 };
        let set = match (self.is_as_set(), self.is_usual(), self.method.is_engine()) {
            (true, ..) => 0.0,
            (false, true, true) => CHANGED_ENGINE_RARITY,
            (false, true, false) => CHANGED_METHOD_RARITY,
            (false, false, _) => UNUSUAL_SUBSTEPS_RARITY,
        };
        held + set
    }

    /// Which comes first among candidates that do the same: an engine as it is set by default, then any engine.
    pub(super) fn preference(&self) -> (bool, bool, bool, bool, u32, Option<usize>) {
        let is_as_set = self.method.is_engine() && self.is_as_set();
        let is_told = self.told().is_some();
        let index = METHODS.iter().position(|method| method.id == self.method.id);
        (!is_as_set, !self.is_usual(), is_told, !self.method.is_engine(), self.substeps, index)
    }
}

/// The ways of telling a method of a body's spring under which it moves differently: of an engine its joints, by the modes
/// that `port` inverts, and a held force.
fn ways(method: &Method, body: &LoggedBody) -> Vec<SpringAs> {
    if method.holds_force() {
        return vec![SpringAs::HeldForce];
    }
    if !method.is_engine() || !body.has_spring() {
        return vec![SpringAs::Acceleration];
    }
    let modes = method.engine.map_or(&[][..], |engine| engine.modes);
    let first = |is_explicit| modes.iter().find(|mode| mode.is_explicit == is_explicit);
    let joints = [false, true].into_iter().filter_map(first).map(SpringAs::Joint);
    joints.chain([SpringAs::HeldForce]).collect()
}

/// All candidates for a body; those with usual counts only where its spring is not known.
pub(super) fn candidates(body: &LoggedBody) -> Vec<Candidate> {
    let mut all = Vec::new();
    let stepped = METHODS.iter().filter(|method| method.tolerance.is_none());
    for method in stepped.filter(|method| method.only.is_none() || method.is_engine()) {
        for spring in ways(method, body) {
            let of = |substeps| Candidate { method, substeps, spring };
            all.extend((1..=MAX_SUBSTEPS).map(of));
        }
    }
    all.retain(|candidate| body.spring.is_some() || candidate.is_usual());
    all
}
