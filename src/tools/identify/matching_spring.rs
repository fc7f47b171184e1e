//! The spring under which a candidate moves as a log shows, from the map of its first tick.

use super::candidates::Candidate;
use super::effective::Effective;
use super::logged::{Log, LogRow, LoggedBody};
use super::motion::map_of_tick;
use crate::sim::least_squares;

/// Shares of the visible stiffness, and stiffnesses in units of the squared tick, near which the search starts. Stiff
/// springs look stiffer, or softer, than they are.
const SHARES: [f64; 6] = [1.0, 0.5, 0.25, 2.0, 4.0, 8.0];
const STIFFNESSES: [f64; 7] = [0.05, 0.25, 1.0, 2.5, 5.0, 10.0, 20.0];
/// Damping ratios near which the search starts, beside the visible damping.
const RATIOS: [f64; 4] = [0.0, 0.1, 0.5, 1.0];
/// Number of starts from which the search goes on.
const NEAREST: usize = 4;
/// Maximum number of Newton iterations from a start.
const ITERATIONS: usize = 30;
/// Displacement for the derivatives, in units of the squared tick and the tick.
const DISPLACEMENT: f64 = 1e-6;
/// The search ends at this distance of the maps.
const FOUND: f64 = 1e-11;
/// Maximum number of times that a step is halved.
const HALVINGS: i32 = 12;
/// Damping below zero that is rounding, in units of the tick.
const ROUNDING: f64 = 1e-5;

/// The map of a tick of a log, from x and v to the next x and v.
pub(super) type Map = [[f64; 2]; 2];

/// Returns the map of a tick that a log about its rest shows, with this length of a tick. `None` if the log lacks
/// velocities. Rows beyond the first count by their directions, for a runaway is all in its last rows.
pub(super) fn map_of_log(log: &Log, tick_s: f64) -> Option<Map> {
    let is_pair = |pair: &&[LogRow]| pair[1].tick == pair[0].tick + 1;
    let pairs: Vec<_> = log.rows().windows(2).filter(is_pair).collect();
    let far = |row: &LogRow| Some(libm::hypot(row.x, row.v? * tick_s));
    let least = far(log.rows().first()?)?;
    let of = |row: usize| -> Option<[Vec<f64>; 2]> {
        let parts = pairs.iter().map(|pair| {
            let size = far(&pair[0])?.max(least);
            Some([pair[row].x / size, pair[row].v? / size])
        });
        let parts: Vec<[f64; 2]> = parts.collect::<Option<_>>()?;
        Some([0, 1].map(|of| parts.iter().map(|part| part[of]).collect()))
    };
    let (before, [x, v]) = (of(0)?, of(1)?);
    let row = |after: &[f64]| <[f64; 2]>::try_from(least_squares(&before, after)?).ok();
    Some([row(&x)?, row(&v)?])
}

/// The numbers that tell a motion: the parts of its map in units of the tick, or else the map's trace and determinant.
fn parts([[a, b], [c, d]]: Map, tick_s: f64, is_whole: bool) -> [f64; 4] {
    match is_whole {
        true => [a, b / tick_s, c * tick_s, d],
        false => [a + d, a * d - b * c, 0.0, 0.0],
    }
}

/// Returns trace and determinant of the map of a tick under which the motion is `seen`.
fn parts_of(seen: &Effective, tick_s: f64) -> [f64; 4] {
    let Effective { omega, decay } = *seen;
    let square = omega * omega - decay * decay;
    let root = square.abs().sqrt() * tick_s;
    let turned = if square > 0.0 { libm::cos(root) } else { libm::cosh(root) };
    [2.0 * libm::exp(-decay * tick_s) * turned, libm::exp(-2.0 * decay * tick_s), 0.0, 0.0]
}

fn size(off: &[f64; 4]) -> f64 {
    off.iter().fold(0.0, |size, part| size.max(part.abs()))
}

/// Returns the stiffness and the damping at which the candidate's tick has the `map` of the log or, without one, the
/// eigenvalues of the motion that is `seen`; `None` if none is found. Of several, the nearest is returned, or that with
/// damping and the smallest stiffness.
pub(super) fn matching_spring(
    candidate: Candidate,
    body: &LoggedBody,
    tick_s: f64,
    (seen, map): (&Effective, Option<Map>),
) -> Option<[f64; 2]> {
    let wanted = map.map_or(parts_of(seen, tick_s), |map| parts(map, tick_s, true));
    let spring_of = |[k, c]: [f64; 2]| [k / (tick_s * tick_s), c / tick_s];
    let off = |spring: [f64; 2]| -> Option<[f64; 4]> {
        let body = LoggedBody { spring: Some(spring_of(spring)), ..body.clone() };
        let mut off = parts(map_of_tick(candidate, &body, tick_s)?, tick_s, map.is_some());
        off.iter_mut().zip(wanted).for_each(|(part, wanted)| *part -= wanted);
        off.iter().all(|part| part.is_finite()).then_some(off)
    };
    let from = |mut spring: [f64; 2]| {
        let mut now = off(spring)?;
        for _ in 0..ITERATIONS {
            if size(&now) <= FOUND {
                break;
            }
            let slope = |by: [f64; 2]| {
                let there = off([spring[0] + by[0], spring[1] + by[1]])?;
                Some(
                    there
                        .iter()
                        .zip(now)
                        .map(|(there, now)| (there - now) / DISPLACEMENT)
                        .collect(),
                )
            };
            let slopes = [slope([DISPLACEMENT, 0.0])?, slope([0.0, DISPLACEMENT])?];
            let step = least_squares(&slopes, &now)?;
            let nearer = (0..=HALVINGS).find_map(|halving| {
                let part = libm::scalbn(1.0, -halving);
                let other = [spring[0] - part * step[0], spring[1] - part * step[1]];
                let reached = off(other).filter(|_| other[0] > 0.0)?;
                (size(&reached) < size(&now)).then_some((other, reached))
            });
            let Some(nearer) = nearer else { break };
            (spring, now) = nearer;
        }
        Some((spring, size(&now)))
    };
    // Rounding of the map limits the last digits, and noise moves the whole map of a log.
    let is_found = |off: f64| off <= FOUND.sqrt();
    let [stiffness, damping] = seen.spring()?;
    let visible = [stiffness * tick_s * tick_s, damping * tick_s];
    if map.is_some()
        && let Some((spring, _)) = from(visible).filter(|(_, off)| is_found(*off))
    {
        return Some(spring_of(spring));
    }
    let stiffnesses = SHARES.iter().map(|share| share * visible[0]).chain(STIFFNESSES);
    let starts = stiffnesses.flat_map(|k| {
        let dampings = RATIOS.iter().map(move |ratio| 2.0 * ratio * k.sqrt());
        dampings.chain([visible[1]]).map(move |c| [k, c])
    });
    let mut starts: Vec<_> = starts.filter_map(|start| Some((size(&off(start)?), start))).collect();
    starts.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let found = starts.into_iter().take(NEAREST).filter_map(|(_, start)| from(start));
    let found = found.filter(|(_, off)| map.is_some() || is_found(*off));
    let rank = |([k, c], off): &([f64; 2], f64)| {
        let far = if map.is_some() { *off } else { 0.0 };
        (far, *c < -ROUNDING, *k)
    };
    found
        .min_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal))
        .map(|(spring, _)| spring_of(spring))
}
