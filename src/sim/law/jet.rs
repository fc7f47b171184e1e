//! A tape evaluated with first and second derivatives by one variable: forward differentiation, exact
//! to rounding.

use super::op::Op;
use super::tape::Tape;
use crate::sim::curve::Curve;

/// A value, its derivative and its second derivative.
pub(super) type Jet = [f64; 3];

/// Evaluates the tape, given the slots of the inputs.
pub(super) fn evaluate(tape: &Tape, slots: &mut [Jet]) {
    for &(slot, number) in tape.numbers() {
        slots[slot as usize] = [number, 0.0, 0.0];
    }
    for (op, operands, to, table) in tape.operations() {
        let operand = |n: usize| operands.get(n).map_or([0.0; 3], |&slot| slots[slot as usize]);
        slots[to as usize] = apply(op, [operand(0), operand(1), operand(2)], table);
    }
}

fn apply(op: Op, [a, b, c]: [Jet; 3], table: Option<&Curve>) -> Jet {
    match op {
        // Already in their slots.
        Op::Number | Op::Input => a,
        Op::Negate => a.map(|x| -x),
        Op::Add => sum(a, b),
        Op::Subtract => difference(a, b),
        Op::Multiply => product(a, b),
        Op::Divide => quotient(a, b),
        Op::Power => power(a, b),
        Op::And => constant(a[0] * b[0]),
        Op::Or => constant(f64::from(u8::from(a[0] + b[0] > 0.0))),
        Op::Not => constant(1.0 - a[0]),
        Op::If if a[0] == 1.0 => b,
        Op::If => c,
        Op::Smooth(smooth) => (smooth.jet)(a, b),
        Op::Switch(switch) => switch.jet([a, b], table),
    }
}

pub(super) fn constant(value: f64) -> Jet {
    [value, 0.0, 0.0]
}

pub(super) fn sum(a: Jet, b: Jet) -> Jet {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn difference(a: Jet, b: Jet) -> Jet {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn product(a: Jet, b: Jet) -> Jet {
    [a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[2]]
}

pub(super) fn quotient(a: Jet, b: Jet) -> Jet {
    let value = a[0] / b[0];
    let slope = (a[1] - value * b[1]) / b[0];
    [value, slope, (a[2] - 2.0 * slope * b[1] - value * b[2]) / b[0]]
}

pub(super) fn root(a: Jet) -> Jet {
    let root = a[0].sqrt();
    let slope = a[1] / (2.0 * root);
    [root, slope, (a[2] - 2.0 * slope * slope) / (2.0 * root)]
}

fn power(a: Jet, b: Jet) -> Jet {
    let value = libm::pow(a[0], b[0]);
    if b[1] == 0.0 && b[2] == 0.0 {
        let (n, slope) = (b[0], b[0] * libm::pow(a[0], b[0] - 1.0));
        return chain(a, [value, slope, n * (n - 1.0) * libm::pow(a[0], n - 2.0)]);
    }
    let logarithm = chain(a, [libm::log(a[0]), 1.0 / a[0], -1.0 / (a[0] * a[0])]);
    let exponent = product(b, logarithm);
    chain(exponent, [value; 3])
}

/// `f` of a jet, given the value of `f` and its first two derivatives there.
pub(super) fn chain(a: Jet, [value, slope, bend]: [f64; 3]) -> Jet {
    [value, slope * a[1], bend * a[1] * a[1] + slope * a[2]]
}
