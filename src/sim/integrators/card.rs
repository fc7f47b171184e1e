//! The card on which a method describes itself, and for each family the card that its methods start from.
//!
//! A method's card says what is its own, and takes the rest from its family's: names, source, orders and
//! evaluations are always its own.

use super::tolerance::Tolerance;

/// How a method works, for menus and tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Each stage from values already known.
    Explicit,
    /// Conserves phase-space area on systems without drag.
    Symplectic,
    /// Chooses its own substeps to meet a tolerance.
    Adaptive,
    /// Solves an equation for the end of the step.
    Implicit,
    /// The chapter's listing, faults and all.
    AsPrinted,
}

impl Family {
    /// The family in one lower-case word.
    pub fn id(self) -> &'static str {
        match self {
            Family::Explicit => "explicit",
            Family::Symplectic => "symplectic",
            Family::Adaptive => "adaptive",
            Family::Implicit => "implicit",
            Family::AsPrinted => "as-printed",
        }
    }
}

/// A method's card: what it claims. Every field is measured by `tests/conformance`.
#[derive(Debug)]
pub struct Method {
    /// Kebab-case name in scenes, on the command line and in output.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// What to expect of it, in one line.
    pub about: &'static str,
    /// How it works.
    pub family: Family,
    /// Global order of the error of the whole state, where forces depend on position only. As printed,
    /// `v` may do better than `q`; else both have it.
    pub order: u32,
    /// Global order where forces depend on velocity too.
    pub order_with_drag: u32,
    /// Evaluations of the acceleration in one step, in the long run; `None` where the method decides. A
    /// method with a [restart](Method::restart) owes one more at its first step.
    pub evaluations: Option<u32>,
    /// Whether the one-step map conserves phase-space area on a system without drag.
    pub symplectic: bool,
    /// Whether a step of `-h` undoes a step of `h`, up to round-off.
    pub reversible: bool,
    /// The largest `h ω` at which the undamped oscillator stays bounded; `None` where there is none: for
    /// implicit methods, and for those that choose their own substeps.
    pub stability_limit: Option<f64>,
    /// The error that an adaptive method allows in a substep.
    pub tolerance: Option<Tolerance>,
    /// How the method begins, where it carries something from step to step: at the start, after a kick, a
    /// switch or a change of the step, and whenever it is given a state other than it left. `None` where
    /// it carries nothing.
    pub restart: Option<&'static str>,
    /// Whether a step of `h` always advances by `h`. A method that does not tells
    /// [`System::skipped`](crate::sim::System::skipped) what is missing.
    pub keeps_time: bool,
    /// Where the method comes from.
    pub source: &'static str,
}

impl Method {
    /// Whether this is the chapter's listing with its faults.
    pub fn is_as_printed(&self) -> bool {
        self.family == Family::AsPrinted
    }
}

impl PartialEq for Method {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

/// What most families have in common: nothing conserved, nothing carried, no step size of its own.
const PLAIN: Method = Method {
    id: "",
    name: "",
    about: "",
    family: Family::Explicit,
    order: 0,
    order_with_drag: 0,
    evaluations: None,
    symplectic: false,
    reversible: false,
    stability_limit: None,
    tolerance: None,
    restart: None,
    keeps_time: true,
    source: "",
};

/// An explicit method: an undamped oscillator grows at every step.
pub(super) const EXPLICIT: Method =
    Method { family: Family::Explicit, stability_limit: Some(0.0), ..PLAIN };

/// A symplectic method: the limit is that of one kick and one drift a step.
pub(super) const SYMPLECTIC: Method = Method {
    family: Family::Symplectic,
    symplectic: true,
    reversible: true,
    stability_limit: Some(2.0),
    ..PLAIN
};

/// An adaptive method; its tolerance is its own.
pub(super) const ADAPTIVE: Method = Method {
    family: Family::Adaptive,
    restart: Some("by trying the whole tick as one step"),
    ..PLAIN
};

/// An implicit method.
pub(super) const IMPLICIT: Method = Method { family: Family::Implicit, ..PLAIN };

/// A listing of the chapter: where forces depend on position only, all are semi-implicit Euler.
pub(super) const AS_PRINTED: Method =
    Method { family: Family::AsPrinted, symplectic: true, stability_limit: Some(2.0), ..PLAIN };
