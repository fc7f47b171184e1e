//! Which method made a log of one body: the methods of the table are run beside it, and the one that fits is named.
//!
//! Every method with steps of one length is run under a few counts of substeps, from a start that is fitted to the whole
//! log by least squares. What is left over decides: a method is named if it explains the log to the noise and no other
//! does.

use std::fmt;

use crate::sim::integrators::{METHODS, Method};

mod effective;
mod fit;
mod logged;
mod motion;

pub use effective::Effective;
use fit::{Fit, fit};
pub use logged::{Columns, Log, LogError, LogRow};
pub use motion::LoggedBody;

/// A method with what a lane would say of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The method.
    pub method: &'static Method,
    /// Its substeps.
    pub substeps: u32,
    /// Whether the game applies the spring as a force of its own, and not as a joint of the engine.
    pub is_held: bool,
}

/// Its id, its substeps, and whether the force is held where it could be a joint.
impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let held = if self.is_held && self.method.id != HELD { ", force held" } else { "" };
        write!(f, "{} ×{}{held}", self.method.id, self.substeps)
    }
}

/// A candidate, and how far the log is from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The candidate.
    pub candidate: Candidate,
    /// The root mean square of what is left over, in units of the largest coordinate and velocity.
    pub residual: f64,
}

/// What is said of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Word {
    /// One method fits, and those that do the same on this body.
    Identified,
    /// Methods that differ on this body fit equally well.
    CannotTell,
    /// No method fits to the noise.
    Unknown,
}

impl Word {
    /// The word in output.
    pub fn id(self) -> &'static str {
        match self {
            Word::Identified => "identified",
            Word::CannotTell => "cannot tell",
            Word::Unknown => "unknown",
        }
    }
}

