//! Reads the formula on every method's card as lines of a step, and compares them with the method. Those of a free
//! rotation have vectors, and are not read: `bodies/tumble.rs` measures their orders. Nor are those of interfaces, whose
//! frames count steps of their own: `interfaces.rs` holds them against runs.
//!
//! | written | meaning |
//! |---|---|
//! | `h k₁ / 2`, `½h`, `√3`, `z²`, `e^(−C h)`, `\|v\|` | as in print; a space or nothing multiplies, and `f(…)` without a space calls |
//! | `q′`, `v′`, `y′` | the method's result at the end of the step: each equation with one must hold |
//! | `q₋₁`, `y₋₁`; `S₋₁` | the state a step before; the value of `S` at the end of the step before |
//! | `a` | `a(t, q, v)`, or `a′` of the step before if the formula has one |
//! | `k = …`, `v = …` | gives a value, also to itself, and before or after it is used |
//! | `φ₁(z) = …` | a function |
//! | `drift c`, `kick d` | `q = q + c h v`, `v = v + d h a` at the time to which the drifts have come |
//! | `n times: …`, `then …` | a loop over all that follows, up to the line that begins with "then" |
//! | `the first time: …`, `if …: …`, `else: …` | the line, in the first turn of the loop, or under a condition |
//! | `\|v\| ≤ 400` | shortens `v` |
//! | `y′ = … if the error is small` | `error` is as large as the tolerance where the method begins to divide a step |
//! | `ns(t): …` | whole nanoseconds, halves down; words after the colon explain |

use std::marker::PhantomData;

use lines::{RESIDUAL, Step, Values, acceleration, evaluated};
use regatta::conformance::problems::{fresh, problem};
use regatta::sim::integrators::{DormandPrince54, EmbeddedPair, Family, METHODS, Method, Pair};
use regatta::sim::{EngineSettings, Pursuit, Query, State, System};

mod lines;

/// The methods whose formulas are read.
fn read() -> impl Iterator<Item = &'static Method> {
    let is_read = |method: &&Method| !method.is_for_spin() && method.family != Family::Interface;
    METHODS.iter().filter(is_read)
}

/// The largest difference left by rounding and Newton's iteration, relative to the value or to 1.
const ROUNDING: f64 = 1e-9;
/// The same where a method takes slopes by differences.
const BY_DIFFERENCES: f64 = 3e-5;
/// The properties of a body that a method reads.
#[derive(Clone, Copy)]
struct Told {
    settings: EngineSettings,
    force: f64,
    rate: f64,
    order: u32,
}

fn target(t: f64) -> f64 {
    2.0 - 3.0 * t
}

impl System for Told {
    type Vector = f64;

    fn acceleration(&self, t: f64, q: &f64, v: &f64, a: &mut f64) {
        *a = acceleration(t, *q, *v);
    }
    fn query(&self, t: f64, query: Query<'_, f64>) -> bool {
        let Told { rate, order, .. } = *self;
        match query {
            Query::Engine { settings, force, .. } => {
                (*settings, *force) = (self.settings, self.force);
            }
            Query::Target(pursuit) => {
                *pursuit = Some(Pursuit { target: target(t), rate, order, is_still: false });
            }
            _ => return false,
        }
        true
    }
}

/// The coefficients of a pair, as `cᵢ`, `aᵢⱼ` and `eⱼ`.
fn tableau<P: Pair<N>, const N: usize>(_: PhantomData<EmbeddedPair<f64, P, N>>) -> Values {
    let mark = |i: usize| char::from_u32(0x2081 + i as u32).unwrap();
    let mut values = Values::new();
    for i in 0..N {
        values.insert(format!("c{}", mark(i)), P::C[i]);
        values.insert(format!("e{}", mark(i)), P::E[i]);
        for j in 0..N {
            values.insert(format!("a{}{}", mark(i), mark(j)), P::A[i][j]);
        }
    }
    values
}

/// The properties of a body, its start, and the length of the steps.
struct Case {
    told: [f64; 4],
    rate: f64,
    start: [f64; 2],
    h: f64,
    substeps: u32,
}

const fn case(told: [f64; 4], start: [f64; 2], h: f64, substeps: u32) -> Case {
    Case { told, rate: 6.0, start, h, substeps }
}

