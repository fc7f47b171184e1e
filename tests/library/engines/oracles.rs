//! Known figures of the engines, taken from their logs.

use regatta::conformance::problems::fresh;
use regatta::sim::State;
use regatta::sim::integrators::method;

use super::log::Body;

/// The figures of an engine at its default substeps: the ship's speed and distance after 17 ticks at 2 Hz; at 60 Hz
/// the amplitude of an undamped spring of 1 Hz after 4 s, where springs with a twentieth and a fifth of critical
/// damping are after 1 s, where an undamped spring of 100 rad/s is after 1 and 2 ticks, and the amplitude of one
/// whose force is held after 6 s.
const FIGURES: [(&str, bool, [f64; 8]); 11] = [
    (
        "engine-box2d",
        false,
        [11.549110, 56.633678, 0.517963, 0.619153, 0.230253, 0.115229, -0.275091, 2.095187],
    ),
    (
        "engine-rapier",
        true,
        [11.274066, 56.934804, 0.719734, 0.672481, 0.252095, -0.006075, -0.527038, 2.095186],
    ),
    (
        "engine-avian",
        false,
        [11.516720, 56.249469, 0.803088, 0.690928, 0.258989, -0.043893, -0.636349, 2.274257],
    ),
    (
        "engine-jolt",
        false,
        [11.055713, 56.470718, 0.270149, 0.526508, 0.193604, 0.264706, -0.124568, 0.999096],
    ),
    (
        "engine-physx",
        false,
        [11.055713, 56.470718, 0.270148, 0.526508, 0.193604, 0.264706, -0.124568, 0.999096],
    ),
    (
        "engine-physx-tgs",
        false,
        [11.055713, 56.470718, 0.662913, 0.607454, 0.170708, -0.006076, -0.449069, 0.999096],
    ),
    (
        "engine-physx-tgs-56",
        false,
        [11.055713, 56.470718, 0.719734, 0.672481, 0.252095, -0.006076, -0.527038, 0.999096],
    ),
    (
        "engine-bullet",
        true,
        [11.740380, 59.792256, 0.999397, 0.729125, 0.273930, 0.937500, 0.816406, 0.999096],
    ),
    (
        "engine-chipmunk",
        true,
        [11.740380, 53.922067, 1.000603, 0.728626, 0.265387, 1.000000, -1.777778, 7.121911],
    ),
    (
        "engine-mujoco",
        true,
        [11.274066, 57.259338, 0.999397, 0.731468, 0.279034, -1.777778, 0.382716, 0.999096],
    ),
    (
        "engine-mujoco-rk4",
        true,
        [11.451701, 55.482990, 0.999998, 0.730093, 0.274965, -0.067387, -0.796595, 2.679149],
    ),
];

const HZ_1: f64 = std::f64::consts::TAU;

/// Where `body` is after `ticks` ticks at `hz`.
fn after(id: &str, body: &Body, hz: f64, ticks: u32, from: [f64; 2]) -> State<f64> {
    let method = method(id).expect("a method of the table");
    let mut state = State { q: from[0], v: from[1] };
    let (body, mut engine) = (body.problem(), fresh(method));
    for tick in 0..ticks {
        let t = f64::from(tick) / hz;
        engine.steps(&body, t, 1.0 / hz, method.default_substeps, &mut state).unwrap();
    }
    state
}

fn spring(omega: f64, ratio: f64) -> Body {
    let spring = [omega * omega, 2.0 * ratio * omega];
    Body { spring, drag: 0.0, push: 0.0, is_held: false }
}

#[test]
fn published_figures_of_engines_are_reproduced_to_their_digits() {
    for (id, is_f64, wanted) in FIGURES {
        let ship = Body { spring: [0.0; 2], drag: 0.1, push: 2.0, is_held: false };
        let sailed = after(id, &ship, 2.0, 17, [0.0; 2]);
        let amplitude = |body: &Body, ticks| {
            let State { q, v } = after(id, body, 60.0, ticks, [1.0, 0.0]);
            (q * q + v * v / (HZ_1 * HZ_1)).sqrt()
        };
        let x = |omega, ratio, ticks| after(id, &spring(omega, ratio), 60.0, ticks, [1.0, 0.0]).q;
        let found = [
            sailed.v,
            sailed.q,
            amplitude(&spring(HZ_1, 0.0), 240),
            x(HZ_1, 0.05, 60),
            x(HZ_1, 0.2, 60),
            x(100.0, 0.0, 1),
            x(100.0, 0.0, 2),
            amplitude(&Body { is_held: true, ..spring(HZ_1, 0.0) }, 360),
        ];
        // Engines that compute in single precision round in the last digits.
        let digit = if is_f64 { 0.51e-6 } else { 2.5e-6 };
        for (index, (found, wanted)) in found.into_iter().zip(wanted).enumerate() {
            let most = digit * wanted.abs().max(1.0);
            let off = (found - wanted).abs();
            assert!(off <= most, "{id}, figure {index}: {found:.7}, not {wanted}");
        }
    }
}

#[test]
fn rapier_moves_faster_than_its_reported_velocity() {
    // Driven for long: 20 m/s is where thrust and drag balance.
    let ship = Body { spring: [0.0; 2], drag: 0.1, push: 2.0, is_held: false };
    let [before, after] =
        [5_000, 5_001].map(|ticks| after("engine-rapier", &ship, 2.0, ticks, [0.0; 2]));
    let moved = (after.q - before.q) * 2.0;
    assert!((after.v - 20.0).abs() < 1e-9 && (moved - 20.625).abs() < 1e-6, "{after:?} {moved}");
}
