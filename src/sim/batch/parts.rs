//! Copies in parts, which the threads of rayon's pool share.

use std::ops::Range;

use super::{Advance, Ticks};
use crate::sim::cores::split;

/// Neighbouring copies, each part of which has its own way to advance: for methods and bodies of every type the threads
/// are shared by the same code.
pub(super) struct Parts {
    grain: usize,
    parts: Vec<Box<dyn Advance>>,
}

impl Parts {
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

impl Advance for Parts {
    fn advance(&mut self, ticks: Ticks, q: &mut [f64], v: &mut [f64]) {
        let all = Share { grain: self.grain, parts: &mut self.parts, q, v };
        split(all, Share::halve, |Share { parts, q, v, .. }| {
            parts.iter_mut().for_each(|part| part.advance(ticks, q, v));
        });
    }

    fn reset(&mut self) {
        self.parts.iter_mut().for_each(|part| part.reset());
    }
}

/// Neighbouring parts, and the states of their copies.
struct Share<'a> {
    grain: usize,
    parts: &'a mut [Box<dyn Advance>],
    q: &'a mut [f64],
    v: &'a mut [f64],
}

impl Share<'_> {
    /// Its halves; it itself if it is one part.
    fn halve(self) -> Result<[Self; 2], Self> {
        if self.parts.len() <= 1 {
            return Err(self);
        }
        let Self { grain, parts, q, v } = self;
        let middle = parts.len() / 2;
        let (near, far) = parts.split_at_mut(middle);
        let (q_near, q_far) = q.split_at_mut(middle * grain);
        let (v_near, v_far) = v.split_at_mut(middle * grain);
        Ok([
            Self { grain, parts: near, q: q_near, v: v_near },
            Self { grain, parts: far, q: q_far, v: v_far },
        ])
    }
}
