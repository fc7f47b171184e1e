//! What a ball under `locate` costs beside a spring, at about one impact a second.
//!
//! `cargo bench --bench bounce` prints the step of each method on both. The two take turns in one process.

use std::hint::black_box;
use std::time::Instant;

use regatta::sim::bodies::kind;
use regatta::sim::integrators::{Method, method};
use regatta::sim::{Solver, Stepper};

/// Ticks in one stretch, their length, and the rounds in which both take their turn.
const TICKS: u32 = 2000;
const TICK_S: f64 = 1.0 / 60.0;
const ROUNDS: usize = 101;

const SPRING: [f64; 6] = [1.0, 39.47841760435743, 0.05, 1.0, 0.0, 3.0];
/// Of 1.2 m, e = 1.
const BALL: [(&str, f64); 2] = [("height_m", 1.2), ("restitution", 1.0)];

fn stepper(body: &str, values: &[f64], method: &'static Method) -> Box<dyn Stepper> {
    let kind = kind(body).expect("a body of the table");
    black_box((kind.build)(values, Solver::Method(method)))
}

/// Nanoseconds a step, over a stretch from the start.
fn stretch_ns(stepper: &mut dyn Stepper, [q, v]: &[Vec<f64>; 2]) -> f64 {
    stepper.set(0.0, q, v);
    let start = Instant::now();
    for tick in 0..TICKS {
        stepper.advance(f64::from(tick) * TICK_S, TICK_S, 1).expect("a gentle motion");
    }
    start.elapsed().as_secs_f64() * 1e9 / f64::from(TICKS)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    let kind = kind("ball").expect("a body of the table");
    let mut values = kind.plain_values();
    for (key, value) in BALL {
        values[kind.parameter(key).expect("a key of the ball").0] = value;
    }
    for id in ["explicit-euler", "semi-implicit-euler", "velocity-verlet", "rk4"] {
        let card = method(id).expect("a built-in method");
        let [mut ball, mut spring] = [("ball", &values[..]), ("spring", &SPRING)]
            .map(|(body, values)| stepper(body, values, card));
        let start = |stepper: &dyn Stepper| [stepper.q().to_vec(), stepper.v().to_vec()];
        let starts = [start(&*ball), start(&*spring)];
        let rounds: Vec<[f64; 2]> = (0..ROUNDS)
            .map(|_| [stretch_ns(&mut *ball, &starts[0]), stretch_ns(&mut *spring, &starts[1])])
            .collect();
        let of = |i: usize| median(rounds.iter().map(|round| round[i]).collect());
        let part = median(rounds.iter().map(|[ball, spring]| ball / spring).collect());
        println!("{id:22} {:7.1} ns {part:6.2} x a spring at {:.1} ns", of(0), of(1));
    }
}
