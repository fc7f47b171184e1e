//! A rule made of a person's own lines, which moves a body by itself.

use std::sync::Arc;

use super::failure::StepFailure;
use super::prelude::*;
use crate::law::{LinearRule, StepRegisters};
use crate::system::{Pursuit, Query};

/// A rule that steps each coordinate of a body towards the body's target, or towards 0 if it has none.
#[derive(Clone)]
pub(crate) struct StepRule {
    /// The rule, and the registers of its lines. If `None`, every step is refused.
    rule: Option<(Arc<LinearRule>, StepRegisters)>,
    pursuit: Option<Pursuit<Vec<f64>>>,
}

/// Returns room for a target of this many coordinates, so that no step allocates.
pub(super) fn room(coordinates: usize) -> Option<Pursuit<Vec<f64>>> {
    Some(Pursuit { target: vec![0.0; coordinates], rate: 0.0, order: 0, is_still: true })
}

impl StepRule {
    pub(crate) fn of(rule: Arc<LinearRule>, coordinates: usize) -> Self {
        let registers = rule.text().registers();
        Self { rule: Some((rule, registers)), pursuit: room(coordinates) }
    }
}

impl<S: System<Vector = Vec<f64>>> Integrator<S> for StepRule {
    /// Refuses every step, because only the card knows the lines.
    fn new(_like: &S::Vector) -> Self {
        Self { rule: None, pursuit: None }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let Some((rule, registers)) = &mut self.rule else {
            return Err(StepFailure::Refused { reason: "it was built without its card" });
        };
        if !system.query(t + h, Query::Target(&mut self.pursuit)) {
            self.pursuit = None;
        }
        let target = |i: usize| self.pursuit.as_ref().map_or(0.0, |found| found.target[i]);
        let moved = q.components_mut().iter_mut().zip(v.components_mut());
        for (i, (q, v)) in moved.enumerate() {
            rule.step(registers, h, target(i), [q, v]);
        }
        Ok(())
    }
}
