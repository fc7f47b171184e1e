//! How physics engines bounce a ball.

/// An engine's own rule for the bounces of a ball of 1 kg. The rules of planck, matter and Havok are not reproduced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EngineBounce {
    /// Chipmunk, which moves first, and solves overlaps with the impulses of the last tick.
    Chipmunk,
    /// Jolt, which bounces with the speed of before the tick when it expects an impact within it.
    Jolt,
    /// A soft contact in substeps, and the rebound at the end of the tick, with the speed of before the tick.
    Soft {
        /// The speed in metres per second up to which nothing bounces.
        threshold: f64,
        /// Whether the contact is softer where substeps are longer than 1/240 s.
        is_capped: bool,
    },
    /// A pybullet multibody, whose rebound loses the gap to the wall in the tick that expects the impact.
    Pybullet,
    /// MuJoCo with `solref = (-1000, -b)`: a penalty force, with b from the restitution.
    Mujoco,
    /// cannon-es, which pushes a ball that overlaps the wall by its depth and by 12/13 of the rebound.
    Cannon,
    /// p2-es, whose contact gives way: a rebound loses more the heavier the ball, and the shorter the tick.
    P2,
}

impl EngineBounce {
    /// Returns the speed in metres per second up to which the engine bounces nothing; 0 if there is none.
    pub fn threshold(self) -> f64 {
        match self {
            Self::Soft { threshold, .. } => threshold,
            Self::Jolt => 1.0,
            Self::Pybullet => 0.2,
            Self::Chipmunk | Self::Mujoco | Self::Cannon | Self::P2 => 0.0,
        }
    }
}
