//! Whether what a person tells of a body of one's own is true.

use super::Own;
use crate::sim::body::Body;
use crate::sim::dice::Dice;
use crate::sim::system::{State, System};

/// A claim about a custom body that does not hold. Messages are in lower case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnFault {
    /// The field of [`Extras`](super::Extras), or `start`.
    pub field: &'static str,
    /// What is wrong.
    pub what: String,
    /// How to mend it.
    pub remedy: &'static str,
}

/// The most that a true claim may be off by, as a part of what is compared: the error of differences.
const TOLERANCE: f64 = 1e-6;

/// When an exact solution is held against the equation, in seconds: at the start and on a wide range of
/// scales after it.
const TIMES: [f64; 12] = [0.0, 1e-3, 0.01, 0.07, 0.2, 0.5, 1.0, 1.7, 3.1, 6.3, 11.0, 20.0];

/// The steps of differences in seconds. A motion of any pace is smooth and well above rounding over one of
/// them.
const STEPS: [f64; 6] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// How many states are tried around the start: enough to go beyond a coincidence.
const STATES: usize = 12;

/// The derivative at 0 by differences of fourth order.
fn derivative(of: impl Fn(f64) -> f64, h: f64) -> f64 {
    (8.0 * (of(h) - of(-h)) - (of(2.0 * h) - of(-2.0 * h))) / (12.0 * h)
}

/// Whether a derivative by differences is `wanted` for some step, within a part of `scale`.
fn is_derivative(of: impl Fn(f64) -> f64, wanted: f64, scale: f64) -> bool {
    STEPS.iter().any(|&h| (derivative(&of, h) - wanted).abs() <= TOLERANCE * scale)
}

/// The first violation of the equation by `exact`; `None` if it holds or was not given.
pub(super) fn find_unsolved(own: &Own) -> Option<OwnFault> {
    let remedy = "correct it, or remove `exact`";
    let fault = |what: String| Some(OwnFault { field: "exact", what, remedy });
    let start = own.start();
    let mut to = start.clone();
    if !own.motion.exact(0.0, &mut to) {
        return None;
    }
    let mut largest = vec![[0.0_f64; 3]; start.q.len()];
    for t in TIMES {
        let at = |t: f64| {
            let mut to = start.clone();
            own.motion.exact(t, &mut to);
            to
        };
        let State { q, v } = at(t);
        let mut a = v.clone();
        own.acceleration(t, &q, &v, &mut a);
        for (i, size) in largest.iter_mut().enumerate() {
            let [name, _] = own.sheet.coordinates[i];
            for (size, now) in size.iter_mut().zip([q[i], v[i], a[i]]) {
                if !now.is_finite() {
                    return fault(format!("at t = {t} s it gives {now} for {name}"));
                }
                *size = size.max(now.abs());
            }
            let off = [(q[i] - start.q[i], 0), (v[i] - start.v[i], 1)];
            let differs = |(off, part): &(f64, usize)| off.abs() > TOLERANCE * (1e-9 + size[*part]);
            if t == 0.0 && off.iter().any(differs) {
                let found = format!("{name} = {}, moving at {} per second", q[i], v[i]);
                let begins = format!("{} and {}", start.q[i], start.v[i]);
                return fault(format!("it begins at {found}, and the start is {begins}"));
            }
            if !is_derivative(|h| at(t + h).q[i], v[i], size[1]) {
                return fault(format!("at t = {t} s the velocity of {name} is not its derivative"));
            }
            if !is_derivative(|h| at(t + h).v[i], a[i], size[2]) {
                let a = a[i];
                return fault(format!("at t = {t} s {name} does not accelerate by {a} per s²"));
            }
        }
    }
    None
}

