//! What may carry a body forward.

use super::integrators::Method;

/// What carries a body forward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// A method from the table.
    Method(&'static Method),
    /// An adaptive method from the table with this tolerance, in all its parts, for its card's.
    Within(&'static Method, f64),
    /// The exact flow, from the last moment at which the input changed; for a body without a closed
    /// form, a reference solution.
    Truth,
}

impl Solver {
    /// The method that steps, if one does.
    pub fn method(self) -> Option<&'static Method> {
        match self {
            Solver::Method(method) | Solver::Within(method, _) => Some(method),
            Solver::Truth => None,
        }
    }
}
