//! Bodies whose type is forgotten, so that the compiler makes every method for all of them once.

use regatta::sim::System;

/// A body with coordinates of type `V`.
pub(crate) type AnySystem<V = f64> = Box<dyn System<Vector = V>>;

pub(crate) fn any<S: System + 'static>(system: S) -> AnySystem<S::Vector> {
    Box::new(system)
}
