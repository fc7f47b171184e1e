//! The claims on the cards of followers, measured on bodies that follow a target.

use std::cell::RefCell;
use std::rc::Rc;

use glam::{DVec2, DVec3};
use regatta::sim::bodies::{Body, Follow, kind};
use regatta::sim::integrators::{
    Family, Integrator, METHODS, Method, StepFailure, integrator, method,
};
use regatta::sim::{Pursuit, Query, Solver, State, System, Vector};

use super::systems::{Problem, bits, fresh, problem, spring};

fn followers() -> impl Iterator<Item = &'static Method> {
    METHODS.iter().filter(|method| method.family == Family::Follower)
}

/// The order of the law that a follower is for.
fn order_of(method: &Method) -> usize {
    method.law_order().expect("a follower is for one law") as usize
}

/// A body at rest 2 m before a still target, by the law that `method` is for.
fn still(method: &Method, rate: f64) -> Follow {
    let order = order_of(method);
    Follow { order, rate, step: 1.0, x0: -1.0, kick: 0.5, ..Follow::default() }
}

/// The states after each of `steps` steps of `h`.
fn course(method: &Method, body: &Follow, h: f64, steps: u32) -> Vec<State<f64>> {
    let (system, mut integrator) = (problem(body.clone()), fresh(method));
    let mut state = body.start();
    let states = (0..steps).map(|step| {
        integrator.step(&system, h * f64::from(step), h, &mut state).expect("the law it is for");
        state
    });
    states.collect()
}

#[test]
fn each_follower_has_the_order_on_its_card_behind_a_steady_target() {
    let span = 1.7;
    for method in followers() {
        let body = Follow { ramp: 0.8, ..still(method, 3.0) };
        let truth = body.exact(span, &body.start()).expect("a closed form");
        let error = |steps: u32| {
            let states = course(method, &body, span / f64::from(steps), steps);
            let last = states.last().expect("a step");
            [(last.q - truth.q).abs(), (last.v - truth.v).abs()]
        };
        for k in 12..15 {
            let [coarse, fine] = [error(1 << k), error(2 << k)];
            for part in 0..2 {
                let order = (coarse[part] / fine[part]).log2();
                println!("{:26} {part}: order {order:.3}", method.id);
                for claimed in [method.order, method.order_with_drag] {
                    assert!((order - f64::from(claimed)).abs() < 0.1, "{}: {order}", method.id);
                }
            }
        }
    }
}

#[test]
fn a_step_evaluates_the_target_as_often_as_its_card_states() {
    for method in followers() {
        let counted = problem(still(method, 3.0));
        let mut state = still(method, 3.0).start();
        let mut integrator = fresh(method);
        for steps in 1..50 {
            integrator.step(&counted, 0.0, 0.1, &mut state).expect("the law it is for");
            assert_eq!(counted.evaluations(), u64::from(steps * method.evaluations.unwrap()));
        }
        assert_eq!(integrator.lost_time(), 0.0);
    }
}

#[test]
fn a_follower_is_stable_up_to_its_limit_and_not_beyond() {
    let furthest = |method: &Method, z: f64| {
        let states = course(method, &still(method, 1.0), z, 4000);
        let distances = states.iter().map(|state| (state.q - 1.0).abs());
        distances.take_while(|distance| distance.is_finite()).fold(0.0, f64::max)
    };
    for method in followers() {
        let parts =
            [0.01, 0.3, 0.9, 0.99].map(|part| part * method.stability_limit.unwrap_or(50.0));
        for z in parts {
            assert!(furthest(method, z) <= 2.0, "{} at {z}", method.id);
        }
        match method.stability_limit {
            Some(limit) => assert!(furthest(method, 1.01 * limit) > 1e6, "{}", method.id),
            None => assert!(furthest(method, 1e4) <= 2.0, "{}", method.id),
        }
    }
}

