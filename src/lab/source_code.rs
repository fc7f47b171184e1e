//! The methods as source code, to be taken into a game: one function of `x`, `v` and the step `h` for each method, in
//! each of four languages.
//!
//! A method is written once, in `assets/methods`, in a small language of its own: one statement a line, numbers only.
//! The [printer](printer) translates it line by line by the table of [dialects](dialect), and its [header](header) is
//! made from the method's card. `tests/library/source_code` compiles what is printed and compares its steps with the method's.
//!
//! | statement | meaning |
//! |---|---|
//! | `takes a(x, v): what it is` | an input: a function of these, or without parentheses a number |
//! | `memory last_h = nan` | a number that is carried from step to step, with its value before the first |
//! | `use solve` | the functions of `assets/methods/shared/solve.step` |
//! | `fn solve(a(x, v), x) {` | a function that returns a number |
//! | `const`, `let`, `var` | a constant, a number, a number that changes; `+=` and the like change it |
//! | `count`, and `takes whole n` | a whole number that changes, and one that is an input |
//! | `4e-15\|2e-6` | a number in double and in single precision |
//! | `if … {`, `} else {`, `while … {`, `}` | with `and` and `or` |
//! | `fail`, `stay` | ends the step with `x` and `v` not a number, or with what they are |
//! | `stability: when`, and `order`, `symplectic` | what the header says in place of the card's sentence |
//! | `several: how`, `held: where` | what it says of several coordinates, and of forces that depend on time |
//! | `refused c: why`, `refused: why` | there is no such function in this language, or in any |
//!
//! A comment begins with `#`; those before the first statement go to the header. A line that begins with an operator
//! continues the one before.

use std::fmt;

use crate::sim::integrators::Method;

pub use dialect::{Language, Precision};
pub use program::MethodInput;
use program::Program;

mod dialect;
mod header;
mod names;
mod printer;
mod program;

/// A method as it is written in `assets/methods`.
#[derive(Debug)]
pub struct MethodSource {
    /// The id of the method.
    pub method: &'static str,
    /// The text, in the language that the module describes.
    pub text: &'static str,
}

impl MethodSource {
    /// What the function takes beside `x`, `v` and `h`.
    pub fn inputs(&self) -> Vec<MethodInput<'static>> {
        Program::read(self.text).inputs
    }

    /// What the source says of a claim of the card, `order`, `stability` or `symplectic`, in words of its own.
    pub fn claim(&self, claim: &str) -> Option<&'static str> {
        Program::read(self.text).claim(claim)
    }

    /// Whether the function has a memory.
    pub fn has_memory(&self) -> bool {
        !Program::read(self.text).memory.is_empty()
    }
}

macro_rules! method_sources {
    ($($id:literal),+ $(,)?) => {
        /// The source of every method, in the order of [`METHODS`](crate::sim::integrators::METHODS).
        pub static METHOD_SOURCES: &[MethodSource] = &[$(MethodSource {
            method: $id,
            text: include_str!(concat!("../../assets/methods/", $id, ".step")),
        }),+];
    };
}

method_sources! {
    "explicit-euler",
    "midpoint",
    "improved-euler",
    "ssp-rk3",
    "rk4",
    "adams-bashforth-2",
    "semi-implicit-euler",
    "velocity-verlet",
    "position-verlet",
    "stormer-verlet",
    "yoshida4",
    "pefrl",
    "adaptive-euler",
    "bogacki-shampine-32",
    "dormand-prince-54",
    "implicit-euler",
    "implicit-midpoint",
    "newmark",
    "bdf2",
    "gauss-legendre-4",
    "tr-bdf2",
    "linearly-implicit-euler",
    "semi-implicit-euler-implicit-drag",
    "verlet-exact-drag",
    "exponential-rosenbrock-euler",
    "improved-euler-as-printed",
    "rk4-as-printed",
    "adaptive-euler-as-printed",
    "jakobsen-verlet",
    "lerp-per-frame",
    "lerp-dt",
    "exponential-decay",
    "smooth-damp",
    "critically-damped-spring",
    "implicit-spring",
    "engine-box2d",
    "engine-rapier",
    "engine-avian",
    "engine-avian-motor",
    "engine-jolt",
    "engine-physx",
    "engine-physx-tgs",
    "engine-bullet",
    "engine-pybullet",
    "engine-chipmunk",
    "engine-mujoco",
    "engine-mujoco-rk4",
    "engine-godot",
    "held-force",
}

/// Why a method has no source code in a language.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoSourceCode {
    /// The id of the method.
    pub method: &'static str,
    /// The language.
    pub language: Language,
    /// A clause in lower case.
    pub reason: &'static str,
}

impl std::error::Error for NoSourceCode {}

impl fmt::Display for NoSourceCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} has no function in {}: {}", self.method, self.language.name(), self.reason)
    }
}

/// The function of a method in a language and a precision, with what it is on its card as a comment above it.
///
/// # Errors
/// If the method is [one's own](Method::own), or cannot be written as such a function, or the language has no such
/// precision.
pub fn source_code(
    method: &Method,
    language: Language,
    precision: Precision,
) -> Result<String, NoSourceCode> {
    let refused = |reason| NoSourceCode { method: method.id, language, reason };
    let source = METHOD_SOURCES.iter().find(|source| source.method == method.id);
    let source =
        source.ok_or(refused("it is a method of one's own, whose code is where it was made"))?;
    let program = Program::read(source.text);
    if let Some(reason) = program.refusal(language).or(language.refusal(precision)) {
        return Err(refused(reason));
    }
    let header = header::lines(method, &program, language);
    Ok(printer::print(method.id, &program, language, precision, &header))
}
