//! What a ball under `locate` costs beside a spring, at about one impact a second, and what a rule for impacts costs a
//! spring, which has none.
//!
//! `cargo bench --bench bounce` prints the step of each method on all three, which take turns in one process.

mod beside_spring;

use beside_spring::{ROUNDS, SPRING, median, stepper, stretch_ns};
use regatta::sim::bodies::kind;
use regatta::sim::integrators::method;
use regatta::sim::{IMPACTS, Solver};

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
        let (plain, ruled) = (Solver::Method(card), Solver::Bouncing(card, None, &IMPACTS[0]));
        let mut bodies = [
            stepper("ball", &values, plain),
            stepper("spring", &SPRING, plain),
            stepper("spring", &SPRING, ruled),
        ];
        let starts = bodies.each_ref().map(|body| [body.q().to_vec(), body.v().to_vec()]);
        let rounds: Vec<[f64; 3]> = (0..ROUNDS)
            .map(|_| [0, 1, 2].map(|i| stretch_ns(&mut *bodies[i], &starts[i])))
            .collect();
        let of = |i: usize| median(rounds.iter().map(|round| round[i]).collect());
        let part = |i: usize| median(rounds.iter().map(|round| round[i] / round[1]).collect());
        println!(
            "{id:22} ball {:6.1} ns, {:.2} x a spring at {:.1} ns; a spring with a rule {:.3} x",
            of(0),
            part(0),
            of(1),
            part(2)
        );
    }
}
