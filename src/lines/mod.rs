//! Lines: one language for the step of a method, for a rule and for a game loop, and the expressions of laws.
//!
//! A reader makes a [`StepText`] or a [`LoopText`] of text, with the place and the remedy of the first fault. Its lines
//! are a tree, which printers walk by [`StepBody`], and a flat [`Tape`], which is stepped.
//!
//! The parser and the evaluator are our own, because crates for expressions evaluate with std's mathematics, which
//! differs from platform to platform. Here every function is `libm`'s. Operations keep the order of the text: `a + b +
//! c` is `(a + b) + c`. A whole exponent up to 16 becomes a product, so that `x^2` has the bits of `x*x`, `x^3` those
//! of `x*x*x`, and `x^-2` those of `1/(x*x)`. Any other power is computed by `libm::pow`. The parser recurses for
//! brackets, signs and functions, at most [`MAX_DEPTH`] deep.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]
#![warn(clippy::iter_over_hash_type)]

mod curve;
mod derivative;
mod expression;
mod fault;
mod form;
mod function;
mod jet;
mod op;
mod step_text;
mod switch;
mod tape;
mod token;

pub use curve::Curve;
pub use derivative::{Term, derivative};
pub use expression::{Expression, MAX_BYTES, MAX_DEPTH, MAX_POINTS, Scope, parse};
pub use fault::{ExpressionFault, Parsed, Remedy, quoted};
pub use form::{is_angle, is_linear};
pub use function::Function;
pub use jet::Jet;
pub use op::Level;
pub use step_text::{
    Carried, Declares, FrameInput, FrameOutput, General, Input, Line, LoopName, LoopText,
    MAX_STEP_BYTES, MAX_SUBSTEPS, MethodInput, Operation, Request, StepBody, StepCall, StepMap,
    StepRegisters, StepText, bracketed,
};
pub use tape::{MAX_OPERATIONS, MAX_SWITCHES, Origin, SwitchKind, Tape, TooLong};

/// Returns the operators of expressions, which are signs and words.
pub fn operators() -> impl Iterator<Item = &'static str> {
    token::operator_signs().chain(op::OPERATOR_WORDS)
}

/// Returns the functions of expressions, each with its arguments, such as `min(a, b)`.
pub fn functions() -> impl Iterator<Item = String> {
    function::FUNCTIONS.iter().map(Function::usage)
}

/// Returns the names that every acceleration can use, which are the time, the inputs and π.
pub fn values() -> impl Iterator<Item = &'static str> {
    op::VALUE_WORDS.into_iter()
}

/// Whether this can be a name.
pub fn is_name(name: &str) -> bool {
    let is_part = |c| token::is_name_start(c) || c.is_ascii_digit();
    name.starts_with(token::is_name_start) && name.chars().all(is_part)
}

/// Whether this is the name of a function that the code of other languages may call.
pub fn is_function(name: &str) -> bool {
    Function::is_printed(name)
}

/// Whether this name has a meaning in every expression.
pub fn is_reserved(name: &str) -> bool {
    op::is_word(name) || Function::named(name).is_some()
}