#[test]
fn a_follower_loses_area_and_is_not_reversible() {
    for method in followers() {
        let system = problem(Follow { ramp: 0.8, ..still(method, 3.0) });
        let step = |t: f64, h: f64, [q, v]: [f64; 2]| {
            let mut state = State { q, v };
            fresh(method).step(&system, t, h, &mut state).expect("the law it is for");
            [state.q, state.v]
        };
        let [from, along, across] =
            [[-1.0, 0.1], [-0.99, 0.1], [-1.0, 0.11]].map(|s| step(0.0, 0.1, s));
        let [a, b] = [along, across].map(|to| [to[0] - from[0], to[1] - from[1]]);
        let area = (a[0] * b[1] - a[1] * b[0]) / 1e-4;
        assert_eq!(method.symplectic, (area - 1.0).abs() < 1e-6, "{}: {area}", method.id);
        assert!(area < 0.9, "{}: {area}", method.id);
        let back = step(0.1, -0.1, from);
        assert_eq!(method.reversible, (back[0] + 1.0).abs() < 1e-9, "{}: {back:?}", method.id);
    }
}

#[test]
fn a_follower_has_no_memory_and_uses_the_target_at_the_end_of_its_step() {
    /// Remembers the times at which it is asked for its target.
    struct Watched(Follow, RefCell<Vec<f64>>);
    impl System for Watched {
        type Vector = f64;
        fn acceleration(&self, _t: f64, _q: &f64, _v: &f64, _a: &mut f64) {
            panic!("a follower needs no acceleration");
        }
        fn query(&self, t: f64, query: Query<'_, f64>) -> bool {
            self.1.borrow_mut().push(t);
            self.0.query(t, query)
        }
    }
    for method in followers() {
        assert!(method.restart.is_none() && method.keeps_time && method.tolerance.is_none());
        let body = Follow { sine: 0.3, sine_hz: 1.0, ..still(method, 3.0) };
        let watched = Rc::new(Watched(body.clone(), RefCell::default()));
        let system = problem(watched.clone());
        let mut state = body.start();
        let mut kept = fresh(method);
        kept.steps(&system, 5.0, 0.3, 3, &mut state).expect("the law it is for");
        let asked = watched.1.take();
        let wanted = [5.1, 5.2, 5.3];
        let are_near = asked.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(asked.len() == 3 && are_near, "{}: {asked:?}", method.id);

        let mut alike = state;
        kept.step(&system, 5.3, 0.1, &mut state).expect("the law it is for");
        fresh(method).step(&system, 5.3, 0.1, &mut alike).expect("the law it is for");
        assert_eq!(bits(&state), bits(&alike), "{}", method.id);
    }
}

#[test]
fn a_follower_refuses_other_bodies_and_the_other_order() {
    let refused = |method: &Method, stepped: Result<(), StepFailure>| {
        let reason = method.only.expect("a follower is for one law").reason;
        assert_eq!(stepped, Err(StepFailure::Refused { reason }), "{}", method.id);
    };
    for method in followers() {
        let mut state = State { q: 1.0, v: 0.0 };
        refused(method, fresh(method).step(&problem(spring(3.0, 0.1)), 0.0, 0.1, &mut state));
        let other = Follow { order: 3 - order_of(method), ..still(method, 3.0) };
        let mut start = other.start();
        refused(method, fresh(method).step(&problem(other), 0.0, 0.1, &mut start));
    }
}

/// A still target at 1 in every coordinate.
struct Ones<V>(V, u32);

impl<V: Vector> System for Ones<V> {
    type Vector = V;
    fn acceleration(&self, _t: f64, _q: &V, _v: &V, _a: &mut V) {
        panic!("a follower needs no acceleration");
    }
    fn query(&self, _t: f64, query: Query<'_, V>) -> bool {
        let Query::Target(pursuit) = query else { return false };
        let mut target = self.0.clone();
        target.components_mut().fill(1.0);
        *pursuit = Some(Pursuit { target, rate: 3.0, order: self.1, is_still: true });
        true
    }
}

