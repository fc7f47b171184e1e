//! Which method made a log of one body: the methods of the table are run beside it, and the one that fits is named.
//!
//! Every method with steps of one length is run under 1 to 16 substeps, from a start that is fitted to the log by least
//! squares. What is left over decides: a method is named if it explains the log to the noise and no other does.

use std::collections::BTreeSet;

use crate::sim::integrators::{METHODS, Method};

mod candidates;
mod effective;
mod fit;
mod logged;
mod motion;
mod search;

pub use candidates::Candidate;
use candidates::candidates;
pub use effective::Effective;
use fit::Fit;
pub use logged::{Columns, Log, LogError, LogRow};
pub use motion::LoggedBody;
use search::search;

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
    /// Others that do the same on this body.
    pub also: Vec<Candidate>,
    /// Others that do something else and explain the log as well, but are set aside because they are rare.
    pub unusual: Vec<Candidate>,
    /// The best candidate that does something else; `None` if all do the same.
    pub runner_up: Option<Fitted>,
    /// The body, with what was fitted of it.
    pub body: LoggedBody,
    /// Whether its spring was fitted.
    pub is_spring_fitted: bool,
    /// What a player sees; `None` if it is nothing like a damped spring or a body that comes to its last speed.
    pub effective: Option<Effective>,
    /// What the equation of motion says.
    pub exact: Option<Effective>,
    /// Methods of one step a tick under which a player would see the exact motion to within 1 %, the cheapest first, and
    /// the motion under each.
    pub recommended: Vec<(&'static Method, Effective)>,
}

/// What rounding leaves over in a run, in units of the largest values: the least, in double precision, and the most, in
/// single precision.
const ROUNDING: [f64; 2] = [1e-9, 3e-5];
/// Nothing below this many times what the closest candidate leaves over tells candidates apart, up to the most that
/// rounding leaves over.
const TIMES_CLOSEST: f64 = 10.0;
/// Among candidates that do the same, one that leaves over this many times what the nearest does is not named.
const TIMES_NEAREST: f64 = 3.0;
/// Candidates whose runs are nowhere farther apart, with the same spring, do the same; so do those that are nowhere
/// farther apart than this part of the residual.
const SAME: f64 = 1e-5;
const SAME_PART: f64 = 0.2;
/// The least difference of twice the logarithm of the likelihood that tells candidates apart: four standard deviations.
const DECISIVE: f64 = 16.0;
/// More left over than this is no fit, whatever its form.
const NO_FIT: f64 = 0.01;
/// What is left over may follow from row to row by this much more than chance allows.
const FOLLOWING: f64 = 0.1;
/// Where rows are too few to tell noise from what follows from row to row, a rival leaves over this many times as much.
const CLEAR: f64 = 3.0;
/// A log that this part of all methods explain says nothing.
const NEARLY_ALL: f64 = 0.8;
/// The most methods that are recommended.
const MOST_RECOMMENDED: usize = 3;

/// What rounding may leave over where the closest candidate leaves over this.
fn rounding(closest: f64) -> f64 {
    (TIMES_CLOSEST * closest).clamp(ROUNDING[0], ROUNDING[1])
}

/// Finds out which method made `log`, a motion of `body` at `tick_hz`. What is not known of the body is fitted too.
///
/// Returns `None` if no method can be run on the body.
pub fn identify(log: &Log, body: &LoggedBody, tick_hz: f64) -> Option<Identification> {
    let fits = search(log, body, tick_hz);
    let least = fits.iter().map(|(_, fit)| fit.residual()).fold(f64::INFINITY, f64::min);
    let rounding = rounding(least);
    let deviance = |(_, fit): &(Candidate, Fit)| fit.deviance(rounding);
    let with_rarity = |fitted: &(Candidate, Fit)| deviance(fitted) + fitted.0.rarity();
    let by_both =
        |a: &&(Candidate, Fit), b: &&(Candidate, Fit)| with_rarity(a).total_cmp(&with_rarity(b));
    let closest = fits.iter().min_by(by_both)?;
    let fits_as_well = |fitted: &(Candidate, Fit)| deviance(fitted) - deviance(closest) < DECISIVE;
    let is_plausible =
        |fitted: &(Candidate, Fit)| with_rarity(fitted) - with_rarity(closest) < DECISIVE;
    let apart = SAME.max(SAME_PART * closest.1.residual());
    let (mut same, others): (Vec<_>, Vec<_>) = fits
        .iter()
        .partition(|fitted| fits_as_well(fitted) && fitted.1.distance(&closest.1) <= apart);
    let nearest = same.iter().map(|(_, fit)| fit.residual()).fold(f64::INFINITY, f64::min);
    same.sort_by_key(|(candidate, fit)| {
        let is_nearest = fit.residual() <= TIMES_NEAREST * nearest + ROUNDING[0] / TIMES_CLOSEST;
        (!is_nearest, candidate.preference())
    });
    let (best, best_fit) = same.first()?;
    let unusual = others.iter().filter(|fitted| fits_as_well(fitted) && !is_plausible(fitted));
    let rival = others.iter().copied().min_by(by_both);
    let is_clear = rival.is_none_or(|(_, fit)| fit.residual() > CLEAR * best_fit.residual());
    let says_nothing = explained_by_nearly_all(&same, body);
    let rival = match rival {
        Some(rival) if is_plausible(rival) => Some(rival),
        _ if says_nothing => same.iter().find(|other| other.0.method != best.method).copied(),
        _ => rival,
    };
    let is_short = best_fit.has_few_rows() && !is_clear;
    let word = if best_fit.residual() > NO_FIT || best_fit.is_systematic() {
        Word::Unknown
    } else if says_nothing || is_short || rival.is_some_and(is_plausible) {
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
        Word::Unknown => Effective::nearest(log, &body, tick_hz),
        _ => Effective::of(*best, &body, best_fit.start, tick_s),
    };
    let exact = Effective::exact(&body);
    let recommended = recommended(&body, best_fit.start, tick_s, exact);
    Some(Identification {
        word,
        best: Fitted { candidate: *best, residual: best_fit.residual() },
        also: same[1..].iter().map(|(candidate, _)| *candidate).collect(),
        unusual: unusual.map(|(candidate, _)| *candidate).collect(),
        runner_up: rival.map(fitted),
        body,
        is_spring_fitted,
        effective,
        exact,
        recommended,
    })
}

/// Whether so many methods do the same that the log says nothing.
fn explained_by_nearly_all(same: &[&(Candidate, Fit)], body: &LoggedBody) -> bool {
    let methods = |all: &mut dyn Iterator<Item = Candidate>| {
        all.map(|candidate| candidate.method.id).collect::<BTreeSet<_>>().len() as f64
    };
    let of_same = methods(&mut same.iter().map(|(candidate, _)| *candidate));
    of_same >= NEARLY_ALL * methods(&mut candidates(body).into_iter())
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
