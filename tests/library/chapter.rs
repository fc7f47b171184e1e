//! The chapter's own figures, from the library: Table 7-1, the instabilities, growth on a spring, and
//! step doubling done right.
//!
//! Bourg & Bywalec, *Physics for Game Developers*, 2nd edition, chapter 7.

use regatta::conformance::problems::{fresh, problem};
use regatta::sim::bodies::{Body, Ship, Spring};
use regatta::sim::integrators::{AdaptiveEuler, Integrator, Tolerance, method};
use regatta::sim::{Counted, State};

const SHIP: Ship = Ship {
    thrust: 20_000.0,
    throttle: 1.0,
    drag: 1_000.0,
    mass: 10_000.0,
    s0: 0.0,
    v0: 0.0,
    kick: 20_000.0,
};

/// The times of Table 7-1, in steps of 0.5 s.
const TABLE_STEPS: [u32; 5] = [13, 14, 15, 16, 17];

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

fn exact(t: f64) -> State<f64> {
    SHIP.exact(t, &SHIP.start()).expect("a closed form")
}

/// As C's `%.7g` prints it, for numbers from 1e-4 up to 1e7.
fn seven_digits(x: f64) -> String {
    let digits_before = format!("{x:.6e}").rsplit('e').next().unwrap().parse::<i32>().unwrap();
    let fixed = format!("{x:.*}", (6 - digits_before).try_into().unwrap());
    match fixed.contains('.') {
        true => fixed.trim_end_matches('0').trim_end_matches('.').to_string(),
        false => fixed,
    }
}

#[test]
fn numbers_are_printed_as_c_prints_them() {
    let cases = [
        (10.246500418, "10.2465"),
        (9.7331583, "9.733158"),
        (11.45170136, "11.4517"),
        (9.99999999, "10"),
        (0.000123456789, "0.0001234568"),
        (1234567.8, "1234568"),
        (0.0, "0"),
    ];
    for (x, printed) in cases {
        assert_eq!(seven_digits(x), printed);
    }
}

/// The relative error of the speed at each time of the table, in percent.
fn percent_errors(id: &str) -> Vec<f64> {
    let states = sail(id, 0.5, 17);
    let errors = TABLE_STEPS.iter().map(|&step| {
        let truth = exact(0.5 * f64::from(step)).v;
        100.0 * (states[step as usize - 1].v - truth) / truth
    });
    errors.collect()
}

fn mean_magnitude(errors: &[f64]) -> f64 {
    errors.iter().map(|error| error.abs()).sum::<f64>() / errors.len() as f64
}

#[test]
fn table_7_1_is_printed_as_in_the_book() {
    let printed = [
        ("9.559084", "9.733158", "1.82%"),
        ("10.06829", "10.2465", "1.77%"),
        ("10.55267", "10.73418", "1.72%"),
        ("11.01342", "11.19747", "1.67%"),
        ("11.4517", "11.63759", "1.62%"),
    ];
    let euler = sail("explicit-euler", 0.5, 17);
    let errors = percent_errors("explicit-euler");
    for ((step, (truth, speed, error)), found) in TABLE_STEPS.iter().zip(printed).zip(errors) {
        assert_eq!(seven_digits(exact(0.5 * f64::from(*step)).v), truth);
        assert_eq!(seven_digits(euler[*step as usize - 1].v), speed);
        assert_eq!(format!("{found:.2}%"), error);
    }
}

#[test]
fn the_speeds_of_table_7_1_agree_to_the_last_digit() {
    let table = [
        ("explicit-euler", [9.733158334, 10.246500418, 10.734175397, 11.197466627, 11.637593296]),
        ("improved-euler", [9.556148145, 10.065285923, 10.549603234, 11.010310076, 11.448557460]),
        ("rk4", [9.559084096, 10.068293547, 10.552668560, 11.013420327, 11.451700966]),
    ];
    for (id, speeds) in table {
        let states = sail(id, 0.5, 17);
        for (step, speed) in TABLE_STEPS.into_iter().zip(speeds) {
            let found = states[step as usize - 1].v;
            assert!((found - speed).abs() <= 0.5001e-9, "{id} at step {step}: {found:.12}");
        }
    }
}

