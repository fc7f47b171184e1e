//! Steps of a body in stretches that take turns with those of a spring.

use std::hint::black_box;
use std::time::Instant;

use regatta::sim::bodies::kind;
use regatta::sim::{Solver, Stepper};

/// Ticks in one stretch, their length, and the rounds in which both take their turn.
const TICKS: u32 = 2000;
const TICK_S: f64 = 1.0 / 60.0;
pub(crate) const ROUNDS: usize = 101;

pub(crate) const SPRING: [f64; 6] = [1.0, 39.47841760435743, 0.05, 1.0, 0.0, 3.0];

pub(crate) fn stepper(body: &str, values: &[f64], solver: Solver) -> Box<dyn Stepper> {
    let kind = kind(body).expect("a body of the table");
    black_box((kind.build)(values, solver))
}

/// Nanoseconds a step, over a stretch from the start.
pub(crate) fn stretch_ns(stepper: &mut dyn Stepper, [q, v]: &[Vec<f64>; 2]) -> f64 {
    stepper.set(0.0, q, v);
    let start = Instant::now();
    for tick in 0..TICKS {
        stepper.advance(f64::from(tick) * TICK_S, TICK_S, 1).expect("a gentle motion");
    }
    start.elapsed().as_secs_f64() * 1e9 / f64::from(TICKS)
}

pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
