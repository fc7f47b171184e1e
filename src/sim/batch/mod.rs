//! Many copies of a body of one coordinate, each from its own start, stepped together.
//!
//! A method that steps each number by itself steps blocks of copies. Its formula file is compiled for `[f64; W]`
//! instead of `f64`, once per [`InstructionSet`], and the widest set of the processor runs. Other methods step copy by
//! copy. All methods share the work among the threads of rayon's pool. Neither the instruction set nor the number of
//! threads changes a bit, so that each copy has the state of a body stepped alone.

mod blocks;
mod instruction_set;
mod one_by_one;

use std::collections::TryReserveError;
use std::ops::Range;

use rayon::prelude::*;

use blocks::in_blocks;
pub use instruction_set::InstructionSet;
pub(crate) use instruction_set::Kernel;
use one_by_one::one_by_one;

use super::integrators::{Method, Problem, problem, steps_in_blocks};
use super::state::State;
use super::stepper::Solver;
use super::system::System;
use super::tick_rate::TickRate;

/// Consecutive ticks of one rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ticks {
    /// The time of tick 0 in seconds, as if every tick since then had this rate.
    pub origin: f64,
    /// Index of the first tick.
    pub first: u64,
    /// Number of ticks.
    pub count: u64,
    /// Ticks per second.
    pub hz: TickRate,
    /// Steps per tick.
    pub substeps: u32,
}

impl Ticks {
    /// Returns the first `count` ticks of a run.
    ///
    /// # Panics
    /// If the rate or the substeps are 0.
    #[track_caller]
    pub fn from_start(hz: impl Into<TickRate>, substeps: u32, count: u64) -> Self {
        Self { origin: 0.0, first: 0, count, hz: hz.into(), substeps }.checked()
    }

    #[track_caller]
    fn checked(self) -> Self {
        let Self { hz, substeps, .. } = self;
        assert!(
            hz > 0 && substeps > 0,
            "ticks of {hz} Hz and {substeps} substeps take no time; give at least 1 of each"
        );
        self
    }

    /// Returns the `count` ticks after these.
    pub fn next(self, count: u64) -> Self {
        Self { first: self.first + self.count, count, ..self }
    }

    /// Returns the time of a tick, in seconds.
    #[inline]
    pub fn t(self, tick: u64) -> f64 {
        self.origin + self.hz.seconds(tick)
    }

    /// Returns the length of a tick, in seconds.
    #[inline]
    pub fn h(self) -> f64 {
        self.hz.step_s()
    }

    /// Returns the length of a step, in seconds.
    #[inline]
    fn part(self) -> f64 {
        self.h() / f64::from(self.substeps)
    }
}

/// Advances the copies of a batch.
pub(crate) trait Advance: Send {
    /// Steps the copies with these coordinates and velocities through `ticks`.
    fn advance(&mut self, ticks: Ticks, q: &mut [f64], v: &mut [f64]);

    /// Clears the memory of the method.
    fn reset(&mut self);
}

/// Copies of a body of one coordinate, all under one method.
///
/// ```
/// # use regatta_sim::State;
/// # use regatta_sim::batch::{Batch, Ticks};
/// # use regatta_sim::integrators::method;
/// # use regatta_sim::System;
/// #[derive(Clone)]
/// struct Spring;
/// impl System for Spring {
///     type Vector = f64;
///     fn acceleration(&self, _t: f64, x: &f64, _v: &f64, a: &mut f64) {
///         *a = -40.0 * x;
///     }
/// }
/// let starts = (0..1000).map(|n| State { q: f64::from(n), v: 0.0 });
/// let mut batch = Batch::new(&Spring, method("rk4").unwrap(), starts)?;
/// batch.run(Ticks::from_start(60, 1, 600));
/// assert_eq!(batch.q().len(), 1000);
/// # Ok::<(), std::collections::TryReserveError>(())
/// ```
pub struct Batch {
    /// The coordinates in whole blocks. The padding repeats the last copy.
    q: Vec<f64>,
    v: Vec<f64>,
    count: usize,
    advance: Box<dyn Advance>,
}

/// A batch, or an error if its copies do not fit into memory.
pub type NewBatch = Result<Batch, TryReserveError>;

/// Upper bounds on the memory of a copy, in bytes. A copy in a block needs its state and the method's memory, and a
/// copy that is stepped alone needs a whole integrator.
const BLOCK_BYTES: usize = 256;
const ALONE_BYTES: usize = 2048;

/// The number of copies is padded to a multiple of this number, which is a multiple of every block width.
const PADDING: usize = 32;

impl Batch {
    /// Makes one copy of `system` for each of these starts.
    ///
    /// # Errors
    /// If the copies do not fit into memory.
    pub fn new<S: OneCoordinate>(
        system: &S,
        method: &'static Method,
        starts: impl ExactSizeIterator<Item = State<f64>>,
    ) -> NewBatch {
        Self::on(InstructionSet::widest(), system, Solver::Method(method), starts)
    }

    /// Makes copies as [`Batch::new`] does, under a method that may have an override, on an instruction set that this
    /// processor must [have](InstructionSet::is_available).
    ///
    /// # Errors
    /// The same as for [`Batch::new`].
    ///
    /// # Panics
    /// If the solver is the truth.
    pub fn on<S: OneCoordinate>(
        set: InstructionSet,
        system: &S,
        solver: Solver,
        starts: impl ExactSizeIterator<Item = State<f64>>,
    ) -> NewBatch {
        Self::with(&Uniform(system.clone()), solver, starts, set)
    }

