//! Bodies and methods that somebody else has written: a system and a start, or a step and a card, get all that
//! the built-in ones have.

mod bodies;
mod methods;
mod options;
mod runs;

use glam::DVec2;
use regatta::sim::System;

/// The built-in spring's equation, in the same order of operations.
#[derive(Clone, Debug)]
struct Spring {
    mass: f64,
    stiffness: f64,
    damping: f64,
}

impl System for Spring {
    type Vector = f64;
    fn acceleration(&self, _t: f64, x: &f64, v: &f64, a: &mut f64) {
        *a = -(self.stiffness / self.mass) * x - self.damping / self.mass * v;
    }
}

/// The built-in orbit's.
#[derive(Clone, Debug)]
struct Orbit {
    mu: f64,
}

impl System for Orbit {
    type Vector = DVec2;
    fn acceleration(&self, _t: f64, q: &DVec2, _v: &DVec2, a: &mut DVec2) {
        *a = -(self.mu / (q.length_squared() * q.length())) * *q;
    }
}
