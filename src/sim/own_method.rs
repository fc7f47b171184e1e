//! Methods made of a person's own lines, with measured cards.
//!
//! Lines make no claims, so that the card of a method is measured, unless it needs a target or a joint. Then menus,
//! advice and refusals treat them as they do any other method.
//!
//! The list [`KNOWN`] holds all lines that have become a method, with their ids and cards. Lanes name methods by
//! `&'static`, so that an entry stays where it is until the process ends. Equal lines under one id are one entry, and
//! only lines without a fault are listed: a file that is edited for a day fills some hundred entries of a few KB.

use std::sync::{Arc, OnceLock};

use super::conformance;
use super::integrators::step_method::StepMethod;
use super::integrators::step_rule::StepRule;
use super::integrators::{
    AnyIntegrator, BuildIntegrator, Family, METHODS, Method, Needs, Only, integrator,
};
use super::law::{ExpressionFault, Input, LinearRule, RuleBody, StepText};
use super::state::State;
use super::system::{Coupling, System};
use super::tick_rate::TickRate;

/// The maximum number of characters in the id of an own method.
pub const MAX_OWN_ID_CHARS: usize = 64;

/// Lines of a person's own that step a body.
#[derive(Clone, Debug)]
pub enum OwnLines {
    /// A method, which calls the acceleration.
    Method(Arc<StepText>),
    /// A rule, which is the whole motion.
    Rule(Arc<LinearRule>),
}

impl OwnLines {
    fn lines(&self) -> &StepText {
        match self {
            Self::Method(text) => text,
            Self::Rule(rule) => rule.text(),
        }
    }
}

impl BuildIntegrator for OwnLines {
    fn build(&self, coordinates: usize, coupling: Coupling) -> Box<dyn AnyIntegrator> {
        match self {
            Self::Method(text) => Box::new(StepMethod::of(text.clone(), coordinates, coupling)),
            Self::Rule(rule) => Box::new(StepRule::of(rule.clone(), coordinates)),
        }
    }

    fn text(&self) -> Option<&str> {
        Some(self.lines().source())
    }

    fn fps(&self) -> Option<TickRate> {
        match self {
            Self::Method(_) => None,
            Self::Rule(rule) => Some(rule.fps()),
        }
    }

    fn numbers_kept(&self, n: usize) -> usize {
        (self.lines().slots() + 3) * n
    }
}

/// Lines under an id, and the method made of them.
struct Entry {
    id: String,
    own: OwnLines,
    formula: OnceLock<Vec<&'static str>>,
    /// The card before it is measured.
    card: OnceLock<Method>,
    about: OnceLock<String>,
    method: OnceLock<Method>,
    next: OnceLock<Box<Self>>,
}

/// The first entry, from which [`Entry::next`] leads to all others.
static KNOWN: OnceLock<Box<Entry>> = OnceLock::new();

impl Entry {
    /// Returns the entry of these lines under this id, which is appended if there is none.
    fn of(id: &str, own: &OwnLines) -> &'static Self {
        let new = || Self {
            id: id.to_owned(),
            own: own.clone(),
            formula: OnceLock::new(),
            card: OnceLock::new(),
            about: OnceLock::new(),
            method: OnceLock::new(),
            next: OnceLock::new(),
        };
        let mut place = &KNOWN;
        loop {
            let entry = place.get_or_init(|| Box::new(new()));
            if entry.id == id && entry.own.text() == own.text() && entry.own.fps() == own.fps() {
                return entry;
            }
            place = &entry.next;
        }
    }

    /// Returns the method. The first call makes it by `finish` from a card with the name and formula of the lines. If
    /// `finish` panics, the next call tries again.
    fn method(&'static self, finish: impl FnOnce(Method) -> Method) -> &'static Method {
        self.method.get_or_init(|| {
            let lines = self.own.lines().source().lines().map(str::trim);
            let lines = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
            let formula = self.formula.get_or_init(|| lines.collect());
            let (id, source) = (&self.id, "lines of one's own");
            let custom = Some(&self.own as &dyn BuildIntegrator);
            finish(Method { id, name: id, formula, source, custom, ..Family::Explicit.card() })
        })
    }

    /// Returns this card with measured values.
    fn measured(&'static self, card: Method) -> Method {
        let (measured, about) = conformance::measured(self.card.get_or_init(|| card));
        let has_own_floor = has_floor(&measured);
        Method { about: self.about.get_or_init(|| about), has_own_floor, ..measured }
    }
}

/// Returns the method of these lines under this id. [`conformance`] measures its card once per process, in a fraction
/// of a second. Equal lines share one card, which lives as long as the process.
///
/// # Errors
/// The first fault of the lines, or a fault if the lines do not call the acceleration.
///
/// ```
/// use regatta_sim::own_method;
///
/// let euler = own_method("mine", "v += a(x, v) * h; x += v * h").unwrap();
/// assert_eq!((euler.order, euler.evaluations, euler.symplectic), (1, Some(1), true));
/// assert!(own_method("mine", "x += v * h").is_err());
/// ```
pub fn own_method(id: &str, text: &str) -> Result<&'static Method, ExpressionFault> {
    let read = StepText::read(text)?;
    if read.acceleration_at().is_none() {
        return Err(ExpressionFault::new(
            0..text.len(),
            "no line calls `a(x, v)`, so that the lines are a rule",
            "give its `fps` in a scene, or its file in the place of one; or call the acceleration: `v += h * a(x, v)`",
        ));
    }
    let (only, default_substeps) = (only(&read), read.default_substeps());
    let entry = Entry::of(id, &OwnLines::Method(Arc::new(read)));
    Ok(entry.method(|card| {
        let about = "a method by lines of one's own";
        let card = Method { only, about, default_substeps, ..card };
        // The problems of the measurements have no target and no joint.
        if only.is_some() {
            return card;
        }
        entry.measured(Method { source: "lines of one's own; this card is measured", ..card })
    }))
}

