//! What stands for a method on a system that it cannot step.

use super::failure::{StepFailure, Stepped};
use super::integrator::Integrator;
use crate::sim::system::{StateOf, System};

/// A method that refuses every step.
#[derive(Clone)]
pub(super) struct Unfit {
    pub(super) reason: &'static str,
}

impl<S: System> Integrator<S> for Unfit {
    fn new(_like: &S::Vector) -> Self {
        Self { reason: "it was built without its card" }
    }

    fn step(&mut self, _system: &S, _t: f64, _h: f64, _state: &mut StateOf<S>) -> Stepped {
        Err(StepFailure::Refused { reason: self.reason })
    }
}
