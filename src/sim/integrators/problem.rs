//! Systems whose type is forgotten, so that the methods are compiled for all of them once.

use super::card::Method;
use super::integrator;
use super::integrator::Integrator;
use crate::sim::state::Vector;
use crate::sim::system::{Counted, System};

/// A system of any type with coordinates of type `V`, which counts evaluations.
pub type Problem<V> = Counted<Box<dyn System<Vector = V>>>;

/// This system as a problem, with nothing counted.
pub fn problem<S: System<Vector: Vector> + 'static>(system: S) -> Problem<S::Vector> {
    Counted::new(Box::new(system))
}

/// A fresh [integrator](super::integrator()) for problems of one coordinate. What is generic is compiled again in each crate
/// that uses it, and this is not.
pub fn fresh(method: &Method) -> Box<dyn Integrator<Problem<f64>>> {
    integrator(method, &0.0)
}