/// What was found out about a log.
#[derive(Clone, Debug)]
pub struct Identification {
    /// What is said.
    pub word: Word,
    /// The candidate that fits best.
    pub best: Fitted,
    /// Others that do the same on this body, each method once.
    pub also: Vec<Candidate>,
    /// The best candidate that does something else; `None` if all do the same.
    pub runner_up: Option<Fitted>,
    /// The body, with what was fitted of it.
    pub body: LoggedBody,
    /// Whether its spring was fitted.
    pub is_spring_fitted: bool,
    /// What a player sees.
    pub effective: Option<Effective>,
    /// What the equation of motion says.
    pub exact: Option<Effective>,
    /// Methods of one step a tick under which a player would see the exact motion to within 1 %, the cheapest first, and
    /// the motion under each.
    pub recommended: Vec<(&'static Method, Effective)>,
}

/// The substeps that are tried of engines, besides each one's own.
const SUBSTEPS_OF_ENGINES: &[u32] = &[1, 2, 4, 8, 16];
/// The substeps that are tried of other methods.
const SUBSTEPS: &[u32] = &[1, 2, 4];
/// The id of the method whose force is held whatever the body.
const HELD: &str = "held-force";
/// What rounding leaves over in a run, in units of the largest values: the least, in double precision, and the most, in
/// single precision.
const ROUNDING: [f64; 2] = [1e-9, 3e-5];
/// Nothing below this many times what the closest candidate leaves over tells candidates apart, up to the most that
/// rounding leaves over.
const TIMES_CLOSEST: f64 = 10.0;
/// Candidates whose runs are nowhere farther apart, with the same spring, do the same.
const SAME: f64 = 1e-5;
/// The least difference of twice the logarithm of the likelihood that tells candidates apart: four standard deviations.
const DECISIVE: f64 = 16.0;
/// More left over than this is no fit, whatever its form.
const NO_FIT: f64 = 0.01;
/// What is left over may follow from row to row by this much more than chance allows.
const FOLLOWING: f64 = 0.1;
/// The most methods that are recommended.
const MOST_RECOMMENDED: usize = 3;

fn candidates(body: &LoggedBody) -> Vec<Candidate> {
    let mut all = Vec::new();
    let stepped = METHODS.iter().filter(|method| method.tolerance.is_none());
    for method in stepped.filter(|method| method.only.is_none() || method.is_engine()) {
        let counts = if method.is_engine() { SUBSTEPS_OF_ENGINES } else { SUBSTEPS };
        let mut counts = counts.to_vec();
        if !counts.contains(&method.default_substeps) {
            counts.push(method.default_substeps);
        }
        let is_special = method.is_engine() && method.id != HELD && body.has_spring();
        for is_held in [false, true] {
            if is_held && !is_special {
                continue;
            }
            let is_held = is_held || method.id == HELD;
            let of = |&substeps: &u32| Candidate { method, substeps, is_held };
            all.extend(counts.iter().map(of));
        }
    }
    all
}

/// Which comes first among candidates that do the same: an engine as it is set by default, then any engine.
fn preference(candidate: &Candidate) -> (bool, bool, bool, u32) {
    let Candidate { method, substeps, is_held } = *candidate;
    let is_as_set = method.is_engine() && substeps == method.default_substeps;
    (!is_as_set, is_held && method.id != HELD, !method.is_engine(), substeps)
}

/// Finds out which method made `log`, a motion of `body` at `tick_hz`. What is not known of the body is fitted too.
///
/// Returns `None` if no method can be run on the body.
pub fn identify(log: &Log, body: &LoggedBody, tick_hz: f64) -> Option<Identification> {
    let fits = candidates(body).into_iter().filter_map(|candidate| {
        let fit = fit(log, body, candidate, tick_hz)?;
        Some((candidate, fit))
    });
    let fits: Vec<(Candidate, Fit)> = fits.collect();
    let least = fits.iter().map(|(_, fit)| fit.residual()).fold(f64::INFINITY, f64::min);
    let rounding = (TIMES_CLOSEST * least).clamp(ROUNDING[0], ROUNDING[1]);
    let deviance = |fit: &Fit| fit.deviance(rounding);
    let closest = fits.iter().min_by(|(_, a), (_, b)| deviance(a).total_cmp(&deviance(b)))?;
    let is_plausible = |fit: &Fit| deviance(fit) - deviance(&closest.1) < DECISIVE;
    let is_same = |fit: &Fit| fit.distance(&closest.1) <= SAME;
    let mut same: Vec<&(Candidate, Fit)> =
        fits.iter().filter(|(_, fit)| is_plausible(fit) && is_same(fit)).collect();
    same.sort_by_key(|(candidate, _)| preference(candidate));
    let (best, best_fit) = same.first()?;
    let others = fits.iter().filter(|(_, fit)| !(is_plausible(fit) && is_same(fit)));
    let runner_up = others.min_by(|(_, a), (_, b)| deviance(a).total_cmp(&deviance(b)));

    let mut also: Vec<Candidate> = Vec::new();
    for (candidate, _) in &same {
        let is_new = |known: &Candidate| known.method != candidate.method;
        if is_new(best) && also.iter().all(is_new) {
            also.push(*candidate);
        }
    }
    let word = if best_fit.residual() > NO_FIT || best_fit.is_systematic() {
        Word::Unknown
    } else if runner_up.is_some_and(|(_, fit)| is_plausible(fit)) {
        Word::CannotTell
    } else {
        Word::Identified
    };
    let fitted = |(candidate, fit): &(Candidate, Fit)| Fitted {
        candidate: *candidate,
        residual: fit.residual(),
    };
    let is_spring_fitted = body.spring.is_none();
    let body = best_fit.body.clone();
    let tick_s = 1.0 / tick_hz;
    let effective = match word {
        Word::Unknown => Effective::of_log(log, &body, tick_s),
        _ => Effective::of(*best, &body, best_fit.start, tick_s),
    };
    let exact = Effective::exact(&body);
    let recommended = recommended(&body, best_fit.start, tick_s, exact);
    let runner_up = runner_up.map(fitted);
    let best = Fitted { candidate: *best, residual: best_fit.residual() };
    Some(Identification {
        word,
        best,
        also,
        runner_up,
        body,
        is_spring_fitted,
        effective,
        exact,
        recommended,
    })
}

/// The cheapest methods under which the motion is what the equation says.
fn recommended(
    body: &LoggedBody,
    start: [f64; 2],
    tick_s: f64,
    exact: Option<Effective>,
) -> Vec<(&'static Method, Effective)> {
    let Some(exact) = exact else { return Vec::new() };
    let own = METHODS.iter().filter(|method| method.only.is_none() && method.tolerance.is_none());
    let mut found: Vec<_> = own
        .filter(|method| !method.is_as_printed())
        .filter_map(|method| {
            let candidate = Candidate { method, substeps: 1, is_held: false };
            let effective = Effective::of(candidate, body, start, tick_s)?;
            effective.is_near(&exact).then_some((method, effective))
        })
        .collect();
    found.sort_by_key(|(method, _)| method.evaluations.unwrap_or(u32::MAX));
    found.truncate(MOST_RECOMMENDED);
    found
}
