//! The length of the last step of a method with memory, which is valid only for a next step of the same
//! length.

/// The length of the last step of a method with memory.
///
/// A method compares step lengths by itself. A jump of the state or the forces is reported by
/// [`Integrator::reset`](crate::sim::integrators::Integrator::reset), because detecting it would cost a
/// copy of the state and a comparison per step.
#[derive(Clone)]
pub(in crate::sim::integrators) struct LastStep {
    /// In seconds; NaN, which equals nothing, if there is no valid memory.
    h: f64,
}

impl LastStep {
    /// Before the first step and after a jump: no memory.
    pub(in crate::sim::integrators) const NONE: Self = Self { h: f64::NAN };

    /// Whether a step of `h` is as long as the last one. The last step is forgotten until the next
    /// [ends](Self::end), so that a step that fails leaves no memory.
    #[inline(always)]
    pub(in crate::sim::integrators) fn is_continued_by(&mut self, h: f64) -> bool {
        std::mem::replace(&mut self.h, f64::NAN) == h
    }

    /// Remembers that a step of `h` has ended.
    #[inline(always)]
    pub(in crate::sim::integrators) fn end(&mut self, h: f64) {
        self.h = h;
    }
}
