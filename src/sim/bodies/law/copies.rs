//! Copies of a law of one coordinate, whose tape runs over blocks.

use std::any::Any;
use std::array::{from_mut, from_ref};
use std::cell::RefCell;
use std::sync::Arc;

use super::{Law, known};
use crate::batch::{Batch, Copies, InstructionSet, Kernel, NewBatch};
use crate::integrators::{Problem, problem};
use crate::law::{Equations, LawLanes};
use crate::state::State;
use crate::stepper::Solver;
use crate::system::System;

/// Copies of a law of one coordinate.
#[derive(Clone)]
struct LawCopies {
    equations: Arc<Equations>,
    /// The values of [`Registers`](crate::law::Registers).
    values: Arc<[f64]>,
    /// Throttle and rudder.
    steering: [f64; 2],
}

/// Returns a batch of copies of a law; `None` if the law has several coordinates.
pub(super) fn batch(
    body: &dyn Any,
    set: InstructionSet,
    solver: Solver,
    starts: Vec<State<f64>>,
) -> Option<NewBatch> {
    let law: &Law = body.downcast_ref()?;
    let values = known(&law.equations, &law.values).into();
    let copies = LawCopies { equations: law.equations.clone(), values, steering: law.steering };
    let has_walls = law.equations.events() > 0;
    (law.coordinates() == 1 && !has_walls)
        .then(|| Batch::with(&copies, solver, starts.into_iter(), set))
}

/// A block of [`LawCopies`].
struct LawBlock<const W: usize> {
    equations: Arc<Equations>,
    lanes: RefCell<LawLanes<W>>,
    set: InstructionSet,
}

impl Copies for LawCopies {
    const IS_INTERPRETED: bool = true;
    type Block<const W: usize> = LawBlock<W>;

    fn block<const W: usize>(&self, set: InstructionSet) -> LawBlock<W> {
        let lanes = RefCell::new(LawLanes::new(&self.equations, &self.values, self.steering));
        LawBlock { equations: self.equations.clone(), lanes, set }
    }

    fn alone(&self) -> Problem<f64> {
        problem(LawAlone(self.block(InstructionSet::Portable)))
    }
}

impl<const W: usize> System for LawBlock<W> {
    type Vector = [f64; W];

    fn acceleration(&self, t: f64, q: &[f64; W], v: &[f64; W], a: &mut [f64; W]) {
        let Self { equations, lanes, set } = self;
        set.run(Evaluation { equations, lanes: &mut lanes.borrow_mut(), t, at: [q, v], a });
    }
}

/// The evaluation of a block. It is compiled apart from the methods, because its code is long.
struct Evaluation<'a, const W: usize> {
    equations: &'a Equations,
    lanes: &'a mut LawLanes<W>,
    t: f64,
    at: [&'a [f64; W]; 2],
    a: &'a mut [f64; W],
}

impl<const W: usize> Kernel for Evaluation<'_, W> {
    #[inline(always)]
    fn run(self) {
        self.equations.accelerate_lanes(self.lanes, self.t, self.at, self.a);
    }
}

/// A single copy, as a block with one copy.
struct LawAlone(LawBlock<1>);

impl System for LawAlone {
    type Vector = f64;

    fn acceleration(&self, t: f64, q: &f64, v: &f64, a: &mut f64) {
        self.0.acceleration(t, from_ref(q), from_ref(v), from_mut(a));
    }
}
