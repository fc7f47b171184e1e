//! What a step costs of a spring that is written as a law, against the built-in one.
//!
//! `cargo bench --no-default-features --features lab --bench law` steps both under some methods, and prints nanoseconds a
//! step and the law's time in units of the built-in spring's, which is to be at most 10.
//!
//! The two take turns in one process, so that the ratio, a median over the rounds, holds on a busy
//! machine; the nanoseconds are those of the quietest round.

use std::hint::black_box;
use std::time::Instant;

use regatta::scene::Scene;
use regatta::sim::integrators::method;
use regatta::sim::{Solver, Stepper};

/// The spring of the built-in scene, as a body of the table and as a law.
const SPRINGS: [&str; 2] = [
    "[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 39.47841760435743\ndamping_n_s_per_m = 0.05\n",
    "[[law]]\nconstants = { m = 1, k = 39.47841760435743, c = 0.05 }\n[law.coordinates.x]\nstart = 1\n\
     acceleration = '-(k/m)*x - c/m*vx'\n",
];

/// Methods of one and of several evaluations a step, and one that solves.
const METHODS: [&str; 4] = ["semi-implicit-euler", "velocity-verlet", "rk4", "implicit-midpoint"];

/// Steps in a round, and rounds.
const STEPS: u32 = 5_000;
const ROUNDS: usize = 301;

/// The most a law's step may cost in steps of the built-in spring.
const MAX_RATIO: f64 = 10.0;

fn stepper(text: &str, id: &str) -> Box<dyn Stepper> {
    let text = format!("title = 'Spring'\ntick_hz = 60\nseconds = 10\n{text}");
    let scene = Scene::parse("spring.toml", &text).expect("a scene");
    let body = &scene.bodies[0];
    let method = method(id).expect("a method of the table");
    black_box((body.kind.build)(&body.values, Solver::Method(method)))
}

/// Nanoseconds a step of a round.
fn round(stepper: &mut dyn Stepper) -> f64 {
    stepper.set(0.0, &[1.0], &[0.0]);
    let h = black_box(1.0 / 60.0);
    let begun = Instant::now();
    for tick in 0..STEPS {
        stepper.advance(f64::from(tick) * h, h, 1).expect("a gentle motion");
    }
    begun.elapsed().as_nanos() as f64 / f64::from(STEPS)
}

fn main() {
    println!("{:22} {:>12} {:>12} {:>8}", "METHOD", "BUILT-IN NS", "LAW NS", "RATIO");
    let mut worst = 0.0_f64;
    for id in METHODS {
        let [mut built_in, mut law] = SPRINGS.map(|text| stepper(text, id));
        let (mut ratios, mut least) = (Vec::new(), [f64::INFINITY; 2]);
        for _ in 0..ROUNDS {
            let times = [round(&mut *built_in), round(&mut *law)];
            least = [least[0].min(times[0]), least[1].min(times[1])];
            ratios.push(times[1] / times[0]);
        }
        ratios.sort_by(f64::total_cmp);
        let ratio = ratios[ROUNDS / 2];
        worst = worst.max(ratio);
        println!("{id:22} {:12.1} {:12.1} {ratio:8.2}", least[0], least[1]);
    }
    let word = if worst <= MAX_RATIO { "within" } else { "beyond" };
    println!("{word} the aim: at most {MAX_RATIO} times the built-in spring");
}
