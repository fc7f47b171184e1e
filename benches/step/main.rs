//! What a step costs through the face that lanes use, against the same formula written out by hand.
//!
//! `cargo bench --no-default-features --features lab --bench step` prints nanoseconds a step for each body and method,
//! one virtual call a tick, with 1 and with 16 substeps in it, and beside them three plain loops over
//! local numbers: the equation as it is printed, with its division by the mass at every stage; the bare
//! one, with every division taken out of the loop, which has to give the same bits as ours; and the bare
//! one shown, whose state is in memory after each tick, where it has to be for anyone to draw it.
//!
//! Words after `--` narrow it: `-- spring rk4` benches Runge-Kutta on the spring. `-- --readme` prints the
//! manual's table instead.
//!
//! The four take turns in one process, so that the ratios, medians over the rounds, hold on a busy
//! machine; the nanoseconds are those of the quietest round.

mod floor;
mod rows;

use std::hint::black_box;
use std::time::{Duration, Instant};

use regatta::sim::bodies::kind;
use regatta::sim::integrators::{GENERAL_METHODS, Method};
use regatta::sim::{Solver, Stepper};

use floor::{ByHand, Loop, by_hand};

/// Steps between two looks at the clock, which costs 20 ns, for each coordinate: a quarter of a
/// millisecond at the most, so that few rounds are interrupted.
const STEPS: u32 = 10_000;
/// Rounds, in each of which ours and the loops by hand are timed once.
const ROUNDS: usize = 301;
/// No round begins later than this, but for the first few.
const PATIENCE: Duration = Duration::from_secs(3);
/// The fewest rounds.
const FEW: usize = 5;

/// A body with the values of its keys and the tick it is stepped at.
struct Course {
    body: &'static str,
    /// How many of it there are in the body.
    coordinates: u32,
    values: &'static [f64],
    tick_s: f64,
    /// The most that the methods aimed at may cost in units of the bare loop shown.
    of_shown: f64,
    /// Ticks in one stretch; then all go back to the start, before explicit Euler overflows.
    ticks: u32,
}

const COURSES: [Course; 3] = [
    Course {
        body: "ship",
        coordinates: 1,
        values: &[20_000.0, 1_000.0, 10_000.0, 0.0, 0.0, 20_000.0],
        tick_s: 0.5,
        of_shown: 1.15,
        ticks: 1000,
    },
    Course {
        body: "spring",
        coordinates: 1,
        values: &[1.0, 39.47841760435743, 0.05, 1.0, 0.0, 3.0],
        tick_s: 1.0 / 60.0,
        of_shown: 1.15,
        ticks: 1000,
    },
    Course {
        body: "chain",
        coordinates: 64,
        values: &[64.0, 1.0, 800.0, 0.05, 20.0, 1.0, 3.0],
        tick_s: 1.0 / 120.0,
        of_shown: 1.30,
        ticks: 100,
    },
];

/// The methods that are to cost little more than the loops by hand.
const AIMED: [&str; 3] = ["semi-implicit-euler", "velocity-verlet", "rk4"];
/// The most they may cost in units of the textbook's loop.
const OF_TEXTBOOK: f64 = 1.30;

impl Course {
    /// Hidden from the optimiser, so that every call is a virtual one.
    fn stepper(&self, method: &'static Method) -> Box<dyn Stepper> {
        let kind = kind(self.body).expect("a body of the table");
        black_box((kind.build)(self.values, Solver::Method(method)))
    }

    /// What it is called in tables.
    fn name(&self) -> String {
        match self.coordinates {
            1 => self.body.to_owned(),
            n => format!("{} of {n}", self.body),
        }
    }
}

/// The coordinates, then their velocities.
fn state(stepper: &dyn Stepper) -> Vec<f64> {
    [stepper.q(), stepper.v()].concat()
}

