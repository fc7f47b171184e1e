//! A tape evaluated on several motions at once.

use super::Tape;
use crate::sim::law::switch::Switch;

impl Tape {
    /// Writes the numbers and all that depends on constants alone, once the constants are in their slots.
    pub(in crate::sim::law) fn prepare_lanes<const W: usize>(&self, slots: &mut [[f64; W]]) {
        self.numbers.iter().for_each(|&(slot, number)| slots[slot as usize] = [number; W]);
        self.run_lanes(&self.prelude, slots, &[], Switch::value);
    }

    /// The slots that have the same value in all motions, if all inputs but these have.
    pub(in crate::sim::law) fn alike(&self, differs: impl Fn(usize) -> bool) -> Vec<bool> {
        let mut alike: Vec<bool> = (0..self.slots).map(|slot| !differs(slot)).collect();
        for (_, operands, to, _) in self.operations() {
            alike[to as usize] = operands.iter().all(|&slot| alike[slot as usize]);
        }
        alike
    }

    /// Evaluates the tape. `alike` is [`Tape::alike`].
    #[inline(always)]
    pub(in crate::sim::law) fn evaluate_lanes<const W: usize>(
        &self,
        slots: &mut [[f64; W]],
        alike: &[bool],
    ) {
        self.run_lanes(&self.main, slots, alike, Switch::value);
    }
}
