//! Whether what a law claims is true: its start, its exact solution and its energy.

use super::Law;
use crate::sim::body::Body;
use crate::sim::body_stepper::stepper;
use crate::sim::dice::Dice;
use crate::sim::law::{At, CoordinateText, Equations, Part, Refusal, Remedy};
use crate::sim::solver::Solver;
use crate::sim::system::{State, System};

/// The residual of a claim that is true, relative to the largest term: rounding, with room for terms that
/// cancel.
const TOLERANCE: f64 = 1e-9;

/// When an exact solution is held against the equation, in seconds: at the start and on a wide range of
/// scales after it.
const TIMES: [f64; 12] = [0.0, 1e-3, 0.01, 0.07, 0.2, 0.5, 1.0, 1.7, 3.1, 6.3, 11.0, 20.0];

/// How many states are tried around a state: enough to go beyond a coincidence.
const STATES: usize = 12;

/// How often and for how long the energy is held against the reference solution, in ticks and seconds.
const TICKS: u32 = 120;
const TICK_S: f64 = 1.0 / 30.0;

/// The most by which the energy may change along the reference, relative to the largest of its changes in
/// form; the reference itself is good to 1e-10.
const MOST_DRIFT: f64 = 1e-7;

/// Checks these values of a law's parameters: the accelerations are finite at the start, an exact solution
/// satisfies the equation and begins at the start, and an energy is conserved along the reference.
///
/// # Errors
/// The first of these that is not so, with its place in the text.
pub fn check_law(equations: &'static Equations, values: &[f64]) -> Result<(), Refusal> {
    check_start(equations, values)?;
    let law = Law::new(equations, values);
    if equations.has_exact() {
        check_exact(&law)?;
    }
    if equations.has_energy() {
        check_energy(&law)?;
    }
    Ok(())
}

/// Checks that the accelerations are finite at the start.
pub(super) fn check_start(equations: &'static Equations, values: &[f64]) -> Result<(), Refusal> {
    let law = Law::new(equations, values);
    let State { q, v } = law.start();
    let mut a = v.clone();
    law.acceleration(0.0, &q, &v, &mut a);
    match equations.not_finite(&law.registers.borrow()) {
        Some(refusal) => Err(refusal),
        None => Ok(()),
    }
}

fn refusal(law: &Law, part: Part, what: String, remedy: &str) -> Refusal {
    let span = 0..law.equations.part(part).len();
    Refusal { part, span, what, remedy: Remedy::Words(remedy.into()) }
}

/// What an exact solution is not.
enum NotSolved {
    /// It does not begin at the start.
    Start { coordinate: usize, is_velocity: bool, found: f64, start: f64 },
    /// It does not satisfy the equation.
    Equation { coordinate: usize, t: f64, found: f64, wanted: f64 },
}

fn check_exact(law: &Law) -> Result<(), Refusal> {
    let name = |i: usize| &law.equations.text().coordinates[i].name;
    let Err(fault) = find_unsolved(law) else { return Ok(()) };
    let (coordinate, what, remedy) = match fault {
        NotSolved::Start { coordinate, is_velocity, found, start } => {
            let (v, key) = if is_velocity { ("v", "start_velocity") } else { ("", "start") };
            let name = name(coordinate);
            let what = format!("`{v}{name}` begins at {found}, and `{key}` is {start}");
            (coordinate, what, "let the two agree; `t` is 0 at the start")
        }
        NotSolved::Equation { coordinate, t, found, wanted } => {
            let name = name(coordinate);
            let what = format!(
                "at t = {t} its second derivative is {found:.9}, and the acceleration of `{name}` there is {wanted:.9}"
            );
            (coordinate, what, "correct one of them, or remove `exact`")
        }
    };
    Err(refusal(law, Part::Exact(coordinate), what, remedy))
}

/// Whether the law has an exact solution that is one with the values of `law`.
pub(super) fn is_solved(law: &Law) -> bool {
    law.equations.has_exact() && find_unsolved(law).is_ok()
}

