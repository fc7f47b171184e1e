//! Identifies the method behind a log of one body. The methods of the table run beside the log, and the one that fits
//! is named.
//!
//! Every fixed-step method runs with 1 to 16 substeps, from a start fitted to the log by least squares. A method is
//! named if its residual is at noise level and no candidate that moves the body differently fits as well.

use crate::sim::integrators::{METHODS, Method, method};

mod candidates;
mod decision;
mod effective;
mod fit;
mod forms;
mod logged;
mod matching_spring;
mod motion;
mod readings;
mod simplest;
mod spin;
mod swing;

use candidates::candidates;
pub use candidates::{Candidate, SpringForm};
use decision::{Decision, NO_FIT, decide, rounding};
pub use effective::Effective;
use fit::{Fit, Start, fit};
pub use logged::{Log, LogError, LogRow, LogSetting, LoggedBody};
use matching_spring::map_of_log;
pub(crate) use motion::{SLOW, run};
pub use readings::identify_reading;
pub use simplest::SimpleMotion;
use simplest::{drifting, refusal, simplest};
pub use spin::identify_spin;
pub use swing::FittedSwing;
use swing::fitted_swing;

/// A candidate and its residual against the log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The candidate.
    pub candidate: Candidate,
    /// Root mean square of the residual, in units of the log's largest coordinate and velocity.
    pub residual: f64,
}

/// The conclusion about a log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Conclusion {
    /// One method fits, alone or with other methods that move this body alike.
    Identified,
    /// The log does not single out a method, because others fit as well, or because the residual is doubtful.
    CannotTell,
    /// No method fits to noise level.
    #[default]
    Unknown,
}

impl Conclusion {
    /// Returns the word used in output.
    pub fn id(self) -> &'static str {
        match self {
            Conclusion::Identified => "identified",
            Conclusion::CannotTell => "cannot tell",
            Conclusion::Unknown => "unknown",
        }
    }
}

