//! What a step costs through the face that lanes use, against the same formula written out by hand.
//!
//! `cargo bench --bench step --no-default-features` prints nanoseconds a step for each body and method: one virtual call a
//! tick, with 1 and with 16 substeps in it. The floor is a plain loop over local numbers with the same
//! arithmetic, checked to give the same bits. Floor and candidate take turns in one process, so that the
//! ratio holds on a busy machine; the nanoseconds are those of the quietest round.

mod floor;

use std::hint::black_box;
use std::time::Instant;

use regatta::sim::bodies::{Kind, kind};
use regatta::sim::integrators::{METHODS, Method};
use regatta::sim::{Solver, Stepper};

use floor::Floor;

/// Ticks in one stretch; then both go back to the start, before explicit Euler's spring overflows.
const TICKS: u32 = 1000;
/// Stretches between two looks at the clock, which costs 20 ns: about a quarter of a millisecond.
const STRETCHES: u32 = 10;
/// Rounds of a floor and a candidate each, of which the median ratio counts.
const ROUNDS: usize = 301;

/// A body with the values of its keys and the tick it is stepped at.
struct Course {
    body: &'static str,
    values: &'static [f64],
    tick_s: f64,
}

const COURSES: [Course; 2] = [
    Course {
        body: "ship",
        values: &[20_000.0, 1_000.0, 10_000.0, 0.0, 0.0, 20_000.0],
        tick_s: 0.5,
    },
    Course {
        body: "spring",
        values: &[1.0, 39.47841760435743, 0.05, 1.0, 0.0, 3.0],
        tick_s: 1.0 / 60.0,
    },
];

/// The most that Runge-Kutta may cost in units of the floor, for each body, with 1 substep and with 16.
const AIMS: [(&str, u32, f64); 4] =
    [("ship", 1, 1.15), ("spring", 1, 1.30), ("ship", 16, 1.15), ("spring", 16, 1.15)];

fn candidate(kind: &Kind, course: &Course, method: &'static Method) -> Box<dyn Stepper> {
    // Hidden from the optimiser, so that every call is a virtual one.
    black_box((kind.build)(course.values, Solver::Method(method)))
}

fn run(stepper: &mut dyn Stepper, course: &Course, substeps: u32) -> [f64; 2] {
    stepper.set(0.0, &course.values[3..4], &course.values[4..5]);
    for tick in 0..TICKS {
        let t = f64::from(tick) * course.tick_s;
        stepper.advance(t, course.tick_s, substeps).expect("a gentle motion");
    }
    [stepper.q()[0], stepper.v()[0]]
}

/// Nanoseconds a step of the fastest round, and the median over rounds of a candidate's time in units
/// of the floor's.
struct Figures {
    candidate_ns: f64,
    floor_ns: Option<f64>,
    ratio: Option<f64>,
}

fn time(work: &mut dyn FnMut(), steps: f64) -> f64 {
    let start = Instant::now();
    for _ in 0..STRETCHES {
        work();
    }
    start.elapsed().as_secs_f64() * 1e9 / (steps * f64::from(STRETCHES))
}

fn measure(course: &Course, method: &'static Method, substeps: u32) -> Figures {
    let kind = kind(course.body).expect("a body of the table");
    let mut stepper = candidate(kind, course, method);
    let values = black_box(course.values);
    let h = black_box(course.tick_s) / f64::from(black_box(substeps));
    let steps = TICKS * substeps;
    let floor: Option<Floor> = floor::of(course.body, method.id);

    if let Some(floor) = floor {
        let (found, wanted) = (run(&mut *stepper, course, substeps), floor(values, h, steps));
        let same = found.map(f64::to_bits) == wanted.map(f64::to_bits);
        assert!(same, "{} {}: {found:?}, by hand {wanted:?}", course.body, method.id);
    }
    let (mut candidates, mut floors) = (Vec::new(), Vec::new());
    for round in 0..ROUNDS {
        let mut by_candidate = || {
            let mut work = || _ = black_box(run(&mut *stepper, course, substeps));
            candidates.push(time(&mut work, f64::from(steps)));
        };
        let mut by_floor = || {
            let Some(floor) = floor else { return };
            let mut work = || _ = black_box(floor(black_box(values), black_box(h), steps));
            floors.push(time(&mut work, f64::from(steps)));
        };
        if round % 2 == 0 {
            by_candidate();
            by_floor();
        } else {
            by_floor();
            by_candidate();
        }
    }
    let least = |times: &[f64]| times.iter().copied().reduce(f64::min);
    let mut ratios: Vec<f64> =
        candidates.iter().zip(&floors).map(|(candidate, floor)| candidate / floor).collect();
    ratios.sort_by(f64::total_cmp);
    Figures {
        candidate_ns: least(&candidates).expect("at least one round"),
        floor_ns: least(&floors),
        ratio: ratios.get(ratios.len() / 2).copied(),
    }
}

fn main() {
    println!("body    method                substeps  ns/step  floor ns  ratio");
    let mut missed = Vec::new();
    for course in &COURSES {
        for method in METHODS {
            for substeps in [1, 16] {
                let Figures { candidate_ns, floor_ns, ratio } = measure(course, method, substeps);
                let shown =
                    |x: Option<f64>, digits| x.map_or("-".to_string(), |x| format!("{x:.digits$}"));
                println!(
                    "{:7} {:21} {substeps:8} {candidate_ns:8.2} {:>9} {:>6}",
                    course.body,
                    method.id,
                    shown(floor_ns, 2),
                    shown(ratio, 3),
                );
                let aim = AIMS.iter().find(|aim| (aim.0, aim.1) == (course.body, substeps));
                if let (Some((body, _, aim)), Some(ratio), "rk4") = (aim, ratio, method.id)
                    && ratio > *aim
                {
                    missed.push(format!("{body}, {substeps} substeps: {ratio:.3} > {aim}"));
                }
            }
        }
    }
    match &missed[..] {
        [] => println!("aims for rk4: held (ship 1.15, spring 1.30; with 16 substeps 1.15)"),
        missed => println!("aims for rk4: MISSED ({})", missed.join("; ")),
    }
}
