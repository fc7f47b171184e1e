//! Fits a candidate to a log by least squares. The start and the unknown numbers of the body are fitted.

use super::candidates::Candidate;
use super::effective::Effective;
use super::logged::{Log, LogRow, LoggedBody};
use super::matching_spring::{Map, matching_spring};
use super::motion::{run, run_by_map};
use crate::sim::least_squares;

/// Number of Gauss-Newton iterations if the log has the initial velocity; a linear motion needs one.
const ITERATIONS: usize = 1;
/// Number of iterations if the log lacks that velocity; the second iteration is for the last digits.
const ITERATIONS_WITHOUT_VELOCITY: usize = 2;
/// Number of iterations if the spring is fitted too.
const ITERATIONS_WITH_SPRING: usize = 12;
/// The fit ends once an iteration lowers the sum of squares by less than this share.
const SETTLED: f64 = 1e-6;
/// Displacement for the derivatives, in units of the scale.
const DISPLACEMENT: f64 = 1e-4;
/// Largest residual that may be rounding in a log of single precision.
const PRECISE_IN_SINGLE: f64 = 1.5e-5;
/// Largest residual that may be rounding in a log of double precision by an engine, which may keep a mass in single
/// precision.
const PRECISE_OF_ENGINE: f64 = 3e-6;
/// Largest residual that may be rounding in a log of double precision by any other method.
const PRECISE_IN_DOUBLE: f64 = 1e-8;
/// Largest residual that is rounding alone.
const EXACT: f64 = 1e-9;
/// Largest root mean square of the rounding of printed digits, in units of the last one.
const HALF_A_DIGIT: f64 = 0.5;
/// Number of residuals from which a motion foretells the next one, and the largest part that it leaves of it.
const BEFORE: usize = 4;
const FORETOLD: f64 = 0.5;
/// Damping ratio that is none.
const NO_DAMPING: f64 = 1e-6;
/// Displacement in a run that starts from nothing, in units of the scale.
const DISPLACEMENT_FROM_NOTHING: f64 = 1e-9;
/// A runaway starts below this share of the scale, and so below the noise.
const NOTHING: f64 = 0.01;
/// Maximum number of times that a step is halved if it does not improve the fit.
const HALVINGS: u32 = 8;
/// Minimum number of rows that can separate noise from autocorrelation.
const MIN_ROWS_OF_NOISE: usize = 20;
/// Tolerated autocorrelation beyond the 3σ limit of white noise.
const AUTOCORRELATION_SLACK: f64 = 0.1;
/// Largest part of noise, relative to its root mean square; 3000 rows of normal noise reach 3.6 on average.
const FEW: f64 = 6.0;
/// Largest lag of the autocorrelation, in rows.
const LAGS: usize = 3;

/// A candidate fitted to a log.
pub(super) struct Fit {
    /// The body with its fitted numbers.
    pub(super) body: LoggedBody,
    /// Fitted coordinate and velocity of the first row.
    pub(super) start: [f64; 2],
    /// The run at the log's rows, in units of the scale.
    run: Vec<[f64; 2]>,
    /// Largest residuals of each column that may be rounding alone.
    precise: [f64; 2],
    /// Residuals of the coordinate and, if logged, of the velocity.
    residuals: Vec<Vec<f64>>,
}

/// Returns the states of a body at the log's rows, in units of the scale.
type Run<'a> = dyn Fn(&LoggedBody, [f64; 2]) -> Option<Vec<[f64; 2]>> + 'a;

/// Whether two runs of one start differ by rounding at most.
fn are_alike(a: &[[f64; 2]], b: &[[f64; 2]]) -> bool {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.into_iter().all(|(a, b)| (a - b).abs() <= EXACT * (1.0 + a.abs()))
}

/// Returns the velocity of the first row if it is logged, or else the slope to the next row.
fn first_velocity(log: &Log, tick_s: f64) -> f64 {
    let [first, second] = [log.rows()[0], log.rows()[1]];
    let slope = (second.x - first.x) / ((second.tick - first.tick) as f64 * tick_s);
    first.v.unwrap_or(slope)
}