/// Whether a fall through 0 by this method ends otherwise than the same fall far above it.
fn has_floor(method: &Method) -> bool {
    /// A fall that is exact in binary numbers.
    struct Fall;
    impl System for Fall {
        type Vector = f64;

        fn acceleration(&self, _t: f64, _q: &f64, _v: &f64, a: &mut f64) {
            *a = -8.0;
        }
    }
    let falls = |from: f64| {
        let mut state = State { q: from, v: 0.0 };
        let mut integrator = integrator(method, &state.q);
        let stepped = (0..64)
            .try_for_each(|n| integrator.step(&Fall, f64::from(n) / 64.0, 1.0 / 64.0, &mut state));
        stepped.is_ok().then_some(state.v)
    };
    let ends = [1.0, 1024.0].map(falls);
    ends[0].zip(ends[1]).is_some_and(|(near, far)| (near - far).abs() > 1.0)
}

/// Returns the bodies that a method with these lines steps; `None` if it steps every body.
fn only(text: &StepText) -> Option<Only> {
    let needs = match text.law_order() {
        Some(order) => Needs::Law { order },
        None if text.takes(Input::Stiffness) => Needs::Engine,
        None if text.takes(Input::Force) => Needs::EngineWithoutJoint,
        None => return None,
    };
    let reason = match needs {
        Needs::Law { .. } => {
            "its lines take a target and a rate, so it steps only a body that follows a target"
        }
        _ => "its lines take the force on a body as an engine does",
    };
    Some(Only { needs, reason })
}

/// Returns the rule of these lines under this id, written for this many frames per second. As a method, a rule of one
/// number steps followers of first order, and a rule of two numbers steps bodies with a force. A rule ignores the force
/// of the body.
///
/// # Errors
/// The first fault of the lines, or the reason why no body moves like them.
///
/// ```
/// use regatta_sim::{TickRate, own_rule};
///
/// let chase = own_rule("chase", "x += (target - x) * 20 * dt", TickRate::whole(30)).unwrap();
/// assert_eq!(chase.rule_fps(), Some(TickRate::whole(30)));
/// assert!(own_rule("method", "v += a(x, v) * h; x += v * h", TickRate::whole(30)).is_err());
/// ```
pub fn own_rule(id: &str, text: &str, fps: TickRate) -> Result<&'static Method, ExpressionFault> {
    let rule = linear_rule(text, fps)?;
    let only = match rule.body() {
        RuleBody::Follower { .. } => Only {
            needs: Needs::Law { order: 1 },
            reason: "a rule of one number moves a follower with `order = 1`",
        },
        _ => Only { needs: Needs::Force, reason: "a rule of two numbers moves no follower" },
    };
    let evaluations = Some(u32::from(rule.takes_target()));
    let entry = Entry::of(id, &OwnLines::Rule(Arc::new(rule)));
    Ok(entry.method(|card| Method {
        about: "a rule of one's own: the same lines once a step, whatever the body",
        order: 0,
        order_with_drag: 0,
        evaluations,
        only: Some(only),
        ..card
    }))
}

/// Returns the rule of these lines, written for this many frames per second.
///
/// # Errors
/// The same as for [`own_rule`].
pub fn linear_rule(text: &str, fps: TickRate) -> Result<LinearRule, ExpressionFault> {
    let read = StepText::read_rule(text, "leave `fps` out: these lines are a method")?;
    LinearRule::new(read, fps)
        .map_err(|[what, remedy]| ExpressionFault::new(0..text.len(), what, remedy))
}

/// Returns the method id for a file whose name without its extension is `stem`. The id has the letters and digits of
/// the name in lower case, and a hyphen for each group of other characters between them.
pub fn own_method_id(stem: &str) -> String {
    let mut id = String::new();
    for letter in stem.chars() {
        match letter {
            letter if letter.is_ascii_alphanumeric() => id.push(letter.to_ascii_lowercase()),
            _ if !id.is_empty() && !id.ends_with('-') => id.push('-'),
            _ => {}
        }
    }
    id.trim_end_matches('-').to_owned()
}

/// Checks the id of an own method. The error is a message and a remedy.
///
/// # Errors
/// If it is no valid id, or if one of [`METHODS`] has it.
pub fn check_own_id(id: &str) -> Result<(), [String; 2]> {
    if id.is_empty() || own_method_id(id) != id || id.len() > MAX_OWN_ID_CHARS {
        let remedy = format!(
            "write up to {MAX_OWN_ID_CHARS} lower-case letters and digits with hyphens between, such as `my-rk4`"
        );
        return Err([format!("{id:?} is no id of a method"), remedy]);
    }
    let mut taken = METHODS.iter().flat_map(Method::spellings);
    match taken.find(|(spelling, _)| *spelling == id) {
        Some((_, of)) => Err([
            format!("{id:?} is a name of the built-in method {of}"),
            format!("give it another name, such as `my-{id}`"),
        ]),
        None => Ok(()),
    }
}
