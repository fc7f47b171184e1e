//! The accuracy of reference solutions, against a closed form and against Runge-Kutta at a step so fine
//! that its own error is known from two steps.

use regatta::scene::{SCENES, Scene, SceneBody};
use regatta::sim::bodies::{BODIES, Body, Input, Pendulum, Truth, kind};
use regatta::sim::integrators::{StepFailure, method};
use regatta::sim::{REFERENCE_ACCURACY, Solver, State, stepper};

/// The measured accuracy: the stated one less a margin.
const MEASURED: f64 = REFERENCE_ACCURACY / 20.0;

fn pendulum(theta0: f64, omega0: f64) -> Pendulum {
    Pendulum { length: 1.0, mass: 1.0, gravity: 9.81, damping: 0.0, theta0, omega0, kick: 1.0 }
}

/// K(k) by the arithmetic-geometric mean, and sn, cn, dn at `u` by descending Landen steps: Abramowitz &
/// Stegun 16.4.
fn elliptic(u: f64, k: f64) -> [f64; 3] {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    let mut steps = vec![];
    // Each doubles the digits.
    for _ in 0..7 {
        let c = (a - b) / 2.0;
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
        steps.push((a, c));
    }
    let mut phi = libm::ldexp(a * u, steps.len() as i32);
    for (a, c) in steps.iter().rev() {
        phi = (phi + libm::asin(c / a * libm::sin(phi))) / 2.0;
    }
    let sn = libm::sin(phi);
    [sn, libm::cos(phi), (1.0 - k * k * sn * sn).sqrt()]
}

/// The pendulum let go at rest from `theta0`, `t` seconds later: sin θ/2 = k sn(K - ω t), k = sin θ₀/2.
fn let_go(theta0: f64, t: f64) -> State<f64> {
    let (k, omega) = (libm::sin(theta0 / 2.0), 9.81f64.sqrt());
    // sn(K - u) = cd(u) = cn u / dn u.
    let [sn, cn, dn] = elliptic(omega * t, k);
    let half = k * cn / dn;
    let theta = 2.0 * libm::asin(half);
    // dθ/dt of that: -2 k ω √(1 - k²) sn u / dn u.
    State { q: theta, v: -2.0 * k * omega * (1.0 - k * k).sqrt() * sn / dn }
}

#[test]
fn the_closed_form_of_the_pendulum_satisfies_its_equation() {
    for theta0 in [0.1, 1.0, 2.8] {
        for t in [0.3, 1.0, 7.7] {
            let h = 1e-4;
            let slope = (let_go(theta0, t + h).q - let_go(theta0, t - h).q) / (2.0 * h);
            let bend = (let_go(theta0, t + h).v - let_go(theta0, t - h).v) / (2.0 * h);
            let here = let_go(theta0, t);
            assert!((slope - here.v).abs() < 1e-6, "{slope}, {here:?}");
            assert!((bend + 9.81 * libm::sin(here.q)).abs() < 1e-6, "{bend}, {here:?}");
        }
    }
}

#[test]
fn an_undamped_pendulum_follows_jacobis_elliptic_functions() {
    for theta0 in [0.01, 1.0, 2.0, 2.8] {
        for hz in [5, 60, 1000] {
            let mut reference = stepper(pendulum(theta0, 0.0), Solver::Truth);
            let mut worst = 0.0f64;
            for tick in 0..20 * hz {
                let (t, h) = (f64::from(tick) / f64::from(hz), 1.0 / f64::from(hz));
                reference.advance(t, h, 1).unwrap();
                let exact = let_go(theta0, t + h);
                let swing = 2.0 * 9.81f64.sqrt() * libm::sin(theta0 / 2.0);
                let q = (reference.q()[0] - exact.q).abs() / theta0;
                let v = (reference.v()[0] - exact.v).abs() / swing;
                worst = worst.max(q).max(v);
            }
            println!("{theta0} rad at {hz} Hz: {worst:.1e}");
            assert!(worst < MEASURED, "{worst:e} from {theta0} rad at {hz} Hz");
        }
    }
}

