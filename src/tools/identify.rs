//! Which method made a log of one body: the methods of the table are run beside it, and the one that fits is named.
//!
//! Every method with steps of one length is run under 1 to 16 substeps, from a start that is fitted to the log by least
//! squares. The residual decides: a method is named if its residual is at noise level and no other's is.

use crate::sim::integrators::{METHODS, Method};

mod candidates;
mod decision;
mod effective;
mod fit;
mod logged;
mod logged_body;
mod motion;
mod nearest;
mod search;

pub use candidates::{Candidate, SpringAs};
use decision::{Decision, decide};
pub use effective::Effective;
pub(crate) use effective::SLOW;
use fit::Fit;
pub use logged::{ColumnNames, Log, LogError, LogRow, LogSetting};
pub use logged_body::LoggedBody;
pub(crate) use motion::run;
use nearest::nearest;
use search::search;

/// A candidate, and how far the log is from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The candidate.
    pub candidate: Candidate,
    /// The root mean square of the residual, in units of the largest coordinate and velocity.
    pub residual: f64,
}

/// What is said of a log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Conclusion {
    /// One method fits, and those that do the same on this body.
    Identified,
    /// Methods that differ on this body fit equally well.
    CannotTell,
    /// No method fits to the noise.
    Unknown,
}

impl Conclusion {
    /// The word in output.
    pub fn id(self) -> &'static str {
        match self {
            Conclusion::Identified => "identified",
            Conclusion::CannotTell => "cannot tell",
            Conclusion::Unknown => "unknown",
        }
    }
}

/// What was found out about a log.
#[derive(Clone, Debug)]
pub struct Identification {
    /// What is said.
    pub conclusion: Conclusion,
    /// The candidate that fits best.
    pub best: Fitted,
    /// Others that do the same on this body.
    pub also: Vec<Candidate>,
    /// Others that do something else and explain the log as well, but are set aside because they are rare.
    pub unusual: Vec<Candidate>,
    /// The best candidate that does something else; `None` if all do the same.
    pub runner_up: Option<Fitted>,
    /// Whether its spring was fitted.
    pub is_spring_fitted: bool,
    /// What a player sees; `None` if it is nothing like a damped spring or a body that comes to its
    /// last speed, or if the log is too short to tell.
    pub effective: Option<Effective>,
    /// What the equation of motion says.
    pub exact: Option<Effective>,
    /// Methods of one step a tick under which a player would see the exact motion to within 1 %, the cheapest first, and
    /// the motion under each.
    pub recommended: Vec<(&'static Method, Effective)>,
}

/// The most methods that are recommended.
const MAX_RECOMMENDED: usize = 3;

/// Finds out which method made `log`, a motion of `body` at `tick_hz`. What is not known of the body is fitted too.
///
/// Returns `None` if no method can be run on the body.
pub fn identify(log: &Log, body: &LoggedBody, tick_hz: f64) -> Option<Identification> {
    let fits = search(log, body, tick_hz);
    let Decision { conclusion, same, unusual, rival } = decide(&fits, body, log.is_double())?;
    let (best, best_fit) = same.first()?;
    let fitted = |(candidate, fit): &(Candidate, Fit)| Fitted {
        candidate: *candidate,
        residual: fit.residual(),
    };
    let of = |fits: &[&(Candidate, Fit)]| fits.iter().map(|(candidate, _)| *candidate).collect();
    let is_spring_fitted = body.spring.is_none();
    let body = best_fit.body.clone();
    let tick_s = 1.0 / tick_hz;
    let effective = match conclusion {
        Conclusion::Unknown => nearest(log, &body, tick_hz),
        Conclusion::CannotTell if best_fit.is_short() => None,
        _ => Effective::of(*best, &body, tick_s),
    };
    let exact = Effective::exact(&body);
    let recommended = recommended(&body, tick_s, exact);
    Some(Identification {
        conclusion,
        best: Fitted { candidate: *best, residual: best_fit.residual() },
        also: of(&same[1..]),
        unusual: of(&unusual),
        runner_up: rival.map(fitted),
        is_spring_fitted,
        effective,
        exact,
        recommended,
    })
}

/// The cheapest methods under which the motion is what the equation says.
fn recommended(
    body: &LoggedBody,
    tick_s: f64,
    exact: Option<Effective>,
) -> Vec<(&'static Method, Effective)> {
    let Some(exact) = exact else { return Vec::new() };
    let own = METHODS.iter().filter(|method| method.only.is_none() && method.tolerance.is_none());
    let mut found: Vec<_> = own
        .filter(|method| !method.is_as_printed())
        .filter_map(|method| {
            let candidate = Candidate { method, substeps: 1, spring: SpringAs::Acceleration };
            let effective = Effective::of(candidate, body, tick_s)?;
            effective.is_near(&exact).then_some((method, effective))
        })
        .collect();
    found.sort_by_key(|(method, _)| method.evaluations.unwrap_or(u32::MAX));
    found.truncate(MAX_RECOMMENDED);
    found
}