    pub(crate) fn with<C: Copies>(
        copies: &C,
        solver: Solver,
        starts: impl ExactSizeIterator<Item = State<f64>>,
        set: InstructionSet,
    ) -> NewBatch {
        assert!(set.is_available(), "this processor does not support {set:?}");
        Self::of(starts, |count, padded| {
            let blocks = solver.method().and_then(|method| in_blocks(copies, method, set, padded));
            blocks.or_else(|| one_by_one(copies, solver, count)).expect("a method")
        })
    }

    /// Makes a batch of copies with these starts. `advance` makes what steps them, for the number of copies and that in
    /// whole blocks, once there is room for the states.
    pub(crate) fn of(
        starts: impl ExactSizeIterator<Item = State<f64>>,
        advance: impl FnOnce(usize, usize) -> Box<dyn Advance>,
    ) -> NewBatch {
        let count = starts.len();
        let padded = count.next_multiple_of(PADDING);
        let [mut q, mut v] = [Vec::new(), Vec::new()];
        q.try_reserve_exact(padded)?;
        v.try_reserve_exact(padded)?;
        starts.for_each(|start| {
            q.push(start.q);
            v.push(start.v);
        });
        for numbers in [&mut q, &mut v] {
            numbers.resize(padded, numbers.last().copied().unwrap_or(0.0));
        }
        Ok(Self { q, v, count, advance: advance(count, padded) })
    }

    /// Checks that memory suffices for this number of copies under each of these solvers at once. Allocates nothing.
    ///
    /// # Errors
    /// If the memory does not suffice.
    pub fn find_room(
        copies: usize,
        solvers: impl IntoIterator<Item = Solver>,
    ) -> Result<(), TryReserveError> {
        let of_a_copy = |solver: Solver| match solver.method().is_some_and(steps_in_blocks) {
            true => BLOCK_BYTES,
            false => ALONE_BYTES,
        };
        let bytes: usize = solvers.into_iter().map(of_a_copy).sum();
        let mut room = Vec::<u8>::new();
        let reserved =
            room.try_reserve_exact(copies.saturating_mul(bytes).min(isize::MAX as usize));
        // Without this line, an optimiser drops the unused reservation.
        std::hint::black_box(&mut room);
        reserved
    }

    /// Steps every copy through `ticks`. A method with memory continues from the last run.
    ///
    /// If a copy blows up or its method gives up, the coordinate or the velocity of the copy is not finite.
    ///
    /// # Panics
    /// The same as for [`Ticks::from_start`].
    #[track_caller]
    pub fn run(&mut self, ticks: Ticks) {
        self.advance.advance(ticks.checked(), &mut self.q, &mut self.v);
    }

    /// Returns the coordinates, in the order of the starts.
    pub fn q(&self) -> &[f64] {
        &self.q[..self.count]
    }

    /// Returns the velocities, in the order of the starts.
    pub fn v(&self) -> &[f64] {
        &self.v[..self.count]
    }

    /// Changes the states, and restarts the method from them.
    pub fn change(&mut self, mut change: impl FnMut(&mut f64, &mut f64)) {
        self.q.iter_mut().zip(&mut self.v).for_each(|(q, v)| change(q, v));
        self.advance.reset();
    }
}

/// Copies of a body of one coordinate, to be stepped in blocks or one by one.
pub(crate) trait Copies: Clone + Send + Sync + 'static {
    /// Whether evaluations are interpreted; wide blocks then share the cost of each look-up.
    const IS_INTERPRETED: bool = false;

    /// The system of `W` copies.
    type Block<const W: usize>: System<Vector = [f64; W]>;

    /// Returns the system of `W` copies, on an instruction set.
    fn block<const W: usize>(&self, set: InstructionSet) -> Self::Block<W>;

    /// Returns the system of a single copy.
    fn alone(&self) -> Problem<f64>;
}

/// A system that a batch can step, because it has one coordinate and threads can share it.
pub trait OneCoordinate: System<Vector = f64> + Clone + Send + Sync + 'static {}

impl<S: System<Vector = f64> + Clone + Send + Sync + 'static> OneCoordinate for S {}

/// Identical copies.
#[derive(Clone)]
struct Uniform<S>(S);

/// A block of [`Uniform`].
pub(crate) struct UniformBlock<S, const W: usize>(pub(crate) S);

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

/// Copies in parts, which the threads of rayon's pool share.
///
/// Each part of neighbouring copies advances itself, so that one loop shares the work among threads for methods and
/// bodies of every type.
pub(crate) struct Chunks {
    grain: usize,
    parts: Vec<Box<dyn Advance>>,
}

impl Chunks {
    /// Splits `count` copies into parts of `grain`; the last part may be smaller.
    pub(crate) fn new(
        grain: usize,
        count: usize,
        part: impl FnMut(Range<usize>) -> Box<dyn Advance>,
    ) -> Self {
        let firsts = (0..count).step_by(grain);
        Self {
            grain,
            parts: firsts.map(|first| first..count.min(first + grain)).map(part).collect(),
        }
    }
}

impl Advance for Chunks {
    fn advance(&mut self, ticks: Ticks, q: &mut [f64], v: &mut [f64]) {
        let states = q.par_chunks_mut(self.grain).zip(v.par_chunks_mut(self.grain));
        let parts = self.parts.par_iter_mut().zip(states);
        parts.for_each(|(part, (q, v))| part.advance(ticks, q, v));
    }

    fn reset(&mut self) {
        self.parts.iter_mut().for_each(|part| part.reset());
    }
}