/// Where a fit starts.
#[derive(Clone, Copy)]
pub(super) struct Start {
    pub(super) tick_hz: f64,
    /// The rest, if it is fitted.
    pub(super) rest: Option<f64>,
    /// The motion that the log shows, from which the spring is found if it is fitted.
    pub(super) seen: Option<Effective>,
    /// The map of a tick that the log shows about its rest, if it is needed.
    pub(super) map: Option<Map>,
}

/// Fits `candidate` to a log. `None` if the candidate cannot run on the body, or if its run diverges.
pub(super) fn fit(
    log: &Log,
    body: &LoggedBody,
    candidate: Candidate,
    Start { tick_hz, rest: first_rest, seen, map }: Start,
) -> Option<Fit> {
    let tick_s = 1.0 / tick_hz;
    let scale = log.scale();
    let mut body = body.clone();
    let is_spring_known = body.spring.is_some();
    let is_rest_known = body.rest.is_some();
    let rest = *body.rest.get_or_insert_with(|| first_rest.unwrap_or(0.0));
    let mut other_spring = None;
    if !is_spring_known {
        let there = log.resting_at_zero(rest);
        let of_log = Effective::of_log(&there, &body, tick_s);
        let spring = |seen: Effective| {
            Some(seen.spring()?).filter(|spring| spring.iter().all(|part| part.is_finite()))
        };
        let seen = seen.or(of_log)?;
        body.spring = Some(of_log.and_then(spring).or_else(|| spring(seen))?);
        other_spring = matching_spring(candidate, &body, tick_s, (&seen, map));
    }
    let (mut start, mut displacement) = start_of(log, &body, tick_s);
    let iterations = match (is_spring_known, log.has_velocities()) {
        (true, true) => ITERATIONS,
        (true, false) => ITERATIONS_WITHOUT_VELOCITY,
        (false, _) => ITERATIONS_WITH_SPRING,
    };
    let is_fitted = [true, body.v0.is_none(), !is_spring_known, !is_spring_known, !is_rest_known];
    let fitted: Vec<usize> = (0..PARAMETERS).filter(|index| is_fitted[*index]).collect();
    let ticks = || log.rows().iter().map(|row| row.tick);
    let stepped = |body: &LoggedBody, start: [f64; 2]| {
        run(candidate, body, start, tick_s, ticks()).map(|states| in_units(&states, scale))
    };
    let mapped = |body: &LoggedBody, start: [f64; 2]| {
        run_by_map(candidate, body, start, tick_s, ticks()).map(|states| in_units(&states, scale))
    };
    if let Some(spring) = other_spring {
        let other = LoggedBody { spring: Some(spring), ..body.clone() };
        let off = |body: &LoggedBody, start| {
            let states = stepped(body, start)?;
            Some(squares(&residuals(log, &states, scale))).filter(|off| off.is_finite())
        };
        // A runaway begins below the scale of the log, but under the right spring it begins as logged.
        let logged = [log.rows()[0].x, first_velocity(log, tick_s)];
        let is_nearer = |start| {
            off(&other, start)
                .is_some_and(|there| off(&body, start).is_none_or(|here| there < here))
        };
        let is_right = || {
            let near = NOTHING * NOTHING * log.numbers() as f64;
            off(&other, logged).is_some_and(|off| off <= near)
        };
        if start != logged && body.v0.is_none() && is_right() {
            (start, displacement, body) = (logged, DISPLACEMENT, other);
        } else if is_nearer(start) {
            body = other;
        }
    }
    let search =
        Search { log, tick_s, displacement, fitted, iterations, is_halved: !is_spring_known };
    let refine = |go: &Run<'_>| search.refine(go, start, body.clone());
    // Most candidates are linear, so that the map of a tick stands for their steps.
    let first = stepped(&body, start).zip(mapped(&body, start));
    let is_linear = first.is_some_and(|(steps, map)| are_alike(&steps, &map));
    let by_map = is_linear.then(|| refine(&mapped)).flatten().and_then(|(start, body, now)| {
        let steps = stepped(&body, start)?;
        are_alike(&steps, &now).then_some((start, body, steps))
    });
    let worth = |now: &[[f64; 2]]| squares(&residuals(log, now, scale));
    let mut found = by_map.or_else(|| refine(&stepped))?;
    let precise = precise(log, candidate, is_spring_known);
    let is_far = worth(&found.2) > precise[0] * precise[0] * log.numbers() as f64;
    if !is_linear && !is_spring_known && log.has_velocities() && is_far {
        // Runs have folds where a tick is not linear. Single ticks lead past them.
        let single = |body: &LoggedBody, _: [f64; 2]| {
            single_ticks(log, candidate, body, tick_s).map(|states| in_units(&states, scale))
        };
        let of_spring = Search { fitted: vec![2, 3], ..search.clone() };
        let past = of_spring.refine(&single, start, body.clone());
        let other = past.and_then(|(start, body, _)| search.refine(&stepped, start, body));
        if let Some(other) = other.filter(|other| worth(&other.2) < worth(&found.2)) {
            found = other;
        }
    }
    let (start, body, now) = found;
    let residuals = residuals(log, &now, scale);
    let is_finite = residuals.iter().flatten().all(|r| r.is_finite());
    is_finite.then_some(Fit { body, start, run: now, precise, residuals })
}

