//! A method made of a person's own lines, which are read at run time.

use super::failure::StepFailure;
use super::prelude::*;
use crate::sim::law::{StepRegisters, StepText};

/// A method made of lines that call the acceleration.
#[derive(Clone)]
pub(super) struct StepMethod<V> {
    /// The lines, and the numbers that they carry. If `None`, the method refuses every step.
    lines: Option<(&'static StepText, StepRegisters)>,
    q: V,
    v: V,
    a: V,
}

impl<V: Vector> StepMethod<V> {
    /// Returns the method of these lines, for coordinates shaped `like` these.
    pub(super) fn of(lines: &'static StepText, like: &V) -> Self {
        let registers = lines.method_registers(like.components().len());
        let [q, v, a] = [(); 3].map(|()| like.clone());
        Self { lines: Some((lines, registers)), q, v, a }
    }
}

impl<S: System<Vector: Vector>> Integrator<S> for StepMethod<S::Vector> {
    /// Refuses every step, because only the card knows the lines.
    fn new(like: &S::Vector) -> Self {
        let [q, v, a] = [(); 3].map(|()| like.clone());
        Self { lines: None, q, v, a }
    }

    fn step(&mut self, system: &S, t: f64, h: f64, state: &mut StateOf<S>) -> Stepped {
        let Self { lines, q, v, a } = self;
        let Some((lines, registers)) = lines else {
            return Err(StepFailure::Refused { reason: "it was built without its card" });
        };
        let moved = [state.q.components_mut(), state.v.components_mut()];
        lines.step_method(registers, h, moved, |since, at, with, found| {
            q.components_mut().copy_from_slice(at);
            v.components_mut().copy_from_slice(with);
            system.acceleration(t + since, q, v, a);
            found.copy_from_slice(a.components());
        });
        Ok(())
    }

    fn reset(&mut self) {
        if let Some((lines, registers)) = &mut self.lines {
            lines.forget(registers);
        }
    }
}
