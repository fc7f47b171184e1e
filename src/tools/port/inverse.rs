//! Finds the stiffness and damping under which a map shows a wanted spring.

use crate::identify::Effective;
use crate::sim::numerics::bisect;

/// The visible motion of a joint with this stiffness in 1/s² and damping in 1/s.
pub(super) type Sees<'a> = &'a dyn Fn([f64; 2]) -> Option<Effective>;

/// A joint with its visible motion and its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EvaluatedJoint {
    /// Stiffness in 1/s² and damping in 1/s.
    pub(super) joint: [f64; 2],
    /// Visible motion of the joint.
    pub(super) seen: Effective,
    /// Sum of the absolute values of [`residual`].
    pub(super) missed: f64,
}

/// First stage of the approach to the wanted frequency, as a fraction of that frequency, and the factor between stages.
const FIRST_STAGE: f64 = 1.0 / 64.0;
const STAGE: f64 = 1.5;
/// Number of Newton iterations at a stage, and maximum number of times that a step is halved if it does not come
/// nearer.
const ITERATIONS: u32 = 30;
const HALVINGS: u32 = 12;
/// Displacement for the derivatives.
const DISPLACEMENT: f64 = 1e-6;
/// Largest error that is rounding.
const ROUNDING: f64 = 1e-13;
/// Damping, in units of the frequency, below which it counts as 0.
const NO_DAMPING: f64 = 1e-9;
/// Range of the search in stiffness and damping, as exponents of e around the wanted frequency, and its number of
/// steps.
const SPAN: [f64; 2] = [-12.0, 24.0];
const STEPS: u32 = 240;
/// The grids of a search in two numbers. For each first grid, its reach as an exponent of e, and its number of cells on
/// each side; each first grid starts at the nearest joint found, to leave a ridge. Then the number of cells of the
/// grids that follow, the ratio of their sizes, and their number.
const REACHES: [(f64, i32); 3] = [(10.0, 20), (2.0, 10), (0.5, 10)];
const CELLS: i32 = 4;
const ZOOM: f64 = 0.7;
const ROUNDS: u32 = 40;
/// Number of times that an interval is halved, which is enough to reach rounding.
const HALVED: u32 = 60;

/// Returns the joint that shows `wanted`, or the nearest joint; `None` if no joint shows a motion.
pub(super) fn invert(sees: Sees, wanted: &Effective) -> Option<EvaluatedJoint> {
    let solved = in_stages(sees, wanted);
    if let Some(found) = solved.filter(|found| found.missed <= super::REACHED) {
        return Some(found);
    }
    let nearer = |a: &EvaluatedJoint, b: &EvaluatedJoint| a.missed.total_cmp(&b.missed);
    let kept = min_damping(sees, wanted.omega)
        .and_then(|(stiffness, _)| evaluate(sees, wanted, [stiffness, 0.0]));
    let all = [solved, kept, zoomed(sees, wanted)].into_iter().flatten();
    let best = all.min_by(nearer)?;
    Some(least_stiff(sees, wanted, best))
}

/// Returns the joint with its visible motion and its error; `None` if the joint shows no motion.
fn evaluate(sees: Sees, wanted: &Effective, joint: [f64; 2]) -> Option<EvaluatedJoint> {
    let seen = sees(joint)?;
    let missed = residual(&seen, wanted).into_iter().map(f64::abs).sum();
    Some(EvaluatedJoint { joint, seen, missed })
}

/// Returns the logarithm of the frequency's ratio to the wanted one, and the difference of the damping ratios.
fn residual(seen: &Effective, wanted: &Effective) -> [f64; 2] {
    [libm::log(seen.omega / wanted.omega), seen.decay / seen.omega - wanted.decay / wanted.omega]
}

/// Applies Newton's method in stages, from a frequency so low that every map is near the motion, up to the wanted
/// frequency.
fn in_stages(sees: Sees, wanted: &Effective) -> Option<EvaluatedJoint> {
    let mut part = FIRST_STAGE;
    let ratio = wanted.decay / wanted.omega;
    let mut joint = [1.0, 2.0 * ratio];
    let mut solution = None;
    loop {
        let omega = wanted.omega * part;
        let target = Effective { omega, decay: ratio * omega };
        // The joint is in units of the stage's frequency.
        let scaled = |[k, c]: [f64; 2]| [k * omega * omega, c * omega];
        let at = |joint| evaluate(sees, &target, scaled(joint));
        solution = newton(&at, &target, joint).or(solution.filter(|_| part < 1.0));
        if part >= 1.0 {
            break;
        }
        if let Some(EvaluatedJoint { joint: [k, c], .. }) = solution {
            joint = [k / (omega * omega), c / omega];
        }
        part = (part * STAGE).min(1.0);
    }
    let EvaluatedJoint { joint: [stiffness, damping], .. } = solution?;
    // A wish that needs a negative damping is out of reach.
    let damping = if damping.abs() < NO_DAMPING * wanted.omega { 0.0 } else { damping };
    (damping >= 0.0).then(|| evaluate(sees, wanted, [stiffness, damping]))?
}

