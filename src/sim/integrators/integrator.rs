//! What every method implements.

use super::failure::StepFailure;
use super::tolerance::Tolerance;
use crate::sim::system::{State, System};

/// A way to advance a system by one step.
///
/// The system is a parameter of the trait: the force law is inlined into the method, and
/// `Box<dyn Integrator<Ship>>` is still swappable at run time.
pub trait Integrator<S: System>: Send {
    /// A method at rest, with scratch space for coordinate vectors shaped `like` this one.
    fn new(like: &S::Vector) -> Self
    where
        Self: Sized;

    /// Advances `state` from `t` to exactly `t + h` (s), but for methods whose card says that they do
    /// not [keep time](super::Method::keeps_time). Never allocates.
    ///
    /// # Errors
    /// A [`StepFailure`] of the method's own; `state` is then somewhere on the way. Values that
    /// overflow are not the method's business: its caller checks them.
    fn step(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure>;

    /// Advances from `t` to `t + h` in `n` equal steps: one dynamic call for a whole tick.
    ///
    /// # Errors
    /// As [`Integrator::step`].
    fn steps(
        &mut self,
        system: &S,
        t: f64,
        h: f64,
        n: u32,
        state: &mut State<S::Vector>,
    ) -> Result<(), StepFailure> {
        let part = h / f64::from(n);
        for i in 0..n {
            self.step(system, t + part * f64::from(i), part, state)?;
        }
        Ok(())
    }

    /// Forgets whatever is carried between steps. Call it when the state or the forces jump. A jump of the
    /// step's length every method notices by itself.
    fn reset(&mut self) {}

    /// Sets the error that an adaptive method allows in a substep; the others take no notice.
    fn set_tolerance(&mut self, _tolerance: Tolerance) {}

    /// The memory that it takes beyond its own size and that of its coordinate vectors, in bytes.
    fn heap_bytes(&self) -> usize {
        0
    }
}
