//! A law of one coordinate, evaluated on several motions at once.

use super::{Equations, FIRST_COORDINATE, RUDDER, T, THROTTLE};

/// Where `W` motions by a law of one coordinate are evaluated.
pub(in crate::sim) struct LawLanes<const W: usize> {
    slots: Vec<[f64; W]>,
    /// The slots that have the same value in all motions.
    alike: Vec<bool>,
}

impl<const W: usize> LawLanes<W> {
    /// Motions with these values, as those of [`Registers`](super::Registers), and this throttle and rudder.
    pub(in crate::sim) fn new(equations: &Equations, values: &[f64], steering: [f64; 2]) -> Self {
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
    pub(in crate::sim) fn accelerate_lanes<const W: usize>(
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
