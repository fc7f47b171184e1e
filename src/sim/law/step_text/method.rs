//! The lines of a method, which call the acceleration. A step advances all coordinates of a body together.

use std::ops::Range;

use super::{H, StepRegisters, StepText, V, X};
use crate::sim::law::tape::Call;

/// A call of the acceleration.
#[derive(Clone, Copy, Debug)]
pub struct StepCall {
    call: Call,
    /// The time of the call, as a fraction of the step.
    pub part: f64,
}

impl StepCall {
    /// Returns the calls of a text in the order in which they are made, given the slots of their times. The time of a
    /// call is the value of its slot in a step of 1 s from 0, with a velocity of 1 and without a force.
    pub(super) fn all(text: &StepText, times: Vec<u16>) -> Vec<Self> {
        let mut slots = text.registers().slots;
        (slots[X], slots[V], slots[H]) = (0.0, 1.0, 1.0);
        text.tape.prepare::<1>(slots.as_chunks_mut().0);
        text.tape.evaluate(&mut slots);
        let part = |time: u16| Some(slots[usize::from(time)]).filter(|part| part.is_finite());
        let all = text.tape.calls().into_iter().zip(times);
        all.map(|(call, time)| Self { call, part: part(time).unwrap_or(0.0) }).collect()
    }
}

impl StepText {
    /// Returns the byte range of the first call of the acceleration, which makes the lines those of a method; `None`
    /// for a rule.
    pub fn acceleration_at(&self) -> Option<Range<usize>> {
        self.call.clone()
    }

    /// Returns the calls of the acceleration, in order.
    pub fn calls(&self) -> &[StepCall] {
        &self.calls
    }

    /// Returns how many numbers a step needs per coordinate.
    pub fn slots(&self) -> usize {
        self.tape.slots
    }

    /// Returns the registers of a body with this many coordinates, before its first step by a method.
    pub fn method_registers(&self, coordinates: usize) -> StepRegisters {
        let one = self.registers();
        StepRegisters {
            slots: one.slots.repeat(coordinates),
            next: one.next,
            asked: [(); 3].map(|()| vec![0.0; coordinates]),
        }
    }

    /// Resets all carried numbers but `x` and `v` to their values before the first step.
    pub fn forget(&self, registers: &mut StepRegisters) {
        for slots in registers.slots.chunks_exact_mut(self.tape.slots) {
            for carried in self.carried.iter().filter(|carried| carried.input > V) {
                slots[carried.input] = carried.start;
            }
        }
    }

    /// Steps all coordinates by `h` seconds, and replaces positions and velocities. The arguments of `acceleration` are
    /// the time since the start of the step in seconds, positions, velocities and the output. A call in a block is made
    /// if the block runs for at least one coordinate. Never allocates.
    pub fn step_method(
        &self,
        registers: &mut StepRegisters,
        h: f64,
        [q, v]: [&mut [f64]; 2],
        mut acceleration: impl FnMut(f64, &[f64], &[f64], &mut [f64]),
    ) {
        let StepRegisters { slots, next, asked: [at, with, found] } = registers;
        let size = self.tape.slots;
        for ((slots, q), v) in slots.chunks_exact_mut(size).zip(&*q).zip(&*v) {
            (slots[X], slots[V]) = (*q, *v);
            if slots[H].to_bits() != h.to_bits() || h == 0.0 {
                slots[H] = h;
                self.tape.prepare::<1>(slots.as_chunks_mut().0);
            }
        }
        let mut done = 0;
        for StepCall { call, part } in &self.calls {
            let mut is_made = call.guard.is_none();
            for (i, slots) in slots.chunks_exact_mut(size).enumerate() {
                self.tape.evaluate_part(done..call.at, slots);
                (at[i], with[i]) = (slots[call.x], slots[call.v]);
                is_made |= call.guard.is_some_and(|guard| slots[guard] == 1.0);
            }
            done = call.at;
            if is_made {
                acceleration(part * h, at, with, found);
                let all = slots.chunks_exact_mut(size).zip(&*found);
                all.for_each(|(slots, found)| slots[call.to] = *found);
            }
        }
        for (i, slots) in slots.chunks_exact_mut(size).enumerate() {
            self.tape.evaluate_part(done..self.tape.length(), slots);
            for (next, output) in next.iter_mut().zip(&self.tape.outputs) {
                *next = slots[*output as usize];
            }
            for (next, carried) in next.iter().zip(&self.carried) {
                slots[carried.input] = *next;
            }
            (q[i], v[i]) = (slots[X], slots[V]);
        }
    }
}
