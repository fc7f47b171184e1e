//! Copies in parts, which the threads of rayon's pool share.

use std::ops::Range;

use rayon::prelude::*;

use super::{Advance, Ticks};

/// Neighbouring copies, each part of which has its own way to advance: for methods and bodies of every type the threads
/// are shared by the same code.
pub(super) struct Chunks {
    grain: usize,
    parts: Vec<Box<dyn Advance>>,
}

impl Chunks {
    /// `count` copies in parts of `grain` and a rest.
    pub(super) fn new(
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
