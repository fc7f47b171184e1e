//! The maker of a log of a stiff spring is named without its stiffness, and no other one. So are steps by hand.

use regatta::sim::integrators::{fresh, method, problem};
use regatta::sim::{State, System};
use regatta::table::TableOptions;
use regatta::tools::identify::{Conclusion, Identification, Log, LoggedBody, identify};

/// A spring with this stiffness and damping per unit of mass.
struct Spring([f64; 2]);

impl System for Spring {
    type Vector = f64;

    fn acceleration(&self, _t: f64, x: &f64, v: &f64, a: &mut f64) {
        *a = -(self.0[0] * x + self.0[1] * v);
    }
}

/// A log of a spring with this frequency and damping ratio, let go at 1.
fn log(id: &str, [hz, ratio, tick_hz]: [f64; 3], rows: usize) -> Log {
    let omega = std::f64::consts::TAU * hz;
    let spring = problem(Spring([omega * omega, 2.0 * ratio * omega]));
    let mut stepper = fresh(method(id).expect("a method"));
    let mut state = State { q: 1.0, v: 0.0 };
    let mut text = "tick,x,v\n".to_owned();
    for tick in 0..rows {
        text += &format!("{tick},{:?},{:?}\n", state.q, state.v);
        let t = tick as f64 / tick_hz;
        stepper.steps(&spring, t, 1.0 / tick_hz, 1, &mut state).expect("a step");
    }
    Log::parse("log.csv", &text, &TableOptions::default(), tick_hz).expect("a log")
}

/// A step by hand, of x, v and the acceleration of the tick before, with stiffness, damping and the length of a tick.
type ByHand = fn([f64; 3], [f64; 3]) -> [f64; 3];

/// Steps as people write them, with the forms that they are.
const BY_HAND: [(&str, ByHand); 8] = [
    ("uniform-acceleration", |[x, v, _], [k, c, h]| {
        let a = -k * x - c * v;
        [x + v * h + 0.5 * a * h * h, v + a * h, a]
    }),
    ("verlet-old-velocity", |[x, v, _], [k, c, h]| {
        let a = -k * x - c * v;
        let to = x + v * h + 0.5 * a * h * h;
        [to, v + 0.5 * (a + (-k * to - c * v)) * h, a]
    }),
    ("verlet-half-velocity", |[x, v, _], [k, c, h]| {
        let half = v + 0.5 * h * (-k * x - c * v);
        let to = x + half * h;
        [to, half + 0.5 * h * (-k * to - c * half), 0.0]
    }),
    ("verlet-carried-force", |[x, v, a], [k, c, h]| {
        let half = v + 0.5 * h * if a.is_nan() { -k * x - c * v } else { a };
        let to = x + half * h;
        let a = -k * to - c * half;
        [to, half + 0.5 * h * a, a]
    }),
    ("drift-first", |[x, v, _], [k, c, h]| {
        let to = x + v * h;
        [to, v + h * (-k * to - c * v), 0.0]
    }),
    ("damped-before", |[x, v, _], [k, c, h]| {
        let v = v * libm::exp(-c * h) - k * x * h;
        [x + v * h, v, 0.0]
    }),
    ("damped-between", |[x, v, _], [k, c, h]| {
        let v = (v - k * x * h) * libm::exp(-c * h);
        [x + v * h, v, 0.0]
    }),
    ("damped-after", |[x, v, _], [k, c, h]| {
        let v = v - k * x * h;
        [x + v * h, v * libm::exp(-c * h), 0.0]
    }),
];

#[test]
fn a_step_by_hand_is_named_with_its_numbers_and_is_never_an_engine_s_alone() {
    for (id, step) in BY_HAND {
        for (hz, ratio) in [(2.0, 0.2), (1.0, 0.7), (5.0, 0.05)] {
            let omega = std::f64::consts::TAU * hz;
            let [k, c] = [omega * omega, 2.0 * ratio * omega];
            let mut now = [1.0, 0.0, f64::NAN];
            let mut text = "tick,x,v\n".to_owned();
            for tick in 0..300 {
                text += &format!("{tick},{:?},{:?}\n", now[0], now[1]);
                now = step(now, [k, c, 1.0 / 60.0]);
            }
            let log = Log::parse("log.csv", &text, &TableOptions::default(), 60.0).expect("a log");
            let given = LoggedBody { spring: Some([k, c]), ..LoggedBody::default() };
            let found = identify(&log, &given, 60.0).expect("an answer");
            assert_eq!(found.conclusion, Conclusion::Identified, "{id} at {hz} Hz");
            assert!(names(&found).contains(&id), "{id} at {hz} Hz: {:?}", names(&found));
            let found = identify(&log, &LoggedBody::default(), 60.0).expect("an answer");
            let all = found.unusual.iter().map(|candidate| candidate.method.id);
            let all: Vec<&str> = names(&found).into_iter().chain(all).collect();
            assert!(all.contains(&id), "{id} at {hz} Hz, without its spring: {all:?}");
        }
    }
}

fn names(found: &Identification) -> Vec<&'static str> {
    let best = found.best.iter().map(|best| best.candidate.method.id);
    let all = found.also.iter().chain(&found.rivals);
    best.chain(all.map(|candidate| candidate.method.id)).collect()
}

#[test]
fn the_maker_of_a_stiff_spring_is_named_without_its_stiffness() {
    for (id, numbers, rows) in [
        ("semi-implicit-euler", [8.0, 0.0, 60.0], 300),
        ("semi-implicit-euler", [5.0, 0.0, 30.0], 120),
        ("semi-implicit-euler", [15.0, 0.0, 60.0], 120),
        ("semi-implicit-euler", [8.0, 0.0, 30.0], 300),
        ("semi-implicit-euler", [12.0, 0.05, 60.0], 120),
        // It doubles at each tick.
        ("semi-implicit-euler", [13.361, 0.0, 30.0], 49),
        ("explicit-euler", [2.351, 0.0, 60.0], 300),
        ("pefrl", [4.462, 1.0, 60.0], 60),
        ("rk4", [11.177, 0.7, 30.0], 120),
        ("velocity-verlet", [8.0, 0.0, 60.0], 120),
        ("velocity-verlet", [15.0, 0.0, 60.0], 120),
        ("implicit-midpoint", [15.0, 0.1, 60.0], 120),
        ("implicit-euler", [8.0, 0.1, 60.0], 120),
        ("rk4", [8.0, 0.0, 60.0], 120),
    ] {
        let log = log(id, numbers, rows);
        let found = identify(&log, &LoggedBody::default(), numbers[2]).expect("an answer");
        assert_ne!(found.conclusion, Conclusion::Unknown, "{id} {numbers:?}");
        let named = names(&found);
        // One map under two springs cannot be told apart, and then all are listed.
        let is_open = found.conclusion == Conclusion::CannotTell;
        assert!(is_open || found.rivals.is_empty(), "{id} {numbers:?}");
        assert!(named.contains(&id), "{id} {numbers:?}: {named:?}");
    }
}
