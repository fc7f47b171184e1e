//! What it takes to measure game loops over 20 s of a 144 Hz display: the ideal ones, and those of engines.
//!
//! `cargo bench --no-default-features --features lab --bench loops` prints milliseconds for each, and the cost of a loop of an
//! engine in costs of an ideal one.

use std::sync::Arc;
use std::time::Instant;

use regatta::loops::{ENGINES, LoopRun, POLICIES, PolicyCard, RefreshRate, trace_card};
use regatta::scene::{LaneSpec, Scene};
use regatta::sim::integrators::method;

/// Length of a run in nanoseconds.
const UNTIL_NS: i64 = 20_000_000_000;
/// How often each loop runs; the quickest run counts.
const TIMES: u32 = 5;

fn quickest_ms(scene: &Scene, card: &Arc<PolicyCard>) -> f64 {
    let trace = trace_card("steady-144").expect("a built-in trace").trace(RefreshRate::new(144, 1));
    let spec = LaneSpec::plain(method("rk4").expect("a built-in method"));
    let once = || {
        let start = Instant::now();
        let report =
            LoopRun::new(scene, spec, card, &trace).measure(UNTIL_NS, &|| false, |_, _| {});
        assert!(report.frames > 0, "{}", card.id);
        start.elapsed().as_secs_f64() * 1e3
    };
    (0..TIMES).map(|_| once()).fold(f64::INFINITY, f64::min)
}

fn main() {
    let scene = Scene::built_in("spring").expect("a built-in scene");
    let mut means = Vec::new();
    for (name, cards) in [("ideal", &**POLICIES), ("of engines", &**ENGINES)] {
        let mut times: Vec<(f64, &str)> =
            cards.iter().map(|card| (quickest_ms(&scene, card), &*card.id)).collect();
        times.sort_by(|a, b| b.0.total_cmp(&a.0));
        let sum: f64 = times.iter().map(|(ms, _)| ms).sum();
        let dear: Vec<_> = times.iter().take(3).map(|(ms, id)| format!("{id} {ms:.2}")).collect();
        println!("{} loops {name}: {sum:.1} ms; the dearest: {}", times.len(), dear.join(", "));
        means.push(sum / times.len() as f64);
    }
    println!("a loop of an engine takes {:.2} x an ideal one", means[1] / means[0]);
}
