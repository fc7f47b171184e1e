//! The lines of a step of a body that turns freely in space.
//!
//! They change the attitude `qw`, `qx`, `qy`, `qz`, which is a quaternion from the frame of the body to the world. They
//! change the angular velocity `wx`, `wy`, `wz` in that frame too, in rad/s. They read the principal moments `i1`,
//! `i2`, `i3` and the length of the step `h`.

use std::slice;

use super::plain::plain;
use super::reader::{Reader, SPIN_NAMES};
use super::statements::statements;
use super::{H, StepRegisters, StepText};
use crate::fault::ExpressionFault;

impl StepText {
    /// Parses the lines of a step of a free spin.
    ///
    /// # Errors
    /// The first fault, with its byte range in the text.
    pub fn read_spin(text: &str) -> Result<Self, ExpressionFault> {
        Self::check_size(text)?;
        let (plain, _) = plain(text);
        let read = Reader::read_spin(&plain, &statements(&plain, text)?)?;
        Ok(Self { source: text.to_owned(), ..read })
    }

    /// Whether the lines are those of a step of a free spin.
    pub fn is_spin(&self) -> bool {
        self.names.first().is_some_and(|name| name == SPIN_NAMES[0])
    }

    /// Steps a free spin by `h` (s), for these principal moments (kg m²). Its state is the attitude w, x, y, z, and the
    /// angular velocity x, y, z in the frame of the body (rad/s). The registers are those of
    /// [one coordinate](Self::method_registers).
    pub fn step_spin(
        &self,
        registers: &mut StepRegisters,
        h: f64,
        moments: [f64; 3],
        [qw, qx, others @ ..]: &mut [f64; 7],
    ) {
        registers.slots[H + 1..][..5].copy_from_slice(others);
        registers.slots[H + 6..][..3].copy_from_slice(&moments);
        let moved = [slice::from_mut(qw), slice::from_mut(qx)];
        self.step_method(registers, h, moved, |_, _, _, _| {});
        others.copy_from_slice(&registers.slots[H + 1..][..5]);
    }
}
