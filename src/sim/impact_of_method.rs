//! Which rules for impacts fit a method, and the order of both together.
//!
//! An engine with a rule of its own accepts no other, because its logs are of both together, and so it is with a
//! person's lines. Any other method takes any of the other rules, and the order of both is the smaller one.

use super::impact::{IMPACTS, Impact, Locating, Rule, Turn};
use super::integrators::{EngineBounce, Method};

impl Impact {
    /// Returns the rule that a lane of this method has unless it says otherwise.
    pub fn of(method: &Method) -> &'static Self {
        IMPACTS.iter().find(|impact| impact.fits(method)).unwrap_or_default()
    }

    /// Whether a lane of this method may have the rule. An engine with a rule of its own has no other, and neither have
    /// lines that turn the body themselves.
    pub fn fits(&self, method: &Method) -> bool {
        match self.rule {
            Rule::Engine => method.bounce().is_some(),
            Rule::EngineP2 => method.bounce() == Some(EngineBounce::Cannon),
            Rule::OwnLines => method.has_own_floor,
            _ => method.bounce().is_none() && !method.has_own_floor,
        }
    }

    /// Returns the reason why a lane of this method may not have the rule, in words; `None` if it may.
    pub fn refusal(&self, method: &Method) -> Option<String> {
        let why = match self.rule {
            _ if self.fits(method) => return None,
            Rule::Engine | Rule::EngineP2 | Rule::OwnLines => "has none of its own that is known",
            _ => "has one of its own, and no other",
        };
        Some(format!("the rule {self:?} is not for {}, which {why}", method.id))
    }

    /// Returns the order of the error of a method under the rule, if the force may depend on velocity. `None` if the
    /// wall is soft, if the rule is not the program's, and for a blind turn, whose error does not shrink evenly.
    pub fn order(&self, method: &Method) -> Option<u32> {
        let most = match self.rule {
            Rule::Within(Locating::Method) => u32::MAX,
            Rule::Within(Locating::Cubic) => 4,
            Rule::Within(Locating::Chord) => 2,
            Rule::After(Turn::VelocityBlind) | Rule::Penalty => return None,
            Rule::Engine | Rule::EngineP2 | Rule::OwnLines => return None,
            Rule::Within(_) | Rule::Swept | Rule::After(_) | Rule::BeforeTick => 1,
        };
        Some(method.order_with_drag.min(most))
    }
}
