//! A motion is named only if it explains a log: random motions of twelve kinds, with noise and at uneven times.

use std::f64::consts::TAU;

use regatta::table::TableOptions;
use regatta::tools::identify::{Identification, Log, LoggedBody, SimpleMotion, identify};

use super::dice::Dice;

/// Number of series of each kind; `SERIES` gives another.
const SERIES: usize = 8;
/// Least share of the series of a kind that is named.
const NAMED: f64 = 0.98;

/// A kind of motion, its coordinate at a time, and whether an answer is right; `None` if the kind has no name.
struct Kind {
    name: &'static str,
    make: fn(&mut Dice, times: &[f64]) -> Vec<f64>,
    is_right: Option<fn(&SimpleMotion) -> bool>,
    is_swing: bool,
}

fn noise(dice: &mut Dice) -> f64 {
    (0..12).map(|_| dice.between(-0.5, 0.5)).sum()
}

/// Adds noise of a thousandth to a motion of size 1.
fn noisy(dice: &mut Dice, times: &[f64], at: impl Fn(f64) -> f64) -> Vec<f64> {
    times.iter().map(|t| at(*t) + 1e-3 * noise(dice)).collect()
}

fn swing(dice: &mut Dice, most_damped: f64) -> impl Fn(f64) -> f64 + use<> {
    let [hz, ratio, phase] =
        [(0.3, 3.0), (0.0, most_damped), (0.0, TAU)].map(|(low, high)| dice.between(low, high));
    move |t| (-ratio * TAU * hz * t).exp() * (TAU * hz * t + phase).cos()
}

const KINDS: [Kind; 12] = [
    Kind {
        name: "rest",
        make: |dice, times| noisy(dice, times, |_| 0.7),
        is_right: Some(|it| matches!(it, SimpleMotion::Rest { .. })),
        is_swing: false,
    },
    Kind {
        name: "steady speed",
        make: |dice, times| {
            let v = dice.between(0.1, 3.0);
            noisy(dice, times, |t| v * t)
        },
        is_right: Some(|it| matches!(it, SimpleMotion::Steady { .. })),
        is_swing: false,
    },
    Kind {
        name: "constant acceleration",
        make: |dice, times| {
            let [v, a] = [-2.0, 1.0].map(|low| dice.between(low, low + 2.0));
            noisy(dice, times, |t| v * t + a * t * t / 2.0)
        },
        is_right: Some(|it| matches!(it, SimpleMotion::Accelerated { .. })),
        is_swing: false,
    },
    Kind {
        name: "chase",
        make: |dice, times| {
            let rate = dice.between(0.5, 6.0);
            noisy(dice, times, |t| 1.0 - (-rate * t).exp())
        },
        is_right: Some(|it| matches!(it, SimpleMotion::Chase { .. })),
        is_swing: false,
    },
    Kind {
        name: "linear drag",
        make: |dice, times| {
            let [rate, v] = [(0.5, 3.0), (0.5, 2.0)].map(|(low, high)| dice.between(low, high));
            noisy(dice, times, |t| v * (t - (1.0 - (-rate * t).exp()) / rate))
        },
        is_right: Some(|it| matches!(it, SimpleMotion::Driven { .. })),
        is_swing: false,
    },
    Kind {
        name: "quadratic drag",
        make: |dice, times| {
            let rate = dice.between(0.5, 6.0);
            noisy(dice, times, |t| (1.0 + rate * t).ln())
        },
        is_right: Some(|it| matches!(it, SimpleMotion::Quadratic { .. })),
        is_swing: false,
    },
    Kind {
        name: "swing",
        make: |dice, times| {
            let at = swing(dice, 0.15);
            noisy(dice, times, at)
        },
        is_right: None,
        is_swing: true,
    },
    Kind {
        name: "overdamped return",
        make: |dice, times| {
            let [fast, slow] = [(6.0, 12.0), (1.0, 3.0)].map(|(low, high)| dice.between(low, high));
            let at = |t: f64| (fast * (-slow * t).exp() - slow * (-fast * t).exp()) / (fast - slow);
            noisy(dice, times, at)
        },
        is_right: None,
        is_swing: true,
    },
    Kind {
        name: "swing about a drifting rest",
        make: |dice, times| {
            let (at, v) = (swing(dice, 0.15), dice.between(0.2, 1.0));
            noisy(dice, times, |t| at(t) + v * t)
        },
        is_right: Some(|it| matches!(it, SimpleMotion::DriftingSwing { .. })),
        is_swing: false,
    },
    Kind {
        name: "white noise",
        make: |dice, times| times.iter().map(|_| noise(dice)).collect(),
        is_right: Some(|it| matches!(it, SimpleMotion::Rest { .. })),
        is_swing: false,
    },
    Kind {
        name: "random walk",
        make: |dice, times| {
            let mut x = 0.0;
            times
                .iter()
                .map(|_| {
                    x += noise(dice);
                    x
                })
                .collect()
        },
        is_right: None,
        is_swing: false,
    },
    Kind {
        name: "two swings",
        make: |dice, times| {
            let at = [swing(dice, 0.03), swing(dice, 0.03)];
            noisy(dice, times, |t| at[0](t) + at[1](t))
        },
        is_right: None,
        is_swing: false,
    },
];

/// What a series is called: a simple motion, a swing, or nothing.
fn answer(found: Option<&Identification>) -> (Option<SimpleMotion>, bool) {
    (found.and_then(|it| it.simple), found.is_some_and(|it| it.effective.is_some()))
}

#[test]
fn motions_of_twelve_kinds_are_named_rightly_or_not_at_all() {
    let mut dice = Dice::new(79);
    let series = std::env::var("SERIES").ok().and_then(|n| n.parse().ok()).unwrap_or(SERIES);
    let mut wrong = Vec::new();
    for kind in &KINDS {
        let mut named = 0;
        for number in 0..series {
            let mut t = 0.0;
            let times: Vec<f64> = (0..240)
                .map(|_| {
                    t += dice.between(0.01, 0.04);
                    t
                })
                .collect();
            let x = (kind.make)(&mut dice, &times);
            let rows = times.iter().zip(&x).map(|(t, x)| format!("{t:.6},{x:.6}\n"));
            let text = format!("t,x\n{}", rows.collect::<String>());
            let log = Log::parse("log", &text, &TableOptions::default(), 60.0).unwrap();
            let found = identify(&log, &LoggedBody::default(), 60.0);
            let (simple, is_swing) = answer(found.as_ref());
            // Two swings of nearly one frequency are one to the noise.
            let residual = found.and_then(|it| it.swing).map(|swing| swing.residual);
            let is_one = kind.name == "two swings" && residual.is_some_and(|part| part < 2e-3);
            let is_right = simple.as_ref().is_some_and(|it| kind.is_right.is_some_and(|of| of(it)))
                || simple.is_none() && is_swing && (kind.is_swing || is_one);
            let is_silent = simple.is_none() && !is_swing;
            named += usize::from(is_right);
            if !is_right && !is_silent {
                wrong.push(format!("{} {number}: {simple:?}, swing {is_swing}", kind.name));
            }
        }
        println!("{}: {named} of {series} named", kind.name);
        let has_name = kind.is_right.is_some() || kind.is_swing;
        assert!(!has_name || named as f64 >= NAMED * series as f64, "{}: {named}", kind.name);
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
