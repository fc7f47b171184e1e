//! What it takes to go to another tick of a run: one second back, and anywhere in ten minutes.
//!
//! `cargo bench --no-default-features --features lab --bench seek` prints milliseconds for the harbour's race of all methods at
//! 60 Hz, and beside them what the ticks that are done again take alone, which is the floor.

use std::time::{Duration, Instant};

use regatta::run::{Run, Session};
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::integrators::GENERAL_METHODS;

/// Ticks in ten minutes.
const TICKS: u64 = 10 * 60 * 60;
/// In milliseconds: a second back, and anywhere.
const AIMS_MS: (f64, f64) = (5.0, 50.0);
/// How often each is done.
const TIMES: u64 = 40;

fn harbour(lanes: Vec<LaneSpec>) -> Run {
    let mut scene = Scene::built_in("harbour").expect("a built-in scene");
    scene.lanes = lanes;
    let mut timeline = Run::new(Session::racing(scene.into()));
    (0..TICKS).for_each(|_| timeline.tick(&mut ()));
    timeline
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// The middle and the longest of the times, in milliseconds.
fn middle_and_longest(mut times: Vec<f64>) -> (f64, f64) {
    times.sort_by(f64::total_cmp);
    (times[times.len() / 2], times[times.len() - 1])
}

fn measure(name: &str, lanes: Vec<LaneSpec>) {
    let count = lanes.len();
    let start = Instant::now();
    let mut timeline = harbour(lanes);
    let per_tick_us = start.elapsed().as_secs_f64() * 1e6 / TICKS as f64;
    let megabytes = timeline.bytes() as f64 / f64::from(1 << 20);
    println!("{name}, {count} lanes: {per_tick_us:.1} us a tick, {megabytes:.1} MB of snapshots");

    let mut back = Vec::new();
    for n in 0..TIMES {
        timeline.seek(TICKS - 7 * n);
        let start = Instant::now();
        timeline.seek(TICKS - 7 * n - 60);
        back.push(ms(start.elapsed()));
    }
    // Spread over all of it, from one to another far away.
    let mut anywhere = Vec::new();
    for n in 0..TIMES {
        let tick = (n * 13_627) % TICKS;
        let start = Instant::now();
        timeline.seek(tick);
        anywhere.push(ms(start.elapsed()));
    }
    for (what, times, aim) in
        [("one second back", back, AIMS_MS.0), ("anywhere in ten minutes", anywhere, AIMS_MS.1)]
    {
        let (middle, longest) = middle_and_longest(times);
        println!("  {what}: {middle:.2} ms, at most {longest:.2} (aim: below {aim})");
    }
}

fn main() {
    let harbour = Scene::built_in("harbour").expect("a built-in scene");
    measure("harbour", harbour.lanes);
    measure("harbour, all methods", GENERAL_METHODS.iter().map(LaneSpec::plain).collect());
}
