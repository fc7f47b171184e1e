//! A game that goes back to an earlier tick keeps a state and a clone of its integrator, and repeats every bit.

use std::fmt::Debug;

use regatta::sim::bodies::{Follow, Spring, Tumble};
use regatta::sim::integrators::{
    Family, GENERAL_METHODS, Integrator, METHODS, Method, StepFailure, integrator, method,
    method_or_nearest,
};
use regatta::sim::{Body, Clock, State, System, TickRate, Vector};

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
    let top = Tumble {
        moments: [1.0, 2.0, 3.0].into(),
        spin: [3.0, 0.5, 0.5].into(),
        attitude: glam::DQuat::IDENTITY,
        mass: 1.0,
        kick: [0.0; 3].into(),
    };
    let many = State { q: four.q.to_vec(), v: four.v.to_vec() };
    let mut forgetful = Vec::new();
    for method in METHODS {
        let found = [
            passes(&spring, &spring.start(), method),
            passes(&followers[0], &followers[0].start(), method),
            passes(&followers[1], &followers[1].start(), method),
            passes(&Pair, &four, method),
            passes(&Many, &many, method),
            passes(&top, &top.start(), method),
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
    // The manual names each of them, and no other.
    let library = regatta::manual::chapter("library").expect("a chapter").text;
    let (_, after) = library.split_once("a clone of its integrator: ").expect("the sentence");
    let (told, _) = after.split_once("remember part of the last step").expect("its end");
    let named: Vec<&str> = told.split('`').skip(1).step_by(2).collect();
    assert!(told.ends_with(" and the adaptive methods "), "{told}");
    let adaptive = METHODS.iter().filter(|method| method.family == Family::Adaptive);
    let adaptive: Vec<&str> = adaptive.map(|method| method.id).collect();
    forgetful.retain(|id| !adaptive.contains(id));
    forgetful.sort_by_key(|id| named.iter().position(|named| named == id));
    assert_eq!(named, forgetful);
}

/// A spring of a game, whose stiffness a player changes.
struct Tuned {
    stiffness: f64,
    changes: u64,
}

impl System for Tuned {
    type Vector = f64;
    fn acceleration(&self, _t: f64, q: &f64, v: &f64, a: &mut f64) {
        *a = -self.stiffness * q - 0.4 * v;
    }
    fn generation(&self) -> u64 {
        self.changes
    }
}

#[test]
fn a_new_generation_of_the_forces_resets_every_method() {
    let run = |method: &Method, counts: bool, resets: bool| {
        let mut state = State { q: 1.0, v: 0.0 };
        let mut system = Tuned { stiffness: 40.0, changes: 0 };
        let mut used = integrator(method, &state.q);
        for tick in 0..60 {
            if tick == 30 {
                system = Tuned { stiffness: 160.0, changes: u64::from(counts) };
                if resets {
                    used.reset();
                }
            }
            used.step(&system, f64::from(tick) / 60.0, 1.0 / 60.0, &mut state).unwrap();
        }
        state.bits_hash()
    };
    let mut told = 0;
    for method in GENERAL_METHODS {
        let by_hand = run(method, false, true);
        assert_eq!(run(method, true, false), by_hand, "{}", method.id);
        told += usize::from(run(method, false, false) != by_hand);
    }
    assert!((4..10).contains(&told), "{told} methods with a memory");
}

#[test]
fn a_state_is_drawn_between_ticks_checked_and_hashed() {
    let state = |q: [f64; 2], v: [f64; 2]| State { q, v };
    let (before, after) = (state([1.0, -2.0], [0.0, 4.0]), state([3.0, -2.0], [1.0, 0.0]));
    assert_eq!(before.lerp(&after, 0.0), before);
    assert_eq!(before.lerp(&after, 1.0), after);
    assert_eq!(before.lerp(&after, 0.25), state([1.5, -2.0], [0.25, 3.0]));
    assert!(before.is_finite());
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(
            !state([1.0, bad], [0.0; 2]).is_finite() && !state([0.0; 2], [bad, 1.0]).is_finite()
        );
    }
    // 64-bit FNV-1a of eight zero bytes, twice.
    assert_eq!(State { q: 0.0, v: -0.0 }.bits_hash(), 0x8820_1fb9_60ff_6465);
    assert_ne!(before.bits_hash(), after.bits_hash());
    assert_ne!(before.bits_hash(), state([-2.0, 1.0], [0.0, 4.0]).bits_hash());
}

