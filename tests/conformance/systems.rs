//! The systems that methods are measured on, and a way to put a method on them.

use std::cell::RefCell;

use glam::DVec2;
use regatta::sim::bodies::{Ship, Spring};
use regatta::sim::integrators::{Integrator, Method, Tolerance, integrator};
use regatta::sim::{State, System, Vector};

/// A fresh integrator for systems of one coordinate.
pub(crate) fn fresh<S: System<Vector = f64> + 'static>(method: &Method) -> Box<dyn Integrator<S>> {
    integrator(method, &0.0)
}

/// A fresh integrator that takes the steps it is given: an adaptive one with a tolerance that does not
/// bind.
pub(crate) fn unbound<S: System + 'static>(
    method: &Method,
    like: &S::Vector,
) -> Box<dyn Integrator<S>> {
    let mut integrator = integrator(method, like);
    integrator.set_tolerance(Tolerance::uniform(1e100));
    integrator
}

/// A spring of this angular frequency and damping ratio.
pub(crate) fn spring(omega: f64, damping_ratio: f64) -> Spring {
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
pub(crate) const SHIP: Ship = Ship {
    thrust: 20_000.0,
    throttle: 1.0,
    drag: 1_000.0,
    mass: 10_000.0,
    s0: 0.0,
    v0: 0.0,
    kick: 20_000.0,
};

/// `q″ = -sin q`.
pub(crate) struct Pendulum;

impl System for Pendulum {
    type Vector = f64;
    fn acceleration(&self, _t: f64, q: &f64, _v: &f64, a: &mut f64) {
        *a = -libm::sin(*q);
    }
}

/// A point about a fixed centre of attraction, `q″ = -q / |q|³`.
pub(crate) struct Kepler;

impl System for Kepler {
    type Vector = DVec2;
    fn acceleration(&self, _t: f64, q: &DVec2, _v: &DVec2, a: &mut DVec2) {
        *a = -*q / (q.length_squared() * q.length());
    }
}

/// The state on the orbit of half axis 1 and this eccentricity, `t` after periapsis; the period is 2π.
pub(crate) fn kepler_orbit(eccentricity: f64, t: f64) -> State<DVec2> {
    let e = eccentricity;
    // Kepler's equation E - e sin E = t by Newton's method, which converges from E = π for every e.
    let mut anomaly = std::f64::consts::PI;
    for _ in 0..50 {
        let (sin, cos) = (libm::sin(anomaly), libm::cos(anomaly));
        anomaly -= (anomaly - e * sin - t) / (1.0 - e * cos);
    }
    let (sin, cos, b) = (libm::sin(anomaly), libm::cos(anomaly), (1.0 - e * e).sqrt());
    let rate = 1.0 / (1.0 - e * cos);
    State { q: DVec2::new(cos - e, b * sin), v: DVec2::new(-sin, b * cos) * rate }
}

/// As many independent damped springs as the vector has components.
pub(crate) struct Springs<V>(pub(crate) std::marker::PhantomData<V>);

impl<V: Vector> System for Springs<V> {
    type Vector = V;
    fn acceleration(&self, _t: f64, q: &V, v: &V, a: &mut V) {
        let pairs = q.components().iter().zip(v.components());
        for (a, (q, v)) in a.components_mut().iter_mut().zip(pairs) {
            *a = -9.0 * q - 0.4 * v;
        }
    }
}

/// Two coordinates: one under a force `power · t^(power - 1)` that only the time changes, one on a
/// spring stiff enough to make an adaptive method take many substeps. Remembers the times it is asked
/// for.
pub(crate) struct Timetable {
    pub(crate) power: i32,
    pub(crate) asked: RefCell<Vec<f64>>,
}

impl Timetable {
    pub(crate) fn new(power: i32) -> Self {
        Self { power, asked: RefCell::default() }
    }
}

impl System for Timetable {
    type Vector = DVec2;
    fn acceleration(&self, t: f64, q: &DVec2, _v: &DVec2, a: &mut DVec2) {
        self.asked.borrow_mut().push(t);
        a.x = match self.power {
            0 => 0.0,
            power => f64::from(power) * t.powi(power - 1),
        };
        a.y = -400.0 * q.y;
    }
}

/// The bits of a state, for comparing exactly.
pub(crate) fn bits<V: Vector>(state: &State<V>) -> Vec<u64> {
    state.q.components().iter().chain(state.v.components()).map(|x| x.to_bits()).collect()
}
