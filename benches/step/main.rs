//! What a step costs through the face that lanes use, against the same formula written out by hand.
//!
//! `cargo bench --no-default-features --bench step` prints nanoseconds a step for each body and method,
//! one virtual call a tick, with 1 and with 16 substeps in it, and beside them three plain loops over
//! local numbers: the equation as it is printed, with its division by the mass at every stage; the bare
//! one, with every division taken out of the loop, which has to give the same bits as ours; and the bare
//! one shown, whose state is in memory after each tick, where it has to be for anyone to draw it.
//!
//! Words after `--` narrow it: `-- spring rk4` benches Runge-Kutta on the spring.
//!
//! The four take turns in one process, so that the ratios, medians over the rounds, hold on a busy
//! machine; the nanoseconds are those of the quietest round.

mod floor;

use std::hint::black_box;
use std::time::Instant;

use regatta::sim::bodies::{Kind, kind};
use regatta::sim::integrators::{METHODS, Method};
use regatta::sim::{Solver, Stepper};

use floor::{ByHand, Loop, by_hand};

/// Ticks in one stretch; then both go back to the start, before explicit Euler's spring overflows.
const TICKS: u32 = 1000;
/// Stretches of one substep a tick between two looks at the clock, which costs 20 ns: a quarter of a
/// millisecond at the most, so that few rounds are interrupted.
const STRETCHES: u32 = 10;
/// Rounds, in each of which ours and the loops by hand are timed once.
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

/// The methods that are to cost little more than the loops by hand.
const AIMED: [&str; 3] = ["semi-implicit-euler", "velocity-verlet", "rk4"];
/// The most they may cost in units of the textbook's loop, and of the bare one shown.
const AIMS: [f64; 2] = [1.30, 1.15];

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

/// One loop by hand beside the lane's: nanoseconds a step of the quietest round, and the median of the
/// lane's time in units of the loop's.
struct Beside {
    ns: f64,
    ratio: f64,
}

struct Figures {
    ns: f64,
    /// The textbook's loop, the bare one and the one whose state is shown, where they are written.
    by_hand: Option<[Beside; 3]>,
}

/// Nanoseconds a step of some stretches of `steps` steps each.
fn time(work: &mut dyn FnMut(), steps: u32) -> f64 {
    let stretches = (STRETCHES * TICKS / steps).max(1);
    let start = Instant::now();
    for _ in 0..stretches {
        work();
    }
    start.elapsed().as_secs_f64() * 1e9 / f64::from(steps * stretches)
}

fn measure(course: &Course, method: &'static Method, substeps: u32) -> Figures {
    let kind = kind(course.body).expect("a body of the table");
    let mut stepper = candidate(kind, course, method);
    let h = black_box(course.tick_s) / f64::from(black_box(substeps));
    let steps = TICKS * substeps;
    let mut lane = || time(&mut || _ = black_box(run(&mut *stepper, course, substeps)), steps);
    let hand = |work: Loop, split: [u32; 2]| {
        let mut run = || _ = black_box(work(black_box(course.values), black_box(h), split));
        time(&mut run, steps)
    };
    let Some(ByHand { textbook, bare, shown }) = by_hand(course.body, method.id) else {
        let times: Vec<f64> = (0..ROUNDS).map(|_| lane()).collect();
        return Figures { ns: least(&times), by_hand: None };
    };
    let (unbroken, by_ticks) = ([1, black_box(steps)], black_box([TICKS, substeps]));
    let rounds: Vec<[f64; 4]> = (0..ROUNDS)
        .map(|round| match round % 2 {
            0 => [lane(), hand(textbook, unbroken), hand(bare, unbroken), hand(shown, by_ticks)],
            _ => {
                let shown = hand(shown, by_ticks);
                let (bare, textbook) = (hand(bare, unbroken), hand(textbook, unbroken));
                [lane(), textbook, bare, shown]
            }
        })
        .collect();
    let column = |i: usize| rounds.iter().map(|round| round[i]).collect::<Vec<_>>();
    let beside = |i: usize| {
        let ratios: Vec<f64> = rounds.iter().map(|round| round[0] / round[i]).collect();
        Beside { ns: least(&column(i)), ratio: median(ratios) }
    };
    Figures { ns: least(&column(0)), by_hand: Some([beside(1), beside(2), beside(3)]) }
}

fn least(times: &[f64]) -> f64 {
    times.iter().copied().reduce(f64::min).expect("at least one round")
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The loops by hand are the same formula: the bare ones to the bit, the textbook's but for rounding.
fn check(course: &Course, method: &'static Method, substeps: u32) {
    let Some(ByHand { textbook, bare, shown }) = by_hand(course.body, method.id) else { return };
    let mut stepper = candidate(kind(course.body).expect("a body"), course, method);
    let found = run(&mut *stepper, course, substeps);
    let (h, steps) = (course.tick_s / f64::from(substeps), [TICKS, substeps]);
    let name = format!("{} {}, {substeps} substeps", course.body, method.id);
    for wanted in [bare, shown].map(|work| work(course.values, h, steps)) {
        let bits = [found, wanted].map(|state| state.map(f64::to_bits));
        assert_eq!(bits[0], bits[1], "{name}: {found:?}, {wanted:?}");
    }
    for (found, wanted) in found.into_iter().zip(textbook(course.values, h, steps)) {
        assert!((found / wanted - 1.0).abs() < 1e-10, "{name}: {found}, by the book {wanted}");
    }
}

/// Whether the words on the command line, if any, all name this body or method.
fn wanted(course: &Course, method: &Method) -> bool {
    let words = std::env::args().skip(1).filter(|word| !word.starts_with('-'));
    words.into_iter().all(|word| course.body == word || method.id == word)
}

fn main() {
    println!(
        "                                           nanoseconds a step             ours in units of"
    );
    println!(
        "body    method                    substeps    ours textbook  bare   shown textbook  bare   shown"
    );
    let mut verdicts = Vec::new();
    for course in &COURSES {
        for method in METHODS.iter().filter(|method| wanted(course, method)) {
            for substeps in [1, 16] {
                check(course, method, substeps);
                let Figures { ns, by_hand } = measure(course, method, substeps);
                print!("{:7} {:25} {substeps:8} {ns:7.2}", course.body, method.id);
                let Some(beside) = by_hand else {
                    println!();
                    continue;
                };
                for Beside { ns, .. } in &beside {
                    print!("{ns:8.2}");
                }
                for Beside { ratio, .. } in &beside {
                    print!("{ratio:8.3}");
                }
                println!();
                let [textbook, _, shown] = beside;
                if AIMED.contains(&method.id) {
                    let verdict = |Beside { ratio, .. }: Beside, most: f64| match ratio <= most {
                        true => format!("{ratio:.3} held"),
                        false => format!("{ratio:.3} MISSED"),
                    };
                    let [textbook, shown] = [verdict(textbook, AIMS[0]), verdict(shown, AIMS[1])];
                    let (body, id) = (course.body, method.id);
                    verdicts.push(format!(
                        "  {body:7} {id:20} {substeps:2} substeps: \
                         of the textbook's loop {textbook}, of the bare loop shown {shown}"
                    ));
                }
            }
        }
    }
    println!("aims, at most {} and {}:\n{}", AIMS[0], AIMS[1], verdicts.join("\n"));
}
