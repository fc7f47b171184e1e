//! One formula over every kind of coordinate vector.

use glam::{DVec2, DVec3, DVec4};
use regatta::sim::integrators::{GENERAL_METHODS, Integrator, integrator};
use regatta::sim::{State, Vector};

use super::systems::{Problem, fresh, springs};

/// The methods that take the exponential of a slope of the force.
const EXPONENTIAL: [&str; 2] = ["verlet-exact-drag", "exponential-rosenbrock-euler"];

/// The state after 200 steps of as many equal springs as `like` has components.
fn run<V: Vector>(mut integrator: Box<dyn Integrator<Problem<V>>>, like: &V) -> State<V> {
    let system = springs(9.0, 0.4);
    let mut state = State { q: like.clone(), v: like.clone() };
    state.q.components_mut().fill(1.0);
    state.v.components_mut().fill(-0.37);
    for step in 0..200 {
        integrator.step(&system, 0.1 * f64::from(step), 0.1, &mut state).unwrap();
    }
    state
}

#[test]
fn equal_springs_get_equal_bits_in_every_vector() {
    for method in GENERAL_METHODS {
        let State { q, v } = run(fresh(method), &0.0);
        assert!(q.is_finite() && v.is_finite() && q != 0.0, "{}: {q}, {v}", method.id);
        // The exponential of a number is not rounded as that of a matrix.
        let is_exponential = EXPONENTIAL.contains(&method.id);
        let agree = |there: f64, here: f64| match is_exponential {
            true => (there / here - 1.0).abs() < 1e-12,
            false => there.to_bits() == here.to_bits(),
        };
        let check = |q_there: &[f64], v_there: &[f64]| {
            assert!(q_there.iter().all(|there| agree(*there, q)), "{}", method.id);
            assert!(v_there.iter().all(|there| agree(*there, v)), "{}", method.id);
        };
        let plane = run(integrator(method, &DVec2::ZERO), &DVec2::ZERO);
        check(plane.q.components(), plane.v.components());
        let space = run(integrator(method, &DVec3::ZERO), &DVec3::ZERO);
        check(space.q.components(), space.v.components());
        let four = run(integrator(method, &DVec4::ZERO), &DVec4::ZERO);
        check(four.q.components(), four.v.components());
        let [one, six] = [run(integrator(method, &[0.0]), &[0.0]).q.to_vec(), {
            let state = run(integrator(method, &[0.0; 6]), &[0.0; 6]);
            check(&state.q, &state.v);
            state.q.to_vec()
        }];
        assert_eq!((one.len(), six.len()), (1, 6));
        check(&one, &[]);
        for n in [1, 2, 3, 17] {
            let like = vec![0.0; n];
            let many = run(integrator(method, &like), &like);
            assert_eq!(many.q.len(), n);
            check(&many.q, &many.v);
        }
    }
}
