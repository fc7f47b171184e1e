//! What a player sees in a log that no method explains.

use super::candidates::{Candidate, SpringAs};
use super::decision::NO_FIT;
use super::effective::Effective;
use super::fit::fit;
use super::logged::Log;
use super::logged_body::LoggedBody;
use crate::sim::integrators::method;

/// The id of a method that is exact on springs with drag.
const EXACT: &str = "exponential-rosenbrock-euler";

/// The motion of the equation that comes nearest to a log; `None` if none comes near.
pub(super) fn nearest(log: &Log, body: &LoggedBody, tick_hz: f64) -> Option<Effective> {
    let seen = Effective::of_log(log, body, 1.0 / tick_hz)?;
    let mut free = body.clone();
    match seen.spring() {
        Some(_) => free.spring = None,
        None => free.drag = seen.decay,
    }
    let exact = Candidate { method: method(EXACT)?, substeps: 1, spring: SpringAs::Acceleration };
    let fit = fit(log, &free, exact, tick_hz)?;
    let is_near = fit.residual() <= NO_FIT;
    is_near.then(|| Effective::exact(&fit.body))?
}
