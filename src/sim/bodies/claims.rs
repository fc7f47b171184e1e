//! The checker of the exact solution and the energy that a [law](super::Law) or a [custom body](super::Custom) claims.
//!
//! The checker compares a claim with the equation at the start and at a wide range of times, which is cheap enough for
//! every change of a parameter. When a scene is read, it also compares the claim with the reference solution at every
//! tick.

use std::cell::OnceCell;
use std::sync::{Arc, Mutex, PoisonError};

use crate::TickRate;
use crate::body::Body;
use crate::numerics::XorShift;
use crate::reference::Reference;
use crate::state::State;

/// The times in seconds at which claims are checked against the equation, which are the start and a wide range of
/// scales after it.
pub(super) const TIMES: [f64; 12] =
    [0.0, 1e-3, 0.01, 0.07, 0.2, 0.5, 1.0, 1.7, 3.1, 6.3, 11.0, 20.0];

/// Number, with the start, and spacing (s) of further times at which an exact solution is checked, because a force may
/// act only for a while. The spacing is odd, so that no written force begins at one of these times.
const EVEN_TIMES: u32 = 160;
const EVEN_TIME_S: f64 = 0.12361;

/// Number of trial states around the start, enough to rule out a coincidence.
const STATES: usize = 12;

/// Number of trial states around each later state.
const LATER_STATES: usize = 3;

/// Prefixes of the names of a coordinate and of its velocity.
const PREFIXES: [&str; 2] = ["", "v"];

/// The largest relative change of the energy, or distance from an exact solution, after one tick. It is far above the
/// error of the reference, and far too small to be visible.
const TICK_TOLERANCE: f64 = 1e-7;

/// The largest relative change of the energy over all ticks.
const RUN_TOLERANCE: f64 = 1e-6;

/// The maximum number of evaluations of the acceleration that the reference spends on one claim. They cover a minute or
/// two at 60 Hz of a motion like those of the built-in scenes, and take some hundredths of a second. The rest of the
/// horizon stays unchecked.
const MAX_EVALUATIONS: u64 = 300_000;

/// The ticks at which a body's claims are checked against the reference solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClaimHorizon {
    /// Ticks per second.
    pub tick_hz: TickRate,
    /// Number of ticks.
    pub ticks: u64,
}

/// The claims of a [law](super::Law) or a [custom body](super::Custom) that are false with the body's present
/// parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FalseClaims {
    /// The energy is not conserved.
    pub energy: bool,
    /// The exact solution does not satisfy the equation.
    pub exact: bool,
}

/// The number of parameter sets whose findings are kept, enough for some minutes of dragging a slider.
const MAX_FINDINGS: usize = 256;

/// Findings on the bodies of one kind, oldest first. A finding is the bits of the parameters, and the claims that are
/// false with them.
type Findings = Mutex<Vec<(Vec<u64>, FalseClaims)>>;

/// The false claims of a body with its present parameters. Copies of a body share the findings, so that each set of
/// parameters is checked once.
#[derive(Clone, Debug, Default)]
pub(super) struct Checked {
    findings: Arc<Findings>,
    present: OnceCell<FalseClaims>,
}

impl Checked {
    /// Returns a checker that reports every claim as false, for the body whose claims are being checked.
    pub(super) fn without_claims() -> Self {
        let none = FalseClaims { energy: true, exact: true };
        Self { present: OnceCell::from(none), ..Self::default() }
    }

    /// Forgets the finding for the present parameters, because they changed.
    pub(super) fn reset(&mut self) {
        self.present.take();
    }

