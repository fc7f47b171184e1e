//! The runs that are compared: their forces and targets, and the steps of the methods of the table.

use regatta::conformance::problems::{fresh, problem};
use regatta::sim::integrators::{METHODS, Method};
use regatta::sim::{Pursuit, Query, State, System};
use regatta::tools::source_code::MethodSource;

/// The acceleration of a run.
pub(crate) struct Force {
    pub(crate) a: fn(f64, f64) -> f64,
    /// The same in a syntax that every language shares.
    #[allow(dead_code, reason = "tests/tools writes it in each of them; tests/library has none")]
    pub(crate) text: &'static str,
}

macro_rules! force {
    (|$x:ident, $v:ident| $a:expr) => {
        Force { a: |$x, $v| $a, text: stringify!($a) }
    };
}

pub(crate) const FORCES: [Force; 3] = [
    // A spring with drag, one without, and a pendulum.
    force!(|x, v| -40.0 * x - 1.5 * v),
    force!(|x, v| -90.0 * x + 0.0 * v),
    force!(|x, v| -30.0 * (x - x * x * x / 6.0 + x * x * x * x * x / 120.0) - 0.1 * v),
];
/// Steps of a run.
pub(crate) const STEPS: u32 = 200;
/// The lengths of the steps of each quarter of a run that is compared: a change restarts a memory.
const LENGTHS: [f64; 4] = [1.0 / 64.0, 1.0 / 64.0, 1.0 / 100.0, 1.0 / 100.0];
/// Those of a run with frames in which no time passes.
const PAUSED: [f64; 4] = [0.0, 1.0 / 64.0, 0.0, 1.0 / 64.0];
const START: [f64; 2] = [1.0, 0.5];

/// A run of every method.
pub(crate) struct Case {
    /// The index of its force.
    pub(crate) force: usize,
    /// Position and velocity.
    pub(crate) start: [f64; 2],
    /// The length of the steps of each quarter.
    pub(crate) lengths: [f64; 4],
}

impl Case {
    pub(crate) fn length(&self, n: u32) -> f64 {
        self.lengths[(4 * n / STEPS) as usize]
    }

    /// Whether it has steps of no length, which the methods of the table need not make.
    pub(crate) fn is_paused(&self) -> bool {
        self.lengths.contains(&0.0)
    }
}

pub(crate) const CASES: [Case; 6] = [
    Case { force: 0, start: START, lengths: LENGTHS },
    Case { force: 1, start: START, lengths: LENGTHS },
    Case { force: 2, start: START, lengths: LENGTHS },
    Case { force: 0, start: [0.0, 0.0], lengths: PAUSED },
    Case { force: 2, start: START, lengths: PAUSED },
    Case { force: 1, start: [1.0, 0.0], lengths: PAUSED },
];
pub(crate) const RATE: f64 = 6.0;
pub(crate) const SETTINGS: [f64; 3] = [40.0, 1.5, 0.3];
pub(crate) const FORCE: f64 = 2.5;
pub(crate) const SUBSTEPS: u32 = 3;
/// Where a target is at time t.
#[allow(dead_code, reason = "as the text of a force")]
pub(crate) const TARGET: &str = "2.0 - 0.5 * t";

fn target(t: f64) -> f64 {
    2.0 - 0.5 * t
}

/// A body under a force of the table, or the target of a follower of this order.
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

    fn query(&self, t: f64, query: Query<'_, f64>) -> bool {
        match query {
            Query::Engine { settings, force, .. } => {
                *force = FORCE;
                settings.drag = SETTINGS[2];
                if self.has_joint {
                    [settings.stiffness, settings.damping] = [SETTINGS[0], SETTINGS[1]];
                }
            }
            Query::Target(pursuit) => {
                let (rate, order) = (RATE, self.order);
                *pursuit = Some(Pursuit { target: target(t), rate, order, is_still: false });
            }
            _ => return false,
        }
        true
    }
}

/// The states that `stepped` passes through, with the body and the substeps of the method `like`.
pub(crate) fn steps_as(stepped: &Method, like: &Method, case: &Case) -> Vec<[f64; 2]> {
    let method = like;
    let force = FORCES[case.force].a;
    let order = method.law_order().unwrap_or(1);
    let run = problem(Run { force, order, has_joint: method.has_joint() || !method.is_engine() });
    let [q, v] = case.start;
    let mut state = State { q, v };
    let mut stepper = fresh(stepped);
    (0..STEPS)
        .map(|n| {
            let h = case.length(n);
            // The lines of an engine whose iterations change nothing take no substeps.
            let takes =
                |source: MethodSource| source.inputs().iter().any(|input| input.name == "substeps");
            let is_whole = stepped.is_from_outside() && !MethodSource::of(like).is_some_and(takes);
            let substeps = if is_whole {
                1
            } else if method.engine.is_some_and(|engine| engine.has_substeps()) {
                SUBSTEPS
            } else {
                1
            };
            stepper.steps(&run, f64::from(n) * h, h, substeps, &mut state).unwrap();
            [state.q, state.v]
        })
        .collect()
}

/// The methods of the table, each with its source. Those of a free rotation step
/// another state.
pub(crate) fn sources() -> impl Iterator<Item = (&'static Method, MethodSource)> {
    METHODS
        .iter()
        .filter(|method| !method.is_for_spin())
        .map(|method| (method, MethodSource::of(method).expect("a source")))
}