/// The findings about a log.
#[derive(Clone, Debug, Default)]
pub struct Identification {
    /// The conclusion.
    pub conclusion: Conclusion,
    /// The candidate that fits best; `None` if no method can run beside the log, for example because the log's rows are
    /// uneven.
    pub best: Option<Fitted>,
    /// Other candidates that move this body alike.
    pub also: Vec<Candidate>,
    /// Usual candidates that move this body differently and fit as well, the likeliest first.
    pub rivals: Vec<Candidate>,
    /// Other candidates that move this body differently and fit as well, but are set aside as rare.
    pub unusual: Vec<Candidate>,
    /// The best candidate that moves this body differently. If nearly all methods fit, it is a candidate of another
    /// method that moves this body alike. `None` if there is neither.
    pub runner_up: Option<Fitted>,
    /// Whether the stiffness and damping of the spring were fitted.
    pub is_spring_fitted: bool,
    /// The spring's rest, in metres.
    pub rest: f64,
    /// Whether the position of the rest was fitted.
    pub is_rest_fitted: bool,
    /// Whether the conclusion assumes that the body starts at rest, because x alone does not decide.
    pub supposes_start_at_rest: bool,
    /// Signed distance of the last row from the exact motion of the same start, in metres, and the row's time in
    /// seconds. `None` if no method was identified.
    pub from_exact: Option<(f64, f64)>,
    /// Why the rows count as ticks although their times are uneven, with the row that is late.
    pub rows_are_ticks: Option<String>,
    /// The simple motion that explains the log as well as a spring does, so that no method is searched.
    pub simple: Option<SimpleMotion>,
    /// Why no motion is named, if the method is unknown.
    pub unexplained: Option<String>,
    /// The nearest damped swing, if the method is unknown.
    pub swing: Option<FittedSwing>,
    /// The motion that a player sees. `None` if it resembles neither a damped spring nor a body approaching its last
    /// speed, or if the log is too short.
    pub effective: Option<Effective>,
    /// The exact motion, by the equation of motion.
    pub exact: Option<Effective>,
    /// Methods whose visible motion at one step a tick is within 1 % of the exact one, each with its visible motion.
    /// The cheapest method comes first.
    pub recommended: Vec<(&'static Method, Effective)>,
}

const MAX_RECOMMENDED: usize = 3;

/// Largest residual from a supposed start at rest, as a multiple of that from a fitted start, and the least of these.
const REST_NEARER: f64 = 10.0;
const REST_EXACT: f64 = 1e-10;

/// Largest residual of a swing, relative to its amplitude, at which the swing counts as that of the log.
const NO_SWING: f64 = 0.2;

/// Finds the method behind `log`, a motion of `body` at `tick_hz`. Unknown numbers of the body are fitted too, but the
/// rest is fitted only if no method fits with the rest at 0. If x alone does not decide, a start at rest is assumed,
/// provided that this assumption decides.
///
/// Rows that step alike whatever their times count as ticks.
///
/// Returns `None` if no method can run on the body and no swing is near.
pub fn identify(log: &Log, body: &LoggedBody, tick_hz: f64) -> Option<Identification> {
    if let Some((ticks, late)) = log.as_ticks() {
        let found = identify(&ticks, body, tick_hz);
        let found = found.filter(|found| found.conclusion != Conclusion::Unknown);
        if let Some(found) = found {
            return Some(Identification {
                rows_are_ticks: Some(late.unwrap_or_default()),
                ..found
            });
        }
    }
    let swing = fitted_swing(log, body);
    if let (true, Some(simple)) = (body.is_unknown(), simplest(log, swing.as_ref())) {
        return Some(Identification { simple: Some(simple), ..Identification::unknown(body) });
    }
    let refused = swing.as_ref().and_then(|swing| refusal(log, swing));
    let unexplained = refused.clone().filter(|_| body.is_unknown());
    let swing =
        swing.filter(|swing| swing.residual <= NO_SWING && refused.is_none() || !body.is_unknown());
    let of_swing = || match swing {
        Some(swing) => Some(Identification::of_swing(swing, body, tick_hz)),
        None => last_resort(log, body, None, unexplained.clone()),
    };
    if log.is_uneven() {
        return of_swing();
    }
    let resting = |rest: f64| LoggedBody { rest: Some(rest), ..body.clone() };
    let usual = resting(body.rest.unwrap_or(0.0));
    let mut found = identify_with(log, &usual, (tick_hz, None), swing);
    let is_unknown = found.as_ref().is_none_or(|found| found.conclusion == Conclusion::Unknown);
    if let Some(swing) = swing.filter(|_| is_unknown && body.rest.is_none()) {
        let fitted = identify_with(log, body, (tick_hz, Some(swing.rest)), Some(swing));
        found = fitted.filter(|it| it.conclusion != Conclusion::Unknown).or(found);
    }
    let is_open = found.as_ref().is_some_and(|it| it.conclusion == Conclusion::CannotTell);
    if is_open && !log.has_velocities() && body.v0.is_none() {
        let still = LoggedBody { v0: Some(0.0), ..usual };
        let told = identify_with(log, &still, (tick_hz, None), swing);
        // A start at rest that leads away from the log is not its start.
        let residual = |it: &Identification| it.best.map_or(f64::INFINITY, |best| best.residual);
        let most = REST_NEARER * found.as_ref().map_or(f64::INFINITY, residual).max(REST_EXACT);
        let is_near = |it: &Identification| residual(it) <= most;
        let told = told.filter(|it| it.conclusion == Conclusion::Identified && is_near(it));
        found = told.map(|it| Identification { supposes_start_at_rest: true, ..it }).or(found);
    }
    match found {
        Some(found) if found.conclusion == Conclusion::Unknown && swing.is_none() => {
            last_resort(log, body, Some(found), unexplained)
        }
        Some(found) => Some(found),
        None => of_swing(),
    }
}

/// Names a swing whose rest moves, for a log that no method and no simpler motion explains; else says why none does.
fn last_resort(
    log: &Log,
    body: &LoggedBody,
    found: Option<Identification>,
    unexplained: Option<String>,
) -> Option<Identification> {
    if let (true, Some(simple)) = (body.is_unknown(), drifting(log, body)) {
        return Some(Identification { simple: Some(simple), ..Identification::unknown(body) });
    }
    let found = found.or_else(|| unexplained.is_some().then(|| Identification::unknown(body)))?;
    Some(Identification { unexplained, ..found })
}

/// Identifies the method with the body as given. The fit of an unknown rest starts at `first_rest`.
fn identify_with(
    log: &Log,
    body: &LoggedBody,
    (tick_hz, first_rest): (f64, Option<f64>),
    swing: Option<FittedSwing>,
) -> Option<Identification> {
    let seen = swing.filter(|swing| swing.residual <= NO_SWING).map(|swing| swing.seen);
    let rest = body.rest.or(first_rest).unwrap_or(0.0);
    let map = if body.spring.is_none() {
        map_of_log(&log.resting_at_zero(rest), 1.0 / tick_hz)
    } else {
        None
    };
    let fits = search(log, body, Start { tick_hz, rest: first_rest, seen, map });
    let Decision { conclusion, same, rivals, unusual, rival } =
        decide(&fits, body, log.is_double())?;
    let (best, best_fit) = same.first()?;
    let fitted = |(candidate, fit): &(Candidate, Fit)| Fitted {
        candidate: *candidate,
        residual: fit.residual(),
    };
    let of = |fits: &[&(Candidate, Fit)]| fits.iter().map(|(candidate, _)| *candidate).collect();
    let asked = Identification::unknown(body);
    let mut body = best_fit.body.clone();
    if conclusion == Conclusion::Unknown && asked.is_spring_fitted {
        // Only the swing that is named may be compared with its equation.
        body.spring = swing.and_then(|swing| swing.seen.spring());
    }
    let tick_s = 1.0 / tick_hz;
    let swing = swing.filter(|_| conclusion == Conclusion::Unknown);
    let effective = match conclusion {
        Conclusion::Unknown => {
            swing.map(|swing| swing.seen).or_else(|| nearest(log, &body, tick_hz))
        }
        Conclusion::CannotTell if best_fit.is_short() => None,
        _ => Effective::of(*best, &body, tick_s),
    };
    let exact = Effective::exact(&body);
    let recommended = recommended(&body, tick_s, exact);
    let is_identified = conclusion == Conclusion::Identified;
    Some(Identification {
        conclusion,
        best: Some(Fitted { candidate: *best, residual: best_fit.residual() }),
        also: of(&same[1..]),
        rivals: of(&rivals),
        unusual: of(&unusual),
        runner_up: rival.map(fitted),
        rest: body.rest.unwrap_or(0.0),
        from_exact: is_identified.then(|| from_exact(log, best_fit, tick_s)).flatten(),
        swing,
        effective,
        exact,
        recommended,
        ..asked
    })
}

/// Returns the signed distance of the last row from the exact motion of the fitted start, in metres, and the row's
/// time.
fn from_exact(log: &Log, fit: &Fit, tick_s: f64) -> Option<(f64, f64)> {
    let exact = Candidate { method: method(EXACT)?, substeps: 1, spring: SpringForm::Acceleration };
    let last = log.rows().last()?;
    let states = run(exact, &fit.body, fit.start, tick_s, [0, last.tick].into_iter())?;
    Some((last.x - states.last()?[0], last.t_s))
}

impl Identification {
    /// Returns the result for a log that shows only the visible motion, and not the method.
    fn of_swing(swing: FittedSwing, body: &LoggedBody, tick_hz: f64) -> Self {
        let spring = swing.seen.spring();
        let fitted = LoggedBody { spring: body.spring.or(spring), ..body.clone() };
        let exact = Effective::exact(&fitted);
        Self {
            rest: swing.rest,
            swing: Some(swing),
            effective: Some(swing.seen),
            exact,
            recommended: recommended(&fitted, 1.0 / tick_hz, exact),
            ..Self::unknown(body)
        }
    }