/// Number of rows whose single ticks are fitted.
const SINGLE_TICKS: usize = 60;

/// Returns the first row, and the states after a tick from each of the first rows; `None` without velocities.
fn single_ticks(
    log: &Log,
    candidate: Candidate,
    body: &LoggedBody,
    tick_s: f64,
) -> Option<Vec<[f64; 2]>> {
    let rows = &log.rows()[..log.rows().len().min(SINGLE_TICKS)];
    let state = |row: &LogRow| Some([row.x, row.v?]);
    let after = |pair: &[LogRow]| {
        let ticks = [pair[0].tick, pair[1].tick].into_iter();
        run(candidate, body, state(&pair[0])?, tick_s, ticks)?.last().copied()
    };
    [state(&rows[0])].into_iter().chain(rows.windows(2).map(after)).collect()
}

/// A search for the best numbers of a body, whose runs are made elsewhere.
#[derive(Clone)]
struct Search<'a> {
    log: &'a Log,
    tick_s: f64,
    /// Displacement for the slopes, in units of the scale.
    displacement: f64,
    /// Indices of the parameters that are fitted.
    fitted: Vec<usize>,
    iterations: usize,
    /// Whether a step that does not improve the fit is halved.
    is_halved: bool,
}

impl Search<'_> {
    /// Fits start and body by Gauss-Newton steps, and returns them with their run.
    fn refine(
        &self,
        go: &Run<'_>,
        mut start: [f64; 2],
        mut body: LoggedBody,
    ) -> Option<([f64; 2], LoggedBody, Vec<[f64; 2]>)> {
        let Self { log, tick_s, displacement, ref fitted, iterations, is_halved } = *self;
        let scale = log.scale();
        let mut now = go(&body, start)?;
        for _ in 0..iterations {
            let unit = start_unit(scale, &body, tick_s);
            let mut columns = Vec::new();
            for index in fitted {
                let (mut there, mut other) = (start, body.clone());
                displace(*index, displacement * unit[*index], &mut there, &mut other);
                columns.push(go(&other, there)?);
            }
            let residual = residuals(log, &now, scale).concat();
            let base = flat(log, &now);
            let slope = |there: &Vec<[f64; 2]>| -> Vec<f64> {
                let changes = flat(log, there).into_iter().zip(&base);
                changes.map(|(there, base)| (there - base) / displacement).collect()
            };
            let slopes: Vec<Vec<f64>> = columns.iter().map(slope).collect();
            let Some(change) = least_squares(&slopes, &residual) else { break };
            let worth = |states: &[[f64; 2]]| squares(&residuals(log, states, scale));
            let before = worth(&now);
            let halvings = if is_halved { HALVINGS } else { 0 };
            let nearer = (0..=halvings).find_map(|halving| {
                let part = libm::scalbn(1.0, -(halving as i32));
                let (mut there, mut other) = (start, body.clone());
                for (index, change) in fitted.iter().zip(&change) {
                    displace(*index, part * change * unit[*index], &mut there, &mut other);
                }
                let reached = go(&other, there)?;
                (worth(&reached) < before).then_some((there, other, reached))
            });
            let Some(nearer) = nearer else { break };
            (start, body, now) = nearer;
            if worth(&now) > (1.0 - SETTLED) * before {
                break;
            }
        }
        Some((start, body, now))
    }
}