#[test]
fn a_word_for_a_method_is_found_or_answered_with_those_near() {
    for (word, id) in [
        ("rk4", "rk4"),
        ("RK4", "rk4"),
        (" velocity_verlet ", "velocity-verlet"),
        ("Semi-implicit Euler", "semi-implicit-euler"),
        ("xpbd", "linearly-implicit-euler"),
    ] {
        assert_eq!(method_or_nearest(word).expect(word).id, id);
    }
    let error = method_or_nearest("verlet").unwrap_err();
    assert!(error.near.contains(&"velocity-verlet") && error.near.len() > 2, "{error}");
    assert!(error.to_string().contains("did you mean velocity-verlet or "), "{error}");
    for word in ["", "  ", "leap of faith"] {
        let error = method_or_nearest(word).unwrap_err();
        assert!(error.near.is_empty() && error.to_string().ends_with("METHODS lists all"));
    }
}

#[cfg(feature = "serde")]
#[test]
fn a_saved_clock_goes_on_with_the_same_ticks() {
    for rate in ["60", "59.94", "1/0.015", "60000/1001"] {
        let mut clock = Clock::new(rate.parse::<TickRate>().unwrap());
        clock.set_speed_percent(150);
        clock.set_max_frame_ms(500);
        clock.advance(123_456_789);
        let text = serde_json::to_string(&clock).unwrap();
        let mut loaded: Clock = serde_json::from_str(&text).unwrap();
        assert_eq!(loaded, clock, "{text}");
        assert_eq!(loaded.advance(777_777_777), clock.advance(777_777_777));
        let state = State { q: vec![0.1, -0.0], v: vec![1e-300, 2.0] };
        let text = serde_json::to_string(&state).unwrap();
        let loaded: State<Vec<f64>> = serde_json::from_str(&text).unwrap();
        assert_eq!(loaded.bits_hash(), state.bits_hash(), "{text}");
    }
    let text = serde_json::to_string(&Clock::new(60)).unwrap();
    for (is, bad) in [("[0,0]", "[1,0]"), ("\"60\"", "\"1e9\"")] {
        assert!(text.contains(is), "{text}");
        assert!(serde_json::from_str::<Clock>(&text.replace(is, bad)).is_err());
    }
}

/// A loop beside the prelude of an engine, which has two names of ours too.
mod beside_an_engine {
    mod engine {
        pub(super) struct State;
        pub(super) trait System {}
        impl System for State {}
    }
    use self::engine::*;
    use regatta::prelude::beside::*;

    struct Drop;

    impl MotionSystem for Drop {
        type Vector = f64;
        fn acceleration(&self, _t: f64, _q: &f64, _v: &f64, a: &mut f64) {
            *a = -9.81;
        }
    }

    #[test]
    fn a_loop_is_written_beside_an_engine_with_a_state_and_a_system() {
        fn takes(_: impl System) {}
        takes(State);
        let mut state = MotionState { q: 0.0, v: 0.0 };
        let mut rk4 = integrator(method("rk4").unwrap(), &state.q);
        let mut clock = Clock::new(60);
        for _ in 0..clock.advance_by(std::time::Duration::from_millis(100)).ticks {
            rk4.step(&Drop, 0.0, clock.dt_s(), &mut state).unwrap();
        }
        assert!((state.q + 9.81 * 0.005).abs() < 1e-12, "{}", state.q);
    }
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
