//! The operations of expressions and tapes.

use super::function::Smooth;
use super::switch::{ModeRule, Switch, SwitchValue};
use crate::curve::Curve;

/// One operation. A truth value is 0 for false and 1 for true.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Op {
    Number,
    Input,
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    And,
    Or,
    Not,
    If,
    Smooth(&'static Smooth),
    Switch(Switch),
    /// A call of the acceleration by a step, at a position with a velocity. A third operand guards the call.
    Call,
    /// A number of an array of the lines, at the index of its operand.
    Element,
    /// A call of a function of the lines, whose operand is its last argument.
    Apply,
    /// An argument of such a call, after the argument before.
    Argument,
}

impl Op {
    /// Returns the value of an operation on numbers; 0 if it is no such operation.
    #[inline]
    pub(super) fn value(self, [a, b, c]: [f64; 3], table: Option<&Curve>) -> f64 {
        match self {
            Op::Negate => -a,
            Op::Add => a + b,
            Op::Subtract => a - b,
            Op::Multiply | Op::And => a * b,
            Op::Divide => a / b,
            Op::Power => libm::pow(a, b),
            Op::Or => f64::from(u8::from(a + b > 0.0)),
            Op::Not => 1.0 - a,
            Op::If if a == 1.0 => b,
            Op::If => c,
            Op::Smooth(smooth) => (smooth.value)(a, b),
            Op::Switch(switch) => switch.value(a, b, table),
            Op::Number | Op::Input | Op::Call | Op::Apply | Op::Argument | Op::Element => 0.0,
        }
    }

    /// Whether the value is a truth value, rather than a number.
    pub(super) fn is_truth(self) -> bool {
        match self {
            Op::And | Op::Or | Op::Not => true,
            Op::Switch(switch) => switch.is_truth(),
            Op::Number | Op::Input | Op::Negate | Op::If | Op::Smooth(_) | Op::Call => false,
            Op::Apply | Op::Argument | Op::Element => false,
            Op::Add | Op::Subtract | Op::Multiply | Op::Divide | Op::Power => false,
        }
    }

    /// Whether the value is a whole number near that of the operand.
    pub(super) fn rounds(self) -> bool {
        match self {
            Op::Smooth(smooth) => smooth.rounds,
            Op::Switch(switch) => switch.pieces == ModeRule::Floor,
            _ => false,
        }
    }

    /// Whether the operation reads a table.
    pub(super) fn is_table(self) -> bool {
        self == Op::Switch(Switch::TABLE)
    }
}

/// How tightly an operator binds, from loose to tight.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Either of two conditions.
    Or,
    /// Both conditions.
    And,
    /// Two numbers compared.
    Comparison,
    /// Addition and subtraction.
    Sum,
    /// Multiplication and division.
    Product,
    /// Powers.
    Power,
}

/// An operator between two operands.
pub(super) struct Infix {
    pub(super) sign: &'static str,
    pub(super) level: Level,
    pub(super) op: Op,
    /// Whether the operands are swapped.
    pub(super) is_swapped: bool,
}

/// Every operator between two operands.
pub(super) const INFIXES: [Infix; 13] = [
    infix("or", Level::Or, Op::Or),
    infix("and", Level::And, Op::And),
    comparison("<", ModeRule::Less, SwitchValue::Truth),
    comparison("<=", ModeRule::LessEqual, SwitchValue::Truth),
    Infix { is_swapped: true, ..comparison(">", ModeRule::Less, SwitchValue::Truth) },
    Infix { is_swapped: true, ..comparison(">=", ModeRule::LessEqual, SwitchValue::Truth) },
    comparison("==", ModeRule::Order, SwitchValue::Equal),
    comparison("!=", ModeRule::Order, SwitchValue::NotEqual),
    infix("+", Level::Sum, Op::Add),
    infix("-", Level::Sum, Op::Subtract),
    infix("*", Level::Product, Op::Multiply),
    infix("/", Level::Product, Op::Divide),
    infix("^", Level::Power, Op::Power),
];

/// The operators of step lines that the parser writes out, each with its function.
pub(super) static WRITTEN: [(Infix, &str); 4] = [
    (infix("%%", Level::Product, Op::Call), "mod"),
    (infix("%", Level::Product, Op::Call), "fmod"),
    (infix("mod", Level::Product, Op::Call), "fmod"),
    (infix("//", Level::Product, Op::Call), "floor_divide"),
];

const fn infix(sign: &'static str, level: Level, op: Op) -> Infix {
    Infix { sign, level, op, is_swapped: false }
}

const fn comparison(sign: &'static str, pieces: ModeRule, value: SwitchValue) -> Infix {
    infix(sign, Level::Comparison, Op::Switch(Switch { pieces, value }))
}

/// The operators that are words.
pub(super) const OPERATOR_WORDS: [&str; 3] = ["and", "or", "not"];

/// The names that every law knows.
pub(super) const VALUE_WORDS: [&str; 4] = ["t", "throttle", "rudder", "pi"];

/// Whether this name is an operator or a value.
pub(super) fn is_word(name: &str) -> bool {
    OPERATOR_WORDS.contains(&name) || VALUE_WORDS.contains(&name)
}
