//! Joint and damping settings of a body in a physics engine.

/// The part of an acceleration that an engine's joint and its damping take over: `-(K q + c v) - C v`, the same for
/// every coordinate, with the spring at rest where `q` is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EngineSettings {
    /// K, the stiffness of the joint for each kilogram, per second squared.
    pub stiffness: f64,
    /// c, the damping of the joint for each kilogram, per second.
    pub damping: f64,
    /// C, the damping setting of the body, per second.
    pub drag: f64,
}

impl EngineSettings {
    /// Everything is a force of user code.
    pub const NONE: Self = Self { stiffness: 0.0, damping: 0.0, drag: 0.0 };

    /// Whether there is a joint.
    #[inline]
    pub fn has_spring(&self) -> bool {
        self.stiffness != 0.0 || self.damping != 0.0
    }

    /// `D = 1 + h c + h² K`, by which an implicit solve of a step of `h` (s) divides.
    #[inline]
    pub fn resistance(&self, h: f64) -> f64 {
        1.0 + h * self.damping + h * h * self.stiffness
    }
}