#[test]
fn the_error_columns_and_their_averages_agree() {
    let improved = [-0.03071759, -0.02987598, -0.02905153, -0.02824410, -0.02745357];
    for (found, printed) in percent_errors("improved-euler").into_iter().zip(improved) {
        assert!((found - printed).abs() <= 0.501e-8, "{found:.10}, printed {printed}");
    }
    // Seven digits of a difference of numbers that agree to eight: the last two are round-off's.
    let rk4 = [-3.855145e-6, -3.749481e-6, -3.645971e-6, -3.544600e-6, -3.445353e-6];
    for (found, printed) in percent_errors("rk4").into_iter().zip(rk4) {
        assert!((found / printed - 1.0).abs() < 1e-6, "{found:.6e}, printed {printed}");
    }
    let averages = [
        ("explicit-euler", 1.72107759, 0.501e-8),
        ("improved-euler", 0.02906855, 0.501e-8),
        ("rk4", 3.64811e-6, 0.501e-11),
    ];
    for (id, printed, tolerance) in averages {
        let found = mean_magnitude(&percent_errors(id));
        assert!((found - printed).abs() <= tolerance, "{id}: {found}, printed {printed}");
    }
}

#[test]
fn the_distances_run_after_8_5_s_agree_and_fall_with_the_methods_order() {
    let table = [
        ("explicit-euler", 53.624067, -1.859, 0.5e-3, 1.01),
        ("semi-implicit-euler", 59.442864, 3.960, 0.5e-3, 1.00),
        ("improved-euler", 55.514425, 3.14e-2, 0.5e-4, 2.01),
        ("rk4", 55.482990, 3.95e-6, 0.5e-8, 4.02),
    ];
    let truth = exact(8.5).q;
    for (id, distance, error, resolution, order) in table {
        let found = sail(id, 0.5, 17)[16].q;
        assert!((found - distance).abs() <= 0.5001e-6, "{id}: {found:.8}");
        assert!((found - truth - error).abs() <= resolution, "{id}: off by {}", found - truth);
        let (coarse, fine) = (sail(id, 0.25, 34)[33].q, sail(id, 0.125, 68)[67].q);
        let found = ((coarse - truth) / (fine - truth)).log2();
        assert!((found - order).abs() <= 0.0051, "{id}: order {found}, the table says {order}");
    }
}

#[test]
fn explicit_euler_shows_both_kinds_of_instability_on_the_ship() {
    let speeds = |h| -> Vec<f64> {
        sail("explicit-euler", h, 200).into_iter().map(|state| state.v).collect()
    };
    let begins = |h, wanted: [f64; 5], resolution: f64| {
        for (found, wanted) in speeds(h).into_iter().zip(wanted) {
            assert!((found - wanted).abs() <= resolution, "h = {h}: {found}, {wanted}");
        }
    };
    // Converges from one side, oscillates and converges, oscillates for ever, diverges.
    assert!(speeds(9.9).is_sorted());
    begins(15.0, [30.0, 15.0, 22.5, 18.75, 20.625], 1e-12);
    assert!((speeds(15.0).last().unwrap() - 20.0).abs() < 1e-12);
    begins(20.0, [40.0, 0.0, 40.0, 0.0, 40.0], 0.0);
    assert!(speeds(20.0).iter().step_by(2).all(|&v| v == 40.0));
    begins(21.0, [42.0, -4.2, 46.62, -9.282, 52.2102], 1e-12);
    assert!(speeds(21.0).last().unwrap().abs() > 1e9);
}

/// A spring of 1 Hz without drag.
fn one_hertz() -> Spring {
    let stiffness = 4.0 * std::f64::consts::PI * std::f64::consts::PI;
    Spring { mass: 1.0, stiffness, damping: 0.0, x0: 1.0, v0: 0.0, kick: 1.0 }
}

/// The amplitude after `n` steps of `h` from an amplitude of 1 at `phase`.
fn amplitude(id: &str, spring: &Spring, h: f64, n: u32, phase: f64) -> f64 {
    let omega = spring.angular_frequency();
    let (spring, mut integrator) = (problem(spring.clone()), fresh(method(id).expect("a method")));
    let mut state = State { q: libm::cos(phase), v: omega * libm::sin(phase) };
    for step in 0..n {
        integrator.step(&spring, h * f64::from(step), h, &mut state).unwrap();
    }
    libm::hypot(state.q, state.v / omega)
}