    /// Returns the half-life of a chase in seconds, if the motion is one.
    pub fn chase_half_life_s(&self) -> Option<f64> {
        match self.simple {
            Some(SimpleMotion::Chase { half_life_s, .. }) => Some(half_life_s),
            _ => None,
        }
    }

    /// Returns the result for a log that shows nothing of the method.
    fn unknown(body: &LoggedBody) -> Self {
        Self {
            is_spring_fitted: body.spring.is_none(),
            rest: body.rest.unwrap_or(0.0),
            is_rest_fitted: body.rest.is_none(),
            ..Self::default()
        }
    }
}

/// Returns the cheapest methods whose visible motion is near the exact one.
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
            let candidate = Candidate { method, substeps: 1, spring: SpringForm::Acceleration };
            let effective = Effective::of(candidate, body, tick_s)?;
            effective.is_near(&exact).then_some((method, effective))
        })
        .collect();
    found.sort_by_key(|(method, _)| method.evaluations.unwrap_or(u32::MAX));
    found.truncate(MAX_RECOMMENDED);
    found
}

/// Length of a log's head in ticks. First, every candidate is fitted to the head.
const HEAD_TICKS: u64 = 60;
/// A candidate does not explain a log if its sum of squares exceeds the smallest one by this factor.
const APART: f64 = 4.0;

