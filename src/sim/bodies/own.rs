//! A body of one's own: any [`System`] with a start.

use std::any::Any;
use std::cell::OnceCell;

use glam::DVec2;

use super::claims::{find_leak, find_unsolved};
use super::false_claims::FalseClaims;
use super::own_sheet::OwnSheet;
use super::survey::ranges;
use crate::sim::body::{Body, Input};
use crate::sim::engine_settings::EngineSettings;
use crate::sim::state::State;
use crate::sim::system::System;

mod claims;
mod extras;
mod kind;
mod motion;

pub use claims::OwnFault;
pub use extras::{Energy, Exact, Extras};
pub use kind::own_kind;
use motion::Motion;

/// A body of one's own. The type of its system is forgotten, so that it needs no code of its own here.
#[derive(Debug)]
pub struct Own {
    motion: Box<dyn Motion>,
    sheet: &'static OwnSheet,
    start: State<Vec<f64>>,
    /// The change of the velocity by one kick.
    kick: Vec<f64>,
    /// Whether the acceleration is linear.
    is_linear: bool,
    /// Whether the energy is conserved with the present parameters.
    conserves: OnceCell<bool>,
    /// Whether the exact solution is one with the present parameters.
    is_solved: OnceCell<bool>,
    ranges: OnceCell<Vec<(f64, f64)>>,
}

impl Clone for Own {
    fn clone(&self) -> Self {
        let Self { motion, sheet, start, kick, is_linear, conserves, is_solved, ranges } = self;
        Self {
            motion: motion.boxed_clone(),
            sheet,
            start: start.clone(),
            kick: kick.clone(),
            is_linear: *is_linear,
            conserves: conserves.clone(),
            is_solved: is_solved.clone(),
            ranges: ranges.clone(),
        }
    }
}

impl Own {
    /// What is known of it beside its motion.
    pub fn sheet(&self) -> &'static OwnSheet {
        self.sheet
    }

    /// The system with its present parameters; its type is the one that it was made of.
    pub fn system(&self) -> &dyn Any {
        self.motion.system()
    }

    /// What was told of it and does not hold with the present parameters.
    pub fn false_claims(&self) -> FalseClaims {
        let has_energy = || {
            let State { q, v } = &self.start;
            self.motion.energy(q, Some(v)).is_some()
        };
        let has_exact = || self.motion.exact(0.0, &mut self.start.clone());
        FalseClaims {
            energy: !self.conserves() && has_energy(),
            exact: !self.is_solved() && has_exact(),
        }
    }

    fn conserves(&self) -> bool {
        *self.conserves.get_or_init(|| find_leak(self).is_none())
    }

    fn is_solved(&self) -> bool {
        *self.is_solved.get_or_init(|| find_unsolved(self).is_none())
    }

    /// The least and the largest value of each coordinate in the first seconds of the motion, for drawing.
    pub fn ranges(&self) -> &[(f64, f64)] {
        self.ranges.get_or_init(|| ranges(self))
    }
}

impl System for Own {
    type Vector = Vec<f64>;

    fn acceleration(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        self.motion.acceleration(t, q, v, a);
    }

    fn engine_settings(
        &self,
        t: f64,
        State { q, v }: &State<Vec<f64>>,
        force: &mut Vec<f64>,
    ) -> Option<EngineSettings> {
        self.motion.engine_settings(t, q, v, force)
    }
}

impl Body for Own {
    fn with_parameters(mut self, values: &[f64]) -> Self {
        for (place, &value) in values.iter().enumerate() {
            self.motion.set(place, value);
        }
        self.prepare();
        // Before the first tick, which must not allocate.
        self.conserves();
        self.is_solved();
        self
    }

    fn set_parameter(&mut self, place: usize, value: f64) -> bool {
        let is_new = self.motion.set(place, value);
        if is_new {
            self.prepare();
        }
        is_new
    }

    fn prepare(&mut self) {
        self.ranges.take();
        self.conserves.take();
        self.is_solved.take();
    }

    fn heap_bytes(&self) -> usize {
        let vectors = 3 + self.motion.vectors();
        let ranges = self.ranges.get().map_or(0, |ranges| size_of_val(&ranges[..]));
        self.motion.bytes() + vectors * size_of_val(&self.start.q[..]) + ranges
    }

    fn start(&self) -> State<Vec<f64>> {
        self.start.clone()
    }

    fn exact(&self, _dt: f64, _from: &State<Vec<f64>>) -> Option<State<Vec<f64>>> {
        None
    }

    fn exact_since_start(&self, t: f64, to: &mut State<Vec<f64>>) -> bool {
        self.is_solved() && self.motion.exact(t, to)
    }

    fn is_linear(&self) -> bool {
        self.is_linear
    }

    fn is_angle(&self, coordinate: usize) -> bool {
        self.sheet.coordinates[coordinate][1] == "rad"
    }

    fn energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        if self.conserves() { self.motion.energy(&state.q, Some(&state.v)) } else { None }
    }

    fn kinetic_energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        Some(self.energy(state)? - self.motion.energy(&state.q, None)?)
    }

    fn input(&mut self, input: Input, state: &mut State<Vec<f64>>) -> bool {
        let Input::Kick(times) = input else { return false };
        state.v.iter_mut().zip(&self.kick).for_each(|(v, kick)| *v += times * kick);
        true
    }

    /// The coordinates of the plane, or the first coordinate to the right.
    fn place(&self, q: &Vec<f64>) -> DVec2 {
        match self.sheet.plane {
            Some([x, y]) => DVec2::new(q[x], q[y]),
            None => DVec2::new(q[0], 0.0),
        }
    }
}
