//! Methods that do not step every body: which of them a scene refuses, and why.

use super::{Scene, SceneBody};
use crate::sim::bodies::refusal;
use crate::sim::integrators::{METHODS, Method};

/// Why a method cannot step a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{method} does not step the body {body:?}: {reason}")]
pub struct Refusal {
    /// The method's id.
    pub method: &'static str,
    /// The name of the first body that it refuses.
    pub body: String,
    /// Why, as on the method's card.
    pub reason: &'static str,
}

impl Scene {
    /// Why `method` cannot step this scene; `None` if it steps every body.
    pub fn refusal(&self, method: &Method) -> Option<Refusal> {
        self.bodies.iter().find_map(|SceneBody { name, kind, values }| {
            let reason = refusal(method, kind, values)?;
            Some(Refusal { method: method.id, body: name.clone(), reason })
        })
    }

    /// The methods of the table that step every body of this scene, in its order.
    pub fn fitting_methods(&self) -> impl Iterator<Item = &'static Method> {
        METHODS.iter().filter(|method| self.refusal(method).is_none())
    }
}
