//! Nets of masses and springs: the conserved quantities, the scene syntax, and verdicts without a reference solution.

use regatta::sim::bodies::{Grid, Lists, NetLayout, NetPlan, Pin, PlannedSpring, net_kind};
use regatta::sim::integrators::method;
use regatta::sim::{Solver, Stepper};

mod files;
mod implicit;
mod motion;
mod verdicts;

/// The parameters of a net of nodes of 20 g, without gravity, damping and drag.
const PLAIN: Values = Values {
    mass: 0.02,
    stiffness: 200.0,
    damping: 0.0,
    drag: 0.0,
    gravity: 0.0,
    rest_ratio: 1.0,
    kick: [3.0, 0.0],
};

#[derive(Clone, Copy)]
struct Values {
    mass: f64,
    stiffness: f64,
    damping: f64,
    drag: f64,
    gravity: f64,
    rest_ratio: f64,
    kick: [f64; 2],
}

fn with(id: &str) -> Solver {
    Solver::Method(method(id).unwrap())
}

fn build(plan: &NetPlan, values: Values, solver: Solver) -> Box<dyn Stepper> {
    let Values { mass, stiffness, damping, drag, gravity, rest_ratio, kick: [x, y] } = values;
    let kind = net_kind(plan.clone()).unwrap();
    (kind.build)(&[mass, stiffness, damping, drag, gravity, rest_ratio, x, y], solver)
}

fn grid(columns: usize, rows: usize, pin: Option<Pin>) -> NetPlan {
    let grid = Grid { columns, rows, spacing: 0.1, shear: true, pin };
    NetPlan { form: NetLayout::Grid(grid), kicked: None }
}

fn lists(nodes: &[[f64; 2]], fixed: &[usize], springs: &[PlannedSpring]) -> NetPlan {
    let (nodes, fixed, springs) = (nodes.to_vec(), fixed.to_vec(), springs.to_vec());
    NetPlan { form: NetLayout::Lists(Lists { nodes, fixed, springs }), kicked: None }
}

fn energy(body: &dyn Stepper) -> f64 {
    let [kinetic, potential] = body.mechanical_energy().unwrap();
    kinetic + potential
}

/// Advances by whole ticks from tick 0, and calls `see` after each.
fn run(body: &mut dyn Stepper, hz: f64, ticks: u32, mut see: impl FnMut(u32, &dyn Stepper)) {
    for tick in 0..ticks {
        body.advance(f64::from(tick) / hz, 1.0 / hz, 1).unwrap();
        assert!(body.q().iter().chain(body.v()).all(|x| x.is_finite()), "tick {tick}");
        see(tick + 1, body);
    }
}
