//! The registers in which a law is evaluated, for one motion or for several at once.

use regatta_lines::{Jet, Tape};

use super::{Equations, FIRST_COORDINATE, RUDDER, T, THROTTLE};

/// The registers of one copy of a law, with its values. The values are the constants, then the coordinates at the
/// start, then the velocities at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Registers {
    pub(super) motion: Vec<f64>,
    pub(super) energy: Vec<f64>,
    pub(super) exact: Vec<Jet>,
    pub(super) places: Vec<f64>,
    pub(super) when: Vec<Vec<Jet>>,
    pub(super) then: Vec<f64>,
}

impl Registers {
    /// Returns the registers for these values.
    pub fn new(equations: &Equations, values: &[f64]) -> Self {
        let slots = |tape: Option<&Tape>| tape.map_or(0, |tape| tape.slots);
        let mut registers = Self {
            motion: vec![0.0; slots(Some(&equations.motion))],
            energy: vec![0.0; slots(equations.energy.as_ref())],
            exact: vec![[0.0; 3]; slots(equations.exact.as_ref())],
            places: vec![0.0; slots(equations.places.as_ref())],
            when: equations.when.iter().map(|tape| vec![[0.0; 3]; tape.slots]).collect(),
            then: vec![0.0; slots(equations.then.as_ref())],
        };
        registers.set(equations, values);
        registers
    }

    /// Sets the values. Never allocates.
    pub fn set(&mut self, equations: &Equations, values: &[f64]) {
        let from = equations.text.slots_of_constants().start;
        for (tape, slots) in [
            (Some(&equations.motion), &mut self.motion),
            (equations.energy.as_ref(), &mut self.energy),
            (equations.places.as_ref(), &mut self.places),
            (equations.then.as_ref(), &mut self.then),
        ] {
            if let Some(tape) = tape {
                slots[from..from + values.len()].copy_from_slice(values);
                tape.prepare::<1>(slots.as_chunks_mut().0);
            }
        }
        let exact = equations.exact.is_some().then_some(&mut self.exact);
        for jets in exact.into_iter().chain(&mut self.when) {
            for (slot, &value) in jets[from..].iter_mut().zip(values) {
                *slot = [value, 0.0, 0.0];
            }
        }
    }

    /// Returns the memory on the heap, in bytes.
    pub fn heap_bytes(&self) -> usize {
        let tapes = [&self.motion, &self.energy, &self.places, &self.then];
        tapes.map(|slots| size_of_val(&slots[..])).iter().sum::<usize>()
            + size_of_val(&self.exact[..])
            + self.when.iter().map(|slots| size_of_val(&slots[..])).sum::<usize>()
    }
}

/// The registers of `W` motions by a law of one coordinate.
pub(crate) struct LawLanes<const W: usize> {
    slots: Vec<[f64; W]>,
    /// For each slot, whether it has the same value in all motions.
    alike: Vec<bool>,
}

impl<const W: usize> LawLanes<W> {
    /// Returns registers for motions with the `values` of [`Registers`], and this throttle and rudder.
    pub(crate) fn new(equations: &Equations, values: &[f64], steering: [f64; 2]) -> Self {
        let mut slots = vec![[0.0; W]; equations.motion.slots];
        [slots[THROTTLE], slots[RUDDER]] = steering.map(|part| [part; W]);
        let from = equations.text.slots_of_constants().start;
        slots[from..].iter_mut().zip(values).for_each(|(slot, &value)| *slot = [value; W]);
        equations.motion.prepare(&mut slots);
        let moves = FIRST_COORDINATE..FIRST_COORDINATE + 2;
        Self { slots, alike: equations.motion.alike(|slot| moves.contains(&slot)) }
    }
}

impl Equations {
    /// Overwrites `a` with the accelerations of several motions. Never allocates.
    #[inline(always)]
    pub(crate) fn accelerate_lanes<const W: usize>(
        &self,
        LawLanes { slots, alike }: &mut LawLanes<W>,
        t: f64,
        [q, v]: [&[f64; W]; 2],
        a: &mut [f64; W],
    ) {
        slots[T] = [t; W];
        [slots[FIRST_COORDINATE], slots[FIRST_COORDINATE + 1]] = [*q, *v];
        self.motion.evaluate_lanes(slots, alike);
        *a = slots[self.motion.outputs[0] as usize];
    }
}
