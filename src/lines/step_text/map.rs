//! The map of a step of a rule, with its derivatives and the pieces of its switches.

use std::ops::Range;

use super::{H, StepText, SwitchKind, TARGET};
use crate::jet::Jet;

/// The carried numbers after a step, and their derivatives with respect to each carried number and then the target.
#[derive(Clone, Debug, PartialEq)]
pub struct StepMap {
    /// The carried numbers, in the order of [`StepText::carried`].
    pub values: Vec<f64>,
    /// One column of derivatives per carried number, then one for the target.
    pub columns: Vec<Vec<f64>>,
}

impl StepText {
    /// Returns the map of a step of `h` seconds at these carried numbers and this target, with its exact derivatives.
    pub fn map(&self, h: f64, at: &[f64], target: f64) -> StepMap {
        self.map_on(&[], h, at, target)
    }

    /// Returns the map on the piece with these modes of the switches, continued beyond its boundaries.
    pub fn map_on(&self, modes: &[i64], h: f64, at: &[f64], target: f64) -> StepMap {
        let inputs = self.carried.iter().map(|carried| carried.input).chain([TARGET]);
        let mut slots: Vec<Jet> = vec![[0.0; 3]; self.tape.slots];
        let mut values = Vec::new();
        let mut column = |input: usize| {
            slots[H] = [h, 0.0, 0.0];
            slots[TARGET] = [target, 0.0, 0.0];
            for (carried, value) in self.carried.iter().zip(at) {
                slots[carried.input] = [*value, 0.0, 0.0];
            }
            slots[input][1] = 1.0;
            self.tape.evaluate_jets_on(modes, &mut slots);
            let outputs = self.tape.outputs.iter().map(|slot| slots[*slot as usize]);
            values = outputs.clone().map(|[value, ..]| value).collect();
            outputs.map(|[_, slope, _]| slope).collect()
        };
        let columns = inputs.map(&mut column).collect();
        StepMap { values, columns }
    }
}

impl StepText {
    /// Returns the modes of the switches in a step of `h` seconds from these carried numbers. An equality has mode 0
    /// where its numbers are equal, and else 1.
    pub fn modes(&self, h: f64, at: &[f64], target: f64) -> Vec<i64> {
        let mut slots = vec![0.0; self.tape.slots];
        (slots[H], slots[TARGET]) = (h, target);
        for (carried, value) in self.carried.iter().zip(at) {
            slots[carried.input] = *value;
        }
        self.tape.prepare::<1>(slots.as_chunks_mut().0);
        self.tape.evaluate(&mut slots);
        let mut modes = vec![0; self.tape.switches()];
        self.tape.write_modes(&slots, &mut modes);
        for (index, mode) in modes.iter_mut().enumerate().filter(|(_, mode)| **mode < 0) {
            *mode = if self.is_equality(index) { 1 } else { *mode };
        }
        modes
    }

    /// Returns for each switch the mode in which a limit leaves the number that moves; `None` if both or neither of its
    /// operands move.
    pub fn free_modes(&self) -> Vec<Option<i64>> {
        let sets = self.inputs_of_slots();
        let moving = self.carried.iter().fold(0, |set, carried| set | 1 << carried.input);
        let moves = |slot: u16| sets[usize::from(slot)] & moving != 0;
        let mode = |operands: [u16; 2]| match operands.map(moves) {
            [true, false] => Some(1),
            [false, true] => Some(0),
            _ => None,
        };
        self.tape.switch_operands().map(mode).collect()
    }

    /// Returns for each switch the earlier switches that decide what it compares, as a list of indices.
    pub fn switches_before(&self) -> Vec<Vec<usize>> {
        let slots: Vec<u16> = self.tape.switch_slots().collect();
        let mut deciding: Vec<Vec<usize>> = vec![Vec::new(); self.tape.slots];
        let mut found = vec![Vec::new(); slots.len()];
        for (_, operands, to, _) in self.tape.operations() {
            let mut all: Vec<usize> =
                operands.iter().flat_map(|slot| deciding[usize::from(*slot)].clone()).collect();
            all.sort_unstable();
            all.dedup();
            if let Some(index) = slots.iter().position(|slot| *slot == to) {
                found[index].clone_from(&all);
                all.push(index);
            }
            deciding[usize::from(to)] = all;
        }
        found
    }

