//! The runs that are compared: their forces and targets, and the steps of the methods of the table.

use regatta::lab::{METHOD_SOURCES, MethodSource};
use regatta::sim::integrators::{Method, integrator, method};
use regatta::sim::{EngineSettings, Pursuit, State, System};

/// The acceleration of a run.
pub(crate) struct Force {
    pub(crate) name: &'static str,
    pub(crate) a: fn(f64, f64) -> f64,
    /// The same in a syntax that every language shares.
    pub(crate) text: &'static str,
}

macro_rules! force {
    ($name:literal, |$x:ident, $v:ident| $a:expr) => {
        Force { name: $name, a: |$x, $v| $a, text: stringify!($a) }
    };
}

pub(crate) const FORCES: [Force; 3] = [
    force!("a spring with drag", |x, v| -40.0 * x - 1.5 * v),
    force!("an undamped spring", |x, v| -90.0 * x + 0.0 * v),
    force!("a pendulum", |x, v| -30.0 * (x - x * x * x / 6.0 + x * x * x * x * x / 120.0)
        - 0.1 * v),
];
/// Steps of a run. Half of them have one length, half another, so that a memory is restarted.
pub(crate) const STEPS: u32 = 200;
pub(crate) const LENGTHS: [f64; 2] = [1.0 / 64.0, 1.0 / 100.0];
pub(crate) const START: [f64; 2] = [1.0, 0.5];
pub(crate) const RATE: f64 = 6.0;
pub(crate) const SETTINGS: [f64; 3] = [40.0, 1.5, 0.3];
pub(crate) const FORCE: f64 = 2.5;
pub(crate) const SUBSTEPS: u32 = 3;
/// Where a target is at time t.
pub(crate) const TARGET: &str = "2.0 - 0.5 * t";

fn target(t: f64) -> f64 {
    2.0 - 0.5 * t
}

/// A body under a force of the table, or what a follower of this order follows.
struct Run {
    force: fn(f64, f64) -> f64,
    order: u32,
    has_joint: bool,
}

impl System for Run {
    type Vector = f64;

    fn acceleration(&self, _t: f64, q: &f64, v: &f64, a: &mut f64) {
        *a = (self.force)(*q, *v);
    }

    fn engine_settings(&self, _t: f64, _y: &State<f64>, force: &mut f64) -> Option<EngineSettings> {
        *force = FORCE;
        let [stiffness, damping, drag] =
            if self.has_joint { SETTINGS } else { [0.0, 0.0, SETTINGS[2]] };
        Some(EngineSettings { stiffness, damping, drag })
    }

    fn pursuit(&self, t: f64) -> Option<Pursuit<f64>> {
        Some(Pursuit { target: target(t), rate: RATE, order: self.order, is_still: false })
    }
}

/// The states that the method of the table passes through.
pub(crate) fn steps(method: &Method, force: fn(f64, f64) -> f64) -> Vec<[f64; 2]> {
    let order = method.only.and_then(|only| only.with).map_or(1, |(_, order)| order as u32);
    let run = Run { force, order, has_joint: method.id != "engine-pybullet" };
    let mut state = State { q: START[0], v: START[1] };
    let mut stepper = integrator(method, &state.q);
    (0..STEPS)
        .map(|n| {
            let h = LENGTHS[(2 * n / STEPS) as usize];
            let substeps =
                if method.engine.is_some_and(|engine| engine.has_substeps) { SUBSTEPS } else { 1 };
            stepper.steps(&run, f64::from(n) * h, h, substeps, &mut state).unwrap();
            [state.q, state.v]
        })
        .collect()
}

/// The methods of the table, each with its source.
pub(crate) fn sources() -> impl Iterator<Item = (&'static Method, &'static MethodSource)> {
    METHOD_SOURCES.iter().map(|source| (method(source.method).expect("a method"), source))
}
