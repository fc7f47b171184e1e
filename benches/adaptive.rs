//! What an accepted step of Dormand-Prince's costs, ours against the crate `ode_solvers`.
//!
//! `cargo bench --no-default-features --features lab --bench adaptive` lets both carry the spring of 1 Hz over some
//! seconds in one call, and prints nanoseconds an accepted step, the steps and evaluations of both, and
//! the largest error at the end of a second.
//!
//! The two take turns in one process, so that the ratio, a median over the rounds, holds on a busy
//! machine; the nanoseconds are those of the quietest round.

use std::hint::black_box;
use std::time::Instant;

use ode_solvers::{Dopri5, OutputType, SVector};
use regatta::sim::bodies::{Body, Spring};
use regatta::sim::integrators::{DormandPrince54, Integrator, Tolerance};
use regatta::sim::{Counted, State};

/// The undamped spring of the built-in scene.
const SPRING: Spring =
    Spring { mass: 1.0, stiffness: 39.47841760435743, damping: 0.0, x0: 1.0, v0: 0.0, kick: 3.0 };
/// Seconds in one call: enough that setting up is nothing, and few enough for one tick of ours.
const SECONDS: f64 = 8.0;
/// Calls between two looks at the clock.
const CALLS: u32 = 4;
/// Rounds, in each of which both are timed once.
const ROUNDS: usize = 301;

/// At this tolerance an accepted step of ours takes at most this part of the peer's time, and the error
/// is at most so many times the peer's.
const AIM: (f64, f64, f64) = (1e-9, 0.6, 1.5);

struct Peer;

impl ode_solvers::System<f64, SVector<f64, 2>> for Peer {
    fn system(&self, _t: f64, y: &SVector<f64, 2>, dy: &mut SVector<f64, 2>) {
        let (k, c) = (SPRING.stiffness / SPRING.mass, SPRING.damping / SPRING.mass);
        dy[0] = y[1];
        dy[1] = -k * y[0] - c * y[1];
    }
}

/// A run from the start to the end.
struct Run {
    end: State<f64>,
    accepted: u64,
    rejected: u64,
    evaluations: u64,
}

fn ours(tolerance: f64) -> Run {
    let spring = Counted::new(SPRING);
    let mut method = DormandPrince54::with_tolerance(&0.0, Tolerance::uniform(tolerance));
    let mut end = SPRING.start();
    method.step(&spring, 0.0, SECONDS, &mut end).expect("a gentle motion");
    let (accepted, rejected) = method.attempts();
    Run { end, accepted, rejected, evaluations: spring.evaluations() }
}

fn peers(tolerance: f64) -> Run {
    let start = SVector::<f64, 2>::new(SPRING.x0, SPRING.v0);
    let mut method = Dopri5::new(Peer, 0.0, SECONDS, SECONDS, start, tolerance, tolerance);
    // Of the three it is the quickest: one push a step, into what it allocates.
    method.set_output(OutputType::Sparse);
    let stats = method.integrate().expect("a gentle motion");
    let end = method.y_out().last().expect("the end");
    Run {
        end: State { q: end[0], v: end[1] },
        accepted: stats.accepted_steps.into(),
        rejected: stats.rejected_steps.into(),
        evaluations: stats.num_eval.into(),
    }
}

/// The distance from the exact end, velocities in units of the angular frequency.
fn error(run: &Run) -> f64 {
    let truth = SPRING.exact(SECONDS, &SPRING.start()).expect("a closed form");
    let omega = SPRING.angular_frequency();
    (run.end.q - truth.q).hypot((run.end.v - truth.v) / omega)
}

/// Nanoseconds an accepted step.
fn time(run: fn(f64) -> Run, tolerance: f64) -> f64 {
    let (start, mut accepted) = (Instant::now(), 0);
    for _ in 0..CALLS {
        accepted += black_box(run(black_box(tolerance))).accepted;
    }
    start.elapsed().as_secs_f64() * 1e9 / accepted as f64
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() {
    println!("tolerance          ns a step   accepted   rejected   evaluations     error");
    let mut verdict = String::new();
    for tolerance in [1e-3, 1e-6, AIM.0, 1e-12] {
        let rounds: Vec<[f64; 2]> = (0..ROUNDS)
            .map(|round| match round % 2 {
                0 => [time(ours, tolerance), time(peers, tolerance)],
                _ => {
                    let peers = time(peers, tolerance);
                    [time(ours, tolerance), peers]
                }
            })
            .collect();
        let runs = [("ours", ours(tolerance)), ("ode_solvers", peers(tolerance))];
        for (i, (name, run)) in runs.iter().enumerate() {
            let least = rounds.iter().map(|round| round[i]).fold(f64::INFINITY, f64::min);
            println!(
                "{tolerance:<9e} {name:12} {least:6.1} {:10} {:10} {:13} {:9.2e}",
                run.accepted,
                run.rejected,
                run.evaluations,
                error(run),
            );
        }
        let times = median(rounds.iter().map(|[ours, peers]| ours / peers).collect());
        let errors = error(&runs[0].1) / error(&runs[1].1);
        println!("{:9} ours / ode_solvers: time {times:.3}, error {errors:.3}", "");
        if tolerance == AIM.0 {
            let held = |found: f64, most: f64| if found <= most { "held" } else { "MISSED" };
            verdict = format!(
                "aims at tolerance {:e}: time at most {}: {times:.3} {}, error at most {}: {errors:.3} {}",
                AIM.0,
                AIM.1,
                held(times, AIM.1),
                AIM.2,
                held(errors, AIM.2),
            );
        }
    }
    println!("{verdict}");
}
