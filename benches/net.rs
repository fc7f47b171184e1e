//! How many nodes of a net are stepped in a second: `cargo bench --no-default-features --features lab --bench net`.

use std::time::{Duration, Instant};

use regatta::sim::Solver;
use regatta::sim::bodies::{Grid, NetLayout, NetPlan, Pin, net_kind};
use regatta::sim::integrators::method;

/// How long each row is measured, five times; the fastest counts.
const MEASURED: Duration = Duration::from_millis(300);

fn main() {
    println!("method                nodes   springs  million node-steps/s  evaluations/step");
    for (columns, rows) in [(24, 16), (100, 100), (400, 250)] {
        let form = Grid { columns, rows, spacing: 0.1, shear: true, pin: Some(Pin::Corners) };
        let plan = NetPlan { form: NetLayout::Grid(form), kicked: None };
        let lists = form.lists();
        let (nodes, springs) = (lists.nodes.len(), lists.springs.len());
        let kind = net_kind(plan).expect("a net");
        // h ω of the fastest motion is 1.2, and for implicit methods 4.7.
        for (id, hz) in [
            ("semi-implicit-euler", 240.0),
            ("velocity-verlet", 240.0),
            ("rk4", 240.0),
            ("implicit-euler", 60.0),
            ("implicit-midpoint", 60.0),
        ] {
            let solver = Solver::Method(method(id).expect("a method of the table"));
            let fastest = (0..5).map(|_| {
                let mut net = (kind.build)(&[0.02, 200.0, 0.0, 0.0, 9.81, 1.0, 1.0, 0.0], solver);
                let (mut tick, started) = (0_u32, Instant::now());
                while started.elapsed() < MEASURED {
                    let t = f64::from(tick) / hz;
                    net.advance(t, 1.0 / hz, 1).expect("it is stable at this rate");
                    tick += 1;
                }
                let steps_per_s = f64::from(tick) / started.elapsed().as_secs_f64();
                (steps_per_s, net.evaluations() as f64 / f64::from(tick))
            });
            let (steps_per_s, evaluations) =
                fastest.reduce(|a, b| if b.0 > a.0 { b } else { a }).expect("five of them");
            let million = nodes as f64 * steps_per_s / 1e6;
            println!("{id:20} {nodes:6}  {springs:8}  {million:20.3}  {evaluations:16.1}");
        }
    }
}
