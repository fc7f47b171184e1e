//! Finds the built-in method that is closest to another method on linear forces. Two methods are compared by the powers
//! of the step in their one-step maps.

use std::sync::LazyLock;

use super::problems::{Air, Problem, UnitPendulum, fresh, problem};
use super::stability::{map_of, small_motion};
use crate::integrators::{Family, METHODS, Method};
use crate::number::{significant, superscript};
use crate::numerics::{XorShift, least_squares};
use crate::state::State;

/// The highest degree of the map in `k` and `c`, which is the number of evaluations in a row that each depend on the
/// one before.
const MAX_DEGREE: u32 = 6;
/// Number of maps to which the coefficients are fitted, and number of further maps on which they are tested.
const SAMPLES: usize = 60;
const TRIED: usize = 6;
/// Coefficients that differ by less than this number are equal, and smaller coefficients are 0.
const ROUNDING: f64 = 1e-8;
/// The lowest rank of a method that counts as near.
const NEAR: f64 = 0.5;
/// The weight of a coefficient with the opposite sign. It is positive because a slip of a sign keeps the terms.
const OTHER_SIGN: f64 = 0.5;
/// The bonus on the rank for the same number of evaluations.
const AS_MANY: f64 = 0.1;
/// Number of steps over which two methods must agree to be the same.
const STEPS: u32 = 12;
/// Steps per swing for the measured energy, which is that of a spring of 1 Hz at 60 Hz.
const STEPS_A_SWING: f64 = 60.0;
/// The largest denominator of a coefficient written as a fraction.
const MAX_DENOMINATOR: u32 = 120;

/// A term `kⁱ cʲ` in the map of one step. It contributes to the new `x` or `v`, in proportion to the old `x` or `v`.
#[derive(Clone, Copy, PartialEq)]
struct Term {
    i: u32,
    j: u32,
    /// The new number (`of`) and the old one (`by`), each 0 for `x` and 1 for `v`.
    of: usize,
    by: usize,
}

impl Term {
    fn all() -> impl Iterator<Item = Term> {
        let entries = [[0, 0], [0, 1], [1, 0], [1, 1]].into_iter();
        entries.flat_map(|[of, by]| monomials().map(move |[i, j]| Term { i, j, of, by }))
    }

    /// Returns the power of the step that multiplies the term.
    fn power(self) -> u32 {
        (2 * self.i + self.j + self.by as u32).saturating_sub(self.of as u32)
    }
}

/// Writes a text such as `h² k x in x`.
impl std::fmt::Display for Term {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let factor = |letter: &str, power: u32| match power {
            0 => String::new(),
            1 => format!("{letter} "),
            _ => format!("{letter}{} ", superscript(power as i32)),
        };
        let [of, by] = [self.of, self.by].map(|part| ["x", "v"][part]);
        let factors = [factor("h", self.power()), factor("k", self.i), factor("c", self.j)];
        write!(f, "{}{by} in {of}", factors.concat())
    }
}

fn monomials() -> impl Iterator<Item = [u32; 2]> {
    (0..=MAX_DEGREE).flat_map(|i| (0..=MAX_DEGREE - i).map(move |j| [i, j]))
}

/// Returns the coefficients of the one-step map, in the order of [`Term::all`]; `None` if the map is no polynomial of
/// degree [`MAX_DEGREE`].
fn coefficients(method: &Method) -> Option<Vec<f64>> {
    let mut random = XorShift::new(1);
    let forces: Vec<[f64; 2]> =
        (0..SAMPLES + TRIED).map(|_| [random.next(), random.next()]).collect();
    let maps: Vec<_> =
        forces.iter().map(|force| map_of(method, *force, 1.0)).collect::<Result<_, _>>().ok()?;
    let value = |[i, j]: [u32; 2], [k, c]: [f64; 2]| {
        libm::pow(k, f64::from(i)) * libm::pow(c, f64::from(j))
    };
    let columns: Vec<Vec<f64>> = monomials()
        .map(|term| forces[..SAMPLES].iter().map(|force| value(term, *force)).collect())
        .collect();
    let mut all = Vec::new();
    for [of, by] in [[0, 0], [0, 1], [1, 0], [1, 1]] {
        let values: Vec<f64> = maps.iter().map(|map| map[by][of]).collect();
        let found = least_squares(&columns, &values[..SAMPLES])?;
        let is_so = |(force, value_there): (&[f64; 2], &f64)| {
            let sum: f64 = monomials().zip(&found).map(|(term, by)| by * value(term, *force)).sum();
            (sum - value_there).abs() < ROUNDING
        };
        if !forces.iter().zip(&values).all(is_so) {
            return None;
        }
        all.extend(found);
    }
    Some(all)
}

/// The built-in methods whose stages use only known values, with their coefficients.
static KNOWN: LazyLock<Vec<(&'static Method, Vec<f64>)>> = LazyLock::new(|| {
    let families = [Family::Explicit, Family::Symplectic, Family::AsPrinted];
    let all = METHODS.iter().filter(|method| families.contains(&method.family));
    all.filter_map(|method| Some((method, coefficients(method)?))).collect()
});