#[test]
fn equal_targets_get_equal_bits_in_every_vector() {
    fn run<V: Vector>(
        method: &Method,
        mut integrator: Box<dyn Integrator<Problem<V>>>,
        like: V,
    ) -> Vec<u64> {
        let system = problem(Ones(like.clone(), order_of(method) as u32));
        let mut state = State { q: like.clone(), v: like };
        state.q.components_mut().fill(-0.3);
        state.v.components_mut().fill(0.7);
        integrator.steps(&system, 0.0, 0.7, 7, &mut state).expect("the law it is for");
        bits(&state)
    }
    for method in followers() {
        let alone = run(method, fresh(method), 0.0);
        for many in [
            run(method, integrator(method, &DVec2::ZERO), DVec2::ZERO),
            run(method, integrator(method, &DVec3::ZERO), DVec3::ZERO),
            run(method, integrator(method, &vec![0.0; 5]), vec![0.0; 5]),
        ] {
            let half = many.len() / 2;
            assert!(many[..half].iter().all(|&bits| bits == alone[0]), "{}", method.id);
            assert!(many[half..].iter().all(|&bits| bits == alone[1]), "{}", method.id);
        }
    }
}

/// The largest error of the place over 2 s, as a part of the way, at a step of `z` divided by the rate.
fn error_at_rest(id: &str, z: f64) -> f64 {
    let method = method(id).expect("a follower");
    let body = still(method, 5.0);
    let h = z / body.rate;
    let errors = (1..).zip(course(method, &body, h, (2.0 / h) as u32)).map(|(step, state)| {
        let truth = body.exact(h * f64::from(step), &body.start()).expect("a closed form");
        (state.q - truth.q).abs() / 2.0
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn only_closed_forms_follow_a_fixed_target_exactly_at_any_step() {
    for z in [0.03, 0.3, 1.0, 5.0] {
        for id in ["exponential-decay", "critically-damped-spring"] {
            let error = error_at_rest(id, z);
            assert!(error < 1e-14, "{id} at {z}: {error:e}");
        }
        for id in ["lerp-per-frame", "lerp-dt", "implicit-spring"] {
            assert!(error_at_rest(id, z) > 3e-3, "{id} at {z}: {:e}", error_at_rest(id, z));
        }
    }
}

#[test]
fn smooth_damps_exponential_is_within_0_12_percent_up_to_a_step_of_one() {
    let method = method("smooth-damp").expect("a follower");
    // From rest x' - g = (x - g) (1 + z) e, so that one step shows the e that it uses.
    let off = |z: f64| {
        let end = course(method, &still(method, 1.0), z, 1)[0].q;
        let e = (end - 1.0) / -2.0 / (1.0 + z);
        (e / libm::exp(-z) - 1.0).abs()
    };
    let worst = (1..=100).map(|n| off(f64::from(n) / 100.0)).fold(0.0, f64::max);
    println!("smooth damp: e is off by {:.4} %", 100.0 * worst);
    assert!((1.15e-3..1.25e-3).contains(&worst), "{worst:e}");
}

#[test]
fn only_smooth_damp_stops_dead_at_a_moving_target() {
    let stops = |id: &str| {
        let method = method(id).expect("a follower");
        let body = Follow { step: 0.0, sine: 1.0, sine_hz: 1.0, x0: 0.0, ..still(method, 8.0) };
        let states = course(method, &body, 1.0 / 144.0, 6 * 144);
        states.iter().skip(144).filter(|state| state.v == 0.0).count()
    };
    // Once in every swing.
    let stopped = stops("smooth-damp");
    assert!((4..=6).contains(&stopped), "{stopped} stops in 5 s");
    assert_eq!(stops("critically-damped-spring") + stops("implicit-spring"), 0);
}

#[test]
fn an_implicit_spring_solves_the_equations_of_backward_euler() {
    // Towards a target that steps, moves away and swings.
    let values = [2.0, 5.0, 1.0, 0.5, 0.3, 1.2, -1.0, 0.7, 0.5];
    let solver = Solver::Method(method("implicit-spring").unwrap());
    for h in [1.0 / 144.0, 1.0 / 30.0, 0.5] {
        let mut body = (kind("follow").unwrap().build)(&values, solver);
        for tick in 0..40 {
            let (t, [x, v]) = (f64::from(tick) * h, [body.q()[0], body.v()[0]]);
            body.advance(t, h, 1).unwrap();
            let (q, w, mut a) = (body.q().to_vec(), body.v().to_vec(), [0.0]);
            body.acceleration(t + h, &q, &w, &mut a);
            assert!((q[0] - (x + h * w[0])).abs() < 1e-13, "{h} s, tick {tick}");
            assert!((w[0] - (v + h * a[0])).abs() < 1e-12, "{h} s, tick {tick}");
        }
    }
}
