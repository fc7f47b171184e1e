//! Steps copies in blocks, by the formula files of the methods.

use std::marker::PhantomData;
use std::ops::Range;

use super::instruction_set::{InstructionSet, Kernel, NARROW, WIDE};
use super::{Advance, Chunks, Copies, Ticks};
use crate::integrators::{Construct, Integrator, Method, MethodOf};
use crate::state::State;
use crate::system::System;

/// The number of copies that a thread handles at a time. Their state is 64 KiB, which fits the second-level cache of
/// every processor. The number is a multiple of every block width.
const GRAIN: usize = 1 << 12;

/// The number of copies that a thread steps through all ticks before it continues with the next ones. Their state of 4
/// KiB stays in the first-level cache. Unlike the ticks of one block, the blocks of these copies do not wait for each
/// other.
const TILE: usize = 256;

/// Builds the block stepper of `copies`; `None` if `method` does not step in blocks.
pub(super) fn in_blocks<C: Copies>(
    copies: &C,
    method: &Method,
    set: InstructionSet,
    count: usize,
) -> Option<Box<dyn Advance>> {
    if const { C::IS_INTERPRETED } {
        return construct::<C, 32>(copies, method, set, count);
    }
    match set.width() {
        WIDE => construct::<C, WIDE>(copies, method, set, count),
        _ => construct::<C, NARROW>(copies, method, set, count),
    }
}

fn construct<C: Copies, const W: usize>(
    copies: &C,
    method: &Method,
    set: InstructionSet,
    count: usize,
) -> Option<Box<dyn Advance>> {
    let make =
        Make::<C, W> { copies: copies.clone(), set, count, has_memory: method.restart.is_some() };
    crate::integrators::construct_in_blocks(method, make)
}

struct Make<C, const W: usize> {
    copies: C,
    set: InstructionSet,
    count: usize,
    has_memory: bool,
}

impl<C: Copies, const W: usize> Construct<C::Block<W>> for Make<C, W> {
    type Output = Box<dyn Advance>;

    fn of<I: MethodOf<C::Block<W>>>(self, new: impl FnOnce(&[f64; W]) -> I) -> Self::Output {
        let Self { copies, set, count, has_memory } = self;
        let integrator = new(&[0.0; W]);
        let part = |copies_of: Range<usize>| {
            let blocks = if has_memory { copies_of.len() / W } else { 0 };
            let memory = vec![integrator.clone(); blocks];
            let (copies, integrator) = (copies.clone(), integrator.clone());
            Box::new(Blocks::<C, I, W> { copies, set, integrator, memory }) as _
        };
        Box::new(Chunks::new(GRAIN, count, part))
    }
}

/// Copies under a method whose integrator is `I`.
struct Blocks<C, I, const W: usize> {
    copies: C,
    set: InstructionSet,
    /// An integrator before its first step.
    integrator: I,
    /// The integrator of each block; empty for a method without memory.
    memory: Vec<I>,
}

impl<C: Copies, I: Integrator<C::Block<W>> + Clone, const W: usize> Advance for Blocks<C, I, W> {
    fn advance(&mut self, ticks: Ticks, q: &mut [f64], v: &mut [f64]) {
        let Self { copies, set, integrator, memory } = self;
        let (system, integrator) = (copies.block::<W>(*set), integrator.clone());
        set.run(Grain { system, integrator, memory, ticks, q, v, of: PhantomData });
    }

    fn reset(&mut self) {
        self.memory.iter_mut().for_each(Integrator::reset);
    }
}

/// The blocks that one thread steps.
struct Grain<'a, S, I, const W: usize> {
    system: S,
    integrator: I,
    memory: &'a mut [I],
    ticks: Ticks,
    q: &'a mut [f64],
    v: &'a mut [f64],
    of: PhantomData<[f64; W]>,
}

impl<S, I, const W: usize> Kernel for Grain<'_, S, I, W>
where
    S: System<Vector = [f64; W]>,
    I: Integrator<S> + Clone,
{
    const WIDTH: Option<usize> = Some(W);

    #[inline(always)]
    fn run(self) {
        let Self { system, integrator, memory, ticks, q, v, of: _ } = self;
        let (q, v) = (q.as_chunks_mut::<W>().0, v.as_chunks_mut::<W>().0);
        let part = ticks.part();
        let tiles = q.chunks_mut(TILE / W).zip(v.chunks_mut(TILE / W)).enumerate();
        for (tile, (q, v)) in tiles {
            let tile = tile * (TILE / W);
            for tick in ticks.first..ticks.first + ticks.count {
                for substep in 0..ticks.substeps {
                    let t = ticks.t(tick) + part * f64::from(substep);
                    for (n, (q, v)) in q.iter_mut().zip(v.iter_mut()).enumerate() {
                        let mut own = memory.get(tile + n).unwrap_or(&integrator).clone();
                        let mut state = State { q: *q, v: *v };
                        let stepped = own.step(&system, t, part, &mut state);
                        debug_assert!(stepped.is_ok(), "a method for blocks never gives up");
                        (*q, *v) = (state.q, state.v);
                        if let Some(memory) = memory.get_mut(tile + n) {
                            *memory = own;
                        }
                    }
                }
            }
        }
    }
}
