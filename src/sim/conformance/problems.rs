//! Systems with known solutions, and integrators to run on them.

use glam::DVec2;

use crate::bodies::{Ship, Spring};
use crate::integrators::{Integrator, Method, Override, integrator};
use crate::state::{State, Vector};
use crate::system::System;

pub use crate::integrators::{Problem, fresh, problem};

/// Returns a fresh integrator that steps exactly as asked. If it is adaptive, its tolerance is set so large that it
/// never shortens a step.
pub fn fixed_step<V: Vector>(method: &Method, like: &V) -> Box<dyn Integrator<Problem<V>>> {
    let mut integrator = integrator(method, like);
    integrator.set(Override::tolerance(1e100));
    integrator
}

/// Returns a spring of this angular frequency (rad/s) and damping ratio.
pub fn spring(omega: f64, damping_ratio: f64) -> Spring {
    Spring {
        mass: 1.0,
        stiffness: omega * omega,
        damping: 2.0 * damping_ratio * omega,
        x0: 1.0,
        v0: 0.7 * omega,
        kick: 1.0,
    }
}

/// The chapter's ship.
pub const SHIP: Ship = Ship {
    thrust: 20_000.0,
    throttle: 1.0,
    drag: 1_000.0,
    mass: 10_000.0,
    s0: 0.0,
    v0: 0.0,
    kick: 20_000.0,
};

/// A pendulum, `q″ = -sin q`.
#[derive(Clone, Copy, Debug)]
pub struct UnitPendulum;

impl System for UnitPendulum {
    type Vector = f64;
    fn acceleration(&self, _t: f64, q: &f64, _v: &f64, a: &mut f64) {
        *a = -libm::sin(*q);
    }
}

/// A body that is pushed through air, `q″ = 1 - v |v|`.
#[derive(Clone, Copy, Debug)]
pub struct Air;

impl System for Air {
    type Vector = f64;
    fn acceleration(&self, _t: f64, _q: &f64, v: &f64, a: &mut f64) {
        *a = 1.0 - v * v.abs();
    }
}

/// Returns the state of a body in [`Air`] at time `t`, from rest at 0.
pub fn course_in_air(t: f64) -> State<f64> {
    State { q: libm::log(libm::cosh(t)), v: libm::tanh(t) }
}

/// A point about a fixed centre of attraction, `q″ = -q / |q|³`.
#[derive(Clone, Copy, Debug)]
pub struct Kepler;

impl System for Kepler {
    type Vector = DVec2;
    fn acceleration(&self, _t: f64, q: &DVec2, _v: &DVec2, a: &mut DVec2) {
        *a = -*q / (q.length_squared() * q.length());
    }
}

/// Returns the state on [`Kepler`]'s orbit of half axis 1, at time `t` after periapsis. The eccentricity is from 0 to
/// below 1, and the period is 2π.
pub fn kepler_orbit(eccentricity: f64, t: f64) -> State<DVec2> {
    let e = eccentricity;
    // Solves Kepler's equation E - e sin E = t by Newton's method, which converges from E = π for every e.
    let mut anomaly = std::f64::consts::PI;
    for _ in 0..50 {
        let (sin, cos) = (libm::sin(anomaly), libm::cos(anomaly));
        anomaly -= (anomaly - e * sin - t) / (1.0 - e * cos);
    }
    let (sin, cos, b) = (libm::sin(anomaly), libm::cos(anomaly), (1.0 - e * e).sqrt());
    let rate = 1.0 / (1.0 - e * cos);
    State { q: DVec2::new(cos - e, b * sin), v: DVec2::new(-sin, b * cos) * rate }
}

/// The distance of a point on [`Kepler`]'s orbit from the centre, for a method that steps one coordinate. The half axis
/// is 1.
#[derive(Clone, Copy, Debug)]
pub struct KeplerRadius {
    /// The eccentricity of the orbit.
    pub eccentricity: f64,
}

impl KeplerRadius {
    /// Returns the distance and its rate at time `t` after periapsis.
    pub fn at(&self, t: f64) -> State<f64> {
        let State { q, v } = kepler_orbit(self.eccentricity, t);
        State { q: q.length(), v: q.dot(v) / q.length() }
    }
}

impl System for KeplerRadius {
    type Vector = f64;
    fn acceleration(&self, _t: f64, q: &f64, _v: &f64, a: &mut f64) {
        let momentum = 1.0 - self.eccentricity * self.eccentricity;
        *a = (momentum / q - 1.0) / (q * q);
    }
}
