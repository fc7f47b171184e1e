//! Many copies of a body of one coordinate, from other starts, stepped at once.
//!
//! A method that steps each number by itself steps blocks of copies: its formula file is compiled for `[f64; W]` in place
//! of `f64`, for each [`InstructionSet`], and the widest that the processor has is taken. Other methods step copy by copy.
//! Both share the work between the threads of rayon's pool. Neither instruction set nor number of threads changes a bit:
//! each copy has the state that the body has alone.

mod blocks;
mod instruction_set;
mod one_by_one;

use std::collections::TryReserveError;
use std::ops::Range;

use rayon::prelude::*;

use blocks::in_blocks;
pub use instruction_set::InstructionSet;
#[cfg(feature = "lab")]
pub(in crate::sim) use instruction_set::Kernel;
use one_by_one::one_by_one;

use super::integrators::{Method, Problem, problem, steps_in_blocks};
use super::state::State;
use super::stepper::Solver;
use super::system::System;
use super::tick_rate::TickRate;

/// Consecutive ticks of one rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ticks {
    /// The time of tick 0 if it has this rate, in seconds.
    pub origin: f64,
    /// The first tick.
    pub first: u64,
    /// How many ticks.
    pub count: u64,
    /// Ticks per second.
    pub hz: TickRate,
    /// Steps in a tick.
    pub substeps: u32,
}

impl Ticks {
    /// The first ticks of a run.
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

    /// The ticks after these.
    pub fn next(self, count: u64) -> Self {
        Self { first: self.first + self.count, count, ..self }
    }

    /// The time of a tick, in seconds.
    #[inline]
    pub fn t(self, tick: u64) -> f64 {
        self.origin + self.hz.seconds(tick)
    }

    /// The length of a tick, in seconds.
    #[inline]
    pub fn h(self) -> f64 {
        self.hz.step_s()
    }

    /// The length of a step, in seconds.
    #[inline]
    fn part(self) -> f64 {
        self.h() / f64::from(self.substeps)
    }
}

/// What advances the copies of a batch.
trait Advance: Send {
    /// Steps the copies whose coordinates and velocities these are.
    fn advance(&mut self, ticks: Ticks, q: &mut [f64], v: &mut [f64]);

    /// Forgets what the method carries from step to step.
    fn reset(&mut self);
}

/// Copies of a body of one coordinate under one method.
///
/// ```
/// # use regatta::sim::State;
/// # use regatta::sim::batch::{Batch, Ticks};
/// # use regatta::sim::integrators::method;
/// # use regatta::sim::System;
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
    /// In whole blocks: those beyond the last copy are like the last.
    q: Vec<f64>,
    v: Vec<f64>,
    count: usize,
    advance: Box<dyn Advance>,
}

/// A batch, unless its copies do not fit into memory.
pub type NewBatch = Result<Batch, TryReserveError>;

/// The most memory of a copy in bytes: in blocks its state and what a method carries, alone an integrator of its own.
const BLOCK_BYTES: usize = 256;
const ALONE_BYTES: usize = 2048;

/// A multiple of every width of a block.
const PADDING: usize = 32;

impl Batch {
    /// Copies of `system` from these starts.
    ///
    /// # Errors
    /// If they do not fit into memory.
    pub fn new<S: OneCoordinate>(
        system: &S,
        method: &'static Method,
        starts: impl ExactSizeIterator<Item = State<f64>>,
    ) -> NewBatch {
        Self::on(InstructionSet::widest(), system, Solver::Method(method), starts)
    }

    /// As [`Batch::new`], under a method with what it replaces of its card, on an instruction set that this processor must
    /// [have](InstructionSet::is_available).
    ///
    /// # Errors
    /// As [`Batch::new`].
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

    pub(in crate::sim) fn with<C: Copies>(
        copies: &C,
        solver: Solver,
        starts: impl ExactSizeIterator<Item = State<f64>>,
        set: InstructionSet,
    ) -> NewBatch {
        assert!(set.is_available(), "this processor does not support {set:?}");
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
        let blocks = solver.method().and_then(|method| in_blocks(copies, method, set, padded));
        let advance = blocks.or_else(|| one_by_one(copies, solver, count)).expect("a method");
        Ok(Self { q, v, count, advance })
    }

    /// Whether memory suffices for this number of copies under each of these solvers at once. Allocates nothing.
    ///
    /// # Errors
    /// If it does not suffice.
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
        // An optimiser leaves out a reservation that nothing looks at.
        std::hint::black_box(&mut room);
        reserved
    }

    /// Steps every copy through `ticks`. A method with memory goes on from the last run.
    ///
    /// A copy that blows up has a coordinate or a velocity that is not finite, and so has one whose method gives up.
    ///
    /// # Panics
    /// As [`Ticks::from_start`].
    #[track_caller]
    pub fn run(&mut self, ticks: Ticks) {
        self.advance.advance(ticks.checked(), &mut self.q, &mut self.v);
    }

    /// The coordinates, in the order of the starts.
    pub fn q(&self) -> &[f64] {
        &self.q[..self.count]
    }

    /// The velocities, in the order of the starts.
    pub fn v(&self) -> &[f64] {
        &self.v[..self.count]
    }

    /// Changes the states, and restarts the method from them.
    pub fn change(&mut self, mut change: impl FnMut(&mut f64, &mut f64)) {
        self.q.iter_mut().zip(&mut self.v).for_each(|(q, v)| change(q, v));
        self.advance.reset();
    }
}

/// Copies of a body of one coordinate, as a batch steps them: in blocks, or each alone.
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
struct Uniform<S>(S);

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

/// Copies in parts, which the threads of rayon's pool share.
///
/// Each part of neighbouring copies has its own way to advance: for methods and bodies of every type the threads
/// are shared by the same code.
struct Chunks {
    grain: usize,
    parts: Vec<Box<dyn Advance>>,
}

impl Chunks {
    /// `count` copies in parts of `grain` and a rest.
    fn new(grain: usize, count: usize, part: impl FnMut(Range<usize>) -> Box<dyn Advance>) -> Self {
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
