//! Claims of a body that a change of its parameters has made untrue.

/// Which of the claims of a [law](super::Law) or of a [body of one's own](super::Own) do not hold with its present
/// parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FalseClaims {
    /// That the energy is conserved.
    pub energy: bool,
    /// That the exact solution satisfies the equation.
    pub exact: bool,
}