/// Returns the state from which a fit starts, and the displacement for its slopes.
fn start_of(log: &Log, body: &LoggedBody, tick_s: f64) -> ([f64; 2], f64) {
    let start = [log.rows()[0].x, body.v0.unwrap_or(first_velocity(log, tick_s))];
    let is_nothing =
        start.iter().zip(log.scale()).all(|(start, scale)| start.abs() < NOTHING * scale);
    match log.has_velocities() && is_nothing {
        true => ([0.0; 2], DISPLACEMENT_FROM_NOTHING),
        false => (start, DISPLACEMENT),
    }
}

/// Returns the residuals of each column, in units of the log, up to which a run is the logged one.
fn precise(log: &Log, candidate: Candidate, is_spring_known: bool) -> [f64; 2] {
    // A fitted spring takes up the mass.
    let has_mass = candidate.method.is_engine() && is_spring_known;
    let precise = match (log.is_double(), has_mass) {
        (false, _) => PRECISE_IN_SINGLE,
        (true, true) => PRECISE_OF_ENGINE,
        (true, false) => PRECISE_IN_DOUBLE,
    };
    log.printed().map(|printed| precise.max(HALF_A_DIGIT * printed))
}

/// Number of parameters, which are coordinate and velocity at the start, stiffness, damping and rest.
const PARAMETERS: usize = 5;

/// Adds `by` to the parameter with this index.
fn displace(index: usize, by: f64, start: &mut [f64; 2], body: &mut LoggedBody) {
    match (index, &mut body.spring) {
        (0 | 1, _) => start[index] += by,
        (4, _) => body.rest = body.rest.map(|rest| rest + by),
        (_, Some(spring)) => spring[index - 2] += by,
        (_, None) => {}
    }
}

/// Returns the units of the parameters.
fn start_unit(scale: [f64; 2], body: &LoggedBody, tick_s: f64) -> [f64; PARAMETERS] {
    let [stiffness, _] = body.spring.unwrap_or_default();
    let stiffness = stiffness.abs().max(1e-6);
    let v = if scale[1] == 1.0 { scale[0] / tick_s } else { scale[1] };
    [scale[0], v, stiffness, stiffness.sqrt(), scale[0]]
}

fn in_units(states: &[[f64; 2]], scale: [f64; 2]) -> Vec<[f64; 2]> {
    states.iter().map(|[x, v]| [x / scale[0], v / scale[1]]).collect()
}

/// Returns all coordinates, followed by all logged velocities.
fn flat(log: &Log, states: &[[f64; 2]]) -> Vec<f64> {
    let x = states.iter().map(|state| state[0]);
    let logged = states.iter().zip(log.rows()).filter(|(_, row)| row.v.is_some());
    x.chain(logged.map(|(state, _)| state[1])).collect()
}

fn residuals(log: &Log, states: &[[f64; 2]], scale: [f64; 2]) -> Vec<Vec<f64>> {
    let rows = || log.rows().iter().zip(states);
    let x = rows().map(|(row, state)| row.x / scale[0] - state[0]).collect();
    let v: Vec<f64> =
        rows().filter_map(|(row, state)| Some(row.v? / scale[1] - state[1])).collect();
    if v.is_empty() { vec![x] } else { vec![x, v] }
}

fn squares(residuals: &[Vec<f64>]) -> f64 {
    residuals.iter().flatten().map(|r| r * r).sum()
}

fn mean_square(residuals: &[f64]) -> f64 {
    residuals.iter().map(|r| r * r).sum::<f64>() / residuals.len() as f64
}

impl Fit {
    /// Returns the sum of the squared residuals.
    pub(super) fn squares(&self) -> f64 {
        squares(&self.residuals)
    }

    /// Returns the root mean square of the residuals.
    pub(super) fn residual(&self) -> f64 {
        mean_square(&self.residuals.concat()).sqrt()
    }

    /// Returns the damping ratio of the fitted spring.
    pub(super) fn damping_ratio(&self) -> f64 {
        let [stiffness, damping] = self.body.spring.unwrap_or_default();
        damping / (2.0 * stiffness.abs().sqrt()).max(f64::MIN_POSITIVE)
    }

