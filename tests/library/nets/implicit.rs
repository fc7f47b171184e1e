//! The implicit methods on nets: their equations are solved without a matrix.

use regatta::sim::bodies::{Body, Input, Net};
use regatta::sim::integrators::{Family, METHODS, Method, StepFailure};
use regatta::sim::{Elementwise, Query, State, System, Vector};

use super::*;

/// The cloth of the scene, a hundred times as stiff: h ω is about 280 at 10 Hz.
fn stiff_cloth(id: &str) -> Box<dyn Stepper> {
    let values = Values { stiffness: 20_000.0, gravity: 9.81, ..PLAIN };
    build(&grid(24, 16, Some(Pin::Corners)), values, with(id))
}

#[test]
fn implicit_euler_is_stable_at_10_hz_on_the_stiff_cloth() {
    let mut cloth = stiff_cloth("implicit-euler");
    cloth.input(0.0, Input::Kick(1.0));
    let start = energy(&*cloth);
    let (mut last, mut highest) = (start, 0.0_f64);
    run(&mut *cloth, 10.0, 60, |tick, cloth| {
        let now = energy(cloth);
        assert!(now <= last + 1e-9 * start.abs(), "tick {tick}: {last} J to {now} J");
        highest = cloth.q().iter().fold(highest, |most, x| most.max(x.abs()));
        last = now;
    });
    assert!(last < start - 0.1, "{start} J to {last} J");
    // It has come to rest, near where it was hung.
    assert!(cloth.v().iter().all(|v| v.abs() < 1e-3) && highest < 3.0, "{highest} m");
    let mut explicit = stiff_cloth("semi-implicit-euler");
    explicit.input(0.0, Input::Kick(1.0));
    let blown = (0..60).any(|tick| {
        explicit.advance(f64::from(tick) / 10.0, 0.1, 1).unwrap();
        explicit.q().iter().any(|x| x.is_nan() || x.abs() > 1e6)
    });
    assert!(blown, "what explicit methods bear is no test of an implicit one");
}

#[test]
fn implicit_midpoint_keeps_a_cloths_energy_and_implicit_euler_does_not() {
    let exchanged = |id: &str| {
        let values = Values { stiffness: 2000.0, gravity: 9.81, ..PLAIN };
        let mut cloth = build(&grid(12, 8, Some(Pin::Corners)), values, with(id));
        cloth.input(0.0, Input::Kick(1.0));
        let start = energy(&*cloth);
        let kinetic = cloth.kinetic_energy().unwrap();
        run(&mut *cloth, 60.0, 300, |_, _| {});
        (energy(&*cloth) - start) / kinetic
    };
    let (kept, lost) = (exchanged("implicit-midpoint"), exchanged("implicit-euler"));
    assert!(kept.abs() < 0.4 && lost < -0.9, "{kept}, {lost}");
}

#[test]
fn a_step_solves_the_equations_of_implicit_euler_to_rounding() {
    let values = Values { damping: 0.3, drag: 0.01, gravity: 9.81, ..PLAIN };
    let mut net = build(&grid(10, 7, Some(Pin::Top)), values, with("implicit-euler"));
    net.input(0.0, Input::Kick(1.0));
    let (h, mut a) = (0.05, vec![0.0; net.q().len()]);
    for tick in 0..20 {
        let (q, v) = (net.q().to_vec(), net.v().to_vec());
        net.advance(tick as f64 * h, h, 1).unwrap();
        let (to, w) = (net.q().to_vec(), net.v().to_vec());
        net.acceleration(0.0, &to, &w, &mut a);
        for i in 0..q.len() {
            assert!((to[i] - (q[i] + h * w[i])).abs() < 1e-13, "tick {tick}, {i}");
            assert!((w[i] - (v[i] + h * a[i])).abs() < 1e-9, "tick {tick}, {i}");
        }
    }
}

#[test]
fn the_slope_of_the_force_matches_its_finite_differences() {
    let values = Values { damping: 0.3, drag: 0.02, gravity: 9.81, rest_ratio: 0.8, ..PLAIN };
    let stepper = build(&grid(4, 3, Some(Pin::Corners)), values, with("rk4"));
    let net = stepper.body().downcast_ref::<Net>().unwrap();
    let wave = |k: f64, size: f64| {
        (0..20).map(|i| size * libm::sin(k * f64::from(i) + 0.3)).collect::<Vec<_>>()
    };
    let start = net.start();
    let mut here = State { q: wave(1.7, 0.02), v: wave(0.9, 1.0) };
    here.q.add_scaled(1.0, &start.q);
    let along = State { q: wave(2.3, 1.0), v: wave(3.1, 5.0) };
    let mut slope = here.q.clone();
    let query = Query::Slope { state: &here, along: &along, slope: &mut slope };
    assert!(net.query(0.0, query));
    let at = |part: f64| {
        let mut moved = here.clone();
        moved.add_scaled(part, &along);
        let mut a = here.q.clone();
        net.acceleration(0.0, &moved.q, &moved.v, &mut a);
        a
    };
    let (ahead, behind) = (at(1e-6), at(-1e-6));
    let size = slope.components().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(size > 1000.0, "{size}");
    for (i, slope) in slope.components().iter().enumerate() {
        let difference = (ahead.components()[i] - behind.components()[i]) / 2e-6;
        assert!((slope - difference).abs() < 1e-6 * size, "{i}: {slope}, not {difference}");
    }
}

#[test]
fn unsolvable_equations_fail_within_bounded_work() {
    // Far beyond the convergence of Gauss and Legendre's two stages.
    let values = Values { stiffness: 2e9, gravity: 9.81, ..PLAIN };
    let mut net = build(&grid(16, 12, Some(Pin::Corners)), values, with("gauss-legendre-4"));
    net.input(0.0, Input::Kick(1.0));
    let failure = (0..10).find_map(|tick| net.advance(f64::from(tick) / 10.0, 0.1, 1).err());
    assert!(matches!(failure, Some(StepFailure::NewtonFailed { .. })), "{failure:?}");
    let evaluations = net.evaluations();
    assert!((1000..300_000).contains(&evaluations), "{evaluations} evaluations");
}

#[test]
fn no_implicit_method_keeps_a_matrix_for_a_net() {
    let plan = grid(100, 100, Some(Pin::Top));
    let with_equations =
        |method: &&Method| [Family::Implicit, Family::Linearised].contains(&method.family);
    for method in METHODS.iter().filter(with_equations) {
        let net = build(&plan, PLAIN, Solver::Method(method));
        let vectors = net.bytes(Solver::Method(method)) as f64 / size_of_val(net.q()) as f64;
        // A matrix of one stage would be as many vectors as there are coordinates, 20 000.
        assert!((3.0..80.0).contains(&vectors), "{}: {vectors} vectors", method.id);
    }
}
