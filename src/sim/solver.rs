//! What a body is advanced by.

use super::integrators::Method;

/// A method, or the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// A method from the table.
    Method(&'static Method),
    /// An adaptive method from the table; the number replaces its card's tolerance, absolute and
    /// relative.
    WithTolerance(&'static Method, f64),
    /// An engine from the table whose joint has this stiffness in 1/s² and this damping in 1/s, each per unit of
    /// mass, in place of the body's. Other methods, and engines on a body without a joint, ignore it.
    WithJoint(&'static Method, [f64; 2]),
    /// The exact flow from the last jump; for a body without a closed form, a reference solution.
    Truth,
}

impl Solver {
    /// The method, unless this is the truth.
    pub fn method(self) -> Option<&'static Method> {
        match self {
            Solver::Method(method)
            | Solver::WithTolerance(method, _)
            | Solver::WithJoint(method, _) => Some(method),
            Solver::Truth => None,
        }
    }
}
