//! The map of a step of every method, against the cards and the chapter's tables.

use regatta::sim::bodies::{Ship, Spring};
use regatta::sim::integrators::{DAMPING_RATIOS, GENERAL_METHODS, method};
use regatta::sim::stability::{FOREVER_S, RateSearch, Stability, Tick, normal_modes, unforced};
use regatta::sim::{Solver, Stepper, stepper};

use crate::conformance::limits::LONG_RUN;

fn spring(omega: f64, damping_ratio: f64) -> Box<dyn Stepper> {
    let spring = Spring {
        mass: 1.0,
        stiffness: omega * omega,
        damping: 2.0 * damping_ratio * omega,
        x0: 1.0,
        v0: 0.0,
        kick: 1.0,
    };
    stepper(spring, Solver::Truth)
}

/// The chapter's ship under part of its thrust and drag.
fn ship(drag: f64) -> Box<dyn Stepper> {
    let ship = Ship {
        thrust: 20_000.0,
        throttle: 1.0,
        drag,
        mass: 10_000.0,
        s0: 0.0,
        v0: 0.0,
        kick: 20_000.0,
    };
    stepper(ship, Solver::Truth)
}

fn in_steps(body: &dyn Stepper, id: &str, h: f64, substeps: u32) -> Stability {
    let modes = normal_modes(body).expect("a linear body");
    let [mode] = &modes[..] else { panic!("{modes:?}") };
    let solver = Solver::Method(method(id).expect("a method"));
    mode.stability(&*unforced(body), solver, Tick { t: 0.0, h, substeps })
        .expect("nothing fails so near")
}

fn of(body: &dyn Stepper, id: &str, h: f64) -> Stability {
    in_steps(body, id, h, 1)
}

/// The smallest `h ω` on the way up at which deviations grow, on a spring of 1 rad/s.
fn limit(id: &str, damping_ratio: f64) -> f64 {
    let body = spring(1.0, damping_ratio);
    let grows = |z: f64| of(&*body, id, z).spectral_radius > 1.0 + 1e-12;
    let first = (1..=500).map(|i| 0.01 * f64::from(i)).find(|&z| grows(z)).expect("a limit");
    let (mut low, mut high) = (first - 0.01, first);
    while high - low > 1e-7 {
        let middle = low.midpoint(high);
        if grows(middle) { high = middle } else { low = middle }
    }
    low
}

#[test]
fn the_map_has_the_limits_of_the_cards_or_those_of_long_runs() {
    for method in GENERAL_METHODS {
        let limits = method.stability_limit.zip(method.damped_limits);
        let (id, Some((undamped, one_step))) = (method.id, limits) else { continue };
        let carried = LONG_RUN.iter().find(|(carrying, _)| *carrying == id);
        let damped = carried.map_or(one_step, |(_, limits)| *limits);
        let ratios = [0.0].into_iter().chain(DAMPING_RATIOS);
        for (damping_ratio, wanted) in ratios.zip([undamped].into_iter().chain(damped)) {
            let found = limit(id, damping_ratio);
            // Where no step is small enough, a growth of z⁴/8 or z⁴/4 disappears in rounding first.
            let resolution = if wanted == 0.0 { 1e-2 } else { 0.6e-3 };
            let off = (found - wanted).abs();
            assert!(off <= resolution, "{id}, ζ = {damping_ratio}: {found:.5}, not {wanted}");
        }
    }
}

const HZ_1: f64 = std::f64::consts::TAU;

