//! Copies of a system of one coordinate, as a batch steps them: in blocks, or each alone.

use super::instruction_set::InstructionSet;
use crate::sim::integrators::{Problem, problem};
use crate::sim::system::System;

/// Copies of a body of one coordinate.
pub(in crate::sim) trait Copies: Clone + Send + Sync + 'static {
    /// Whether an evaluation is interpreted; wide blocks share the cost of each look-up.
    const IS_INTERPRETED: bool = false;

    /// `W` copies at once.
    type Block<const W: usize>: System<Vector = [f64; W]>;

    /// `W` copies, on an instruction set.
    fn block<const W: usize>(&self, set: InstructionSet) -> Self::Block<W>;

    /// One copy.
    fn alone(&self) -> Problem<f64>;
}

/// A system that a batch can step: of one coordinate, and shared by threads.
pub trait OneCoordinate: System<Vector = f64> + Clone + Send + Sync + 'static {}

impl<S: System<Vector = f64> + Clone + Send + Sync + 'static> OneCoordinate for S {}

/// Identical copies.
#[derive(Clone)]
pub(super) struct Uniform<S>(pub(super) S);

/// A block of [`Uniform`].
pub(in crate::sim) struct UniformBlock<S, const W: usize>(pub(in crate::sim) S);

impl<S: OneCoordinate> Copies for Uniform<S> {
    type Block<const W: usize> = UniformBlock<S, W>;

    fn block<const W: usize>(&self, _set: InstructionSet) -> UniformBlock<S, W> {
        UniformBlock(self.0.clone())
    }

    fn alone(&self) -> Problem<f64> {
        problem(self.0.clone())
    }
}

impl<S: System<Vector = f64>, const W: usize> System for UniformBlock<S, W> {
    type Vector = [f64; W];

    #[inline(always)]
    fn acceleration(&self, t: f64, q: &[f64; W], v: &[f64; W], a: &mut [f64; W]) {
        for i in 0..W {
            self.0.acceleration(t, &q[i], &v[i], &mut a[i]);
        }
    }
}
