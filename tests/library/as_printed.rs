//! The chapter's listings as printed, errors included, tested against the figures of those errors.
//!
//! Bourg & Bywalec, *Physics for Game Developers*, 2nd edition, chapter 7.

use regatta::conformance::problems::{fresh, problem};
use regatta::sim::bodies::{Body, Ship, Spring};
use regatta::sim::integrators::{
    AdaptiveEulerAsPrinted, GENERAL_METHODS, Integrator, Method, Tolerance, method,
};
use regatta::sim::{Counted, State, System};

const SHIP: Ship = Ship {
    thrust: 20_000.0,
    throttle: 1.0,
    drag: 1_000.0,
    mass: 10_000.0,
    s0: 0.0,
    v0: 0.0,
    kick: 20_000.0,
};

/// The ship after each of the first `n` steps of `h`.
fn sail(id: &str, h: f64, n: u32) -> Vec<State<f64>> {
    let (ship, mut integrator) = (problem(SHIP), fresh(method(id).expect("a method")));
    let mut state = SHIP.start();
    let states = (0..n).map(|step| {
        integrator.step(&ship, h * f64::from(step), h, &mut state).unwrap();
        state
    });
    states.collect()
}

/// The three listings, and the chapter's Euler.
fn printed() -> impl Iterator<Item = &'static Method> {
    GENERAL_METHODS
        .iter()
        .filter(|method| method.id.ends_with("-as-printed") || method.id == "semi-implicit-euler")
}

#[test]
fn printed_listings_reproduce_their_distances_at_order_1() {
    let table = [
        ("semi-implicit-euler", 59.442864, 3.960, 1.00),
        ("improved-euler-as-printed", 58.303177, 2.820, 0.99),
        ("rk4-as-printed", 58.322053, 2.839, 1.00),
    ];
    let truth = SHIP.exact(8.5, &SHIP.start()).expect("a closed form").q;
    for (id, distance, error, order) in table {
        let found = sail(id, 0.5, 17)[16].q;
        assert!((found - distance).abs() <= 0.5001e-6, "{id}: {found:.8}");
        assert!((found - truth - error).abs() <= 0.5e-3, "{id}: off by {}", found - truth);
        let (coarse, fine) = (sail(id, 0.25, 34)[33].q, sail(id, 0.125, 68)[67].q);
        let found = ((coarse - truth) / (fine - truth)).log2();
        assert!((found - order).abs() <= 0.0051, "{id}: order {found}, the table says {order}");
    }
}

#[test]
fn printed_listings_have_the_speeds_of_the_intended_methods() {
    for (printed, meant) in
        [("improved-euler-as-printed", "improved-euler"), ("rk4-as-printed", "rk4")]
    {
        for (printed, meant) in sail(printed, 0.5, 40).into_iter().zip(sail(meant, 0.5, 40)) {
            assert_eq!(printed.v.to_bits(), meant.v.to_bits());
            assert!((printed.q - meant.q).abs() > 0.1);
        }
    }
}

#[test]
fn all_printed_listings_agree_on_a_force_of_position_alone() {
    assert_eq!(printed().count(), 4);
    let run = |method: &Method, damping: f64| {
        let spring = Spring { mass: 2.0, stiffness: 300.0, damping, x0: 1.0, v0: -0.4, kick: 1.0 };
        let mut integrator = fresh(method);
        let mut state = spring.start();
        let spring = problem(spring);
        for step in 0..400 {
            integrator.step(&spring, 0.05 * f64::from(step), 0.05, &mut state).unwrap();
        }
        assert!(state.q.is_finite() && state.v.is_finite(), "{}", method.id);
        state
    };
    let euler = method("semi-implicit-euler").expect("a method");
    let (undamped, damped) = (run(euler, 0.0), run(euler, 2.0));
    for method in printed() {
        let found = run(method, 0.0);
        let off = (found.q - undamped.q).abs().max((found.v - undamped.v).abs());
        assert!(off < 1e-12, "{}: off by {off:e}", method.id);
        let apart = (run(method, 2.0).q - damped.q).abs();
        assert_eq!(apart > 1e-6, method != euler, "{}: {apart:e} apart under drag", method.id);
    }
}

#[test]
fn adaptive_euler_as_printed_sails_in_slow_motion() {
    // The tolerance; the seconds simulated in 8.5 s, the speed then; and half a unit of their last digit.
    let table = [(1e-2, 8.3447, 11.50002), (1e-3, 2.5524, 4.53532), (1e-4, 0.7742, 1.49330)];
    for (absolute_v, simulated, speed) in table {
        let tolerance = Tolerance { absolute_q: f64::INFINITY, absolute_v, relative: 0.0 };
        let system = Counted::new(SHIP);
        let mut adaptive = AdaptiveEulerAsPrinted::with_tolerance(&0.0, tolerance);
        let mut state = SHIP.start();
        for tick in 0..17 {
            adaptive.step(&system, 0.5 * f64::from(tick), 0.5, &mut state).unwrap();
        }
        let lost = Integrator::<Counted<Ship>>::lost_time(&adaptive);
        assert!((8.5 - lost - simulated).abs() <= 0.5e-4, "{absolute_v}: {} s", 8.5 - lost);
        assert!((state.v - speed).abs() <= 0.5001e-5, "{absolute_v}: {} m/s", state.v);
        // Three a tick, and a fourth where the step is cut: improved Euler needs two.
        let evaluations = system.evaluations();
        assert!((17 * 3..=17 * 4).contains(&evaluations), "{evaluations} evaluations");
        assert_eq!(evaluations == 17 * 4, absolute_v < 1e-2, "{evaluations} evaluations");
    }
}

/// `q″ = t`.
struct Rising;

impl System for Rising {
    type Vector = f64;
    fn acceleration(&self, t: f64, _q: &f64, _v: &f64, a: &mut f64) {
        *a = t;
    }
}

#[test]
fn adaptive_euler_as_printed_sees_a_force_change_within_the_step() {
    let card = method("adaptive-euler-as-printed").expect("a method");
    let rising = problem(Rising);
    let mut integrator = fresh(card);
    let mut state = State { q: 0.0, v: 0.0 };
    integrator.step(&rising, 3.0, 0.5, &mut state).unwrap();
    let lost = integrator.lost_time();
    // The second half step feels a force greater by h/2: e = h² / 4.
    let h = 0.5 * (1e-3_f64 / 0.0625).sqrt();
    assert!((0.5 - lost - h).abs() < 1e-12, "{lost}");
    assert!((state.v - 3.0 * h).abs() < 1e-12, "{state:?}");
}

#[test]
fn the_card_of_adaptive_euler_has_the_tolerance_that_loses_2_55_s() {
    let card = method("adaptive-euler-as-printed").expect("a method");
    let ship = problem(SHIP);
    let mut integrator = fresh(card);
    let mut state = SHIP.start();
    for tick in 0..17 {
        integrator.step(&ship, 0.5 * f64::from(tick), 0.5, &mut state).unwrap();
    }
    assert_eq!(card.tolerance.expect("a tolerance").absolute_v, 1e-3);
    assert!((8.5 - integrator.lost_time() - 2.55).abs() <= 0.5e-2);
}
