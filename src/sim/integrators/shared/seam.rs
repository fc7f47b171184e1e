//! Where one step ended: what a method carries is good only for a step that begins there.

use crate::sim::{State, Vector};

/// The state that the last step left, and its length.
pub(in crate::sim::integrators) struct Seam<V> {
    y: State<V>,
    /// In seconds; NaN, which equals nothing, before the first step and after a reset.
    h: f64,
}

impl<V: Vector> Seam<V> {
    /// The seam before the first step, which joins nothing.
    pub(in crate::sim::integrators) fn new(like: &V) -> Self {
        Self { y: State { q: like.clone(), v: like.clone() }, h: f64::NAN }
    }

    /// Whether a step of `h` from `y` goes on where the last one ended, and is as long.
    #[inline]
    pub(in crate::sim::integrators) fn joins(&self, h: f64, y: &State<V>) -> bool {
        h == self.h
            && y.q.components() == self.y.q.components()
            && y.v.components() == self.y.v.components()
    }

    /// Remembers that a step of `h` ended at `y`.
    #[inline]
    pub(in crate::sim::integrators) fn end(&mut self, h: f64, y: &State<V>) {
        self.h = h;
        self.y.assign(y);
    }

    /// Joins nothing until the next step ends.
    pub(in crate::sim::integrators) fn cut(&mut self) {
        self.h = f64::NAN;
    }
}