/// Usual steps, and such that every limit of an engine acts: its clamps, its speed limit, its largest numbers.
const CASES: [Case; 13] = [
    case([40.0, 1.5, 0.3, 2.5], [1.0, 0.5], 0.05, 3),
    case([40.0, 1.5, 0.3, 0.0], [-1.0, 0.5], 0.01, 2),
    case([0.0, 0.0, 0.3, 2.5], [1.0, -0.5], 0.05, 3),
    case([0.0, 0.0, 0.3, 0.0], [1.0, -0.5], 0.05, 1),
    case([40.0, 1.5, 0.3, -200.0], [1.0, 0.5], 0.05, 1),
    case([4e3, 90.0, 30.0, 2.5], [1.0, -0.5], 0.1, 3),
    case([40.0, 1.5, 30.0, 200.0], [2.0, 1.0], 0.1, 2),
    case([4.0, 0.0, 0.3, 2.5], [1.0, 650.0], 0.01, 3),
    case([0.001, 0.0, 0.0, 2.0], [1.5e10, 2.0], 0.05, 2),
    case([0.001, 0.0, 0.0, -2.0], [1.9, 3.0], 0.02, 1),
    case([1.0, 0.5, 0.5, 9e9], [9e9, 0.1], 0.05, 2),
    case([1.0, 0.5, 0.5, 0.0], [9e9, -9e9], 0.05, 2),
    case([1.0, 1.0, 1.0, 9e9], [9e9, 9e9], 0.05, 2),
];
/// Steps of a run.
const STEPS: u32 = 4;

/// The steps of the method in a case, each with the values that its formula may name.
fn steps(method: &Method, formula: &[&str], case: &Case) -> Vec<Step> {
    let [stiffness, damping, drag, force] = case.told;
    let settings = EngineSettings { stiffness, damping, drag };
    let order = method.law_order().unwrap_or(1);
    let told = problem(Told { settings, force, rate: case.rate, order });
    let [mut q, v] = case.start;
    // The eigenvalues of `∂f/∂y` are real here.
    if formula.concat().contains("∂f/∂y") {
        q = 3.0;
    }
    let mut state = State { q, v };
    let mut stepper = fresh(method);
    let has_substeps = method.engine.is_some_and(|engine| engine.has_substeps());
    let substeps = if has_substeps { case.substeps } else { 1 };
    let a0 = acceleration(0.0, q, v);
    let [mut before_q, mut before_v] = [q - case.h * v + case.h * case.h / 2.0 * a0, 0.0];
    let number = |(name, value): (&str, f64)| (name.to_owned(), value);
    let mut steps = Vec::new();
    let mut before = Values::new();
    for n in 0..STEPS {
        let t = case.h * f64::from(n);
        let from = state;
        if stepper.steps(&told, t, case.h, substeps, &mut state).is_err() {
            return Vec::new();
        }
        let mut known: Values = [
            ("t", t),
            ("H", case.h),
            ("n", f64::from(substeps)),
            ("h", case.h / f64::from(substeps)),
            ("q", from.q),
            ("v", from.v),
            ("q₋₁", before_q),
            ("v₋₁", before_v),
        ]
        .map(number)
        .into();
        match method.family {
            Family::Engine => known
                .extend([("K", stiffness), ("c", damping), ("C", drag), ("f", force)].map(number)),
            Family::Follower => known.extend(
                [("g", target(t + case.h)), ("k", case.rate), ("ω", case.rate)].map(number),
            ),
            Family::AsPrinted => {
                known.extend(method.tolerance.map(|tol| number(("tolerance", tol.absolute_v))))
            }
            Family::Adaptive => known.extend(tableau(PhantomData::<DormandPrince54<f64>>)),
            _ => {}
        }
        let step = Step { substeps, known, end: [state.q, state.v], before };
        // Only for a formula that carries a value, since a long formula takes long to read.
        let carries = formula.iter().any(|line| line.contains("a′ =") || line.contains("S₋₁"));
        before = if carries { evaluated(formula, &step) } else { Values::new() };
        steps.push(step);
        [before_q, before_v] = [from.q, from.v];
    }
    steps
}

/// The formula's largest difference from the step, for which it is wrong if it is above the returned tolerance.
fn residual(formula: &[&str], step: &Step) -> f64 {
    evaluated(formula, step)[RESIDUAL]
}

fn tolerance(method: &Method) -> f64 {
    if method.formula.iter().any(|line| line.contains('∂')) { BY_DIFFERENCES } else { ROUNDING }
}

