//! The candidates nearest to a log, without fitting each of them to the whole of it.

use super::candidates::{Candidate, candidates};
use super::decision::rounding;
use super::fit::{Fit, fit};
use super::logged::Log;
use super::logged_body::LoggedBody;

/// The first part of a log, to which every candidate is fitted, in ticks.
const HEAD_TICKS: u64 = 60;
/// A candidate whose sum of squares exceeds the nearest's by this factor does not explain a log.
const APART: f64 = 4.0;

/// The candidates that may explain `log`, and the nearest that does not, each fitted.
///
/// The residual on the head of a log is a lower bound for that on the whole log. So candidates are taken in that order,
/// until the bound of the next is too large.
pub(super) fn search(log: &Log, body: &LoggedBody, tick_hz: f64) -> Vec<(Candidate, Fit)> {
    let head = if body.spring.is_some() { log.head(HEAD_TICKS) } else { log.clone() };
    let is_whole = head.rows().len() == log.rows().len();
    let fit_to = |log: &Log, candidate| fit(log, body, candidate, tick_hz);
    let mut queue: Vec<(Candidate, Fit)> = candidates(body)
        .into_iter()
        .filter_map(|candidate| Some((candidate, fit_to(&head, candidate)?)))
        .collect();
    queue.sort_by(|(_, a), (_, b)| a.squares().total_cmp(&b.squares()));
    let (mut fits, mut squares): (Vec<(Candidate, Fit)>, Vec<f64>) = (Vec::new(), Vec::new());
    for (candidate, of_head) in queue {
        if of_head.squares() > enough(&squares, log) {
            break;
        }
        let fit = if is_whole { Some(of_head) } else { fit_to(log, candidate) };
        let Some(fit) = fit else { continue };
        squares.push(fit.squares());
        fits.push((candidate, fit));
    }
    fits
}

/// The sum of squares beyond which nothing is worth a fit.
fn enough(squares: &[f64], log: &Log) -> f64 {
    let numbers = log.numbers() as f64;
    let nearest = squares.iter().copied().fold(f64::INFINITY, f64::min);
    let rounding = rounding((nearest / numbers).sqrt(), log.is_double());
    let near = APART * (nearest + numbers * rounding * rounding);
    let farther = squares.iter().copied().filter(|squares| *squares > near);
    near.max(farther.fold(f64::INFINITY, f64::min))
}