    /// Returns the false claims of `body`, whose present parameters are `values`.
    pub(super) fn false_claims<B: Claimant>(&self, body: &B, values: &[f64]) -> FalseClaims {
        *self.present.get_or_init(|| {
            let is_of = |(bits, _): &&(Vec<u64>, _)| {
                values.iter().map(|x| x.to_bits()).eq(bits.iter().copied())
            };
            let findings = || self.findings.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some((_, known)) = findings().iter().find(is_of) {
                return *known;
            }
            let found = FalseClaims {
                energy: find_energy_defect(body).is_some(),
                exact: find_unsolved(body).is_some(),
            };
            let mut findings = findings();
            if findings.len() == MAX_FINDINGS {
                findings.remove(0);
            }
            findings.push((values.iter().map(|x| x.to_bits()).collect(), found));
            found
        })
    }
}

/// A body that may claim to know its exact motion and its energy.
pub(super) trait Claimant: Body<Vector = Vec<f64>> + Clone {
    /// The relative tolerance of a claim.
    const TOLERANCE: f64;

    /// Names of the start values of a coordinate and of a velocity, for error messages.
    const START_KEYS: [&'static str; 2];

    /// Returns the name of a coordinate.
    fn name(&self, coordinate: usize) -> &str;

    /// Overwrites `to` with the claimed state at `t` (s). Returns whether the body claims an exact solution.
    fn claimed(&self, t: f64, to: &mut State<Vec<f64>>) -> bool;

    /// Returns the time derivative of the claimed state. Of several finite differences, returns the one nearest to
    /// `wanted`.
    fn claimed_slope(&self, t: f64, wanted: &State<Vec<f64>>) -> State<Vec<f64>>;

    /// Returns the claimed energy in joules; `None` if the body claims none.
    fn claimed_energy(&self, state: &State<Vec<f64>>) -> Option<f64>;

    /// Returns the rate of change of the energy and the exchanged power, in watts; `None` if one of them is not finite.
    fn power(&self, t: f64, state: &State<Vec<f64>>) -> Option<[f64; 2]>;

    /// Returns the same body at the start of a run, without its claims and its steering.
    fn without_claims(&self) -> Self;
}

/// A claim that does not hold. Messages are in lower case.
#[derive(Debug)]
pub(super) struct ClaimFault {
    /// The coordinate whose exact solution is false; `None` for the energy.
    pub(super) coordinate: Option<usize>,
    /// The error message.
    pub(super) what: String,
    /// How to mend the fault.
    pub(super) remedy: &'static str,
}

impl ClaimFault {
    fn exact(coordinate: usize, what: String) -> Self {
        let remedy = "correct one of them, or remove `exact`";
        Self { coordinate: Some(coordinate), what, remedy }
    }

