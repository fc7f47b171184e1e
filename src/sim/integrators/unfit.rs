//! What stands for a method on a system that it cannot step.

use super::failure::StepFailure;
use super::integrator::Integrator;
use crate::sim::state::State;
use crate::sim::system::System;

/// A method that refuses every step.
#[derive(Clone)]
pub(super) struct Unfit {
    pub(super) reason: &'static str,
}

impl<S: System> Integrator<S> for Unfit {
    fn new(_like: &S::Vector) -> Self {
        unreachable!("it is built with its reason")
    }

    fn step(
        &mut self,
        _system: &S,
        _t: f64,
        _h: f64,
        _state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        Err(StepFailure::Refused { reason: self.reason })
    }
}
