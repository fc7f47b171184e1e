//! Coordinate vectors, and the state of a body.

use super::fnv::Fnv;

/// Numbers that are added and scaled one by one, which is all that the formula of a method with fixed steps needs.
///
/// The numbers may be the [components](Vector) of one body, or one coordinate of each of several bodies stepped
/// together. Such bodies must not mix, so that each has the same bits as alone. A method that looks across components,
/// for a norm, a limit or a solution, steps a single body. Such a method must declare this by the bound `System<Vector:
/// Vector>`:
///
/// ```compile_fail,E0277
/// # use regatta_sim::{Elementwise, System, integrators::{Integrator, LinearlyImplicitEuler}};
/// fn step_together<S: System<Vector: Elementwise>>(bodies: &S, like: &S::Vector) {
///     let _ = <LinearlyImplicitEuler<S::Vector> as Integrator<S>>::new(like);
/// }
/// ```
///
/// ```
/// # use regatta_sim::{Elementwise, System, integrators::{Integrator, Rk4}};
/// fn step_together<S: System<Vector: Elementwise>>(bodies: &S, like: &S::Vector) {
///     let _ = <Rk4<S::Vector> as Integrator<S>>::new(like);
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no vector of coordinates",
    note = "a vector is f64, [f64; N], Vec<f64>, or DVec2, DVec3, DVec4 of `regatta::glam`, not of another glam: two bodies in the plane are one [f64; 4]",
    note = "f32 is not stepped: keep the state in f64, and convert what is drawn"
)]
pub trait Elementwise: Clone + Send + Sync + 'static {
    /// Copies `from`, which must have the same length. Never allocates.
    fn assign(&mut self, from: &Self);
    /// Computes `self += h x`, rounded after the product and after the sum.
    fn add_scaled(&mut self, h: f64, x: &Self);
    /// Computes `self *= h`.
    fn scale(&mut self, h: f64);
    /// Computes `v += k a`, then `q += h v`, which is a kick and the drift after it.
    #[inline(always)]
    fn kick_and_drift(k: f64, a: &Self, v: &mut Self, h: f64, q: &mut Self) {
        v.add_scaled(k, a);
        q.add_scaled(h, v);
    }
    /// Computes `self += h1 x1 + h2 x2 …`, term by term in this order. Each term is rounded after the product and after
    /// the sum.
    #[inline(always)]
    fn add_terms<const N: usize>(&mut self, terms: [(f64, &Self); N]) {
        for (h, x) in terms {
            self.add_scaled(h, x);
        }
    }
    /// Computes `self = x + h d`, rounded after the product and after the sum; `x` must have the same length. Never
    /// allocates.
    #[inline(always)]
    fn assign_sum(&mut self, x: &Self, h: f64, d: &Self) {
        self.assign(x);
        self.add_scaled(h, d);
    }
    /// Computes `self = h x`; `x` must have the same length. Never allocates.
    #[inline(always)]
    fn assign_scaled(&mut self, h: f64, x: &Self) {
        self.assign(x);
        self.scale(h);
    }
}

/// The coordinates of one body.
///
/// `f64` is for bodies of one coordinate, [`glam::DVec2`] and [`glam::DVec3`] for motion in a plane or in space. `[f64;
/// N]` and [`glam::DVec4`] are for a few coordinates, such as those of two bodies in the plane. `Vec<f64>` is for many
/// coordinates. A method is written once over this trait. The method compiles to registers for the small types and to
/// loops for `Vec`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no vector of one body's coordinates",
    note = "a vector is f64, [f64; N], Vec<f64>, or DVec2, DVec3, DVec4 of `regatta::glam`, not of another glam: two bodies in the plane are one [f64; 4]",
    note = "f32 is not stepped: keep the state in f64, and convert what is drawn"
)]
pub trait Vector: Elementwise {
    /// Whether the coordinates fit into registers, so that each method is compiled for each body of this type. For any
    /// other type, a method is compiled once for all bodies.
    const IS_SMALL: bool = false;
    /// Returns the components in order.
    fn components(&self) -> &[f64];
    /// Returns the components in order, as a mutable slice.
    fn components_mut(&mut self) -> &mut [f64];
}

/// Implements a vector in registers, given the functions that return its components as slices.
macro_rules! small {
    ($($Small:ty: $components:expr, $components_mut:expr;)+) => {$(
        impl Elementwise for $Small {
            #[inline]
            fn assign(&mut self, from: &Self) {
                *self = *from;
            }

            #[inline]
            fn add_scaled(&mut self, h: f64, x: &Self) {
                *self += h * *x;
            }

            #[inline]
            fn scale(&mut self, h: f64) {
                *self *= h;
            }
        }

        impl Vector for $Small {
            const IS_SMALL: bool = true;

            #[inline]
            fn components(&self) -> &[f64] {
                $components(self)
            }

            #[inline]
            fn components_mut(&mut self) -> &mut [f64] {
                $components_mut(self)
            }
        }
    )+};
}

