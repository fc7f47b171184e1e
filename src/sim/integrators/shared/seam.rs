//! Where one step ended: what a method carries is good only for a step as long that begins there.

/// The length of the last step, for the next to join on to.
///
/// That the next also begins in the state that the last one left is for the method's caller to see to:
/// see [`Integrator::reset`](crate::sim::integrators::Integrator::reset).
#[derive(Clone)]
pub(in crate::sim::integrators) struct Seam {
    /// In seconds; NaN, which equals nothing, where there is nothing to join.
    h: f64,
}

impl Seam {
    /// The seam before the first step, which joins nothing.
    pub(in crate::sim::integrators) fn new() -> Self {
        Self { h: f64::NAN }
    }

    /// Whether a step of `h` is as long as the last. Whatever it is, nothing joins until it
    /// [ends](Seam::end), which a step that fails does not.
    #[inline]
    pub(in crate::sim::integrators) fn joins(&mut self, h: f64) -> bool {
        std::mem::replace(&mut self.h, f64::NAN) == h
    }

    /// Remembers that a step of `h` has ended.
    #[inline]
    pub(in crate::sim::integrators) fn end(&mut self, h: f64) {
        self.h = h;
    }

    /// Joins nothing until the next step ends.
    pub(in crate::sim::integrators) fn cut(&mut self) {
        self.h = f64::NAN;
    }
}