fn run(stepper: &mut dyn Stepper, course: &Course, start: &[f64], substeps: u32) {
    let (q, v) = start.split_at(start.len() / 2);
    stepper.set(0.0, q, v);
    for tick in 0..course.ticks {
        let t = f64::from(tick) * course.tick_s;
        stepper.advance(t, course.tick_s, substeps).expect("a gentle motion");
    }
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

fn measure(course: &Course, method: &'static Method, substeps: u32) -> Figures {
    let mut stepper = course.stepper(method);
    let start = state(&*stepper);
    let h = black_box(course.tick_s) / f64::from(black_box(substeps));
    let steps = course.ticks * substeps;
    let stretches = (STEPS / course.coordinates / steps).max(1);
    let time = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        for _ in 0..stretches {
            work();
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(steps * stretches)
    };
    let mut lane = || time(&mut || run(&mut *stepper, course, black_box(&start), substeps));
    let mut end = start.clone();
    let mut hand = |work: Loop, split: [u32; 2]| {
        time(&mut || {
            end.copy_from_slice(black_box(&start));
            work(black_box(course.values), black_box(h), split, &mut end);
            black_box(&end);
        })
    };
    let began = Instant::now();
    let rounds = (0..ROUNDS).take_while(|&round| round < FEW || began.elapsed() < PATIENCE);
    let Some(ByHand { textbook, bare, shown }) = by_hand(course.body, method.id) else {
        let times: Vec<f64> = rounds.map(|_| lane()).collect();
        return Figures { ns: least(&times), by_hand: None };
    };
    let (unbroken, by_ticks) = ([1, black_box(steps)], black_box([course.ticks, substeps]));
    let rounds: Vec<[f64; 4]> = rounds
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
    let mut stepper = course.stepper(method);
    let start = state(&*stepper);
    run(&mut *stepper, course, &start, substeps);
    let found = state(&*stepper);
    let (h, steps) = (course.tick_s / f64::from(substeps), [course.ticks, substeps]);
    let name = format!("{} {}, {substeps} substeps", course.body, method.id);
    let [bare, shown, textbook] = [bare, shown, textbook].map(|work| {
        let mut state = start.clone();
        work(course.values, h, steps, &mut state);
        state
    });
    for wanted in [bare, shown] {
        let same = found.iter().zip(&wanted).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same, "{name}: {found:?}, {wanted:?}");
    }
    let scale = found.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for (found, wanted) in found.iter().zip(&textbook) {
        assert!((found - wanted).abs() < 1e-10 * scale, "{name}: {found}, by the book {wanted}");
    }
}

/// Whether the words on the command line, if any, all name this body or method.
fn wanted(course: &Course, method: &Method) -> bool {
    let words = std::env::args().skip(1).filter(|word| !word.starts_with('-'));
    words.into_iter().all(|word| course.body == word || method.id == word)
}

fn main() {
    match std::env::args().any(|word| word == "--readme") {
        true => readme(),
        false => everything(),
    }
}

/// The manual's table: one step a tick, and beside it the loop by hand as the book prints it. With `BLESS=1` it replaces
/// that of the manual.
fn readme() {
    let heads = COURSES.each_ref().map(|course| format!("{}, ns | by hand |", course.name()));
    let mut table = format!("| method | {}\n", heads.join(" "));
    table += &format!("|---|{}\n", "---:|---:|".repeat(COURSES.len()));
    for method in GENERAL_METHODS {
        table += &format!("| `{}` |", method.id);
        for course in &COURSES {
            let Figures { ns, by_hand } = measure(course, method, 1);
            // Three digits, and no more than the measurement has.
            let ns = if ns < 100.0 { format!("{ns:.1}") } else { format!("{ns:.0}") };
            let ratio = by_hand.map(|[textbook, ..]| format!("{:.2} ×", textbook.ratio));
            table += &format!(" {ns} | {} |", ratio.unwrap_or_default());
        }
        table.push('\n');
    }
    print!("{table}");
    if std::env::var_os("BLESS").is_some_and(|value| value == "1") {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/manual/speed.md");
        let text = std::fs::read_to_string(path).expect("a chapter");
        let from = text.find("| method | ship, ns |").expect("its table");
        let to = from + text[from..].find("\n\n").expect("the end of the table") + 1;
        std::fs::write(path, text[..from].to_owned() + &table + &text[to..]).expect("written");
    }
}

fn everything() {
    println!(
        "                                              nanoseconds a step                 ours in units of"
    );
    println!(
        "body        method                    substeps      ours  textbook      bare     shown textbook  bare   shown"
    );
    let mut verdicts = Vec::new();
    for course in &COURSES {
        for method in GENERAL_METHODS.iter().filter(|method| wanted(course, method)) {
            for substeps in [1, 16] {
                check(course, method, substeps);
                let Figures { ns, by_hand } = measure(course, method, substeps);
                let body = course.name();
                print!("{body:11} {:25} {substeps:8} {ns:9.2}", method.id);
                let Some(beside) = by_hand else {
                    println!();
                    continue;
                };
                for Beside { ns, .. } in &beside {
                    print!("{ns:10.2}");
                }
                for Beside { ratio, .. } in &beside {
                    print!("{ratio:8.3}");
                }
                println!();
                let [textbook, _, shown] = beside;
                if AIMED.contains(&method.id) {
                    let verdict = |Beside { ratio, .. }: Beside, most: f64| match ratio <= most {
                        true => format!("{ratio:.3} holds {most:.2}"),
                        false => format!("{ratio:.3} MISSES {most:.2}"),
                    };
                    let textbook = verdict(textbook, OF_TEXTBOOK);
                    let shown = verdict(shown, course.of_shown);
                    verdicts.push(format!(
                        "  {body:11} {:20} {substeps:2} substeps: \
                         of the textbook's loop {textbook}, of the bare loop shown {shown}",
                        method.id
                    ));
                }
            }
        }
    }
    println!("aims:\n{}", verdicts.join("\n"));
}