/// The steps on which a method's formula is tested.
fn judged<'a>(method: &'a Method, formula: &'a [&str]) -> impl Iterator<Item = Step> + 'a {
    let is_far = |case: &&Case| case.start[0].abs() > 1e3 || case.start[1].abs() > 1e2;
    let is_adaptive = method.family == Family::Adaptive;
    let is_for = move |case: &&Case| match method.only {
        _ if is_adaptive => false,
        // Only engines get far starts: a pendulum cannot reach them, and other methods do not notice.
        _ if !method.is_engine() || method.holds_force() => !is_far(case),
        Some(_) if case.start[0].abs() > 1e9 => formula.concat().contains("10¹⁰"),
        _ => method.engine.is_some_and(|e| e.damping_ratio.is_some()) || case.told[0] == 0.0,
    };
    // The first step of a method that looks back is its restart.
    let looks_back = formula.concat().contains("y₋₁");
    let usual = CASES.iter().filter(is_for).flat_map(move |case| {
        steps(method, formula, case).into_iter().skip(usize::from(looks_back))
    });
    // An adaptive method makes these steps at once.
    let starts: &[[f64; 2]] = if is_adaptive { &[[1.0, 0.5], [-0.4, 1.0]] } else { &[] };
    let at_once = starts.iter().flat_map(move |&start| {
        let h = 0.45 * longest_step(method);
        steps(method, formula, &case([0.0; 4], start, h, 1)).into_iter().take(1)
    });
    usual.chain(at_once)
}

/// The longest step from the first start that an adaptive method makes at once.
fn longest_step(method: &Method) -> f64 {
    let evaluations = |h: f64| {
        let told = Told { settings: EngineSettings::NONE, force: 0.0, rate: 1.0, order: 1 };
        let (system, mut state) = (problem(told), State { q: 1.0, v: 0.5 });
        fresh(method).steps(&system, 0.0, h, 1, &mut state).unwrap();
        system.evaluations()
    };
    let at_once = evaluations(1e-5);
    let (mut short, mut long) = (1e-5, 1.0);
    for _ in 0..60 {
        let middle = (short + long) / 2.0;
        if evaluations(middle) == at_once { short = middle } else { long = middle }
    }
    short
}

/// The error that the formula of an adaptive method has where the method begins to divide a step, relative to the
/// tolerance there.
fn error_where_divided(method: &Method, formula: &[&str]) -> f64 {
    let case = case([0.0; 4], [1.0, 0.5], longest_step(method), 1);
    let step = &steps(method, formula, &case)[0];
    let error = ["n_error_q", "n_error_v"].map(|half| evaluated(formula, step)[half]);
    let tolerance = method.tolerance.expect("it is adaptive");
    let allowed = |y: f64, absolute: f64| absolute + tolerance.relative * y.abs();
    let [q, v] = case.start;
    let of_v = error[1] / allowed(v, tolerance.absolute_v);
    (error[0] / allowed(q, tolerance.absolute_q)).max(of_v)
}

/// Whether the formula agrees with the method.
fn holds(method: &Method, formula: &[&str]) -> bool {
    let is_followed = |step: Step| residual(formula, &step) <= tolerance(method);
    judged(method, formula).all(is_followed)
        && (method.family != Family::Adaptive
            || (error_where_divided(method, formula) - 1.0).abs() < 1e-6)
}

#[test]
fn every_formula_matches_the_step_of_its_method() {
    let mut wrong = Vec::new();
    for method in read() {
        let steps: Vec<Step> = judged(method, method.formula).collect();
        assert!(steps.len() > 1, "{}", method.id);
        let worst = steps.iter().map(|step| residual(method.formula, step)).fold(0.0, f64::max);
        if !holds(method, method.formula) {
            wrong.push(format!("{}: off by {worst:.1e}", method.id));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_step_that_ends_elsewhere_contradicts_its_formula() {
    for method in read() {
        for step in judged(method, method.formula) {
            for half in 0..2 {
                let mut step = step.clone();
                step.end[half] += 1e-3 * step.end[half].abs().max(1.0);
                let off = residual(method.formula, &step);
                assert!(off > tolerance(method), "{}: {off:.1e} with another {half}", method.id);
            }
        }
    }
}

/// The line with each of its signs in turn wrong.
fn misprints(line: &str) -> impl Iterator<Item = String> + '_ {
    let wrong = [("+ ", "− "), ("− ", "+ "), ("−", "")];
    line.match_indices([' ', '(']).filter_map(move |(at, _)| {
        let (before, after) = line.split_at(at + 1);
        let (sign, other) = wrong.iter().find(|(sign, _)| after.starts_with(sign))?;
        Some(format!("{before}{other}{}", &after[sign.len()..]))
    })
}

#[test]
fn every_sign_of_every_formula_matters() {
    let mut missed = Vec::new();
    for method in read() {
        for (n, line) in method.formula.iter().enumerate() {
            for misprint in misprints(line) {
                let mut formula = method.formula.to_vec();
                formula[n] = &misprint;
                if holds(method, &formula) {
                    missed.push(format!("{}: {misprint}", method.id));
                }
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}
