//! An eccentric orbit, and the truth that methods are compared with on it.

use regatta::conformance::problems::KeplerRadius;
use regatta::sim::System;
use regatta::sim::integrators::{integrator, method};

use super::systems::{Kepler, Problem, kepler_orbit, problem};

/// How far from periapsis ten orbits of eccentricity 0.6 end, at 200 steps an orbit.
fn after_ten_orbits(id: &str) -> f64 {
    let start = kepler_orbit(0.6, 0.0);
    let mut state = start;
    let mut integrator = integrator::<Problem<_>>(method(id).expect("a method"), &state.q);
    let (kepler, h) = (problem(Kepler), std::f64::consts::TAU / 200.0);
    for step in 0..2000 {
        integrator.step(&kepler, h * f64::from(step), h, &mut state).unwrap();
    }
    (state.q - start.q).length()
}

#[test]
fn kick_drift_kick_and_drift_kick_drift_differ_on_an_orbit() {
    for (id, listed) in [
        ("velocity-verlet", 1.0321129),
        ("stormer-verlet", 1.0321129),
        ("position-verlet", 0.2516829),
    ] {
        let found = after_ten_orbits(id);
        assert!((found - listed).abs() <= 0.5e-7, "{id}: {found:.9}, listed {listed}");
    }
}

#[test]
fn the_kepler_orbit_of_the_tests_solves_its_equation() {
    for e in [0.0, 0.3, 0.6] {
        for t in [0.0, 0.7, 2.0, 3.1, 5.0, 6.2] {
            let d = 1e-4;
            let [before, at, after] = [t - d, t, t + d].map(|t| kepler_orbit(e, t));
            let mut a = at.q;
            Kepler.acceleration(t, &at.q, &at.v, &mut a);
            let (v, found) = ((after.q - before.q) / (2.0 * d), (after.v - before.v) / (2.0 * d));
            assert!((v - at.v).length() < 1e-6 && (found - a).length() < 1e-6, "{e} at {t}");
            let radius = KeplerRadius { eccentricity: e };
            let [before, at, after] = [t - d, t, t + d].map(|t| radius.at(t));
            let mut a = 0.0;
            radius.acceleration(t, &at.q, &at.v, &mut a);
            let [v, found] = [after.q - before.q, after.v - before.v].map(|it| it / (2.0 * d));
            assert!((v - at.v).abs() < 1e-6 && (found - a).abs() < 1e-6, "{e} at {t}");
        }
        let home = (kepler_orbit(e, std::f64::consts::TAU).q - kepler_orbit(e, 0.0).q).length();
        assert!(home < 1e-13, "{e}: {home}");
    }
}
