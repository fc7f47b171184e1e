//! What a ball under `locate` costs beside a spring, at about one impact a second.
//!
//! `cargo bench --bench bounce` prints the step of each method on both. The two take turns in one process.

mod beside_spring;

use beside_spring::{ROUNDS, SPRING, median, stepper, stretch_ns};
use regatta::sim::Stepper;
use regatta::sim::bodies::kind;
use regatta::sim::integrators::method;

/// Of 1.2 m, e = 1.
const BALL: [(&str, f64); 2] = [("height_m", 1.2), ("restitution", 1.0)];

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
