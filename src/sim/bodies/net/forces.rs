//! The forces in a net: on a node by itself, and along a spring.

/// A sum of forces on each node of a net, from `N` vectors of pairs of numbers at the nodes.
pub(super) trait Forces<const N: usize>: Copy + Send + Sync {
    /// The force on a node by itself.
    fn on_node(&self, node: [[f64; 2]; N]) -> [f64; 2];

    /// The force on the first end of a spring; the other end gets its negative. The constants are stiffness and
    /// damping divided by the mass of a node, and the rest length.
    fn spring_force(
        &self,
        constants: &[f64; 3],
        from: [[f64; 2]; N],
        to: [[f64; 2]; N],
    ) -> [f64; 2];
}

/// Accelerations of nodes at a state: places and velocities.
#[derive(Clone, Copy)]
pub(super) struct Accelerations {
    /// Drag divided by the mass of a node.
    pub(super) drag: f64,
    pub(super) gravity: f64,
}

/// Derivatives of the accelerations at a state in the direction of another. The four vectors are places, velocities,
/// and those of the direction.
#[derive(Clone, Copy)]
pub(super) struct Derivatives {
    /// Drag divided by the mass of a node.
    pub(super) drag: f64,
}

impl Forces<2> for Accelerations {
    #[inline(always)]
    fn on_node(&self, [_, v]: [[f64; 2]; 2]) -> [f64; 2] {
        [-self.drag * v[0], -self.gravity - self.drag * v[1]]
    }

    /// A spring of length 0 has no direction, and does not pull.
    #[inline(always)]
    fn spring_force(
        &self,
        [k, c, rest]: &[f64; 3],
        from: [[f64; 2]; 2],
        to: [[f64; 2]; 2],
    ) -> [f64; 2] {
        let [d, w] = difference(from, to);
        let (length, _, u) = direction(d);
        let pull = k * (length - rest) + c * (u[0] * w[0] + u[1] * w[1]);
        [pull * u[0], pull * u[1]]
    }
}

impl Forces<4> for Derivatives {
    #[inline(always)]
    fn on_node(&self, [_, _, _, dv]: [[f64; 2]; 4]) -> [f64; 2] {
        [-self.drag * dv[0], -self.drag * dv[1]]
    }

    #[inline(always)]
    fn spring_force(
        &self,
        [k, c, rest]: &[f64; 3],
        from: [[f64; 2]; 4],
        to: [[f64; 2]; 4],
    ) -> [f64; 2] {
        let [d, w, dd, dw] = difference(from, to);
        let (length, inverse, u) = direction(d);
        let pull = k * (length - rest) + c * (u[0] * w[0] + u[1] * w[1]);
        let longer = u[0] * dd[0] + u[1] * dd[1];
        let turned = [(dd[0] - u[0] * longer) * inverse, (dd[1] - u[1] * longer) * inverse];
        let faster = turned[0] * w[0] + turned[1] * w[1] + u[0] * dw[0] + u[1] * dw[1];
        let more = k * longer + c * faster;
        [more * u[0] + pull * turned[0], more * u[1] + pull * turned[1]]
    }
}

/// The numbers of the second node minus those of the first.
#[inline(always)]
fn difference<const N: usize>(from: [[f64; 2]; N], to: [[f64; 2]; N]) -> [[f64; 2]; N] {
    let mut apart = to;
    for (apart, from) in apart.iter_mut().zip(from) {
        *apart = [apart[0] - from[0], apart[1] - from[1]];
    }
    apart
}

/// The length of a spring, its inverse, and its unit direction.
#[inline(always)]
fn direction(d: [f64; 2]) -> (f64, f64, [f64; 2]) {
    let length = (d[0] * d[0] + d[1] * d[1]).sqrt();
    let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
    (length, inverse, [d[0] * inverse, d[1] * inverse])
}
