//! Properties of the methods that use the derivative of the acceleration, and of Jakobsen's Verlet.

use regatta::conformance::problems::{Air, SHIP, course_in_air};
use regatta::sim::bodies::{Body, Ship};
use regatta::sim::integrators::{integrator, method};
use regatta::sim::{State, System};

use super::systems::{
    Kepler, Problem, Sparse, bits, fresh, kepler_orbit, problem, spring, springs,
};

/// The states after each of `steps` steps of `h`.
fn course(
    id: &str,
    system: impl System<Vector = f64> + 'static,
    start: &State<f64>,
    h: f64,
    steps: u32,
) -> Vec<State<f64>> {
    let (system, mut integrator) = (problem(system), fresh(method(id).expect("a method")));
    let mut state = *start;
    let states = (0..steps).map(|step| {
        integrator.step(&system, h * f64::from(step), h, &mut state).unwrap();
        state
    });
    states.collect()
}

/// The largest error over a hundred steps, relative to the largest position and velocity.
fn error<B: Body<Vector = f64> + 'static>(id: &str, body: &B, h: f64) -> f64 {
    let (start, mut worst, mut largest) = (body.start(), [0.0_f64; 2], [0.0_f64; 2]);
    for (step, found) in course(id, body.clone(), &start, h, 100).into_iter().enumerate() {
        let truth = body.exact(h * (step + 1) as f64, &start).expect("a closed form");
        for (i, (found, truth)) in [(found.q, truth.q), (found.v, truth.v)].into_iter().enumerate()
        {
            worst[i] = worst[i].max((found - truth).abs());
            largest[i] = largest[i].max(truth.abs());
        }
    }
    (worst[0] / largest[0]).max(worst[1] / largest[1])
}

#[test]
fn the_exponential_method_is_exact_on_springs_and_the_ship() {
    let id = "exponential-rosenbrock-euler";
    for (omega, ratio) in [(1.0, 0.0), (1.0, 0.2), (6.0, 0.05), (6.0, 1.0)] {
        let off = error(id, &spring(omega, ratio), 0.1);
        assert!(off < 1e-13, "ω = {omega}, ζ = {ratio}: {off:e}");
    }
    let off = error(id, &SHIP, 0.5);
    assert!(off < 1e-13, "{off:e}");
    // Far beyond the limit of every explicit method. Squaring limits the accuracy to the rounding of the phase.
    let off = error(id, &spring(1000.0, 0.01), 0.1);
    assert!(off < 1e-10, "{off:e}");
}

#[test]
fn linearly_implicit_euler_is_implicit_euler_on_a_linear_spring() {
    let start = State { q: 1.0, v: 0.7 };
    for (omega, ratio) in [(1.0, 0.0), (1.0, 0.2), (30.0, 0.05), (300.0, 1.0)] {
        let spring = spring(omega, ratio);
        let [one, other] = ["linearly-implicit-euler", "implicit-euler"]
            .map(|id| course(id, spring.clone(), &start, 0.1, 100));
        for (one, other) in one.iter().zip(&other) {
            let off = (one.q - other.q).abs().max((one.v - other.v).abs());
            assert!(off < 1e-13, "ω = {omega}, ζ = {ratio}: {off:e}");
        }
    }
    // And not on a curved force.
    let [one, other] = ["linearly-implicit-euler", "implicit-euler"]
        .map(|id| course(id, super::systems::UnitPendulum, &start, 0.1, 100));
    assert!((one[99].q - other[99].q).abs() > 1e-6);
}

#[test]
fn linearly_implicit_euler_makes_the_step_of_xpbd() {
    // Macklin, Müller & Chentanez: λ = -C / (w + α~), x' = x + h v + w λ, with α~ = α / h² and α = 1 / k.
    let (mass, stiffness, h) = (2.0, 300.0, 1.0 / 60.0);
    let body =
        regatta::sim::bodies::Spring { mass, stiffness, damping: 0.0, x0: 0.5, v0: 3.0, kick: 1.0 };
    let [mut x, mut v] = [0.5, 3.0];
    for found in course("linearly-implicit-euler", body.clone(), &body.start(), h, 100) {
        let predicted = x + h * v;
        let lambda = -predicted / (1.0 / mass + 1.0 / (stiffness * h * h));
        let next = predicted + lambda / mass;
        (x, v) = (next, (next - x) / h);
        assert!((found.q - x).abs() < 1e-13 && (found.v - v).abs() < 1e-11, "{found:?}: {x}, {v}");
    }
}

