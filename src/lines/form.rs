//! Finds from the form of a tape whether its motion is linear and which coordinates are angles.

use super::op::Op;
use super::tape::Tape;

/// How a slot depends on the coordinates and velocities.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Dependence {
    Constant,
    Linear,
    Any,
}

/// Whether every output is a linear function of the inputs that `moves` selects, plus a constant, with coefficients
/// that do not change in time. `t` is the index of the time among the inputs.
pub fn is_linear(tape: &Tape, inputs: usize, t: usize, moves: impl Fn(usize) -> bool) -> bool {
    let mut of = vec![Dependence::Constant; tape.slots];
    for (input, of) in of.iter_mut().enumerate().take(inputs) {
        *of = match input {
            _ if input == t => Dependence::Any,
            _ if moves(input) => Dependence::Linear,
            _ => Dependence::Constant,
        };
    }
    for (op, operands, to, _) in tape.operations() {
        let operand = |n: usize| of[operands[n] as usize];
        of[to as usize] = match op {
            Op::Negate => operand(0),
            Op::Add | Op::Subtract => operand(0).max(operand(1)),
            Op::Multiply => match (operand(0), operand(1)) {
                (Dependence::Constant, other) | (other, Dependence::Constant) => other,
                _ => Dependence::Any,
            },
            Op::Divide if operand(1) == Dependence::Constant => operand(0),
            Op::Number
            | Op::Input
            | Op::Divide
            | Op::Power
            | Op::And
            | Op::Or
            | Op::Not
            | Op::If
            | Op::Smooth(_)
            | Op::Call
            | Op::Apply
            | Op::Element
            | Op::Argument
            | Op::Switch(_) => match operands.iter().map(|&slot| of[slot as usize]).max() {
                None | Some(Dependence::Constant) => Dependence::Constant,
                _ => Dependence::Any,
            },
        };
    }
    tape.outputs.iter().all(|&output| of[output as usize] < Dependence::Any)
}

/// Whether this input is used, and only by sines, cosines and tangents, so that a full turn of the input changes
/// nothing.
pub fn is_angle(tape: &Tape, input: usize) -> bool {
    let is_it = |slot: &u16| usize::from(*slot) == input;
    let mut uses = tape.operations().filter(|(_, operands, ..)| operands.iter().any(is_it));
    let is_periodic = |op: Op| matches!(op, Op::Smooth(function) if function.is_periodic);
    let mut is_used = false;
    let are_periodic = uses.all(|(op, ..)| {
        is_used = true;
        is_periodic(op)
    });
    is_used && are_periodic && !tape.outputs.iter().any(is_it)
}
