//! The body of a log.

/// A body on a line: a spring, drag and a constant push, any of which may be 0.
#[derive(Clone, Debug, PartialEq)]
pub struct LoggedBody {
    /// k/m in 1/s² and c/m in 1/s of the spring; `None` if they are to be fitted.
    pub spring: Option<[f64; 2]>,
    /// The damping setting of the body, in 1/s.
    pub drag: f64,
    /// The constant force for each kilogram, in m/s².
    pub push: f64,
}

impl LoggedBody {
    /// Whether there is a spring, known or not.
    pub fn has_spring(&self) -> bool {
        self.spring != Some([0.0; 2])
    }
}
