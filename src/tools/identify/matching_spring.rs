//! The spring under which a candidate moves as a log shows, from the map of its first tick.

use super::candidates::Candidate;
use super::effective::Effective;
use super::logged::LoggedBody;
use super::motion::map_of_tick;

/// Shares of the visible stiffness from which the search starts. Stiff springs look stiffer, or softer, than they are.
const STARTS: [f64; 6] = [1.0, 0.5, 0.25, 2.0, 4.0, 8.0];
/// Maximum number of Newton iterations from a start.
const ITERATIONS: usize = 30;
/// Displacement for the derivatives, in units of the squared tick and the tick.
const DISPLACEMENT: f64 = 1e-6;
/// The search ends at this distance of trace and determinant.
const FOUND: f64 = 1e-11;
/// Maximum number of times that a step is halved.
const HALVINGS: i32 = 12;
/// Damping below zero that is rounding, in units of the tick.
const ROUNDING: f64 = 1e-5;

/// Returns trace and determinant of the map of a tick under which the motion is `seen`.
fn wanted(seen: &Effective, tick_s: f64) -> [f64; 2] {
    let Effective { omega, decay } = *seen;
    let square = omega * omega - decay * decay;
    let root = square.abs().sqrt() * tick_s;
    let turned = if square > 0.0 { libm::cos(root) } else { libm::cosh(root) };
    [2.0 * libm::exp(-decay * tick_s) * turned, libm::exp(-2.0 * decay * tick_s)]
}

/// Returns the stiffness and the damping at which the candidate's tick has the eigenvalues of the motion that is
/// `seen`; `None` if none is found. Of several, that with damping and the smallest stiffness is returned.
pub(super) fn matching_spring(
    candidate: Candidate,
    body: &LoggedBody,
    tick_s: f64,
    seen: &Effective,
) -> Option<[f64; 2]> {
    let wanted = wanted(seen, tick_s);
    let spring_of = |[k, c]: [f64; 2]| [k / (tick_s * tick_s), c / tick_s];
    let off = |spring: [f64; 2]| -> Option<[f64; 2]> {
        let body = LoggedBody { spring: Some(spring_of(spring)), ..body.clone() };
        let [[a, b], [c, d]] = map_of_tick(candidate, &body, tick_s)?;
        let off = [a + d - wanted[0], a * d - b * c - wanted[1]];
        off.iter().all(|part| part.is_finite()).then_some(off)
    };
    let size = |off: &[f64; 2]| off[0].abs().max(off[1].abs());
    let from = |share: f64| {
        let [stiffness, damping] = seen.spring()?;
        let mut spring = [share * stiffness * tick_s * tick_s, damping * tick_s];
        let mut now = off(spring)?;
        for _ in 0..ITERATIONS {
            if size(&now) <= FOUND {
                break;
            }
            let there = |[k, c]: [f64; 2]| off([spring[0] + k, spring[1] + c]);
            let [of_k, of_c] = [there([DISPLACEMENT, 0.0])?, there([0.0, DISPLACEMENT])?];
            let slope = |of: [f64; 2], i: usize| (of[i] - now[i]) / DISPLACEMENT;
            let [kt, ct, kd, cd] = [slope(of_k, 0), slope(of_c, 0), slope(of_k, 1), slope(of_c, 1)];
            let determinant = kt * cd - ct * kd;
            let step = [ct * now[1] - cd * now[0], kd * now[0] - kt * now[1]];
            let step = step.map(|part| part / determinant);
            let nearer = (0..=HALVINGS).find_map(|halving| {
                let part = libm::scalbn(1.0, -halving);
                let other = [spring[0] + part * step[0], spring[1] + part * step[1]];
                let reached = off(other).filter(|_| other[0] > 0.0)?;
                (size(&reached) < size(&now)).then_some((other, reached))
            });
            let Some(nearer) = nearer else { break };
            (spring, now) = nearer;
        }
        // Rounding of the map limits the last digits.
        (size(&now) <= FOUND.sqrt()).then_some(spring)
    };
    let found = STARTS.into_iter().filter_map(from);
    let rank = |[k, c]: &[f64; 2]| (*c < -ROUNDING, *k);
    found
        .min_by(|a, b| rank(a).partial_cmp(&rank(b)).unwrap_or(std::cmp::Ordering::Equal))
        .map(spring_of)
}
