//! Nets of masses and springs.

use regatta::sim::bodies::{Form, Grid, Lists, NetPlan, Pin, PlannedSpring, net_kind};
use regatta::sim::integrators::method;
use regatta::sim::{Solver, Stepper};

fn build(plan: NetPlan, values: &[f64], solver: Solver) -> Box<dyn Stepper> {
    let kind = net_kind(plan).unwrap();
    (kind.build)(values, solver)
}
fn grid(columns: usize, rows: usize, pin: Option<Pin>) -> NetPlan {
    NetPlan {
        form: Form::Grid(Grid { columns, rows, spacing: 0.1, shear: true, pin }),
        kicked: None,
    }
}

#[test]
fn probe() {
    let ids = std::env::var("IDS").unwrap_or("implicit-euler".into());
    let hz: f64 = std::env::var("HZ").map_or(10.0, |x| x.parse().unwrap());
    let k: f64 = std::env::var("K").map_or(2000.0, |x| x.parse().unwrap());
    let c: f64 = std::env::var("C").map_or(0.0, |x| x.parse().unwrap());
    for id in ids.split(',') {
        let mut body = build(
            grid(24, 16, Some(Pin::Corners)),
            &[0.02, k, c, 0.0, 9.81, 1.0, 3.0, 0.0],
            Solver::Method(method(id).unwrap()),
        );
        let e0 = body.mechanical_energy().unwrap();
        let started = std::time::Instant::now();
        let mut last = 0;
        for tick in 0..(5.0 * hz) as u64 {
            let r = body.advance(tick as f64 / hz, 1.0 / hz, 1);
            let n = body.evaluations() - last;
            last = body.evaluations();
            if let Err(e) = r {
                println!("{id}: tick {tick}: {e}, {n}");
                break;
            }
            if tick % (hz as u64 / 2).max(1) == 0 {
                println!(
                    "{id} tick {tick}: evals {n}, energy {:.4}",
                    body.mechanical_energy().unwrap() - e0
                );
            }
            if !body.q()[0].is_finite() {
                break;
            }
        }
        println!(
            "{id}: {:?} for {} evaluations, {:.1} us each",
            started.elapsed(),
            body.evaluations(),
            started.elapsed().as_secs_f64() * 1e6 / body.evaluations() as f64
        );
    }
}
