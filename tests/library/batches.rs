//! A copy in a batch has the bits of its body alone, for any instruction set and any number of threads.

use rayon::ThreadPoolBuilder;
use regatta::scene::Scene;
use regatta::sim::batch::{Batch, InstructionSet, Ticks};
use regatta::sim::integrators::{GENERAL_METHODS, Method, method};
use regatta::sim::{Solver, State, Stepper, System};

/// One body of each kind that can be a cloud, as scenes write it.
const BODIES: [&str; 6] = [
    "[[spring]]\nmass_kg = 1.5\nstiffness_n_per_m = 60\ndamping_n_s_per_m = 0.4\n",
    "[[ship]]\nthrust_n = 20000\ndrag_n_s_per_m = 1000\nmass_kg = 10000\n",
    "[[pendulum]]\nlength_m = 1.2\ndamping_n_m_s = 0.05\n",
    "[[follow]]\nrate_per_s = 8\norder = 2\nstep_m = 1\nsine_m = 0.3\nsine_hz = 2\n",
    "[[law]]\nconstants = { d = 0.25, g = 0.4, w = 5 }\n[law.coordinates.x]\nstart = 1\n\
     acceleration = 'x - x^3 - d*vx + g*cos(w*t)'\n",
    "[[law]]\nconstants = { k = 40 }\n[law.coordinates.x]\nstart = 1\n\
     acceleration = 'if(x > 0.2, -k*x, -k*sin(x)^2 + min(x, vx)) - table(x, [[0, 1], [1, 3]]) + x^2.5'\n",
];

const TICK_HZ: u32 = 30;
const TICKS: u64 = 3;
const SUBSTEPS: u32 = 2;

fn scene(text: &str) -> Scene {
    let text = format!("title = 'A body'\ntick_hz = {TICK_HZ}\nseconds = 1\n{text}");
    Scene::parse("body.toml", &text).unwrap()
}

fn body(text: &str, solver: Solver) -> Box<dyn Stepper> {
    let body = &scene(text).bodies[0];
    (body.kind.build)(&body.values, solver)
}

/// States apart from each other.
fn starts(count: u32) -> Vec<State<f64>> {
    let start = |n| State { q: 0.01 * f64::from(n) - 0.5, v: 0.3 - 0.02 * f64::from(n) };
    (0..count).map(start).collect()
}

fn bits([q, v]: [f64; 2]) -> [Option<u64>; 2] {
    // A state that blew up has no bits to compare.
    [q, v].map(|number| number.is_finite().then(|| number.to_bits()))
}

/// The states of every copy alone, tick by tick.
fn alone(text: &str, method: &'static Method, starts: &[State<f64>]) -> Vec<Vec<[f64; 2]>> {
    let one = body(text, Solver::Method(method));
    let run = |start: &State<f64>| {
        let mut stepper = one.clone();
        stepper.set(0.0, &[start.q], &[start.v]);
        let h = 1.0 / f64::from(TICK_HZ);
        let mut gave_up = false;
        let tick = |tick: u64| {
            let t = tick as f64 / f64::from(TICK_HZ);
            gave_up |= stepper.advance(t, h, SUBSTEPS).is_err();
            if gave_up { [f64::NAN; 2] } else { [stepper.q()[0], stepper.v()[0]] }
        };
        (0..TICKS).map(tick).collect()
    };
    starts.iter().map(run).collect()
}

fn batch(text: &str, method: &'static Method, set: InstructionSet, s: &[State<f64>]) -> Batch {
    let solver = Solver::Method(method);
    let kind = &scene(text).bodies[0].kind;
    (kind.batch)(body(text, solver).body(), set, solver, s.to_vec()).unwrap().unwrap()
}

fn available() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::ALL.into_iter().filter(|set| set.is_available())
}

#[test]
fn a_batch_matches_lone_bodies_to_the_bit_on_every_instruction_set() {
    // Two blocks of the widest, and a part.
    let starts = starts(67);
    for text in BODIES {
        for method in GENERAL_METHODS {
            let alone = alone(text, method, &starts);
            for set in available() {
                let mut batch = batch(text, method, set, &starts);
                for tick in 0..TICKS {
                    batch.run(Ticks { first: tick, ..Ticks::from_start(TICK_HZ, SUBSTEPS, 1) });
                    for (copy, alone) in alone.iter().enumerate() {
                        let found = [batch.q()[copy], batch.v()[copy]];
                        let at = format!("{} {set:?} copy {copy} tick {tick}", method.id);
                        assert_eq!(bits(found), bits(alone[tick as usize]), "{at}\n{text}");
                    }
                }
            }
        }
    }
}

#[test]
fn neither_thread_count_nor_ticks_per_run_change_a_batch() {
    let starts = starts(9000);
    for text in [BODIES[0], BODIES[4]] {
        for id in ["rk4", "velocity-verlet", "dormand-prince-54"] {
            let starts = if id == "dormand-prince-54" { &starts[..150] } else { &starts[..] };
            let run = |threads, parts: &[u64]| {
                let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let mut batch = batch(text, method(id).unwrap(), InstructionSet::widest(), starts);
                let mut ticks = Ticks::from_start(TICK_HZ, SUBSTEPS, 0);
                for &part in parts {
                    ticks = ticks.next(part);
                    pool.install(|| batch.run(ticks));
                }
                let pairs = batch.q().iter().zip(batch.v());
                pairs.map(|(q, v)| [q.to_bits(), v.to_bits()]).collect::<Vec<_>>()
            };
            let one = run(1, &[5]);
            assert!(one == run(2, &[1; 5]) && one == run(7, &[2, 3]), "{id}");
        }
    }
}

#[derive(Clone)]
struct Oscillator(f64);

impl System for Oscillator {
    type Vector = f64;
    fn acceleration(&self, _t: f64, x: &f64, v: &f64, a: &mut f64) {
        *a = -self.0 * x - 0.1 * v;
    }
}

#[test]
fn copies_exceeding_the_memory_are_refused_before_allocation() {
    struct Endless;
    impl Iterator for Endless {
        type Item = State<f64>;
        fn next(&mut self) -> Option<State<f64>> {
            panic!("nothing is asked of the starts")
        }
        fn size_hint(&self) -> (usize, Option<usize>) {
            (1 << 58, Some(1 << 58))
        }
    }
    impl ExactSizeIterator for Endless {}
    assert!(Batch::new(&Oscillator(1.0), method("rk4").unwrap(), Endless).is_err());
}