/// Steps a scene's body as the scene does, script left out, with `substeps` a tick; where it is at the
/// end, and the largest |q| and |v| on the way.
fn sail(scene: &Scene, body: &SceneBody, solver: Solver, substeps: u32) -> [Vec<f64>; 3] {
    let mut stepper = (body.kind.build)(&body.values, solver);
    stepper.input(0.0, Input::Rudder(0.4));
    let h = 1.0 / f64::from(scene.tick_hz);
    let (mut q, mut v) = (0.0f64, 0.0f64);
    for tick in 0..(scene.seconds / h).round() as u32 {
        stepper.advance(f64::from(tick) * h, h, substeps).unwrap();
        let most = |values: &[f64]| values.iter().fold(0.0, |most: f64, x| x.abs().max(most));
        (q, v) = (q.max(most(stepper.q())), v.max(most(stepper.v())));
    }
    [stepper.q().to_vec(), stepper.v().to_vec(), vec![q, v]]
}

#[test]
fn every_scenes_reference_agrees_with_runge_kutta_at_a_fine_step() {
    let mut count = 0;
    for scene in SCENES {
        let scene = Scene::built_in(scene.name).unwrap();
        for body in scene.bodies.iter().filter(|body| body.kind.truth == Truth::Reference) {
            let is_too_dear = (body.kind.build)(&body.values, Solver::Truth).is_beyond_reference();
            if is_too_dear {
                assert_eq!(scene.name, "cloth", "only a large net has no reference");
                continue;
            }
            count += 1;
            let truth = sail(&scene, body, Solver::Truth, 1);
            assert!(
                truth.iter().flatten().all(|x| x.is_finite()),
                "{} in {}",
                body.name,
                scene.name
            );
            let rk4 = |rate_hz: u32| {
                let solver = Solver::Method(method("rk4").unwrap());
                sail(&scene, body, solver, (rate_hz / scene.tick_hz.whole_hz().unwrap()).min(1000))
            };
            let gap = |one: &[Vec<f64>; 3], other: &[Vec<f64>; 3]| {
                let from = |part: usize| {
                    let pairs = one[part].iter().zip(&other[part]);
                    pairs.map(|(a, b)| (a - b).abs() / truth[2][part]).fold(0.0, f64::max)
                };
                from(0).max(from(1))
            };
            let has_corners = body.kind.law().is_some_and(|law| law.switches() > 0);
            let is_hard = has_corners || body.kind.net().is_some();
            // At 4 kHz its error is some 1e-12, except for the fast rotor; at 8 kHz rounding is larger for a motion
            // that spreads. A law with corners needs ten times that rate, and so does a net, whose stiff springs
            // whip.
            let rates: &[u32] = if is_hard { &[40_000] } else { &[4000, 8000] };
            let worst = rates.iter().map(|&hz| gap(&truth, &rk4(hz))).fold(f64::INFINITY, f64::min);
            println!("{} in {}: {worst:.1e}", body.name, scene.name);
            // Where a force jumps, as under the feet of who lands, it is of first order only.
            let own = if has_corners { gap(&rk4(rates[0]), &rk4(rates[0] / 2)) } else { 0.0 };
            assert!(own < 1e-8, "{own:e} of {} in {}", body.name, scene.name);
            // Runge-Kutta meets a corner within a step, which costs it digits at any rate. A rope whips, which
            // amplifies the rounding in either solution.
            let whips = if body.kind.net().is_some() { 10.0 } else { 1.0 };
            let most = if is_hard { whips * REFERENCE_ACCURACY } else { MEASURED };
            assert!(worst < most.max(2.0 * own), "{worst:e} of {} in {}", body.name, scene.name);
        }
    }
    assert!(count >= 2);
}

#[test]
fn a_kind_is_exact_if_and_only_if_its_bodies_have_a_closed_form() {
    let values = |id: &str| match id {
        "helm" => vec![1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 1.0],
        id => {
            let parameters = kind(id).unwrap().parameters.iter();
            parameters.map(|parameter| parameter.default.unwrap_or(1.0)).collect()
        }
    };
    for kind in BODIES.iter() {
        let mut truth = (kind.build)(&values(kind.id), Solver::Truth);
        // In one stride or in many: to the bit the same only where nothing is stepped.
        let mut many = (kind.build)(&values(kind.id), Solver::Truth);
        truth.advance(0.0, 0.75, 1).unwrap();
        for step in 0..3 {
            many.advance(0.25 * f64::from(step), 0.25, 1).unwrap();
        }
        let same = truth.q() == many.q() && truth.v() == many.v();
        assert_eq!(same, kind.truth == Truth::Exact, "{}", kind.id);
    }
}