fn find_unsolved(law: &Law) -> Result<(), NotSolved> {
    let n = law.coordinates();
    let start = law.start();
    let mut largest = vec![[0.0_f64; 3]; n];
    for t in TIMES {
        let mut found = vec![[0.0; 3]; n];
        let registers = &mut law.registers.borrow_mut();
        law.equations.solve(registers, t, |i, jet| found[i] = jet);
        let [q, v] = [0, 1].map(|d| found.iter().map(|jet| jet[d]).collect::<Vec<_>>());
        let mut a = vec![0.0; n];
        law.equations.accelerate(registers, At { t, steering: [1.0, 0.0], q: &q, v: &v }, &mut a);
        for coordinate in 0..n {
            let (jet, wanted) = (found[coordinate], a[coordinate]);
            let size = &mut largest[coordinate];
            let sizes = [jet[0], jet[1], jet[2].abs().max(wanted.abs())];
            for (size, now) in size.iter_mut().zip(sizes) {
                *size = size.max(now.abs());
            }
            // Written so that a NaN does not pass.
            let is_near = |a: f64, b: f64, scale: f64| (a - b).abs() <= TOLERANCE * scale;
            let starts = [start.q[coordinate], start.v[coordinate]];
            for (d, &wanted) in starts.iter().enumerate().filter(|_| t == 0.0) {
                let scale = size[d].max(size[2]).max(wanted.abs());
                if !is_near(jet[d], wanted, scale) {
                    let (is_velocity, found) = (d == 1, jet[d]);
                    return Err(NotSolved::Start { coordinate, is_velocity, found, start: wanted });
                }
            }
            if !is_near(jet[2], wanted, size[2]) {
                let found = jet[2];
                return Err(NotSolved::Equation { coordinate, t, found, wanted });
            }
        }
    }
    Ok(())
}

/// Whether the energy of the law is conserved with the values of `law`, at states around the start.
pub(super) fn conserves(law: &Law) -> bool {
    let mut scale = 0.0;
    law.equations.has_energy() && leak(law, &law.start(), &mut scale).is_none()
}

/// The power at which the energy leaks, and the largest power that is exchanged, at a state around `state`
/// where it leaks most; `None` if it does not leak. `scale` is the largest power that has been seen.
fn leak(law: &Law, state: &State<Vec<f64>>, scale: &mut f64) -> Option<[f64; 2]> {
    let n = law.coordinates();
    let mut dice = Dice::new(0x9E37_79B9_7F4A_7C15);
    let mut worst: Option<[f64; 2]> = None;
    for trial in 0..STATES {
        let mut there = state.clone();
        for x in there.q.iter_mut().chain(&mut there.v).filter(|_| trial > 0) {
            let reach = if *x == 0.0 { 1.0 } else { x.abs() };
            *x += reach * dice.next();
        }
        let mut a = vec![0.0; n];
        law.acceleration(0.0, &there.q, &there.v, &mut a);
        let registers = law.registers.borrow();
        let parts = law.equations.power(&registers, [&there.q, &there.v, &a]);
        let Some([moved, turned]) = parts.filter(|parts| parts.iter().all(|x| x.is_finite()))
        else {
            continue;
        };
        let exchanged = moved.abs() + turned.abs();
        *scale = scale.max(exchanged);
        let leaks = (moved + turned).abs();
        if leaks > TOLERANCE * exchanged && worst.is_none_or(|[most, _]| leaks > most) {
            worst = Some([leaks, exchanged]);
        }
    }
    worst
}

fn check_energy(law: &Law) -> Result<(), Refusal> {
    let refuse = |what: String| {
        let remedy = "correct it, remove what drives or damps the motion, or remove `energy`";
        Err(refusal(law, Part::Energy, what, remedy))
    };
    let mut scale = 0.0;
    let mut truth = stepper(law.clone(), Solver::Truth);
    let energy = |q: &[f64], v: &[f64]| {
        law.equations.energy(&mut law.registers.borrow_mut(), q, Some(v)).unwrap_or(f64::NAN)
    };
    let first = energy(truth.q(), truth.v());
    if !first.is_finite() {
        return refuse(format!("the energy is {first} at the start"));
    }
    let mut exchanged = 0.0_f64;
    for tick in 0..TICKS {
        let t = f64::from(tick) * TICK_S;
        let there = State { q: truth.q().to_vec(), v: truth.v().to_vec() };
        if let Some([leaks, of]) = leak(law, &there, &mut scale) {
            let what = format!(
                "the energy is not conserved: near t = {t:.2} it changes by {leaks:.3e} J/s, where {of:.3e} J/s are exchanged"
            );
            return refuse(what);
        }
        if truth.advance(t, TICK_S, 1).is_err() {
            break;
        }
        let now = energy(truth.q(), truth.v());
        exchanged = exchanged.max(scale * TICK_S).max(first.abs()).max(now.abs());
        if (now - first).abs() > MOST_DRIFT * exchanged {
            let t = t + TICK_S;
            let what = format!(
                "the energy is not conserved: it is {first:.9} J at the start and {now:.9} J at t = {t:.2}"
            );
            return refuse(what);
        }
    }
    Ok(())
}

/// The key of a parameter for a fault of the text as a whole: the first.
pub(super) fn first_key(text: &[CoordinateText], constants: &[String]) -> String {
    constants.first().cloned().unwrap_or_else(|| format!("{}.start", text[0].name))
}