small! {
    f64: std::slice::from_ref, std::slice::from_mut;
    glam::DVec2: AsRef::<[f64; 2]>::as_ref, AsMut::<[f64; 2]>::as_mut;
    glam::DVec3: AsRef::<[f64; 3]>::as_ref, AsMut::<[f64; 3]>::as_mut;
    glam::DVec4: AsRef::<[f64; 4]>::as_ref, AsMut::<[f64; 4]>::as_mut;
}

/// Coordinates of one body, or one coordinate of each of `W` bodies.
impl<const W: usize> Elementwise for [f64; W] {
    #[inline(always)]
    fn assign(&mut self, from: &Self) {
        *self = *from;
    }
    #[inline(always)]
    fn add_scaled(&mut self, h: f64, x: &Self) {
        for i in 0..W {
            self[i] += h * x[i];
        }
    }
    #[inline(always)]
    fn scale(&mut self, h: f64) {
        self.iter_mut().for_each(|number| *number *= h);
    }
}

impl<const N: usize> Vector for [f64; N] {
    const IS_SMALL: bool = N <= 4;

    #[inline]
    fn components(&self) -> &[f64] {
        self
    }

    #[inline]
    fn components_mut(&mut self) -> &mut [f64] {
        self
    }
}

impl Elementwise for Vec<f64> {
    #[inline]
    fn assign(&mut self, from: &Self) {
        assert_length(from.len(), self.len());
        self.copy_from_slice(from);
    }
    #[inline]
    fn add_scaled(&mut self, h: f64, x: &Self) {
        assert_length(x.len(), self.len());
        for (component, x) in self.iter_mut().zip(x) {
            *component += h * x;
        }
    }
    #[inline]
    fn scale(&mut self, h: f64) {
        for component in self {
            *component *= h;
        }
    }
    /// Computes the kick and the drift in one pass over the vectors.
    #[inline]
    fn kick_and_drift(k: f64, a: &Self, v: &mut Self, h: f64, q: &mut Self) {
        assert_length(a.len(), v.len());
        assert_length(q.len(), v.len());
        for ((a, v), q) in a.iter().zip(v).zip(q) {
            *v += k * a;
            *q += h * *v;
        }
    }
    /// Adds all terms in one pass over the vectors.
    #[inline]
    fn add_terms<const N: usize>(&mut self, terms: [(f64, &Self); N]) {
        let terms = terms.map(|(h, x)| {
            assert_length(x.len(), self.len());
            (h, &x[..self.len()])
        });
        for (i, component) in self.iter_mut().enumerate() {
            for (h, x) in terms {
                *component += h * x[i];
            }
        }
    }
    #[inline]
    fn assign_sum(&mut self, x: &Self, h: f64, d: &Self) {
        assert_length(x.len(), self.len());
        assert_length(d.len(), self.len());
        for ((component, x), d) in self.iter_mut().zip(x).zip(d) {
            *component = x + h * d;
        }
    }
    #[inline]
    fn assign_scaled(&mut self, h: f64, x: &Self) {
        assert_length(x.len(), self.len());
        for (component, x) in self.iter_mut().zip(x) {
            *component = h * x;
        }
    }
}

/// Checks that a system's vector still has the length that the system started with.
///
/// # Panics
/// If the lengths differ.
#[inline]
pub(super) fn assert_length(found: usize, wanted: usize) {
    if found != wanted {
        other_length(found, wanted);
    }
}

#[cold]
fn other_length(found: usize, wanted: usize) -> ! {
    panic!(
        "a vector of {found} numbers meets one of {wanted}: all vectors of a system keep the length of its first \
         state; `acceleration` must overwrite the numbers of `a`, not replace `a` by another `Vec`"
    )
}

impl Vector for Vec<f64> {
    #[inline]
    fn components(&self) -> &[f64] {
        self
    }
    #[inline]
    fn components_mut(&mut self) -> &mut [f64] {
        self
    }
}

/// Overwrites each value `ahead` with its difference from the value `behind`, divided by the `distance` between the
/// two. The caller must justify its choice of distance.
#[inline]
pub(crate) fn quotient(ahead: &mut [f64], behind: &[f64], distance: f64) {
    for (ahead, behind) in ahead.iter_mut().zip(behind) {
        *ahead = (*ahead - behind) / distance;
    }
}

