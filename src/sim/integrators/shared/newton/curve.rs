//! The curve of solutions that continuation follows.

/// The current point on the curve and its tangent.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub(super) lambda: f64,
    /// The unit of accelerations: the largest force found on the curve.
    pub(super) scale: f64,
    /// The derivative of the solution with respect to λ.
    pub(super) slope_by_lambda: Vec<f64>,
    /// The unit tangent: accelerations in units of `scale`, and λ.
    pub(super) tangent: Vec<f64>,
    pub(super) tangent_lambda: f64,
    /// The accelerations at the start of a step.
    pub(super) start: Vec<f64>,
}

impl Curve {
    pub(super) fn new(size: usize) -> Self {
        let zeros = || vec![0.0; size];
        Self {
            lambda: 0.0,
            scale: 1.0,
            slope_by_lambda: zeros(),
            tangent: zeros(),
            tangent_lambda: 1.0,
            start: zeros(),
        }
    }

    /// Memory on the heap, in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        let vectors = [&self.slope_by_lambda, &self.tangent, &self.start];
        vectors.into_iter().map(|vector| size_of_val(&vector[..])).sum()
    }
}
