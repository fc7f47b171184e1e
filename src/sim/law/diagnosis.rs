//! Finds the operation by which an acceleration is not finite.

use super::fault::{ExpressionFault, LawFault, quoted};
use super::op::Op;
use super::{Equations, Registers};

impl Equations {
    /// The fault of the first operation that makes an acceleration infinite or undefined in the last
    /// evaluation; `None` if all accelerations are finite.
    pub(in crate::sim) fn not_finite(&self, registers: &Registers) -> Option<LawFault> {
        let value = |slot: u16| registers.motion[slot as usize];
        let mut slot = *self.motion.outputs.iter().find(|&&slot| !value(slot).is_finite())?;
        loop {
            let (op, operands, ..) = self.motion.operations().find(|(_, _, to, _)| *to == slot)?;
            // Of a choice, the branch that was not taken does not matter.
            let taken =
                |n: &usize| op != Op::If || *n == if value(operands[0]) == 1.0 { 1 } else { 2 };
            let mut rows = (0..operands.len()).filter(taken).map(|n| operands[n]);
            if let Some(operand) = rows.find(|&operand| !value(operand).is_finite())
                && self.motion.origin(operand).is_some()
            {
                slot = operand;
                continue;
            }
            let origin = self.motion.origin(slot)?;
            let divides = op == Op::Divide && value(operands[1]) == 0.0;
            let what = if divides { "divides by zero" } else { "is not finite" };
            let written = quoted(&self.part(origin.part)[origin.span.clone()]);
            let remedy = "give another start or other constants, or guard it with `if` or `max`";
            let what = format!("`{written}` {what} at the start");
            return Some(ExpressionFault::new(origin.span.clone(), what, remedy).of(origin.part));
        }
    }
}