/// Returns an upper bound on the memory of values with this inline `size` in bytes. It assumes one heap vector as long
/// as `like` for every 24 bytes.
pub(crate) fn bytes_with_vectors(size: usize, like: &[f64]) -> usize {
    size + size / size_of::<Vec<f64>>() * size_of_val(like)
}

/// Returns the largest magnitude; NaN if a component is NaN.
#[inline]
pub(crate) fn largest<'a>(components: impl IntoIterator<Item = &'a f64>) -> f64 {
    // The bits of magnitudes have the order of the magnitudes; the bits of a NaN are above all others.
    let mut bits = components.into_iter().map(|component| component.abs().to_bits());
    // Four maxima are updated in turn, so that no update waits for the one before it.
    let mut most = [0; 4];
    while let Some(a) = bits.next() {
        most[0] = a.max(most[0]);
        let Some(b) = bits.next() else { break };
        most[1] = b.max(most[1]);
        let Some(c) = bits.next() else { break };
        most[2] = c.max(most[2]);
        let Some(d) = bits.next() else { break };
        most[3] = d.max(most[3]);
    }
    f64::from_bits(most.into_iter().fold(0, u64::max))
}

/// Returns the number, or infinity if it is NaN, so that no comparison loses the NaN.
#[inline]
pub(crate) fn nan_is_infinite(error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { error }
}

/// Coordinates and velocities, or their time derivative `(v, a)`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
pub struct State<V> {
    /// Coordinates, in metres or radians.
    pub q: V,
    /// Velocities, per second.
    pub v: V,
}

impl<V: Vector> State<V> {
    /// Whether all numbers are finite. A body that blew up has others.
    pub fn is_finite(&self) -> bool {
        self.numbers().all(|number| number.is_finite())
    }

    /// Returns the state at `part`, from 0 to 1, of the straight way to `next`, to draw between two ticks. Angles
    /// are not turned the shorter way.
    pub fn lerp(&self, next: &Self, part: f64) -> Self {
        let mut between = self.clone();
        between.q.scale(1.0 - part);
        between.v.scale(1.0 - part);
        between.add_scaled(part, next);
        between
    }

    /// Returns a hash of the bits, with -0 as 0: 64-bit FNV-1a over little-endian words, coordinates first. It is the
    /// same on every platform and in every release.
    pub fn bits_hash(&self) -> u64 {
        let mut hash = Fnv::default();
        self.numbers().for_each(|number| hash.number(number));
        hash.0
    }

    fn numbers(&self) -> impl Iterator<Item = f64> {
        self.q.components().iter().chain(self.v.components()).copied()
    }
}

/// Pairs coordinates and velocities.
impl<V> From<(V, V)> for State<V> {
    fn from((q, v): (V, V)) -> Self {
        Self { q, v }
    }
}

impl<V: Elementwise> State<V> {
    /// Copies `from`. Never allocates.
    #[inline(always)]
    pub fn assign(&mut self, from: &Self) {
        self.q.assign(&from.q);
        self.v.assign(&from.v);
    }

    /// Computes `self += h1 x1 + h2 x2 …` in both halves of the state.
    #[inline(always)]
    pub fn add_terms<const N: usize>(&mut self, terms: [(f64, &Self); N]) {
        self.q.add_terms(terms.map(|(h, x)| (h, &x.q)));
        self.v.add_terms(terms.map(|(h, x)| (h, &x.v)));
    }

    /// Computes `self = x + h d` in both halves of the state. Never allocates.
    #[inline(always)]
    pub fn assign_sum(&mut self, x: &Self, h: f64, d: &Self) {
        self.q.assign_sum(&x.q, h, &d.q);
        self.v.assign_sum(&x.v, h, &d.v);
    }

    /// Computes `self += h x` in both halves of the state.
    #[inline(always)]
    pub fn add_scaled(&mut self, h: f64, x: &Self) {
        self.q.add_scaled(h, &x.q);
        self.v.add_scaled(h, &x.v);
    }
}

#[cfg(test)]
mod tests {
    use super::largest;

    #[test]
    fn the_largest_magnitude_is_found_at_any_index_and_nan_counts_as_largest() {
        for index in 0..9 {
            for found in [-7.0, f64::INFINITY, f64::NAN] {
                let mut components = [0.5, -1.0, 2.0, 0.0, -3.0, 1.0, 0.1, -0.0, 4.0];
                components[index] = found;
                assert_eq!(largest(&components).to_bits(), found.abs().to_bits(), "{index}");
            }
        }
        assert_eq!(largest(&[]), 0.0);
    }
}