#[test]
fn a_damped_pendulum_comes_to_rest_and_one_without_gravity_is_a_ship() {
    let body = Pendulum { gravity: 0.0, damping: 0.5, ..pendulum(0.0, 3.0) };
    let mut reference = stepper(body, Solver::Truth);
    for tick in 0..600 {
        reference.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    let (q, v) = (6.0 * -libm::expm1(-5.0), 3.0 * libm::exp(-5.0));
    assert!((reference.q()[0] / q - 1.0).abs() < 1e-12);
    assert!((reference.v()[0] / v - 1.0).abs() < 1e-11);

    let mut damped = stepper(Pendulum { damping: 2.0, ..pendulum(3.0, 0.0) }, Solver::Truth);
    for tick in 0..60 * 60 {
        damped.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    assert!(damped.q()[0].abs() < 1e-9 && damped.v()[0].abs() < 1e-9);
}

#[test]
fn kicks_and_placements_restart_the_reference_without_counting_evaluations() {
    let mut reference = stepper(pendulum(1.0, 0.0), Solver::Truth);
    reference.advance(0.0, 0.5, 1).unwrap();
    let (q, v) = (reference.q()[0], reference.v()[0]);
    assert!(reference.input(0.5, Input::Kick(2.0)));
    assert_eq!((reference.q()[0], reference.v()[0]), (q, v + 2.0));
    reference.advance(0.5, 0.5, 1).unwrap();
    let mut there = stepper(pendulum(q, v + 2.0), Solver::Truth);
    there.advance(0.5, 0.5, 1).unwrap();
    assert_eq!((reference.q(), reference.v()), (there.q(), there.v()));
    assert_eq!(reference.evaluations(), 0);
    reference.set(1.0, &[1.0], &[0.0]);
    reference.advance(1.0, 0.5, 1).unwrap();
    assert_eq!((reference.q()[0], reference.v()[0]), (q, v));
}

#[test]
fn a_motion_too_stiff_for_its_tick_fails_fast() {
    for (gravity, spent) in [(1e12, 3_900_000..4_100_000), (1e40, 200_000..210_000)] {
        let stiff = Pendulum { gravity, ..pendulum(1.0, 0.0) };
        let mut reference = stepper(stiff, Solver::Truth);
        let failure = reference.advance(0.0, 1.0, 1).unwrap_err();
        let StepFailure::ReferenceFailed { evaluations } = failure else { panic!("{failure:?}") };
        assert!(spent.contains(&evaluations), "{gravity}: {evaluations}");
    }
}

#[test]
fn a_failed_reference_fails_until_it_is_placed_again() {
    let stiff = Pendulum { gravity: 1e15, ..pendulum(1.0, 0.0) };
    let mut reference = stepper(stiff, Solver::Truth);
    let failure = reference.advance(0.0, 1.0, 1).unwrap_err();
    for tick in 1..=1000 {
        assert_eq!(reference.advance(f64::from(tick), 1.0, 1).unwrap_err(), failure);
    }
    assert!(reference.truth_error().unwrap().iter().all(|error| *error == f64::INFINITY));
    // Upright, where nothing pulls.
    reference.set(0.0, &[0.0], &[0.0]);
    reference.advance(0.0, 1.0, 1).unwrap();
    assert_eq!(reference.q(), [0.0]);
}

#[test]
fn the_total_work_of_a_stiff_body_is_limited() {
    let body = Pendulum { gravity: 1e7, ..pendulum(1.0, 0.0) };
    let mut reference = stepper(body, Solver::Truth);
    let failed = (0..100_000).find(|tick| reference.advance(f64::from(*tick), 1.0, 1).is_err());
    assert!(failed.is_some_and(|tick| (1..1000).contains(&tick)), "{failed:?}");
}

#[test]
fn a_stiff_scene_has_a_truth_or_fails_soon() {
    let pendulum = |length, damping| vec![length, 1.0, 9.81, damping, 1.0, 0.0, 1.0];
    let mut helm = Scene::built_in("helm").unwrap().bodies[0].values.clone();
    let keys = &kind("helm").unwrap().parameters;
    let side_drag = keys.iter().position(|key| key.key == "side_drag_n_s_per_m").unwrap();
    helm[side_drag] = 1e6;
    let cases = [
        ("pendulum", pendulum(1e-9, 0.0), false),
        ("pendulum", pendulum(1e-11, 0.0), false),
        ("pendulum", pendulum(1.0, 1e3), true),
        ("pendulum", pendulum(1.0, 1e7), false),
        ("helm", helm, true),
    ];
    for (id, values, has_one) in cases {
        for hz in [1, 60] {
            let mut body = (kind(id).unwrap().build)(&values, Solver::Truth);
            body.input(0.0, Input::Rudder(0.3));
            let h = 1.0 / f64::from(hz);
            let failed = (0..20 * hz).filter(|n| body.advance(f64::from(*n) * h, h, 1).is_err());
            assert_eq!(failed.count() == 0, has_one, "{id} {values:?} at {hz} Hz");
        }
    }
}

#[test]
fn an_error_survives_a_kick_but_not_a_placement() {
    for body in [pendulum(3.1, 0.0), pendulum(0.5, 60.0)] {
        let mut reference = stepper(body, Solver::Truth);
        for tick in 0..600 {
            reference.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
        }
        let [before, _] = reference.truth_error().unwrap();
        reference.input(10.0, Input::Kick(1e-3));
        let [after, _] = reference.truth_error().unwrap();
        assert!(before > 1e-14 && after >= before, "{before:e}, {after:e}");
        reference.set(10.0, &[1.0], &[0.0]);
        let [placed, _] = reference.truth_error().unwrap();
        assert!(placed <= f64::EPSILON, "{placed:e}");
    }
}

#[test]
fn the_error_of_a_closed_form_survives_a_kick() {
    let mut body = (kind("orbit").unwrap().build)(&[1.0, 1.0, 0.0, 0.0, 1.0, 0.1], Solver::Truth);
    body.advance(0.0, 1e6, 1).unwrap();
    let [before, _] = body.truth_error().unwrap();
    assert!(!body.input(1e6, Input::Rudder(0.5)));
    assert_eq!(body.truth_error().unwrap()[0], before);
    assert!(body.input(1e6, Input::Kick(1.0)));
    let [after, _] = body.truth_error().unwrap();
    assert!(before > 1e-11 && after >= 0.99 * before, "{before:e}, {after:e}");
    // On the new orbit it grows with the time, as the round takes another.
    body.advance(1e6, 1e4, 1).unwrap();
    assert!(body.truth_error().unwrap()[0] > 100.0 * before);
    body.set(1e6, &[1.0, 0.0], &[0.0, 1.0]);
    assert_eq!(body.truth_error(), Some([0.0; 2]));
}

#[test]
fn a_helm_that_settles_on_a_corner_of_its_curve_keeps_its_truth() {
    // Thrust and drag are equal at 10 m/s, where the curve bends.
    let curve = [0.0, 4000.0, 10.0, 2000.0, 15.0, 1900.0];
    let values = [1000.0, 1e4, 200.0, 500.0, 1e4, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0];
    let values: Vec<f64> = values.into_iter().chain(curve).collect();
    let mut reference = (kind("helm").unwrap().build)(&values, Solver::Truth);
    for tick in 0..60 * 600 {
        reference.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    assert!((reference.v()[0] - 10.0).abs() < 1e-12, "{:?}", reference.v());
    assert!(reference.truth_error().unwrap()[0] < 1e-8);
}

#[test]
fn the_energy_of_a_whirling_pendulum_is_conserved() {
    let body = pendulum(0.0, 7.0);
    let before = body.energy(&body.start()).unwrap();
    let mut reference = stepper(body, Solver::Truth);
    for tick in 0..1200 {
        reference.advance(f64::from(tick) / 60.0, 1.0 / 60.0, 1).unwrap();
    }
    assert!(reference.q()[0] > 50.0, "over the top again and again");
    assert!((reference.energy().unwrap() / before - 1.0).abs() < 1e-12);
}