/// Whether two methods make the same steps on this system.
fn steps_agree(a: &Method, b: &Method, system: &dyn Fn() -> Problem<f64>) -> bool {
    let run = |method: &Method| {
        let (system, mut stepper) = (system(), fresh(method));
        let mut state = State { q: 0.7, v: -0.4 };
        let step =
            |i: u32| stepper.step(&system, 0.2 * f64::from(i), 0.2, &mut state).map(|()| state);
        (0..STEPS).map(step).collect::<Result<Vec<_>, _>>().unwrap_or_default()
    };
    let near = |(a, b): (&State<f64>, &State<f64>)| {
        (a.q - b.q).abs() < ROUNDING && (a.v - b.v).abs() < ROUNDING
    };
    let (a, b) = (run(a), run(b));
    !a.is_empty() && a.len() == b.len() && a.iter().zip(&b).all(near)
}

/// Returns the similarity of two maps, from 0 to 1. It is the sum of the smaller coefficients of all pairs, divided by
/// the sum of the larger ones. The weight of a coefficient of `hᵖ` is p!, the number by which it is divided in the
/// exact motion.
fn similarity(a: &[f64], b: &[f64]) -> f64 {
    let (mut common, mut all) = (0.0, 0.0);
    for (term, (a, b)) in Term::all().zip(a.iter().zip(b)) {
        let weight: f64 = (1..=term.power()).map(f64::from).product();
        let smaller = a.abs().min(b.abs());
        common += weight * if a * b > 0.0 { smaller } else { OTHER_SIGN * smaller };
        all += weight * a.abs().max(b.abs());
    }
    common / all
}

/// Describes the nearest built-in method, and the lowest power of the step in which it differs.
pub(super) fn nearest(method: &Method, evaluations: Option<u32>) -> String {
    let Some(own) = coefficients(method) else {
        return "no step of it on linear forces is a sum of powers of the step".into();
    };
    let is_other = |(a, b): (&f64, &f64)| (a - b).abs() >= ROUNDING;
    let curved: [&dyn Fn() -> Problem<f64>; 2] = [&|| problem(UnitPendulum), &|| problem(Air)];
    let is_it = |known: &Method| curved.iter().all(|system| steps_agree(method, known, system));
    let rank = |(known, theirs): &(&'static Method, Vec<f64>)| {
        let is_same = !own.iter().zip(theirs).any(is_other);
        // Of several methods that are equal on linear forces, one that agrees on other forces too is preferred.
        let as_many = f64::from(u8::from(known.evaluations == evaluations));
        match is_same {
            true => 1.0 + AS_MANY + f64::from(u8::from(is_it(known))),
            false => similarity(&own, theirs) + AS_MANY * as_many,
        }
    };
    let best = KNOWN.iter().rev().max_by(|a, b| rank(a).total_cmp(&rank(b)));
    let Some((known, theirs)) = best.filter(|best| rank(best) >= NEAR) else {
        return "near none of the built-in methods".into();
    };
    let mut differing: Vec<(Term, [f64; 2])> = Term::all()
        .zip(own.iter().zip(theirs))
        .filter(|(_, pair)| is_other(*pair))
        .map(|(term, (own, theirs))| (term, [*own, *theirs]))
        .collect();
    differing.sort_by_key(|(term, _)| term.power());
    let id = known.id;
    let Some((term, pair)) = differing.first() else {
        let is_linear = steps_agree(method, known, &|| problem(super::problems::spring(3.0, 0.1)));
        return match (is_linear, is_it(known)) {
            (true, true) => format!("the same as {id}"),
            (true, false) => format!("the same as {id} on linear forces"),
            (false, _) => {
                format!("its first step is that of {id} on linear forces, and later ones are not")
            }
        };
    };
    let [own, theirs] = pair.map(fraction);
    format!(
        "nearest: {id} (order {}), from which, under a = -k x - c v, the coefficient of {term} differs: {own} for {theirs}",
        known.order
    )
}

/// Writes a coefficient as a fraction if it is close to one, or else as a decimal.
fn fraction(value: f64) -> String {
    let whole = |denominator: u32| (value * f64::from(denominator)).round();
    let is_it = |denominator: &u32| {
        (whole(*denominator) / f64::from(*denominator) - value).abs() < ROUNDING
    };
    match (1..=MAX_DENOMINATOR).find(is_it) {
        Some(1) => format!("{}", whole(1) + 0.0),
        Some(denominator) => format!("{}/{denominator}", whole(denominator)),
        None => significant(value, 6),
    }
}

/// Describes how a method changes the energy of a spring.
pub(super) fn energy(method: &'static Method) -> String {
    let h = std::f64::consts::TAU / STEPS_A_SWING;
    let found = small_motion().and_then(|motion| motion.stability(method, h, 1).ok());
    let radius = found.map_or(f64::NAN, |found| found.spectral_radius);
    let change = libm::pow(radius, 2.0 * STEPS_A_SWING) - 1.0;
    let part = |change: f64| match 100.0 * change {
        percent if percent < 1000.0 => format!("{} %", significant(percent, 3)),
        _ => format!("{} times", significant(change, 3)),
    };
    match change {
        change if !change.is_finite() => "a spring of 1 Hz at 60 Hz blows up".into(),
        change if change.abs() < ROUNDING => {
            "a spring gains and loses no energy in the long run".into()
        }
        change if change > 0.0 => {
            format!("a spring of 1 Hz at 60 Hz gains {} of its energy a swing", part(change))
        }
        change => {
            format!("a spring of 1 Hz at 60 Hz loses {} of its energy a swing", part(-change))
        }
    }
}
