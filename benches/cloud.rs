//! What a step of a copy in a batch costs, against loops written by hand in the same run.
//!
//! `cargo bench --no-default-features --features lab --bench cloud` prints steps of a body per second, and the ratio to the
//! hand-written loop. The two take turns, and the quietest round of each counts.

use std::hint::black_box;
use std::time::Instant;

use multiversion::multiversion;
use rayon::ThreadPoolBuilder;
use regatta::look::density_picture;
use regatta::look::palette::Theme;
use regatta::measure::cloud::{Density, PlaneView};
use regatta::scene::{Scene, SceneBody};
use regatta::sim::batch::{Batch, InstructionSet, Ticks};
use regatta::sim::bodies::BatchFn;
use regatta::sim::integrators::method;
use regatta::sim::{Solver, State, Stepper};

const POINTS: usize = 1_000_000;
const ROUNDS: usize = 9;

/// The least seconds of the rounds of each, which take turns.
fn turns<const N: usize>(mut works: [&mut dyn FnMut(); N]) -> [f64; N] {
    let mut least = [f64::INFINITY; N];
    for _ in 0..ROUNDS {
        for (work, least) in works.iter_mut().zip(&mut least) {
            let begun = Instant::now();
            work();
            *least = least.min(begun.elapsed().as_secs_f64());
        }
    }
    least
}

fn print(what: &str, steps: f64, [ours, other]: [f64; 2], than: &str, aim: f64) {
    let ratio = other / ours;
    let word = if ratio >= aim { "met" } else { "missed" };
    let rate = steps / ours / 1e6;
    println!("{what:44} {rate:8.1} M/s  {ratio:6.2} × {than}  aim {aim}: {word}");
}

/// A body with what makes copies of it.
fn body(text: &str) -> (BatchFn, Box<dyn Stepper>) {
    let scene = format!("title = 'A'\ntick_hz = 60\nseconds = 10\n{text}");
    let scene = Scene::parse("a.toml", &scene).expect("a scene");
    let solver = Solver::Method(method("rk4").expect("a method"));
    let SceneBody { kind, values, .. } = &scene.bodies[0];
    (kind.batch, (kind.build)(values, solver))
}

fn starts(count: usize) -> Vec<State<f64>> {
    (0..count).map(|n| State { q: n as f64 / count as f64, v: 0.1 }).collect()
}

fn batch(
    (make, body): &(BatchFn, Box<dyn Stepper>),
    id: &str,
    set: InstructionSet,
    count: usize,
) -> Batch {
    let solver = Solver::Method(method(id).expect("a method"));
    make(body.body(), set, solver, starts(count)).expect("one coordinate").expect("some memory")
}

/// Runs a batch on so many threads.
fn run(batch: &mut Batch, threads: usize, ticks: u64) -> impl FnMut() {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let mut at = Ticks::from_start(60, 1, 0);
    move || {
        at = at.next(ticks);
        pool.install(|| batch.run(at));
    }
}

/// RK4 on springs as one would write it for this alone.
#[multiversion(targets("x86_64+avx+avx2"))]
fn springs_by_hand(k: f64, c: f64, h: f64, ticks: u64, q: &mut [f64], v: &mut [f64]) {
    for (q, v) in q.as_chunks_mut::<64>().0.iter_mut().zip(v.as_chunks_mut::<64>().0) {
        for _ in 0..ticks {
            for (q, v) in q.iter_mut().zip(v.iter_mut()) {
                let a = |q: f64, v: f64| -k * q - c * v;
                let (x, y) = (*q, *v);
                let k1 = a(x, y);
                let y2 = y + h / 2.0 * k1;
                let k2 = a(x + h / 2.0 * y, y2);
                let y3 = y + h / 2.0 * k2;
                let k3 = a(x + h / 2.0 * y2, y3);
                let y4 = y + h * k3;
                let k4 = a(x + h * y3, y4);
                *q = x + h / 6.0 * y + h / 3.0 * y2 + h / 3.0 * y3 + h / 6.0 * y4;
                *v = y + h / 6.0 * k1 + h / 3.0 * k2 + h / 3.0 * k3 + h / 6.0 * k4;
            }
        }
    }
}

