//! The bodies that a method steps, if it does not step all.

use crate::system::BodyClass;

/// Restricts a method to some bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Only {
    /// The requirement on a body.
    pub needs: Needs,
    /// The reason why it steps no other body, as a clause in lower case that follows a colon.
    pub reason: &'static str,
}

/// A method's requirement on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Needs {
    /// A target that the body follows by a law.
    Law {
        /// The order of the law: 1 or 2.
        order: u32,
    },
    /// Any force.
    Force,
    /// A force that an engine can express.
    Engine,
    /// A force that an engine can express without a joint.
    EngineWithoutJoint,
    /// A spring with a stiffness, as a joint of an engine.
    Joint,
    /// A free rotation in space.
    Spin,
}

/// The reason why an engine without a [free spin](super::FreeSpin) steps no body that turns in space.
pub(super) const NO_FREE_SPIN: &str =
    "it has no step of a free rotation: it works in the plane, or no log shows one";

impl Only {
    /// Returns the reason why a method with this restriction and without a free spin steps no body of this class.
    /// `None` if it may step one.
    pub(super) const fn incompatibility(&self, class: BodyClass) -> Option<&'static str> {
        match (self.needs, class) {
            (Needs::Law { .. }, BodyClass::Follower(_))
            | (
                Needs::Force,
                BodyClass::Forced | BodyClass::Joint | BodyClass::NoEngine(_) | BodyClass::Ball(_),
            )
            | (Needs::Engine, BodyClass::Forced | BodyClass::Joint)
            | (Needs::EngineWithoutJoint, BodyClass::Forced)
            | (Needs::Joint, BodyClass::Joint)
            | (Needs::Spin, BodyClass::Spin) => None,
            (Needs::Law { .. } | Needs::Joint | Needs::Spin, _) | (_, BodyClass::Joint) => {
                Some(self.reason)
            }
            (_, BodyClass::Spin) => Some(NO_FREE_SPIN),
            (_, BodyClass::NoEngine(why) | BodyClass::Follower(why) | BodyClass::Ball(why)) => {
                Some(why)
            }
        }
    }
}
