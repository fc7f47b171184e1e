//! What a step costs through the face that lanes use, against the same formula written out by hand.
//!
//! `cargo bench --no-default-features --bench step` prints nanoseconds a step for each body and method,
//! one virtual call a tick, with 1 and with 16 substeps in it, and beside them two plain loops over local
//! numbers: the equation as it is printed, with its division by the mass at every stage, and the bare
//! one, with every division taken out of the loop, which has to give the same bits as ours.
//!
//! Words after `--` narrow it: `-- spring rk4` benches Runge-Kutta on the spring.
//!
//! The three take turns in one process, so that the ratios, medians over the rounds, hold on a busy
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
/// Stretches between two looks at the clock, which costs 20 ns: about a quarter of a millisecond.
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

/// The methods that are to cost little more than a loop by hand, and the most they may cost in units of
/// it, with so many substeps.
const AIMED: [&str; 3] = ["semi-implicit-euler", "velocity-verlet", "rk4"];
const AIMS: [(u32, f64); 2] = [(1, 1.30), (16, 1.15)];

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
    /// The textbook's loop and the bare one, where they are written.
    by_hand: Option<[Beside; 2]>,
}

/// Nanoseconds a step of some stretches of `steps` steps each.
fn time(work: &mut dyn FnMut(), steps: u32) -> f64 {
    let start = Instant::now();
    for _ in 0..STRETCHES {
        work();
    }
    start.elapsed().as_secs_f64() * 1e9 / f64::from(steps * STRETCHES)
}

fn measure(course: &Course, method: &'static Method, substeps: u32) -> Figures {
    let kind = kind(course.body).expect("a body of the table");
    let mut stepper = candidate(kind, course, method);
    let h = black_box(course.tick_s) / f64::from(black_box(substeps));
    let steps = TICKS * substeps;
    let mut lane = || time(&mut || _ = black_box(run(&mut *stepper, course, substeps)), steps);
    let hand = |work: Loop| {
        time(&mut || _ = black_box(work(black_box(course.values), black_box(h), steps)), steps)
    };
    let Some(ByHand { textbook, bare }) = by_hand(course.body, method.id) else {
        let times: Vec<f64> = (0..ROUNDS).map(|_| lane()).collect();
        return Figures { ns: least(&times), by_hand: None };
    };
    let rounds: Vec<[f64; 3]> = (0..ROUNDS)
        .map(|round| match round % 2 {
            0 => [lane(), hand(textbook), hand(bare)],
            _ => {
                let (bare, textbook) = (hand(bare), hand(textbook));
                [lane(), textbook, bare]
            }
        })
        .collect();
    let column = |i: usize| rounds.iter().map(|round| round[i]).collect::<Vec<_>>();
    let beside = |i: usize| {
        let ratios: Vec<f64> = rounds.iter().map(|round| round[0] / round[i]).collect();
        Beside { ns: least(&column(i)), ratio: median(ratios) }
    };
    Figures { ns: least(&column(0)), by_hand: Some([beside(1), beside(2)]) }
}

fn least(times: &[f64]) -> f64 {
    times.iter().copied().reduce(f64::min).expect("at least one round")
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// The loops by hand are the same formula: the bare one to the bit, the textbook's but for rounding.
fn check(course: &Course, method: &'static Method, substeps: u32) {
    let Some(ByHand { textbook, bare }) = by_hand(course.body, method.id) else { return };
    let mut stepper = candidate(kind(course.body).expect("a body"), course, method);
    let found = run(&mut *stepper, course, substeps);
    let (h, steps) = (course.tick_s / f64::from(substeps), TICKS * substeps);
    let wanted = bare(course.values, h, steps);
    let name = format!("{} {}, {substeps} substeps", course.body, method.id);
    assert_eq!(found.map(f64::to_bits), wanted.map(f64::to_bits), "{name}: {found:?}, {wanted:?}");
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
    println!("                                            ns a step              ours in units of");
    println!(
        "body    method                    substeps    ours textbook    bare textbook    bare"
    );
    let mut verdicts = Vec::new();
    for course in &COURSES {
        for method in METHODS.iter().filter(|method| wanted(course, method)) {
            for substeps in [1, 16] {
                check(course, method, substeps);
                let Figures { ns, by_hand } = measure(course, method, substeps);
                print!("{:7} {:25} {substeps:8} {ns:7.2}", course.body, method.id);
                let Some([textbook, bare]) = by_hand else {
                    println!("{:>9}{:>8}{:>9}{:>8}", "-", "-", "-", "-");
                    continue;
                };
                println!(
                    "{:9.2}{:8.2}{:9.3}{:8.3}",
                    textbook.ns, bare.ns, textbook.ratio, bare.ratio
                );
                let aim = AIMS.iter().find(|(aimed, _)| *aimed == substeps);
                if let (Some((_, most)), true) = (aim, AIMED.contains(&method.id)) {
                    let verdict = |Beside { ratio, .. }: Beside| match ratio <= *most {
                        true => format!("{ratio:.3} held"),
                        false => format!("{ratio:.3} MISSED"),
                    };
                    let (textbook, bare) = (verdict(textbook), verdict(bare));
                    let (body, id) = (course.body, method.id);
                    verdicts.push(format!(
                        "  {body:7} {id:20} {substeps:2} substeps, at most {most:.2}: \
                         of the textbook's loop {textbook}, of the bare loop {bare}"
                    ));
                }
            }
        }
    }
    println!("aims:\n{}", verdicts.join("\n"));
}