/// RK4 on pendulums, one after the other.
fn pendulums_by_hand(pull: f64, h: f64, q: &mut [f64], v: &mut [f64]) {
    for (q, v) in q.iter_mut().zip(v) {
        let a = |q: f64| -pull * libm::sin(q);
        let (x, y) = (*q, *v);
        let k1 = a(x);
        let y2 = y + h / 2.0 * k1;
        let k2 = a(x + h / 2.0 * y);
        let y3 = y + h / 2.0 * k2;
        let k3 = a(x + h / 2.0 * y2);
        let y4 = y + h * k3;
        let k4 = a(x + h * y3);
        *q = x + h / 6.0 * y + h / 3.0 * y2 + h / 3.0 * y3 + h / 6.0 * y4;
        *v = y + h / 6.0 * k1 + h / 3.0 * k2 + h / 3.0 * k3 + h / 6.0 * k4;
    }
}

fn states(count: usize) -> [Vec<f64>; 2] {
    let (q, v) = starts(count).into_iter().map(|state| (state.q, state.v)).unzip();
    [q, v]
}

fn main() {
    let h = black_box(1.0 / 60.0);
    let spring = body("[[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\ndamping_n_s_per_m = 0.1\n");
    let all = POINTS as f64;
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
        let mut ours = batch(&spring, "rk4", set, POINTS);
        let [mut q, mut v] = states(POINTS);
        let mut hand = || springs_by_hand(black_box(40.0), 0.1, h, 10, &mut q, &mut v);
        let times = turns([&mut run(&mut ours, 1, 10), &mut hand]);
        print(&format!("springs, RK4, {set:?}"), 10.0 * all, times, "by hand, AVX2", 0.8);
    }
    let widest = InstructionSet::widest();
    let mut one = batch(&spring, "rk4", widest, POINTS);
    let mut two = batch(&spring, "rk4", widest, POINTS);
    let times = turns([&mut run(&mut two, 2, 10), &mut run(&mut one, 1, 10)]);
    print("springs, RK4, two cores", 10.0 * all, times, "one core", 1.8);

    let mut ours = batch(&spring, "semi-implicit-euler", widest, POINTS);
    let ([from, also], [mut q, mut v]) = (states(POINTS), states(POINTS));
    let mut copy = || {
        q.copy_from_slice(black_box(&from));
        v.copy_from_slice(black_box(&also));
    };
    let times = turns([&mut run(&mut ours, 1, 1), &mut copy]);
    print("springs, semi-implicit Euler", all, times, "a copy of the state", 0.7);

    let count = 100_000;
    let pendulum = body("[[pendulum]]\nlength_m = 1\ngravity_m_per_s2 = 10\n");
    let mut ours = batch(&pendulum, "rk4", widest, count);
    let [mut q, mut v] = states(count);
    let mut hand = || pendulums_by_hand(black_box(10.0), h, &mut q, &mut v);
    let times = turns([&mut run(&mut ours, 1, 1), &mut hand]);
    print("pendulums, RK4", count as f64, times, "by hand", 1.0);

    let duffing = Scene::built_in("duffing").expect("a scene");
    let rk4 = Solver::Method(method("rk4").expect("a method"));
    let SceneBody { kind, values, .. } = &duffing.bodies[0];
    let mut alone = (kind.batch, (kind.build)(values, rk4));
    let mut ours = batch(&alone, "rk4", widest, count);
    let mut tape = || {
        for tick in 0..count {
            alone.1.advance(tick as f64 * h, h, 1).expect("a gentle motion");
        }
    };
    let times = turns([&mut run(&mut ours, 1, 1), &mut tape]);
    print("Duffing's law, RK4", count as f64, times, "the tape of one", 4.0);

    let view = PlaneView { q: [0.0, 1.0], v: [0.0, 1.0], wraps: false };
    let places: Vec<f64> = (0..POINTS).map(|n| (n as f64 * 0.754_877_666).fract()).collect();
    let others: Vec<f64> = (0..POINTS).map(|n| (n as f64 * 0.569_840_29).fract()).collect();
    let mut picture = || {
        let mut density = Density::new([512; 2], view);
        density.add(&places, &others);
        black_box(density_picture(&density, [512; 2], Theme::Dark, [90, 180, 240, 255]));
    };
    let [seconds] = turns([&mut picture]);
    let word = if seconds <= 4e-3 { "met" } else { "missed" };
    println!("a picture of 512² of a million points {:.2} ms  aim 4: {word}", 1e3 * seconds);
}