/// A state at which `energy` is not conserved; `None` if conserved or not given.
pub(super) fn find_leak(own: &Own) -> Option<OwnFault> {
    let remedy = "correct it, take out what drives or damps the motion, or remove `energy`";
    let fault = |what: String| Some(OwnFault { field: "energy", what, remedy });
    let start = own.start();
    let first = own.motion.energy(&start.q, Some(&start.v))?;
    if !first.is_finite() {
        return fault(format!("it is {first} at the start"));
    }
    let mut dice = Dice::new(0x9E37_79B9_7F4A_7C15);
    for trial in 0..STATES {
        let mut there = start.clone();
        for x in there.q.iter_mut().chain(&mut there.v).filter(|_| trial > 0) {
            let reach = if *x == 0.0 { 1.0 } else { x.abs() };
            *x += reach * dice.next();
        }
        let State { q, v } = there;
        let mut a = v.clone();
        own.acceleration(0.0, &q, &v, &mut a);
        // The energy some seconds on if only the place changes, only the velocity, or both.
        let energy = |moved: f64, turned: f64| {
            let q: Vec<f64> = q.iter().zip(&v).map(|(q, v)| q + moved * v).collect();
            let v: Vec<f64> = v.iter().zip(&a).map(|(v, a)| v + turned * a).collect();
            own.motion.energy(&q, Some(&v)).unwrap_or(f64::NAN)
        };
        let power = |h: f64| {
            let exchanged =
                derivative(|s| energy(s, 0.0), h).abs() + derivative(|s| energy(0.0, s), h).abs();
            (derivative(|s| energy(s, s), h), exchanged)
        };
        let is_kept = |h: &f64| {
            let (leaks, exchanged) = power(*h);
            let rounding = 4.0 * f64::EPSILON * energy(0.0, 0.0).abs() / h;
            leaks.abs() <= TOLERANCE * exchanged + rounding
        };
        // A state beside the motion need not have an energy, or a force.
        let is_defined = energy(0.0, 0.0).is_finite() && a.iter().all(|a| a.is_finite());
        if is_defined && !STEPS.iter().any(is_kept) {
            let (leaks, exchanged) = power(1e-4);
            let state = format!("at q = {q:.3?}, v = {v:.3?}");
            let powers = format!("{leaks:.3e} J/s, where {exchanged:.3e} J/s are exchanged");
            return fault(format!("it is not conserved: {state} it changes by {powers}"));
        }
    }
    None
}

/// Where a body that was told to be linear is not; `None` if it is, or if nobody has said so.
fn find_bend(own: &Own) -> Option<OwnFault> {
    if !own.is_linear {
        return None;
    }
    let n = own.start.q.len();
    let acceleration = |t: f64, state: &[f64]| {
        let (q, v) = state.split_at(n);
        let mut a = vec![0.0; n];
        own.motion.acceleration(t, q, v, &mut a);
        a
    };
    let mut dice = Dice::new(0x2545_F491_4F6C_DD1D);
    let still = vec![0.0; 2 * n];
    for t in TIMES {
        // From far inside to far outside the motion: beyond its corners, if it has any.
        for reach in [1e-3, 0.03, 1.0, 30.0, 1e3] {
            let mut state = || (0..2 * n).map(|_| reach * dice.next()).collect::<Vec<_>>();
            let [one, other] = [state(), state()];
            let sum: Vec<f64> = one.iter().zip(&other).map(|(a, b)| a + b).collect();
            let at = [&still, &one, &other, &sum].map(|state| acceleration(t, state));
            let [none, one, other, sum] = at;
            for i in 0..n {
                let parts = [one[i] - none[i], other[i] - none[i], acceleration(0.0, &still)[i]];
                let size = parts.iter().fold(sum[i].abs(), |size, part| size.max(part.abs()));
                let off = [sum[i] - none[i] - parts[0] - parts[1], none[i] - parts[2]];
                if off.iter().any(|off| off.is_nan() || off.abs() > 1e-9 * size) {
                    let [name, _] = own.sheet.coordinates[i];
                    let what =
                        format!("the acceleration of {name} is not linear at {reach} from 0");
                    let remedy = "leave it out: the default is no";
                    return Some(OwnFault { field: "is_linear", what, remedy });
                }
            }
        }
    }
    None
}

/// Checks a body of one's own at its start, and what is told of it.
pub(super) fn check(own: &Own) -> Result<(), OwnFault> {
    let State { q, v } = own.start();
    let mut a = v.clone();
    own.acceleration(0.0, &q, &v, &mut a);
    for (values, what) in [(&q, "coordinate"), (&v, "velocity"), (&a, "acceleration")] {
        if let Some(i) = values.iter().position(|value| !value.is_finite()) {
            let [name, _] = own.sheet.coordinates[i];
            let what = format!("the {what} of {name} is {} at the start", values[i]);
            return Err(OwnFault { field: "start", what, remedy: "begin with finite numbers" });
        }
    }
    let fault = find_unsolved(own).or_else(|| find_leak(own)).or_else(|| find_bend(own));
    fault.map_or(Ok(()), Err)
}