/// Fits the candidates that may explain `log`, and the nearest one that does not.
///
/// The residual on a log's head is a lower bound of the residual on the whole log. Candidates are therefore fitted to
/// the whole log in the order of this bound, until the next bound is too large.
fn search(log: &Log, body: &LoggedBody, start: Start) -> Vec<(Candidate, Fit)> {
    let head = if body.spring.is_some() { log.head(HEAD_TICKS) } else { log.clone() };
    let is_whole = head.rows().len() == log.rows().len();
    let fit_to = |log: &Log, candidate| fit(log, body, candidate, start);
    let mut queue: Vec<(Candidate, Fit)> = candidates(body)
        .into_iter()
        .filter_map(|candidate| Some((candidate, fit_to(&head, candidate)?)))
        .collect();
    queue.sort_by(|(_, a), (_, b)| a.squares().total_cmp(&b.squares()));
    let (mut fits, mut squares): (Vec<(Candidate, Fit)>, Vec<f64>) = (Vec::new(), Vec::new());
    for (candidate, of_head) in queue {
        if of_head.squares() > max_head_squares(&squares, log) {
            break;
        }
        let fit = if is_whole { Some(of_head) } else { fit_to(log, candidate) };
        let Some(fit) = fit else { continue };
        squares.push(fit.squares());
        fits.push((candidate, fit));
    }
    fits
}

/// Returns the largest sum of squares on the head that is worth a fit to the whole log.
fn max_head_squares(squares: &[f64], log: &Log) -> f64 {
    let numbers = log.numbers() as f64;
    let nearest = squares.iter().copied().fold(f64::INFINITY, f64::min);
    let rounding = rounding((nearest / numbers).sqrt(), log.is_double());
    let near = APART * (nearest + numbers * rounding * rounding);
    let farther = squares.iter().copied().filter(|squares| *squares > near);
    near.max(farther.fold(f64::INFINITY, f64::min))
}

/// Id of a method that is exact on springs with drag.
const EXACT: &str = "exponential-rosenbrock-euler";

/// Returns the exact motion of the body that fits a log best; `None` if no motion is near the log.
fn nearest(log: &Log, body: &LoggedBody, tick_hz: f64) -> Option<Effective> {
    let seen = Effective::of_log(log, body, 1.0 / tick_hz)?;
    let mut free = body.clone();
    match seen.spring() {
        Some(_) => free.spring = None,
        None => free.drag = seen.decay,
    }
    let exact = Candidate { method: method(EXACT)?, substeps: 1, spring: SpringForm::Acceleration };
    let fit = fit(log, &free, exact, Start { tick_hz, rest: None, seen: None, map: None })?;
    let is_near = fit.residual() <= NO_FIT;
    is_near.then(|| Effective::exact(&fit.body))?
}