#[test]
fn one_step_multiplies_the_amplitude_as_the_formula_says() {
    type Square = fn(f64) -> f64;
    let formulas: [(&str, Square); 3] = [
        ("explicit-euler", |z| 1.0 + z * z),
        ("improved-euler", |z| 1.0 + z.powi(4) / 4.0),
        ("rk4", |z| 1.0 - z.powi(6) / 72.0 + z.powi(8) / 576.0),
    ];
    let spring = one_hertz();
    for (id, square) in formulas {
        for z in [1e-3, 0.1, 0.5, 1.0, 1.7, 2.5, 4.0] {
            for phase in [0.0, 0.4, 1.6, 3.0, 5.5] {
                let found = amplitude(id, &spring, z / spring.angular_frequency(), 1, phase);
                let error = (found * found / square(z) - 1.0).abs();
                assert!(error < 1e-12, "{id} at h ω = {z}: off by {error:e}");
            }
        }
    }
}

#[test]
fn semi_implicit_euler_conserves_its_own_energy() {
    let spring = one_hertz();
    let omega2 = spring.stiffness / spring.mass;
    let spring = problem(spring);
    for h in [1e-3, 1.0 / 60.0, 0.1, 0.3] {
        let conserved =
            |s: &State<f64>| (s.v * s.v + omega2 * s.q * s.q) / 2.0 - h / 2.0 * omega2 * s.q * s.v;
        let mut integrator = fresh(method("semi-implicit-euler").unwrap());
        let mut state = State { q: 0.8, v: -1.9 };
        let first = conserved(&state);
        let plain = |s: &State<f64>| (s.v * s.v + omega2 * s.q * s.q) / 2.0;
        let (mut least, mut most) = (plain(&state), plain(&state));
        for step in 0..10_000 {
            integrator.step(&spring, h * f64::from(step), h, &mut state).unwrap();
            let error = (conserved(&state) / first - 1.0).abs();
            assert!(error < 1e-11, "off by {error:e} after {step} steps of {h} s");
            (least, most) = (least.min(plain(&state)), most.max(plain(&state)));
        }
        assert!(most / least > 1.0 + h, "the plain energy is not conserved: {least} to {most}");
    }
}

#[test]
fn semi_implicit_euler_holds_the_stiff_spring_at_60_hz_and_loses_it_at_49() {
    let stiff = Spring { stiffness: 10_000.0, ..one_hertz() };
    let after = |tick_hz: u32, n| {
        amplitude("semi-implicit-euler", &stiff, 1.0 / f64::from(tick_hz), n, 0.0)
    };
    assert!((0..2000).all(|n| after(60, n) < 3.0));
    assert!(after(49, 200) > 1e20);
}

struct Doubling {
    tolerance: f64,
    speed: f64,
    accepted: u64,
    rejected: u64,
    /// As the chapter's table counts them: two an attempt.
    two_an_attempt: u64,
}

#[test]
fn step_doubling_agrees_with_the_oracles_of_the_chapter() {
    let table = [
        Doubling {
            tolerance: 1e-2,
            speed: 11.44911643,
            accepted: 27,
            rejected: 1,
            two_an_attempt: 56,
        },
        Doubling {
            tolerance: 1e-3,
            speed: 11.45142237,
            accepted: 62,
            rejected: 1,
            two_an_attempt: 126,
        },
        Doubling {
            tolerance: 1e-4,
            speed: 11.45167142,
            accepted: 182,
            rejected: 2,
            two_an_attempt: 368,
        },
    ];
    for Doubling { tolerance, speed, accepted, rejected, two_an_attempt } in table {
        let system = Counted::new(SHIP);
        let allowed = Tolerance { absolute_q: f64::INFINITY, absolute_v: tolerance, relative: 0.0 };
        let mut adaptive = AdaptiveEuler::with_tolerance(&0.0, allowed);
        let mut state = SHIP.start();
        for tick in 0..17 {
            adaptive.step(&system, 0.5 * f64::from(tick), 0.5, &mut state).unwrap();
        }
        assert!((state.v - speed).abs() <= 0.5001e-8, "tolerance {tolerance}: {:.10}", state.v);
        assert_eq!(adaptive.attempts(), (accepted, rejected));
        // The slope at the start of a substep outlives a rejection, so that ours cost one less each.
        assert_eq!(system.evaluations(), 2 * accepted + rejected);
        assert_eq!(system.evaluations() + rejected, two_an_attempt);
    }
}