/// Returns the best joint that Newton's method finds from `joint`, which is in units of the target's frequency.
fn newton(
    at: &dyn Fn([f64; 2]) -> Option<EvaluatedJoint>,
    target: &Effective,
    joint: [f64; 2],
) -> Option<EvaluatedJoint> {
    // The logarithm keeps the stiffness positive.
    let of = |[s, c]: [f64; 2]| at([libm::exp(s), c]);
    let mut place = [libm::log(joint[0]), joint[1]];
    let mut best = of(place)?;
    for _ in 0..ITERATIONS {
        if best.missed < ROUNDING {
            break;
        }
        let error = residual(&best.seen, target);
        let slope = |i: usize| {
            let moved = |sign: f64| {
                let mut place = place;
                place[i] += sign * DISPLACEMENT;
                Some(residual(&of(place)?.seen, target))
            };
            let (up, down) = (moved(1.0)?, moved(-1.0)?);
            Some([0, 1].map(|row| (up[row] - down[row]) / (2.0 * DISPLACEMENT)))
        };
        let (Some(by_stiffness), Some(by_damping)) = (slope(0), slope(1)) else { break };
        let determinant = by_stiffness[0] * by_damping[1] - by_damping[0] * by_stiffness[1];
        let step = [
            (by_damping[0] * error[1] - by_damping[1] * error[0]) / determinant,
            (by_stiffness[1] * error[0] - by_stiffness[0] * error[1]) / determinant,
        ];
        let shortened = (0..HALVINGS).find_map(|halvings| {
            let part = libm::exp2(-f64::from(halvings));
            let next = [place[0] + part * step[0], place[1] + part * step[1]];
            of(next).filter(|found| found.missed < best.missed).map(|found| (next, found))
        });
        let Some((next, found)) = shortened else { break };
        (place, best) = (next, found);
    }
    Some(best)
}

/// Returns the smallest stiffness at which an undamped spring has the frequency `omega` in rad/s, and the damping ratio
/// of this spring.
pub(super) fn min_damping(sees: Sees, omega: f64) -> Option<(f64, f64)> {
    let at = |s: f64| sees([omega * omega * libm::exp(s), 0.0]);
    let is_fast = |s: f64| at(s).map(|seen| seen.omega >= omega);
    let (low, high) = intervals()
        .find(|(low, high)| is_fast(*low) == Some(false) && is_fast(*high) == Some(true))?;
    let mut is_seen = true;
    let [_, high] = bisect([low, high], HALVED, |s| {
        let is_fast = is_fast(s);
        is_seen &= is_fast.is_some();
        is_fast == Some(false)
    });
    let ratio = at(high).filter(|_| is_seen)?.damping_ratio()?;
    Some((omega * omega * libm::exp(high), ratio))
}

/// Returns the intervals of a search through [`SPAN`].
fn intervals() -> impl Iterator<Item = (f64, f64)> {
    let step = (SPAN[1] - SPAN[0]) / f64::from(STEPS);
    let place = move |i: u32| SPAN[0] + step * f64::from(i);
    (0..STEPS).map(move |i| (place(i), place(i + 1)))
}

/// Returns the nearest joint on grids that shrink around the nearest joint found so far.
fn zoomed(sees: Sees, wanted: &Effective) -> Option<EvaluatedJoint> {
    let damping_of = |s: f64| wanted.omega * (libm::exp(s) - libm::exp(SPAN[0])).max(0.0);
    let of = |[s, d]: [f64; 2]| {
        let stiffness = wanted.omega * wanted.omega * libm::exp(s);
        evaluate(sees, wanted, [stiffness, damping_of(d)])
    };
    let mut middle = [2.0, -3.0];
    let mut best: Option<EvaluatedJoint> = None;
    for (mut reach, first) in REACHES {
        for round in 0..ROUNDS {
            let cells = if round == 0 { first } else { CELLS };
            let offset = |i: i32| f64::from(i) / f64::from(cells);
            let place = |i: i32, j: i32| {
                [middle[0] + reach * offset(i), (middle[1] + reach * offset(j)).max(SPAN[0])]
            };
            let places = (-cells..=cells).flat_map(|i| (-cells..=cells).map(move |j| (i, j)));
            let found = places.filter_map(|(i, j)| Some((place(i, j), of(place(i, j))?)));
            let nearest = found.min_by(|a, b| a.1.missed.total_cmp(&b.1.missed));
            if let Some((place, found)) = nearest
                && best.is_none_or(|best| found.missed < best.missed)
            {
                (middle, best) = (place, Some(found));
            }
            reach *= ZOOM;
        }
    }
    best
}

/// Lowers the stiffness while the visible motion stays the same, down to the engine's limit if there is one.
fn least_stiff(sees: Sees, wanted: &Effective, best: EvaluatedJoint) -> EvaluatedJoint {
    let [stiffness, damping] = best.joint;
    let joint = |s: f64| [stiffness * libm::exp(s), damping];
    let is_same = |s: f64| sees(joint(s)) == Some(best.seen);
    if !is_same(-1e-3) {
        return best;
    }
    let [_, high] = bisect([SPAN[0] - SPAN[1], 0.0], HALVED, |s| !is_same(s));
    evaluate(sees, wanted, joint(high)).unwrap_or(best)
}
