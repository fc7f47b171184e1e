//! Kepler's problem from any state: ellipse, parabola, hyperbola.

use glam::DVec2;
use regatta::sim::State;
use regatta::sim::bodies::{Body, Input, Orbit};

use super::flow::{apart, flow, satisfies_its_equation, size};

const MU: f64 = 3.0;

fn orbit() -> Orbit {
    Orbit { mu: MU, q0: DVec2::new(1.0, 0.0), v0: DVec2::new(0.0, 1.0), kick: 0.5 }
}

/// A state at distance `r` on an orbit with eccentricity `e` and periapsis distance 1, moving inwards
/// or outwards, rotated by `angle`.
fn state(e: f64, r: f64, outwards: bool, angle: f64) -> State<DVec2> {
    let h2 = MU * (1.0 + e);
    let energy = MU * (e - 1.0) / 2.0;
    let across = h2.sqrt() / r;
    let along = (2.0 * (energy + MU / r) - across * across).max(0.0).sqrt();
    let along = if outwards { along } else { -along };
    let turn = DVec2::new(libm::cos(angle), libm::sin(angle));
    State { q: turn.rotate(DVec2::new(r, 0.0)), v: turn.rotate(DVec2::new(along, across)) }
}

/// Circles, ellipses flat and round, near-parabolic orbits and hyperbolas, in both directions.
fn states() -> Vec<(f64, State<DVec2>)> {
    let mut states = Vec::new();
    let eccentricities =
        [0.0, 1e-9, 0.1, 0.6, 0.95, 0.9999, 1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.001, 1.5, 4.0];
    for e in eccentricities {
        let farthest = if e < 1.0 { (1.0 + e) / (1.0 - e) } else { f64::INFINITY };
        for r in [1.0, 1.3, 5.0, 40.0].into_iter().filter(|&r| r <= farthest) {
            for outwards in [true, false] {
                let state = state(e, r, outwards, 0.8 * r + e);
                let mirrored = State { q: state.q.perp(), v: -state.v.perp() };
                states.extend([(e, state), (e, mirrored)]);
            }
        }
    }
    states
}

const STRIDES: [f64; 11] = [-30.0, -2.2, -0.4, -1e-4, 1e-7, 0.01, 0.3, 1.0, 4.0, 33.0, 700.0];

fn energy(state: &State<DVec2>) -> f64 {
    orbit().energy(state).expect("conserved")
}

/// The eccentricity vector.
fn eccentricity(State { q, v }: &State<DVec2>) -> DVec2 {
    -v.perp() * q.perp_dot(*v) / MU - *q / q.length()
}

/// The time scale on which the motion changes.
fn time_s(State { q, v }: &State<DVec2>) -> f64 {
    let r = q.length();
    (r * r * r / MU).sqrt().min(r / v.length())
}

#[test]
fn the_flow_satisfies_its_equation_from_any_state() {
    for (_, from) in states() {
        for dt in STRIDES.into_iter().chain([0.0]) {
            // Short compared to the time scale of the motion, since its derivatives grow at a periapsis.
            let time_s = time_s(&flow(&orbit(), dt, &from)) / 5.0;
            // A motion timed from far off is known to the rounding of that time.
            let late = 1e-14 * dt.abs() / time_s;
            satisfies_its_equation(&orbit(), &from, dt, time_s, 1e-10 + late);
        }
    }
}

#[test]
fn energy_angular_momentum_and_eccentricity_vector_are_conserved() {
    for (e, from) in states() {
        for dt in STRIDES {
            let to = flow(&orbit(), dt, &from);
            // A conserved quantity is a small difference of large terms, both far out and near in.
            let made_of = |s: &State<DVec2>| {
                let kinetic = s.v.length_squared() * s.q.length() / MU;
                (MU / s.q.length() * (1.0 + kinetic), s.q.length() * s.v.length(), 1.0 + kinetic)
            };
            let larger = |a: f64, b: f64| a.max(b);
            let (there, here) = (made_of(&to), made_of(&from));
            let drifts = [
                (energy(&to) - energy(&from)) / larger(there.0, here.0),
                (to.q.perp_dot(to.v) - from.q.perp_dot(from.v)) / larger(there.1, here.1),
                (eccentricity(&to) - eccentricity(&from)).length() / larger(there.2, here.2),
            ];
            let fine = drifts.iter().all(|drift| drift.abs() < 1e-14 * larger(10.0, here.2));
            assert!(fine, "{drifts:?}: {dt} s after {from:?}, e = {e}");
        }
    }
}

/// Seconds since the periapsis, by the textbook formulas.
fn since_periapsis(e: f64, state: &State<DVec2>) -> f64 {
    let (r, inwards) = (state.q.length(), state.q.dot(state.v) < 0.0);
    let a = 1.0 / (1.0 - e);
    let t = if e < 1.0 {
        let anomaly = libm::acos(((1.0 - r / a) / e).clamp(-1.0, 1.0));
        (anomaly - e * libm::sin(anomaly)) * (a * a * a / MU).sqrt()
    } else {
        let anomaly = libm::acosh(((1.0 - r / a) / e).max(1.0));
        (e * libm::sinh(anomaly) - anomaly) * (-a * a * a / MU).sqrt()
    };
    if inwards { -t } else { t }
}

