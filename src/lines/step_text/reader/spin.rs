//! Reads the lines of a step of a free spin.

use super::Reader;
use crate::fault::Parsed;
use crate::step_text::StepText;
use crate::step_text::statements::Statement;

/// The names of every such step. The first three have the slots of `x`, `v` and `h` of other steps.
pub(in super::super) const SPIN_NAMES: [&str; 11] =
    ["qw", "qx", "h", "qy", "qz", "wx", "wy", "wz", "i1", "i2", "i3"];

impl<'t> Reader<'t> {
    /// Reads the lines like those of a function, so that every name but those above needs a value first.
    pub(in super::super) fn read_spin(text: &'t str, all: &[Statement]) -> Parsed<StepText> {
        let mut reader = Self::new(text, Some(0..0), Vec::new());
        reader.is_function = true;
        reader.read_named(&SPIN_NAMES, all)
    }
}
