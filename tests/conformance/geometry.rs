//! Area in phase space, and the way back.

use regatta::sim::integrators::{METHODS, Method};
use regatta::sim::{State, System};

use super::systems::{Pendulum, fresh, spring};

/// Large enough that what a method does not keep is far above round-off.
const STEP: f64 = 0.8;
const FROM: State<f64> = State { q: 1.2, v: 0.5 };

/// One step of a fresh method.
fn map<S: System<Vector = f64> + 'static>(
    method: &Method,
    system: &S,
    mut state: State<f64>,
) -> State<f64> {
    fresh::<S>(method).step(system, 0.0, STEP, &mut state).unwrap();
    state
}

/// The determinant of the one-step map's Jacobian, by central differences.
fn area<S: System<Vector = f64> + 'static>(method: &Method, system: &S) -> f64 {
    let d = 1e-4;
    let column = |dq: f64, dv: f64| {
        let ahead = map(method, system, State { q: FROM.q + dq, v: FROM.v + dv });
        let behind = map(method, system, State { q: FROM.q - dq, v: FROM.v - dv });
        [(ahead.q - behind.q) / (2.0 * d), (ahead.v - behind.v) / (2.0 * d)]
    };
    let (by_q, by_v) = (column(d, 0.0), column(0.0, d));
    by_q[0] * by_v[1] - by_q[1] * by_v[0]
}

#[test]
fn symplectic_methods_and_no_others_keep_area() {
    for method in METHODS {
        let on_spring = (area(method, &spring(1.0, 0.0)) - 1.0).abs();
        let on_pendulum = (area(method, &Pendulum) - 1.0).abs();
        println!("{:22} {on_spring:.1e} {on_pendulum:.1e}", method.id);
        assert!(on_spring.is_finite() && on_pendulum.is_finite(), "{}", method.id);
        if method.symplectic {
            assert!(on_spring < 1e-11 && on_pendulum < 1e-11, "{}", method.id);
        } else {
            assert!(on_spring > 1e-6 && on_pendulum > 1e-6, "{}", method.id);
        }
    }
}

/// How far from its start a step of `h` and a step of `-h` leave the state.
fn there_and_back<S: System<Vector = f64> + 'static>(method: &Method, system: &S) -> f64 {
    let mut integrator = fresh::<S>(method);
    let mut state = FROM;
    integrator.step(system, 0.0, STEP, &mut state).unwrap();
    integrator.step(system, STEP, -STEP, &mut state).unwrap();
    (state.q - FROM.q).abs().max((state.v - FROM.v).abs())
}

#[test]
fn reversible_methods_and_no_others_find_back() {
    for method in METHODS {
        for off in [there_and_back(method, &spring(1.0, 0.0)), there_and_back(method, &Pendulum)] {
            println!("{:22} {off:.1e}", method.id);
            assert!(off.is_finite(), "{}", method.id);
            if method.reversible {
                assert!(off < 1e-14, "{}: {off:e}", method.id);
            } else {
                assert!(off > 1e-6, "{}: {off:e}", method.id);
            }
        }
    }
}
