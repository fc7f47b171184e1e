//! The length of a method's last step: what the method carries fits only a next step as long.

/// The length of the last step, for a method that carries something to the next.
///
/// The step length is what a method sees for itself. That the state or the forces jumped it is told, by
/// [`Integrator::reset`](crate::sim::integrators::Integrator::reset): to see it, it would have to keep the
/// state and compare at every step.
#[derive(Clone)]
pub(in crate::sim::integrators) struct LastStep {
    /// In seconds; NaN, which equals nothing, where there is no step to continue.
    h: f64,
}

impl LastStep {
    /// Before the first step, and after a jump: nothing is carried.
    pub(in crate::sim::integrators) const NONE: Self = Self { h: f64::NAN };

    /// Whether a step of `h` continues the last: whether they are equally long. Until it
    /// [ends](Self::end), which a step that fails does not, there is no last step.
    #[inline]
    pub(in crate::sim::integrators) fn is_continued_by(&mut self, h: f64) -> bool {
        std::mem::replace(&mut self.h, f64::NAN) == h
    }

    /// Remembers that a step of `h` has ended.
    #[inline]
    pub(in crate::sim::integrators) fn end(&mut self, h: f64) {
        self.h = h;
    }
}