#[test]
fn the_elapsed_time_satisfies_keplers_equation() {
    for e in [0.3, 0.6, 0.9, 1.5, 4.0] {
        let from = state(e, 1.3, false, 0.2);
        let begin = since_periapsis(e, &from);
        for dt in [0.4, 1.0, 2.0, 7.0, 50.0] {
            let passed = since_periapsis(e, &flow(&orbit(), dt, &from)) - begin;
            let off = if e < 1.0 {
                let period = std::f64::consts::TAU * ((1.0 - e).powi(-3) / MU).sqrt();
                libm::remainder(passed - dt, period)
            } else {
                passed - dt
            };
            // Near the apsides the anomaly is ill-conditioned.
            assert!(off.abs() < 1e-12 * (1.0 + dt), "{off:e} s after {dt} s at e = {e}");
        }
    }
}

#[test]
fn an_orbit_is_periodic_and_its_flow_composes() {
    for (e, from) in states() {
        if e <= 0.95 {
            let period = std::f64::consts::TAU * ((1.0 - e).powi(-3) / MU).sqrt();
            for rounds in [1.0, -3.0, 100.0] {
                let to = flow(&orbit(), rounds * period, &from);
                // The period is as well known as the energy, a difference.
                let rounding = 1e-14 * rounds.abs() * period / time_s(&from) / (1.0 - e);
                assert!(apart(&to.q, &from.q) < (1e-13 + rounding) * size(&from.q), "{from:?}");
            }
        }
        for (a, b) in [(0.3, 0.9), (4.0, -4.0), (-2.0, 33.0), (1e-7, 1.0)] {
            let between = flow(&orbit(), a, &from);
            let (twice, once) = (flow(&orbit(), b, &between), flow(&orbit(), a + b, &from));
            let (q, v) = (apart(&twice.q, &once.q), apart(&twice.v, &once.v));
            // The error of a position after a rounding error before it.
            let swept =
                (a.abs() + b.abs()) / time_s(&from).min(time_s(&between)).min(time_s(&once));
            // A fly-by from afar is a small difference of large times.
            let afar = |s: &State<DVec2>| s.q.length() * s.v.length_squared() / MU;
            let far = [&from, &between, &once].map(afar).into_iter().fold(1.0, f64::max);
            let tolerance = 1e-14 * (1.0 + swept) * far;
            let speed = size(&from.v).max(size(&once.v)).max(size(&between.v));
            let reach = size(&from.q).max(size(&once.q)).max(size(&between.q));
            assert!(
                q <= tolerance * reach && v <= tolerance * speed,
                "{q:e}, {v:e}: {a} and {b} s after {from:?}"
            );
        }
    }
}

#[test]
fn a_flow_over_no_time_is_the_identity_to_the_bit() {
    for (_, from) in states() {
        assert_eq!(flow(&orbit(), 0.0, &from), from);
    }
}

#[test]
fn a_fall_towards_the_centre_and_an_escape_are_accurate() {
    // From rest at 2, the fall takes π √(r³ / 8 μ).
    let from = State { q: DVec2::new(0.0, 2.0), v: DVec2::ZERO };
    let fall = std::f64::consts::PI * (1.0f64 / MU).sqrt();
    let near = flow(&orbit(), 0.999 * fall, &from);
    assert!(near.q.x == 0.0 && near.q.y > 0.0 && near.q.y < 0.1, "{near:?}");
    assert!((energy(&near) / energy(&from) - 1.0).abs() < 1e-11);
    // Far out on a hyperbola the speed is the square root of twice the energy.
    let from = state(4.0, 1.0, true, 0.0);
    let far = flow(&orbit(), 1e9, &from);
    assert!((far.v.length() / (2.0 * energy(&from)).sqrt() - 1.0).abs() < 1e-8, "{far:?}");
}

#[test]
fn the_flow_terminates_for_any_time_and_state() {
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random >> 11) as f64 / (1u64 << 53) as f64
    };
    for _ in 0..3000 {
        let mut any = |least: f64, most: f64| {
            let size = libm::exp10(least + (most - least) * next());
            if next() < 0.5 { size } else { -size }
        };
        let mu = any(-300.0, 15.0).abs();
        let from = State {
            q: DVec2::new(any(-300.0, 22.0), any(-300.0, 22.0)),
            v: DVec2::new(any(-300.0, 15.0), any(-300.0, 15.0)),
        };
        let dt = any(-323.0, 8.0);
        let body = Orbit { mu, ..orbit() };
        body.exact(dt, &from).expect("a closed form");
    }
    for (q, v) in [(DVec2::ZERO, DVec2::ONE), (DVec2::NAN, DVec2::ONE), (DVec2::ONE, DVec2::NAN)] {
        let to = orbit().exact(1.0, &State { q, v }).expect("a closed form");
        assert!(!to.q.is_finite());
    }
}

#[test]
fn a_tiny_time_does_not_move_a_fly_by() {
    let body = Orbit { mu: 1.0, q0: DVec2::new(100.0, 0.0), v0: DVec2::new(0.0, 3.0), kick: 0.0 };
    for dt in [1e-322, f64::from_bits(1), -1e-322, 1e-308] {
        let to = flow(&body, dt, &body.start());
        assert!(to.q.x == 100.0 && to.q.y.abs() < 1e-300 && to.v.x.abs() < 1e-300, "{to:?}");
    }
}

#[test]
fn a_kick_is_along_the_path() {
    let mut body = orbit();
    let mut state = State { q: DVec2::X, v: DVec2::new(3.0, 4.0) };
    assert!(body.input(Input::Kick(-2.0), &mut state));
    assert!((state.v - DVec2::new(2.4, 3.2)).length() < 1e-15);
    assert!(!body.input(Input::Rudder(1.0), &mut state));
    let mut still = State { q: DVec2::X, v: DVec2::ZERO };
    body.input(Input::Kick(1.0), &mut still);
    assert_eq!(still.v, DVec2::ZERO);
}
