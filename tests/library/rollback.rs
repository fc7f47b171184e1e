//! A game that goes back to an earlier tick keeps a state and a clone of its integrator, and repeats every bit.

use std::fmt::Debug;

use regatta::sim::bodies::{Follow, Spring};
use regatta::sim::integrators::{Integrator, METHODS, Method, StepFailure, integrator, method};
use regatta::sim::{Body, State, System, Vector};

const TICKS: u32 = 10;

type Bits = (Vec<u64>, Vec<u64>);

fn bits<V: Vector>(state: &State<V>) -> Bits {
    let of = |half: &V| half.components().iter().map(|x| x.to_bits()).collect();
    (of(&state.q), of(&state.v))
}

/// Steps through the ticks from `first` on.
fn run<S: System<Vector: Vector>>(
    system: &S,
    integrator: &mut dyn Integrator<S>,
    first: u32,
    state: &mut State<S::Vector>,
) -> Result<Bits, StepFailure> {
    for tick in first..first + TICKS {
        integrator.steps(system, f64::from(tick) / 30.0, 1.0 / 30.0, 2, state)?;
    }
    Ok(bits(state))
}

/// The states after ten ticks more: of the first pass, of a clone of the integrator that was saved with the state, and of a
/// fresh one. `None` if the method is not for the system.
fn passes<S>(system: &S, start: &State<S::Vector>, method: &Method) -> Option<[Bits; 3]>
where
    S: System<Vector: Vector> + 'static,
{
    let mut state = start.clone();
    let mut used = integrator::<S>(method, &state.q);
    match run(system, &mut *used, 0, &mut state) {
        Err(StepFailure::Refused { .. }) => return None,
        stepped => stepped.expect(method.id),
    };
    let (mut again, mut saved, mut anew) = (state.clone(), used.clone(), state.clone());
    let first = run(system, &mut *used, TICKS, &mut state).expect(method.id);
    let second = run(system, &mut *saved, TICKS, &mut again).expect(method.id);
    let mut fresh = integrator::<S>(method, &anew.q);
    let third = run(system, &mut *fresh, TICKS, &mut anew).expect(method.id);
    Some([first, second, third])
}

/// Two masses in the plane on springs whose force is not linear.
#[derive(Clone)]
struct Pair;

impl System for Pair {
    type Vector = [f64; 4];
    fn acceleration(&self, _t: f64, q: &[f64; 4], v: &[f64; 4], a: &mut [f64; 4]) {
        for i in 0..4 {
            let stretch = q[i] - q[(i + 2) % 4];
            a[i] = -30.0 * q[i] - 9.0 * stretch * stretch * stretch - 0.4 * v[i];
        }
    }
}

/// The same of a `Vec`.
#[derive(Clone)]
struct Many;

impl System for Many {
    type Vector = Vec<f64>;
    fn acceleration(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        let [q, v] = [q, v].map(|half| half[..].try_into().expect("four"));
        let mut four = [0.0; 4];
        Pair.acceleration(t, &q, &v, &mut four);
        a.copy_from_slice(&four);
    }
}

#[test]
fn a_cloned_state_and_integrator_repeat_every_bit_under_every_method() {
    let spring = Spring { mass: 1.0, stiffness: 90.0, damping: 0.5, x0: 1.0, v0: 2.0, kick: 1.0 };
    let target = Follow {
        order: 1,
        rate: 3.0,
        step: 1.0,
        ramp: 0.2,
        sine: 0.3,
        sine_hz: 1.0,
        x0: 0.4,
        v0: 0.0,
        kick: 1.0,
    };
    let followers = [target.clone(), Follow { order: 2, ..target }];
    let four = State { q: [1.0, 0.2, -0.5, 0.8], v: [0.0, 1.0, -2.0, 0.3] };
    let many = State { q: four.q.to_vec(), v: four.v.to_vec() };
    let mut forgetful = Vec::new();
    for method in METHODS {
        let found = [
            passes(&spring, &spring.start(), method),
            passes(&followers[0], &followers[0].start(), method),
            passes(&followers[1], &followers[1].start(), method),
            passes(&Pair, &four, method),
            passes(&Many, &many, method),
        ];
        let found: Vec<[Bits; 3]> = found.into_iter().flatten().collect();
        assert!(!found.is_empty(), "no system here is for {}", method.id);
        for [first, second, _] in &found {
            assert_eq!(first, second, "{}", method.id);
        }
        if found.iter().any(|[first, _, fresh]| first != fresh) {
            forgetful.push(method.id);
        }
    }
    for id in ["adams-bashforth-2", "stormer-verlet", "bdf2"] {
        assert!(
            forgetful.contains(&id),
            "a fresh {id} has the memory of an old one: {forgetful:?}"
        );
    }
    assert!(!forgetful.contains(&"rk4"), "{forgetful:?}");
}

#[test]
fn an_integrator_behind_a_pointer_can_be_a_component_of_an_engine() {
    fn component<T: Clone + Debug + Send + Sync + 'static>(of: &T) -> T {
        of.clone()
    }

    #[derive(Clone, Debug)]
    struct Camera {
        state: State<[f64; 4]>,
        method: Box<dyn Integrator<Pair>>,
    }
    let state = State::from(([1.0; 4], [0.0; 4]));
    let camera = Camera { state, method: integrator(method("bdf2").expect("a method"), &state.q) };
    let mut copy = component(&camera);
    copy.method.step(&Pair, 0.0, 0.01, &mut copy.state).expect("a step");
    assert_ne!(copy.state, camera.state);
    let shown = format!("{camera:?}");
    assert!(shown.contains("method: Integrator { .. }"), "{shown}");
}