    /// Returns the largest damping ratio that may be the rounding or the noise of the log.
    pub(super) fn no_damping(&self) -> f64 {
        NO_DAMPING + self.residual()
    }

    /// Returns minus twice the log-likelihood, up to a constant. Each column has its own noise, never less than
    /// `rounding`.
    pub(super) fn deviance(&self, rounding: f64) -> f64 {
        let of = |residuals: &Vec<f64>| {
            residuals.len() as f64 * libm::log(mean_square(residuals) + rounding * rounding)
        };
        self.residuals.iter().map(of).sum()
    }

    /// Returns the largest difference between the two runs, in units of the scale, or between their springs, relative
    /// to this fit's spring.
    pub(super) fn distance(&self, other: &Fit) -> f64 {
        let [a, b] = [self, other].map(|fit| fit.body.spring.unwrap_or_default());
        let critical = 2.0 * a[0].abs().sqrt();
        let apart = (a[0] - b[0]).abs() / a[0].abs() + (a[1] - b[1]).abs() / critical;
        let of_springs = if a == b { 0.0 } else { apart };
        self.distance_of_runs(other).max(of_springs)
    }

    fn distance_of_runs(&self, other: &Fit) -> f64 {
        let apart = |(a, b): (&[f64; 2], &[f64; 2])| {
            let velocities = if self.residuals.len() > 1 { (a[1] - b[1]).abs() } else { 0.0 };
            (a[0] - b[0]).abs().max(velocities)
        };
        self.run.iter().zip(&other.run).map(apart).fold(0.0, f64::max)
    }

    /// Whether there are too few rows to recognise noise.
    pub(super) fn is_short(&self) -> bool {
        self.run.len() < MIN_ROWS_OF_NOISE
    }

    /// Whether the residual may be neither rounding nor noise.
    pub(super) fn is_doubtful(&self) -> bool {
        let is_beyond_rounding = self.residual() > EXACT;
        is_beyond_rounding
            && (self.is_autocorrelated([EXACT; 2])
                || (self.is_short() && self.residual() > self.precise[0]))
    }

    /// Whether the residual is autocorrelated and above rounding level, so that it is not noise.
    pub(super) fn is_systematic(&self) -> bool {
        self.is_autocorrelated(self.precise)
    }

    /// Whether the residual is larger than `precise`, and autocorrelated or in a few rows.
    fn is_autocorrelated(&self, precise: [f64; 2]) -> bool {
        self.residuals.iter().zip(precise).any(|(residuals, precise)| {
            let square = mean_square(residuals);
            let follows = |lag: usize| {
                let pairs = residuals.iter().zip(&residuals[lag..]);
                let mean = pairs.map(|(a, b)| a * b).sum::<f64>() / (residuals.len() - lag) as f64;
                (mean / square).abs()
                    > 3.0 / (residuals.len() as f64).sqrt() + AUTOCORRELATION_SLACK
            };
            let is_of_few = || {
                let largest = residuals.iter().fold(0.0_f64, |largest, r| largest.max(r.abs()));
                residuals.len() >= MIN_ROWS_OF_NOISE && largest > FEW * square.sqrt()
            };
            let lags = 1..=LAGS.min(residuals.len() - 1);
            square.sqrt() > precise
                && (lags.into_iter().any(follows) || is_of_few() || is_foretold(residuals))
        })
    }
}

/// Whether residuals follow from those before them, as those of a swing do and noise does not.
fn is_foretold(residuals: &[f64]) -> bool {
    if residuals.len() < MIN_ROWS_OF_NOISE + BEFORE {
        return false;
    }
    let right = &residuals[BEFORE..];
    let before = |lag: usize| residuals[BEFORE - lag..residuals.len() - lag].to_vec();
    let columns: Vec<Vec<f64>> = (1..=BEFORE).map(before).collect();
    least_squares(&columns, right).is_some_and(|parts| {
        let foretold = |row: usize| -> f64 {
            parts.iter().zip(&columns).map(|(part, column)| part * column[row]).sum()
        };
        let left: Vec<f64> = (0..right.len()).map(|row| right[row] - foretold(row)).collect();
        mean_square(&left) < FORETOLD * FORETOLD * mean_square(right)
    })
}
