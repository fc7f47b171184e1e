//! A place on the curve along which a solution is followed.

/// The place on the curve and its direction.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub(super) lambda: f64,
    /// What the accelerations are measured in: the largest that the force made of them.
    pub(super) scale: f64,
    /// How the solution moves with λ, as the matrix says.
    pub(super) side: Vec<f64>,
    /// The direction of unit length, accelerations in units of `scale`, and λ.
    pub(super) tangent: Vec<f64>,
    pub(super) tangent_lambda: f64,
    /// The accelerations at the beginning of a stretch.
    pub(super) from: Vec<f64>,
}

impl Curve {
    pub(super) fn new(size: usize) -> Self {
        let zeros = || vec![0.0; size];
        Self {
            lambda: 0.0,
            scale: 1.0,
            side: zeros(),
            tangent: zeros(),
            tangent_lambda: 1.0,
            from: zeros(),
        }
    }

    /// The memory that it takes beyond its own size, in bytes.
    pub(super) fn heap_bytes(&self) -> usize {
        let vectors = [&self.side, &self.tangent, &self.from];
        vectors.into_iter().map(|vector| size_of_val(&vector[..])).sum()
    }
}
