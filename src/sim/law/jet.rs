//! A tape evaluated with first and second derivatives by one variable: forward differentiation, exact
//! to rounding.

use super::op::Op;
use super::switch;
use super::table::Table;
use super::tape::Tape;

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

fn apply(op: Op, [a, b, c]: [Jet; 3], table: Option<&Table>) -> Jet {
    let [x, ..] = a;
    match op {
        Op::Negate => a.map(|x| -x),
        Op::Add => sum(a, b),
        Op::Subtract => difference(a, b),
        Op::Multiply => product(a, b),
        Op::Divide => quotient(a, b),
        Op::Power => power(a, b),
        Op::Sqrt => root(a),
        Op::Exp => {
            let e = libm::exp(x);
            chain(a, [e, e, e])
        }
        Op::Ln => chain(a, [libm::log(x), 1.0 / x, -1.0 / (x * x)]),
        Op::Sin => chain(a, [libm::sin(x), libm::cos(x), -libm::sin(x)]),
        Op::Cos => chain(a, [libm::cos(x), -libm::sin(x), -libm::cos(x)]),
        Op::Tan => {
            let tan = libm::tan(x);
            let slope = 1.0 + tan * tan;
            chain(a, [tan, slope, 2.0 * tan * slope])
        }
        Op::Asin | Op::Acos => {
            let slope = 1.0 / (1.0 - x * x).sqrt();
            let bend = x * slope * slope * slope;
            match op {
                Op::Asin => chain(a, [libm::asin(x), slope, bend]),
                _ => chain(a, [libm::acos(x), -slope, -bend]),
            }
        }
        Op::Atan => {
            let slope = 1.0 / (1.0 + x * x);
            chain(a, [libm::atan(x), slope, -2.0 * x * slope * slope])
        }
        Op::Tanh => {
            let tanh = libm::tanh(x);
            let slope = 1.0 - tanh * tanh;
            chain(a, [tanh, slope, -2.0 * tanh * slope])
        }
        Op::Atan2 => {
            // The derivative of the angle of (b, a), and that of this derivative.
            let radius2 = sum(product(a, a), product(b, b));
            let numerator = [b[0] * a[1] - a[0] * b[1], b[0] * a[2] - a[0] * b[2], 0.0];
            let slope = quotient(numerator, [radius2[0], radius2[1], 0.0]);
            [libm::atan2(a[0], b[0]), slope[0], slope[1]]
        }
        Op::Hypot => {
            let [_, slope, bend] = root(sum(product(a, a), product(b, b)));
            [libm::hypot(a[0], b[0]), slope, bend]
        }
        Op::And => constant(a[0] * b[0]),
        Op::Or => constant(f64::from(u8::from(a[0] + b[0] > 0.0))),
        Op::Not => constant(1.0 - a[0]),
        Op::If if a[0] == 1.0 => b,
        Op::If => c,
        _ => switched(op, [a, b], table),
    }
}

fn switched(op: Op, [a, b]: [Jet; 2], table: Option<&Table>) -> Jet {
    let mode = switch::mode(op, a[0], b[0], table);
    match op {
        Op::Abs if mode == 1 => a,
        Op::Abs => a.map(|x| -x),
        Op::Min | Op::Max if mode == 1 => a,
        Op::Min | Op::Max => b,
        Op::Table => {
            let slope = table.map_or(0.0, |table| table.slope(mode));
            chain(a, [switch::value(op, mode, a[0], b[0], table), slope, 0.0])
        }
        _ => constant(switch::value(op, mode, a[0], b[0], table)),
    }
}

fn constant(value: f64) -> Jet {
    [value, 0.0, 0.0]
}

fn sum(a: Jet, b: Jet) -> Jet {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn difference(a: Jet, b: Jet) -> Jet {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn product(a: Jet, b: Jet) -> Jet {
    [a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[2]]
}

fn quotient(a: Jet, b: Jet) -> Jet {
    let value = a[0] / b[0];
    let slope = (a[1] - value * b[1]) / b[0];
    [value, slope, (a[2] - 2.0 * slope * b[1] - value * b[2]) / b[0]]
}

fn root(a: Jet) -> Jet {
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
fn chain(a: Jet, [value, slope, bend]: [f64; 3]) -> Jet {
    [value, slope * a[1], bend * a[1] * a[1] + slope * a[2]]
}
