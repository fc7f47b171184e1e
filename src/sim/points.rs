//! The coordinates of many points, each of which feels few others.

use super::state::{Elementwise, Vector};

/// Coordinates of many points in a plane, `x0, y0, x1, y1 …`, for forces between neighbours.
///
/// It has the components of a `Vec<f64>`. The type tells implicit methods that a row of the Jacobian has
/// few entries, so that they solve their equations by iteration and keep no matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Points(pub Vec<f64>);

impl Points {
    /// The points.
    #[inline]
    pub fn pairs(&self) -> &[[f64; 2]] {
        self.0.as_chunks().0
    }

    /// The points, mutable.
    #[inline]
    pub fn pairs_mut(&mut self) -> &mut [[f64; 2]] {
        self.0.as_chunks_mut().0
    }
}

impl Elementwise for Points {
    #[inline]
    fn assign(&mut self, from: &Self) {
        self.0.assign(&from.0);
    }
    #[inline]
    fn add_scaled(&mut self, h: f64, x: &Self) {
        self.0.add_scaled(h, &x.0);
    }
    #[inline]
    fn kick_and_drift(k: f64, a: &Self, v: &mut Self, h: f64, q: &mut Self) {
        Vec::kick_and_drift(k, &a.0, &mut v.0, h, &mut q.0);
    }
    #[inline]
    fn add_terms<const N: usize>(&mut self, terms: [(f64, &Self); N]) {
        self.0.add_terms(terms.map(|(h, x)| (h, &x.0)));
    }
    #[inline]
    fn assign_sum(&mut self, x: &Self, h: f64, d: &Self) {
        self.0.assign_sum(&x.0, h, &d.0);
    }
    #[inline]
    fn scale(&mut self, h: f64) {
        self.0.scale(h);
    }
    #[inline]
    fn assign_scaled(&mut self, h: f64, x: &Self) {
        self.0.assign_scaled(h, &x.0);
    }
    fn heap_bytes(&self) -> usize {
        self.0.heap_bytes()
    }
}

impl Vector for Points {
    fn components(&self) -> &[f64] {
        &self.0
    }
    fn components_mut(&mut self) -> &mut [f64] {
        &mut self.0
    }
}
