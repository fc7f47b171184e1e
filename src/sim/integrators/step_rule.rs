//! A rule made of a person's own lines, which moves a body by itself.

use super::failure::StepFailure;
use super::prelude::*;
use crate::law::{LinearRule, StepRegisters};
use crate::system::Pursuit;

/// A rule that steps each coordinate of a body towards the body's target, or towards 0 if it has none.
#[derive(Clone)]
pub(super) struct StepRule {
    /// The rule, and the registers of its lines. If `None`, every step is refused.
    rule: Option<(&'static LinearRule, StepRegisters)>,
}

impl StepRule {
    pub(super) fn of(rule: &'static LinearRule) -> Self {
        Self { rule: Some((rule, rule.text().registers())) }
    }
}

impl<S: System<Vector: Vector>> Integrator<S> for StepRule {
    /// Refuses every step, because only the card knows the lines.
    fn new(_like: &S::Vector) -> Self {
        Self { rule: None }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, State { q, v }: &mut StateOf<S>) -> Stepped {
        let Some((rule, registers)) = &mut self.rule else {
            return Err(StepFailure::Refused { reason: "it was built without its card" });
        };
        let pursuit = Pursuit::of(system, t + h);
        let target = |i: usize| pursuit.as_ref().map_or(0.0, |found| found.target.components()[i]);
        let moved = q.components_mut().iter_mut().zip(v.components_mut());
        for (i, (q, v)) in moved.enumerate() {
            rule.step(registers, h, target(i), [q, v]);
        }
        Ok(())
    }
}
