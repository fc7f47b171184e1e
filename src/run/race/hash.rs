//! A hash of a lane's state to the bit: 64-bit FNV-1a over little-endian words, with -0 as 0.

use super::lane::Lane;
use crate::sim::Stepper;

/// The hash so far.
pub(crate) struct Fnv(pub(crate) u64);

impl Fnv {
    pub(crate) fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(super) fn lane(&mut self, lane: &Lane) {
        self.word(u64::from(lane.substeps()));
        if lane.halted().is_none() {
            self.word(u64::MAX);
        }
        for halt in lane.halts() {
            self.word(halt.tick);
            // Where there is one body, it is that one.
            if lane.bodies().len() > 1 {
                self.word(halt.body as u64);
            }
        }
        for body in lane.bodies() {
            let stepper: &dyn Stepper = &*body.stepper;
            for &value in stepper.q().iter().chain(stepper.v()) {
                self.number(value);
            }
        }
    }

    pub(crate) fn number(&mut self, value: f64) {
        self.word(if value == 0.0 { 0 } else { value.to_bits() });
    }

    pub(super) fn word(&mut self, word: u64) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}
