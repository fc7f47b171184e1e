//! Decides from the fits of all candidates which method made a log.
//!
//! A wrong name is worse than none: a method is named only if no other that moves the body differently explains the log
//! as well. Between equal fits the settings that people usually choose win, by a penalty for rare ones.

use std::collections::BTreeSet;

use super::Conclusion;
use super::candidates::{Candidate, candidates};
use super::fit::Fit;
use super::logged::LoggedBody;

/// Smallest residual due to rounding in a run of double precision, in units of the largest values.
const MIN_ROUNDING: f64 = 1e-9;
/// Largest residual due to rounding in a log of single precision.
const MAX_ROUNDING_IN_SINGLE: f64 = 3e-5;
/// Largest residual due to rounding in a log of double precision.
const MAX_ROUNDING_IN_DOUBLE: f64 = 3e-6;
/// Residuals below this multiple of the smallest residual count as rounding, within the limits above.
const TIMES_CLOSEST: f64 = 10.0;
/// An equivalent candidate ranks behind the others if its residual exceeds the smallest residual by this factor.
const TIMES_NEAREST: f64 = 3.0;
/// Candidates are equivalent if their runs and springs differ by at most this.
const SAME: f64 = 1e-5;
/// Candidates are also equivalent if they differ by at most this share of the residual.
const SAME_PART: f64 = 0.2;
/// Smallest difference of deviance that decides between candidates, which is four standard deviations.
const DECISIVE: f64 = 16.0;
/// Largest residual of a fit. A larger one is no fit, even if it looks like noise.
pub(super) const NO_FIT: f64 = 0.01;
/// If the residual may be neither noise nor rounding, a method is named only if its rival's residual is larger by this
/// factor.
const CLEAR: f64 = 3.0;
/// If at least this share of all methods explains a log, the log decides nothing.
const NEARLY_ALL: f64 = 0.8;

/// Returns the largest residual that counts as rounding in a log of this precision, if the smallest residual is
/// `closest`.
pub(super) fn rounding(closest: f64, is_double: bool) -> f64 {
    let largest = if is_double { MAX_ROUNDING_IN_DOUBLE } else { MAX_ROUNDING_IN_SINGLE };
    (TIMES_CLOSEST * closest).clamp(MIN_ROUNDING, largest)
}

/// The conclusion, with the candidates behind it.
pub(super) struct Decision<'a> {
    pub(super) conclusion: Conclusion,
    /// The best candidate, followed by its equivalents.
    pub(super) same: Vec<&'a (Candidate, Fit)>,
    /// Usual candidates that move differently and explain the log as well, the likeliest first.
    pub(super) rivals: Vec<&'a (Candidate, Fit)>,
    /// Other candidates that explain the log as well, but are set aside as rare.
    pub(super) unusual: Vec<&'a (Candidate, Fit)>,
    /// The nearest candidate that moves differently. If that one is implausible and nearly all methods fit, it is an
    /// equivalent candidate of another method.
    pub(super) rival: Option<&'a (Candidate, Fit)>,
}

/// Decides between the candidates for a body by their fits to a log of double or single precision; `None` if there are
/// no fits.
pub(super) fn decide<'a>(
    fits: &'a [(Candidate, Fit)],
    body: &LoggedBody,
    is_double: bool,
) -> Option<Decision<'a>> {
    // A spring that is fitted may lose nothing, but gains nothing.
    let is_spring = |fit: &Fit| body.spring.is_some() || fit.damping_ratio() >= -fit.no_damping();
    let springs: Vec<&(Candidate, Fit)> = fits.iter().filter(|(_, fit)| is_spring(fit)).collect();
    let gains = springs.is_empty();
    let fits = if gains { fits.iter().collect() } else { springs };
    let least = fits.iter().map(|(_, fit)| fit.residual()).fold(f64::INFINITY, f64::min);
    let rounding = rounding(least, is_double);
    let deviance = |(_, fit): &(Candidate, Fit)| fit.deviance(rounding);
    let with_rarity = |fitted: &(Candidate, Fit)| deviance(fitted) + fitted.0.rarity();
    let by_both =
        |a: &&(Candidate, Fit), b: &&(Candidate, Fit)| with_rarity(a).total_cmp(&with_rarity(b));
    let explains = |(_, fit): &(Candidate, Fit)| fit.residual() <= NO_FIT && !fit.is_systematic();
    let lowest = fits.iter().copied().map(deviance).fold(f64::INFINITY, f64::min);
    let may_explain =
        |fitted: &&(Candidate, Fit)| explains(fitted) && deviance(fitted) - lowest < DECISIVE;
    let closest = fits.iter().copied().filter(may_explain).min_by(by_both);
    let closest = closest.or_else(|| fits.iter().copied().min_by(by_both))?;
    let fits_as_well = |fitted: &(Candidate, Fit)| deviance(fitted) - deviance(closest) < DECISIVE;
    let is_plausible =
        |fitted: &(Candidate, Fit)| with_rarity(fitted) - with_rarity(closest) < DECISIVE;
    let apart = SAME.max(SAME_PART * closest.1.residual());
    let (mut same, others): (Vec<_>, Vec<_>) = fits
        .into_iter()
        .partition(|fitted| fits_as_well(fitted) && fitted.1.distance(&closest.1) <= apart);
    let nearest = same.iter().map(|(_, fit)| fit.residual()).fold(f64::INFINITY, f64::min);
    same.sort_by_key(|(candidate, fit)| {
        let is_nearest = fit.residual() <= TIMES_NEAREST * nearest + MIN_ROUNDING / TIMES_CLOSEST;
        (!is_nearest, candidate.preference())
    });
    let best = *same.first()?;
    let rival = others.iter().copied().min_by(by_both);
    let is_clear = rival.is_none_or(|(_, fit)| fit.residual() > CLEAR * best.1.residual());
    let says_nothing = explained_by_nearly_all(&same, body);
    let rival = match rival {
        Some(rival) if is_plausible(rival) => Some(rival),
        _ if says_nothing => same.iter().find(|other| other.0.method != best.0.method).copied(),
        _ => rival,
    };
    let is_set_aside = |fitted: &&(Candidate, Fit)| {
        let is_rival = rival.is_some_and(|rival| rival.0 == fitted.0);
        fits_as_well(fitted) && !is_plausible(fitted) && !is_rival
    };
    let unusual = others.iter().copied().filter(is_set_aside).collect();
    let is_rival = |fitted: &&(Candidate, Fit)| fits_as_well(fitted) && is_plausible(fitted);
    let mut rivals: Vec<_> = others.iter().copied().filter(is_rival).collect();
    rivals.sort_by(by_both);
    let is_doubtful = best.1.is_doubtful() && !is_clear;
    let conclusion = if gains || !explains(best) {
        Conclusion::Unknown
    } else if says_nothing || is_doubtful || rival.is_some_and(is_plausible) {
        Conclusion::CannotTell
    } else {
        Conclusion::Identified
    };
    Some(Decision { conclusion, same, rivals, unusual, rival })
}

/// Whether nearly all methods explain the log, so that it decides nothing.
fn explained_by_nearly_all(same: &[&(Candidate, Fit)], body: &LoggedBody) -> bool {
    let methods = |all: &mut dyn Iterator<Item = Candidate>| {
        all.map(|candidate| candidate.method.id).collect::<BTreeSet<_>>().len() as f64
    };
    let of_same = methods(&mut same.iter().map(|(candidate, _)| *candidate));
    of_same >= NEARLY_ALL * methods(&mut candidates(body).into_iter())
}