#[test]
fn only_implicit_or_exact_drag_is_stable_at_any_step() {
    let coasting = Ship { thrust: 0.0, v0: 20.0, mass: 1.0, drag: 1000.0, ..SHIP };
    let last = |id| course(id, coasting.clone(), &coasting.start(), 0.1, 50)[49].v;
    assert!(last("semi-implicit-euler").abs() > 1e50);
    let found = last("semi-implicit-euler-implicit-drag");
    assert!(found.abs() < 1e-50, "{found}");
    let found = last("verlet-exact-drag");
    assert!(found.abs() < 1e-50, "{found}");
    // One step divides by 1 + h c / m.
    let light = Ship { thrust: 0.0, v0: 20.0, ..SHIP };
    let after =
        &course("semi-implicit-euler-implicit-drag", light.clone(), &light.start(), 3.0, 1)[0];
    assert!((after.v - 20.0 / 1.3).abs() < 1e-13, "{after:?}");
}

#[test]
fn verlet_with_exact_drag_decays_like_a_coasting_ship() {
    let coasting = Ship { thrust: 0.0, v0: 20.0, ..SHIP };
    for h in [0.1, 3.0, 40.0] {
        let start = coasting.start();
        for (step, found) in
            course("verlet-exact-drag", coasting.clone(), &start, h, 100).into_iter().enumerate()
        {
            let truth = coasting.exact(h * (step + 1) as f64, &start).expect("a closed form");
            assert!((found.v - truth.v).abs() < 1e-13 * start.v, "{h} s: {}, {}", found.v, truth.v);
        }
    }
}

#[test]
fn both_methods_keep_order_2_under_quadratic_drag() {
    for id in ["verlet-exact-drag", "exponential-rosenbrock-euler"] {
        let error = |steps: u32| {
            let h = 2.0 / f64::from(steps);
            let states = course(id, Air, &course_in_air(0.0), h, steps);
            let (found, truth) = (states.last().expect("some"), course_in_air(2.0));
            (found.q - truth.q).abs().max((found.v - truth.v).abs())
        };
        let order = (error(100) / error(200)).log2();
        assert!((order - 2.0).abs() < 0.1, "{id}: {order}");
    }
}

#[test]
fn coordinates_coupled_by_drag_decay_together() {
    /// Two coordinates whose velocities turn into each other, and die away.
    struct Coupled;
    impl System for Coupled {
        type Vector = glam::DVec2;
        fn acceleration(&self, _t: f64, _q: &glam::DVec2, v: &glam::DVec2, a: &mut glam::DVec2) {
            *a = glam::DVec2::new(-0.5 * v.x + 3.0 * v.y, -3.0 * v.x - 0.5 * v.y);
        }
    }
    let mut state = State { q: glam::DVec2::ZERO, v: glam::DVec2::X };
    let (coupled, card) = (problem(Coupled), method("verlet-exact-drag").expect("a method"));
    let mut integrator = integrator(card, &state.q);
    for step in 0..10 {
        integrator.step(&coupled, 0.7 * f64::from(step), 0.7, &mut state).unwrap();
    }
    let (decay, angle) = (libm::exp(-3.5), 21.0);
    let truth = decay * glam::DVec2::new(libm::cos(angle), -libm::sin(angle));
    assert!((state.v - truth).length() < 1e-14, "{:?}, {truth:?}", state.v);
}

