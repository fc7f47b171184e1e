//! Copies of a custom body of one coordinate, which threads do not share: each has one of its own.

use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};

use super::Custom;
use super::motion::Motion;
use crate::sim::batch::{Batch, Copies, InstructionSet, NewBatch, UniformBlock};
use crate::sim::integrators::Problem;
use crate::sim::solver::Solver;
use crate::sim::state::State;

#[derive(Clone)]
struct CustomCopies(Arc<Mutex<Box<dyn Motion>>>);

/// Copies of a body that is custom; `None` if its coordinates are not one `f64`.
pub(super) fn batch(
    body: &dyn Any,
    set: InstructionSet,
    solver: Solver,
    starts: Vec<State<f64>>,
) -> Option<NewBatch> {
    let Custom { motion, .. } = body.downcast_ref()?;
    motion.alone()?;
    let copies = CustomCopies(Arc::new(Mutex::new(motion.clone())));
    Some(Batch::with(&copies, solver, starts.into_iter(), set))
}

impl Copies for CustomCopies {
    const IS_INTERPRETED: bool = true;
    type Block<const W: usize> = UniformBlock<Problem<f64>, W>;

    fn block<const W: usize>(&self, _set: InstructionSet) -> UniformBlock<Problem<f64>, W> {
        UniformBlock(self.alone())
    }

    fn alone(&self) -> Problem<f64> {
        let motion = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        motion.alone().expect("it was of one coordinate")
    }
}
