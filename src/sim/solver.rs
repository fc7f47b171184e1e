//! What a body is advanced by.

use super::integrators::{Method, Override};

/// A method, or the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// A method from the table.
    Method(&'static Method),
    /// A method from the table, with its card's tolerance or the body's joint replaced. A method without a tolerance,
    /// and an engine on a body without a joint, ignore it.
    With(&'static Method, Override),
    /// The exact flow from the last jump; for a body without a closed form, a reference solution.
    Truth,
}

impl Solver {
    /// The method, unless this is the truth.
    pub fn method(self) -> Option<&'static Method> {
        match self {
            Solver::Method(method) | Solver::With(method, _) => Some(method),
            Solver::Truth => None,
        }
    }
}