    /// Returns the source of each switch of the lines, with its kind.
    pub fn switches(&self) -> impl Iterator<Item = (SwitchKind, &str)> {
        self.tape
            .switch_origins()
            .map(|(kind, span)| (kind, self.source.get(span.clone()).unwrap_or_default().trim()))
    }

    /// Returns whether the comparison with this index is true in a mode; `None` for a switch of another kind.
    pub fn truth(&self, index: usize, mode: i64) -> Option<bool> {
        self.tape.truth(index, mode)
    }

    /// Whether the switch with this index compares by `==` or `!=`.
    pub fn is_equality(&self, index: usize) -> bool {
        self.truth(index, 1).is_some_and(|truth| self.truth(index, -1) == Some(truth))
    }

    /// Returns the modes in a step of `h` seconds near a rest at 0, where no compared numbers are equal.
    pub fn modes_apart(&self, h: f64) -> Vec<i64> {
        let mut modes = self.modes(h, &vec![0.0; self.carried.len()], 0.0);
        for (index, mode) in modes.iter_mut().enumerate() {
            *mode += i64::from(*mode == 0 && self.is_equality(index));
        }
        modes
    }

    /// Returns the source of each condition of several comparisons, and its truth in each of these modes.
    pub fn joined(&self, h: f64, modes: &[Vec<i64>]) -> Vec<(&str, Vec<bool>)> {
        let mut slots = vec![0.0; self.tape.slots];
        slots[H] = h;
        self.tape.prepare::<1>(slots.as_chunks_mut().0);
        let mut truth = |slot: u16, modes: &Vec<i64>| {
            self.tape.evaluate_on(modes, &mut slots);
            slots[usize::from(slot)] == 1.0
        };
        let mut of = |slot: u16| modes.iter().map(|modes| truth(slot, modes)).collect();
        self.tape
            .joined()
            .map(|(slot, span)| (self.source.get(span.clone()).unwrap_or_default(), of(slot)))
            .collect()
    }

    /// Returns the source of each rounding that decides the next value of these carried numbers, and whose operand they
    /// move, with the derivatives of the operand near 0.
    pub fn roundings(&self, h: f64, state: &[usize]) -> Vec<(&str, Vec<f64>)> {
        let mut decides = vec![false; self.tape.slots];
        for index in state {
            decides[usize::from(self.tape.outputs[*index])] = true;
        }
        let operations: Vec<_> = self.tape.operations().collect();
        for (_, operands, to, _) in operations.into_iter().rev() {
            if decides[usize::from(to)] {
                operands.iter().for_each(|operand| decides[usize::from(*operand)] = true);
            }
        }
        let mut slopes = vec![Vec::new(); self.tape.slots];
        let mut slots: Vec<Jet> = vec![[0.0; 3]; self.tape.slots];
        for index in state {
            slots[..self.names.len()].fill([0.0; 3]);
            slots[H][0] = h;
            slots[self.carried[*index].input][1] = 1.0;
            self.tape.evaluate_jets(&mut slots);
            slopes.iter_mut().zip(&slots).for_each(|(slopes, [_, slope, _])| slopes.push(*slope));
        }
        let all = self.tape.roundings().filter(|([_, to], _)| decides[usize::from(*to)]);
        let rounding = |([operand, _], span): ([u16; 2], &Range<usize>)| {
            let source = self.source.get(span.clone()).unwrap_or_default().trim();
            (source, slopes[usize::from(operand)].clone())
        };
        all.map(rounding).filter(|it| it.1.iter().any(|slope| *slope != 0.0)).collect()
    }
}