    fn energy(what: String) -> Self {
        let remedy = "correct it, remove what drives or damps the motion, or remove `energy`";
        Self { coordinate: None, what, remedy }
    }
}

/// Checks that the exact solution begins at the start, satisfies the equation and agrees with the reference at every
/// tick of the horizon. Checks that the energy is conserved at every tick.
///
/// # Errors
/// The first false claim.
pub(super) fn check<B: Claimant>(body: &B, horizon: ClaimHorizon) -> Result<(), ClaimFault> {
    let fault = find_unsolved(body)
        .or_else(|| find_departure(body, horizon))
        .or_else(|| find_energy_defect(body))
        .or_else(|| find_later_energy_defect(body, horizon));
    fault.map_or(Ok(()), Err)
}

/// Whether `a` and `b` differ by at most `most`; false if one is NaN.
fn is_near(a: f64, b: f64, most: f64) -> bool {
    (a - b).abs() <= most
}

/// Returns the reason why the exact solution does not satisfy the equation; `None` if it does, or if there is no exact
/// solution.
fn find_unsolved<B: Claimant>(body: &B) -> Option<ClaimFault> {
    let body = body.without_claims();
    let start = body.start();
    let mut at = start.clone();
    if !body.claimed(0.0, &mut at) {
        return None;
    }
    let n = start.q.len();
    let mut largest = vec![[0.0_f64; 3]; n];
    let even = (1..EVEN_TIMES).map(|index| f64::from(index) * EVEN_TIME_S);
    for t in TIMES.into_iter().chain(even) {
        body.claimed(t, &mut at);
        let mut wanted = State { q: at.v.clone(), v: vec![0.0; n] };
        body.acceleration(t, &at.q, &at.v, &mut wanted.v);
        let slope = body.claimed_slope(t, &wanted);
        for (coordinate, size) in largest.iter_mut().enumerate() {
            let name = body.name(coordinate);
            let (q, v, a) = (at.q[coordinate], at.v[coordinate], wanted.v[coordinate]);
            let found = slope.v[coordinate];
            for (size, now) in size.iter_mut().zip([q, v, found.abs().max(a.abs())]) {
                *size = size.max(now.abs());
            }
            let starts = [(q, start.q[coordinate]), (v, start.v[coordinate])];
            for (d, (found, start)) in starts.into_iter().enumerate().filter(|_| t == 0.0) {
                let scale = size[d].max(size[2]).max(start.abs());
                if !is_near(found, start, B::TOLERANCE * scale) {
                    let (v, key) = (PREFIXES[d], B::START_KEYS[d]);
                    let what = format!("`{v}{name}` begins at {found}, and `{key}` is {start}");
                    let remedy = "make the two agree; `t` is 0 at the start";
                    return Some(ClaimFault { remedy, ..ClaimFault::exact(coordinate, what) });
                }
            }
            if !is_near(slope.q[coordinate], v, B::TOLERANCE * size[1]) {
                let what = format!("at t = {t} the velocity of `{name}` is not its derivative");
                return Some(ClaimFault::exact(coordinate, what));
            }
            if !is_near(found, a, B::TOLERANCE * size[2]) {
                let what = format!(
                    "at t = {t} its second derivative is {found:.9}, and the acceleration of `{name}` there is {a:.9}"
                );
                return Some(ClaimFault::exact(coordinate, what));
            }
        }
    }
    None
}

/// Returns the first tick at which the motion leaves the exact solution; `None` if there is no such tick, or if there
/// is no exact solution.
fn find_departure<B: Claimant>(body: &B, horizon: ClaimHorizon) -> Option<ClaimFault> {
    let body = body.without_claims();
    let mut from = body.start();
    let mut to = from.clone();
    if !body.claimed(0.0, &mut from) {
        return None;
    }
    let mut evaluations = MAX_EVALUATIONS;
    let mut largest = vec![[0.0_f64; 2]; from.q.len()];
    let h = horizon.tick_hz.step_s();
    for tick in 1..=horizon.ticks {
        let [before, t] = [tick - 1, tick].map(|tick| horizon.tick_hz.seconds(tick));
        // The reference starts from the exact solution at each tick, so that the error of an unstable motion does not
        // grow.
        let mut reference = Reference::within(&from, evaluations);
        reference.solve(&body, before, h, &mut from).ok()?;
        evaluations = reference.saved_evaluations();
        body.claimed(t, &mut to);
        for (coordinate, size) in largest.iter_mut().enumerate() {
            let pairs =
                [(to.q[coordinate], from.q[coordinate]), (to.v[coordinate], from.v[coordinate])];
            for (size, (found, wanted)) in size.iter_mut().zip(pairs) {
                *size = size.max(found.abs()).max(wanted.abs());
            }
            let scales = [size[0] + h * size[1], size[1] + size[0] / h];
            for (d, (found, wanted)) in pairs.into_iter().enumerate() {
                if !is_near(found, wanted, TICK_TOLERANCE * scales[d]) {
                    let (v, name) = (PREFIXES[d], body.name(coordinate));
                    let what = format!(
                        "at t = {t:.4} `{v}{name}` is {found:.9}, and the motion since the tick before leads to {wanted:.9}"
                    );
                    return Some(ClaimFault::exact(coordinate, what));
                }
            }
        }
        std::mem::swap(&mut from, &mut to);
    }
    None
}

/// Returns the first violation of energy conservation around the start; `None` if there is no violation or no energy.
fn find_energy_defect<B: Claimant>(body: &B) -> Option<ClaimFault> {
    let body = body.without_claims();
    let start = body.start();
    let first = body.claimed_energy(&start)?;
    if !first.is_finite() {
        return Some(ClaimFault::energy(format!("the energy is {first} at the start")));
    }
    let is_first = |state| body.claimed_energy(&state) == Some(first);
    if states_around(&start, STATES).all(is_first) {
        let what =
            format!("the energy is {first} in every state, which says nothing about the motion");
        let remedy = "write the kinetic and the potential energy, or remove `energy`";
        return Some(ClaimFault { remedy, ..ClaimFault::energy(what) });
    }
    TIMES.into_iter().find_map(|t| {
        let states = if t == 0.0 { STATES } else { LATER_STATES };
        find_power(&body, t, &start, states).err()
    })
}

/// Returns the first violation of energy conservation along the motion; `None` if there is no violation or no energy.
fn find_later_energy_defect<B: Claimant>(body: &B, horizon: ClaimHorizon) -> Option<ClaimFault> {
    let body = body.without_claims();
    let mut there = body.start();
    let first = body.claimed_energy(&there)?;
    let mut reference = Reference::within(&there, MAX_EVALUATIONS);
    let (mut before, mut largest, mut exchanged) = (first, first.abs(), 0.0_f64);
    let h = horizon.tick_hz.step_s();
    for tick in 0..horizon.ticks {
        let t = horizon.tick_hz.seconds(tick);
        match find_power(&body, t, &there, LATER_STATES) {
            Ok(power) => exchanged += h * power,
            Err(leak) => return Some(leak),
        }
        reference.solve(&body, t, h, &mut there).ok()?;
        let now = body.claimed_energy(&there).unwrap_or(f64::NAN);
        largest = largest.max(now.abs()).max(exchanged);
        let is_kept = is_near(now, before, TICK_TOLERANCE * largest)
            && is_near(now, first, RUN_TOLERANCE * largest);
        if !is_kept {
            let t = horizon.tick_hz.seconds(tick + 1);
            let what = format!(
                "the energy is not conserved: it is {first:.9} J at the start and {now:.9} J at t = {t:.2}"
            );
            return Some(ClaimFault::energy(what));
        }
        before = now;
    }
    None
}

/// Returns the largest power exchanged at `states` states around `state` at time `t` (s). One state is not enough,
/// because no power is exchanged at a turning point.
///
/// # Errors
/// The largest leak at one of these states.
fn find_power<B: Claimant>(
    body: &B,
    t: f64,
    state: &State<Vec<f64>>,
    states: usize,
) -> Result<f64, ClaimFault> {
    let powers = states_around(state, states).filter_map(|there| body.power(t, &there));
    let [leaks, exchanged] =
        powers.fold([0.0_f64; 2], |most, power| [0, 1].map(|i| most[i].max(power[i])));
    if leaks > B::TOLERANCE * exchanged {
        return Err(ClaimFault::energy(format!(
            "the energy is not conserved: near t = {t:.2} it changes by {leaks:.3e} J/s, where {exchanged:.3e} J/s are exchanged"
        )));
    }
    Ok(exchanged)
}

/// Returns `state`, then pseudo-random states around it, which are the same in every run.
fn states_around(
    state: &State<Vec<f64>>,
    count: usize,
) -> impl Iterator<Item = State<Vec<f64>>> + '_ {
    let mut random = XorShift::new(0x9E37_79B9_7F4A_7C15);
    (0..count).map(move |trial| {
        let mut there = state.clone();
        for x in there.q.iter_mut().chain(&mut there.v).filter(|_| trial > 0) {
            let reach = if *x == 0.0 { 1.0 } else { x.abs() };
            *x += reach * random.next();
        }
        there
    })
}