#[test]
fn the_1_hz_spring_doubles_and_halves_as_tabled() {
    const HOUR: f64 = 3600.0;
    const DAY: f64 = 24.0 * HOUR;
    // Seconds, and half a unit of the last digit that the table gives; negative where it halves.
    let table = [
        ("explicit-euler", 240, 8.43, 0.005),
        ("explicit-euler", 60, 2.12, 0.005),
        ("explicit-euler", 30, 1.08, 0.005),
        ("explicit-euler", 10, 0.42, 0.005),
        ("explicit-euler", 5, 0.29, 0.005),
        ("improved-euler", 240, 13.7 * HOUR, 0.05 * HOUR),
        ("improved-euler", 60, 769.0, 0.5),
        ("improved-euler", 30, 96.0, 0.5),
        ("improved-euler", 10, 3.6, 0.05),
        ("improved-euler", 5, 0.57, 0.005),
        ("implicit-euler", 240, -8.43, 0.005),
        ("implicit-euler", 60, -2.12, 0.005),
        ("implicit-euler", 30, -1.08, 0.005),
        ("implicit-euler", 10, -0.42, 0.005),
        ("implicit-euler", 5, -0.29, 0.005),
        ("rk4", 60, -14.6 * DAY, 0.05 * DAY),
        ("rk4", 30, -11.0 * HOUR, 0.5 * HOUR),
        ("rk4", 10, -171.0, 0.5),
        ("rk4", 5, -6.2, 0.05),
    ];
    let body = spring(HZ_1, 0.0);
    for (id, tick_hz, wanted, resolution) in table {
        let stability = of(&*body, id, 1.0 / f64::from(tick_hz));
        let found = match stability.doubling_s() {
            Some(doubling) => doubling,
            None => -std::f64::consts::LN_2 / stability.loss_per_s,
        };
        assert!((found - wanted).abs() <= resolution, "{id} at {tick_hz} Hz: {found} s");
    }
}

#[test]
fn symplectic_methods_are_bounded_with_the_tabled_frequency_errors() {
    // In percent, and half a unit of the last digit that the table gives.
    let table = [
        (240, 5e-4, 0.003, -0.006),
        (60, 5e-4, 0.046, -0.091),
        (30, 5e-3, 0.18, -0.36),
        (10, 0.05, 1.7, -3.1),
        (5, 0.05, 8.1, -10.7),
    ];
    let body = spring(HZ_1, 0.0);
    for (tick_hz, resolution, fast, slow) in table {
        for (id, percent) in [
            ("semi-implicit-euler", fast),
            ("velocity-verlet", fast),
            ("position-verlet", fast),
            ("stormer-verlet", fast),
            ("implicit-midpoint", slow),
            ("newmark", slow),
        ] {
            let stability = of(&*body, id, 1.0 / f64::from(tick_hz));
            assert!(stability.is_bounded(), "{id} at {tick_hz} Hz: {stability:?}");
            assert!(
                stability.loss_per_s * FOREVER_S < std::f64::consts::LN_2,
                "{id} at {tick_hz} Hz"
            );
            let found = 100.0 * stability.frequency_error.expect("it swings");
            assert!((found - percent).abs() <= resolution, "{id} at {tick_hz} Hz: {found} %");
        }
    }
}

#[test]
fn implicit_methods_are_bounded_at_every_step_and_damping() {
    for damping_ratio in [0.0, 0.05, 0.2, 1.0] {
        let body = spring(1.0, damping_ratio);
        for id in [
            "implicit-euler",
            "implicit-midpoint",
            "newmark",
            "bdf2",
            "gauss-legendre-4",
            "tr-bdf2",
            "linearly-implicit-euler",
            "exponential-rosenbrock-euler",
        ] {
            for z in [0.01, 0.1, 0.5, 1.0, 2.0, 5.0, 20.0] {
                let found = of(&*body, id, z);
                assert!(found.is_bounded(), "{id}, ζ = {damping_ratio}, z = {z}: {found:?}");
            }
        }
    }
}

#[test]
fn substeps_count_like_ticks_in_the_stability_map() {
    for omega in [HZ_1, 60.0] {
        let body = spring(omega, 0.1);
        for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
            let tick = in_steps(&*body, method.id, 0.06, 4);
            let step = of(&*body, method.id, 0.015);
            let [tick, step] = [tick.growth_per_s, step.growth_per_s];
            assert!((tick - step).abs() < 1e-9 * step.abs().max(1.0), "{}: {tick}", method.id);
        }
    }
}

#[test]
fn the_ship_is_neutral_and_stable_up_to_twice_its_time_constant() {
    let body = ship(1_000.0);
    for (h, bounded) in [(0.5, true), (15.0, true), (19.9, true), (20.1, false), (21.0, false)] {
        let found = of(&*body, "explicit-euler", h);
        assert_eq!(found.is_bounded(), bounded, "{h} s: {found:?}");
        assert_eq!(found.frequency_error, None);
        assert!(!bounded || (found.spectral_radius - 1.0).abs() < 1e-12, "{h} s: {found:?}");
    }
    // Without drag it is neutral twice over, which rounding must not turn into growth.
    for method in GENERAL_METHODS.iter().filter(|method| method.tolerance.is_none()) {
        let found = of(&*ship(0.0), method.id, 1.0 / 60.0);
        // Jakobsen's has a drag of its own: 0.99 sixty times a second.
        let loss = if method.order == 0 { -60.0 * libm::log(0.99) } else { 0.0 };
        assert!(found.is_bounded(), "{}: {found:?}", method.id);
        assert!((found.loss_per_s - loss).abs() < 1e-9, "{}: {found:?}", method.id);
    }
}