#[test]
fn sparse_and_dense_systems_take_the_same_steps_to_rounding() {
    let run = |id: &str, sparse: bool| -> Vec<f64> {
        fn steps<S: System<Vector = Vec<f64>> + 'static>(id: &str, system: &S) -> Vec<f64> {
            let like: Vec<f64> = (0..8).map(|i| 1.0 - 0.3 * f64::from(i)).collect();
            let mut state = State { q: like.clone(), v: like };
            let card = method(id).expect("a method");
            let mut integrator = integrator::<S>(card, &state.q);
            for i in 0..100 {
                integrator.step(system, 0.1 * f64::from(i), 0.1, &mut state).unwrap();
            }
            [state.q, state.v].concat()
        }
        let springs: Problem<Vec<f64>> = springs(9.0, 0.4);
        if sparse { steps(id, &Sparse(springs)) } else { steps(id, &springs) }
    };
    for id in [
        "linearly-implicit-euler",
        "semi-implicit-euler-implicit-drag",
        "verlet-exact-drag",
        "exponential-rosenbrock-euler",
        "tr-bdf2",
    ] {
        for (sparse, dense) in run(id, true).into_iter().zip(run(id, false)) {
            // The iteration's differences are forward ones, good to half the digits.
            assert!((sparse - dense).abs() < 1e-7, "{id}: {sparse}, {dense}");
        }
    }
}

#[test]
fn tr_bdf2_loses_less_of_an_orbit_than_bdf2() {
    let error = |id: &str| {
        let mut state = kepler_orbit(0.3, 0.0);
        let card = method(id).expect("a method");
        let mut integrator = integrator(card, &state.q);
        integrator.steps(&problem(Kepler), 0.0, 5.0, 400, &mut state).unwrap();
        (state.q - kepler_orbit(0.3, 5.0).q).length()
    };
    let [one, other] = ["tr-bdf2", "bdf2"].map(error);
    assert!(one < other / 2.0, "{one:e}, {other:e}");
}

#[test]
fn jakobsens_positions_follow_his_recurrence_without_a_velocity() {
    let (omega, h) = (5.0, 1.0 / 60.0);
    let start = State { q: 1.0, v: 0.7 };
    let states = course("jakobsen-verlet", spring(omega, 0.0), &start, h, 300);
    let (mut before, mut x) = (start.q - h * start.v, start.q);
    for State { q, v } in &states {
        let next = x + 0.99 * (x - before) - h * h * omega * omega * x;
        assert!((q - next).abs() < 1e-12 && (v - (next - x) / h).abs() < 1e-10, "{q}, {next}");
        (before, x) = (x, next);
    }
}

#[test]
fn jakobsens_drag_depends_on_the_tick_rate() {
    let coasting = Ship { thrust: 0.0, drag: 0.0, v0: 20.0, ..SHIP };
    let after_a_second = |rate: u32| {
        let h = 1.0 / f64::from(rate);
        course("jakobsen-verlet", coasting.clone(), &coasting.start(), h, rate)[rate as usize - 1].v
            / 20.0
    };
    for (rate, left) in [(30, 0.7397), (60, 0.5472), (144, 0.2352)] {
        let found = after_a_second(rate);
        assert!((found - 0.99_f64.powi(rate as i32)).abs() < 1e-14, "{rate} Hz: {found}");
        assert!((found - left).abs() < 5e-5, "{rate} Hz: {found}");
    }
}

#[test]
fn a_body_at_rest_under_forces_that_balance_stays_there() {
    /// A weight on a spring, away from its rest by rounding alone.
    struct Weight;
    impl System for Weight {
        type Vector = f64;
        fn acceleration(&self, _t: f64, q: &f64, v: &f64, a: &mut f64) {
            *a = -9.81 - 4e4 * (q + 0.3) - 2.0 * v;
        }
    }
    for id in [
        "linearly-implicit-euler",
        "semi-implicit-euler-implicit-drag",
        "verlet-exact-drag",
        "exponential-rosenbrock-euler",
    ] {
        let rest = State { q: -0.3 - 9.81 / 4e4, v: 0.0 };
        let states = course(id, Weight, &rest, 0.005, 10_000);
        let off = states.iter().map(|state| (state.q - rest.q).abs()).fold(0.0, f64::max);
        assert!(off < 1e-13, "{id}: {off:e}");
        assert_ne!(bits(&states[0]), [0, 0]);
    }
}