#[test]
fn a_kick_or_a_past_run_changes_only_the_state() {
    let mut body = spring(HZ_1, 0.0).with_solver(Solver::Method(&GENERAL_METHODS[0]), 0.0);
    let before = of(&*body, "rk4", 0.1);
    for tick in 0..7 {
        body.advance(0.1 * f64::from(tick), 0.1, 1).unwrap();
    }
    let (q, v, evaluations) = (body.q().to_vec(), body.v().to_vec(), body.evaluations());
    let after = of(&*body, "rk4", 0.1);
    assert!((before.spectral_radius - after.spectral_radius).abs() < 1e-14);
    assert_eq!((body.q(), body.v(), body.evaluations()), (&*q, &*v, evaluations));
}

#[test]
fn the_slowest_stable_rate_follows_from_the_limit() {
    let rate = |body: &dyn Stepper, id: &str| {
        RateSearch::run(|hz| of(body, id, 1.0 / f64::from(hz)).is_bounded())
    };
    let stiff = spring(100.0, 0.0);
    // At 50 Hz semi-implicit Euler is on the limit itself.
    assert!([Some(50), Some(51)].contains(&rate(&*stiff, "semi-implicit-euler")));
    assert_eq!(rate(&*stiff, "rk4"), Some(36));
    assert_eq!(rate(&*stiff, "explicit-euler"), None);
    // ζ = 0.05: 100 / 0.1, 100 / 0.8.
    let damped = spring(99.99, 0.05);
    assert_eq!(rate(&*damped, "explicit-euler"), Some(1000));
    assert_eq!(rate(&*damped, "improved-euler"), Some(125));
    assert_eq!(rate(&*ship(1_000.0), "explicit-euler"), Some(1));
    // Growth that takes a year to double is none.
    let hz = rate(&*spring(HZ_1, 0.0), "improved-euler").expect("a fast rate");
    let z = HZ_1 / f64::from(hz);
    let doubling = std::f64::consts::LN_2 * 8.0 / z.powi(3) / HZ_1;
    assert!((0.99..1.01).contains(&(doubling / FOREVER_S)), "{hz} Hz: {doubling} s");
}

/// The largest modulus of the roots of the two-step Adams-Bashforth method on `λ y`, `z = h λ`.
fn adams_bashforth_2([re, im]: [f64; 2]) -> f64 {
    // w² - (1 + 1.5 z) w + z / 2 = 0, by Newton from both sides of the circle.
    let mul = |a: [f64; 2], b: [f64; 2]| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
    let b = [1.0 + 1.5 * re, 1.5 * im];
    let square = mul(b, b);
    let d = [square[0] - 2.0 * re, square[1] - 2.0 * im];
    let (modulus, angle) = (libm::hypot(d[0], d[1]).sqrt(), libm::atan2(d[1], d[0]) / 2.0);
    let root = [modulus * libm::cos(angle), modulus * libm::sin(angle)];
    let half = |sign: f64| libm::hypot(b[0] + sign * root[0], b[1] + sign * root[1]) / 2.0;
    half(1.0).max(half(-1.0))
}

#[test]
fn the_map_of_a_multistep_method_includes_its_memory() {
    for damping_ratio in [0.0, 0.05, 0.5] {
        let body = spring(1.0, damping_ratio);
        for z in [0.01, 0.1, 0.3, 0.7, 1.0, 1.5] {
            let swing = (1.0 - damping_ratio * damping_ratio).sqrt();
            let wanted = adams_bashforth_2([-z * damping_ratio, z * swing]);
            let found = of(&*body, "adams-bashforth-2", z).spectral_radius;
            assert!(
                (found - wanted).abs() < 1e-9,
                "ζ = {damping_ratio}, z = {z}: {found}, {wanted}"
            );
        }
    }
    // The start is Heun's or the like, and grows at another rate.
    let (start, running) = (1.0 + 0.3_f64.powi(4) / 8.0, adams_bashforth_2([0.0, 0.3]));
    assert!((running - start).abs() > 1e-4);
}
