//! Small motions of a body about rest, with all coordinates together. They also cover a body whose damping couples its
//! modes, so that it has no normal modes.

use std::fmt;

use nalgebra::{DMatrix, DVector};

use super::Tick;
use super::comparison::{LinearMotion, Mode, Stability};
use super::deviation::{self, acceleration_at, force_slopes};
use super::modes::{NormalMode, modes_of, unforced};
use super::spectrum::{self, Eigenvalue};
use crate::Stepper;
use crate::integrators::{Method, StepFailure};

/// The equation of small deviations of a body from rest, `x″ = A x + B x′`, without throttle. On a linear body, the
/// equation is valid for deviations of any size.
#[derive(Clone, Debug)]
pub struct SmallMotion {
    /// The matrix A, with B to its right.
    jacobian: DMatrix<f64>,
}

/// A [`SmallMotion`] with its true modes. A method steps all coordinates of the motion together.
#[derive(Clone, Debug)]
pub struct CoupledMotion {
    jacobian: DMatrix<f64>,
    motion: LinearMotion,
}

/// The reason why a body has no small motions about rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoSmallMotion {
    /// The body rests neither at its origin nor near its start.
    NoRest,
    /// The force has a corner or a jump where the body rests, so that no linear equation describes the force there.
    Corner,
    /// The stiffness or the damping changes in time.
    Unsteady,
    /// The force or its derivative is not finite at rest.
    NotFinite,
    /// The body has too many coordinates to analyse together.
    TooManyCoordinates,
}

/// Writes a clause, such as `the stiffness or the damping of this body changes in time`.
impl fmt::Display for NoSmallMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoRest => {
                "small motions are about rest, and this body rests neither at its origin nor near its start"
            }
            Self::Corner => {
                "the force has a corner or a jump where this body rests, so that it does not behave as a spring there"
            }
            Self::Unsteady => "the stiffness or the damping of this body changes in time",
            Self::TooManyCoordinates => "too many coordinates of this body act on each other",
            Self::NotFinite => {
                "the force or its slope is not a finite number where this body rests"
            }
        })
    }
}

/// The maximum number of coordinates that are stepped together. The work for one point of a plot grows with the cube of
/// this number.
const MAX_COUPLED: usize = 16;

impl SmallMotion {
    /// Returns the small motions of `body` about its origin if the body rests there, or else about a place of rest near
    /// its start. A linear body needs no place of rest.
    ///
    /// # Errors
    /// The reason why the body has no small motions.
    pub fn of(body: &dyn Stepper) -> Result<Self, NoSmallMotion> {
        if body.is_sparse() {
            return Err(NoSmallMotion::TooManyCoordinates);
        }
        let free = unforced(body);
        let jacobian = if body.is_linear() {
            force_slopes(&*free, &vec![0.0; 2 * free.q().len()], 1.0, 0.0)
        } else {
            let rest = place_of_rest(&*free)?;
            let jacobian = smooth_jacobian(&*free, &rest, 0.0)?;
            for t in LATER_S {
                // If a corner appears at rest only later, a drive has brought it there.
                let later =
                    smooth_jacobian(&*free, &rest, t).map_err(|_| NoSmallMotion::Unsteady)?;
                if !agree(&jacobian, &later) {
                    return Err(NoSmallMotion::Unsteady);
                }
            }
            jacobian
        };
        if jacobian.iter().any(|x| !x.is_finite()) {
            return Err(NoSmallMotion::NotFinite);
        }
        Ok(Self { jacobian })
    }

    /// Returns the normal modes; `None` if damping couples them, or if a mode grows.
    pub fn normal_modes(&self) -> Option<Vec<NormalMode>> {
        modes_of(&self.jacobian)
    }

    /// Returns the motion of all coordinates together.
    ///
    /// # Errors
    /// If there are too many coordinates, or if their modes cannot be found because a rate overflows.
    pub fn coupled(self) -> Result<CoupledMotion, NoSmallMotion> {
        if self.jacobian.nrows() > MAX_COUPLED {
            return Err(NoSmallMotion::TooManyCoordinates);
        }
        let (truth, rate) = true_modes(&self.jacobian).ok_or(NoSmallMotion::NotFinite)?;
        let axes = DMatrix::identity(truth.len() / 2, truth.len() / 2);
        let shapes = axes.column_iter().map(|axis| axis.iter().copied().collect()).collect();
        Ok(CoupledMotion { jacobian: self.jacobian, motion: LinearMotion { shapes, truth, rate } })
    }
}

/// Returns the normal modes of `body`. Returns `None` if `body` is not [linear](crate::PlacedBody::is_linear), if
/// damping couples the modes, or if a mode grows.
pub fn normal_modes(body: &dyn Stepper) -> Option<Vec<NormalMode>> {
    if body.is_linear() { SmallMotion::of(body).ok()?.normal_modes() } else { None }
}

impl CoupledMotion {
    /// Returns the number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.jacobian.nrows()
    }

    /// Whether the true motion grows without bound.
    pub fn grows(&self) -> bool {
        self.motion.truth.iter().any(|mode| mode.growth_per_s > 0.0)
    }

    /// Returns the stability of `method` with equal steps on this motion, from the map of all coordinates over a step.
    /// The stability ignores growth that the true motion shares, and frequencies beyond half a turn in a step.
    ///
    /// # Errors
    /// The failure of the method in the first steps.
    pub fn stability(
        &self,
        method: &'static Method,
        h: f64,
        substeps: u32,
    ) -> Result<Stability, StepFailure> {
        let steps = Tick { t: 0.0, h, substeps }.repeated(Some(method));
        let mut deviation = deviation::linear(self.jacobian.clone(), method);
        Ok(self.motion.stability(&mut *deviation, steps, 1.0)?.0)
    }
}

/// Times in seconds at which the derivatives of the force must equal the derivatives at the start.
const LATER_S: [f64; 2] = [0.37, 2.9];

/// Rates below this fraction of the largest rate count as zero. The fraction is above √ε, by which rounding splits a
/// double eigenvalue.
const FORCE_FREE: f64 = 1e-7;

/// A true growth below this fraction of the largest rate is rounding.
const ROUNDED_GROWTH: f64 = 1e-10;

/// Returns the modes of `x″ = A x + B x′`, and the unit of velocity, per second, in which the fastest mode moves on
/// circles.
fn true_modes(jacobian: &DMatrix<f64>) -> Option<(Vec<Mode>, f64)> {
    let n = jacobian.nrows();
    let stiffness = jacobian.columns(0, n).amax();
    let unit = if stiffness > 0.0 { stiffness.sqrt() } else { 1.0 };
    let system = DMatrix::from_fn(2 * n, 2 * n, |i, j| match (i.checked_sub(n), j < n) {
        (Some(i), true) => jacobian[(i, j)] / unit,
        (Some(i), false) => jacobian[(i, j)],
        (None, _) => unit * f64::from(u8::from(j == i + n)),
    });
    let values = spectrum::eigenvalues_of_map(&system)?;
    let largest = values.iter().map(|value| value.modulus).fold(0.0, f64::max);
    let mode = |value: &Eigenvalue| {
        let growth = value.modulus * libm::cos(value.angle);
        let is_still = value.modulus <= FORCE_FREE * largest;
        let is_rounding = is_still || growth.abs() <= ROUNDED_GROWTH * largest;
        Mode {
            growth_per_s: if is_rounding { 0.0 } else { growth },
            frequency: if is_still || !value.is_complex() {
                0.0
            } else {
                value.modulus * libm::sin(value.angle)
            },
        }
    };
    Some((values.iter().map(mode).collect(), largest))
}

/// Returns a place where `free` rests at any time. This is the origin if `free` rests there at the start, or else the
/// result of Newton's iteration from the start.
fn place_of_rest(free: &dyn Stepper) -> Result<Vec<f64>, NoSmallMotion> {
    let n = free.q().len();
    let origin = vec![0.0; n];
    let push =
        |q: &[f64], t: f64| DVector::from_vec(acceleration_at(free, t, &[q, &origin].concat()));
    if push(&origin, 0.0).iter().all(|&a| a == 0.0) {
        return Ok(origin);
    }
    let mut q = free.q().to_vec();
    for _ in 0..MAX_ITERATIONS {
        let at = [&q[..], &origin].concat();
        let [ahead, behind] = [1.0, -1.0].map(|side| {
            force_slopes(free, &at, side * DISTANCES[0][0], 0.0).columns(0, n).into_owned()
        });
        let step = ((ahead + behind) / 2.0).lu().solve(&push(&q, 0.0));
        let step = step.filter(|step| step.iter().all(|x| x.is_finite()));
        let step = step.ok_or(NoSmallMotion::NoRest)?;
        let is_near = step.iter().zip(&q).all(|(step, q)| step.abs() <= AT_REST * (1.0 + q.abs()));
        q.iter_mut().zip(step.iter()).for_each(|(q, step)| *q -= step);
        if is_near {
            // If there is a drive, this may be a place of rest only for a moment.
            let still = LATER_S.iter().all(|&t| (push(&q, t) - push(&q, 0.0)).amax() == 0.0);
            return if still { Ok(q) } else { Err(NoSmallMotion::NoRest) };
        }
    }
    Err(NoSmallMotion::NoRest)
}

/// The maximum number of steps of Newton's iteration. About 5 are enough from a start with the right stiffness.
const MAX_ITERATIONS: u32 = 30;

/// The largest size of the last step of Newton's iteration, relative to the coordinate. The step after it would be at
/// rounding level.
const AT_REST: f64 = 1e-9;

/// Returns the Jacobian of the force at rest at `q`, by differences. The differences over two distances and on either
/// side must agree, or converge as the distances shrink.
fn smooth_jacobian(free: &dyn Stepper, q: &[f64], t: f64) -> Result<DMatrix<f64>, NoSmallMotion> {
    let n = q.len();
    let at = [q, &vec![0.0; n]].concat();
    let slopes = |by: f64| force_slopes(free, &at, by, t);
    let mut wider: Option<Vec<f64>> = None;
    for [far, near] in DISTANCES {
        let found = [slopes(far), slopes(-far), slopes(near), slopes(-near)];
        if found.iter().flatten().any(|x| !x.is_finite()) {
            return Err(NoSmallMotion::NotFinite);
        }
        let jacobian = (&found[2] + &found[3]) / 2.0;
        let spread: Vec<f64> = (0..n).map(|row| spread(&found, row)).collect();
        let shrinks =
            |row: usize| wider.as_ref().is_some_and(|wider| spread[row] <= wider[row] / 2.0);
        let is_smooth =
            |row: usize| spread[row] <= SMOOTH * jacobian.row(row).amax() || shrinks(row);
        if (0..n).all(is_smooth) {
            return Ok(jacobian);
        }
        wider = Some(spread);
    }
    Err(NoSmallMotion::Corner)
}

/// Returns the largest difference between the entries of these Jacobians in a row.
fn spread(found: &[DMatrix<f64>; 4], row: usize) -> f64 {
    let off = |other: &DMatrix<f64>| (found[0].row(row) - other.row(row)).amax();
    found.iter().map(off).fold(0.0, f64::max)
}

/// Pairs of distances for the differences, in the units of the coordinates. A smooth force that bends over the first
/// pair is straight over the second.
const DISTANCES: [[f64; 2]; 2] = [[1e-5, 1e-6], [1e-7, 1e-8]];

/// Whether two Jacobians agree in each row.
fn agree(a: &DMatrix<f64>, b: &DMatrix<f64>) -> bool {
    let rows = a.row_iter().zip(b.row_iter());
    rows.into_iter().all(|(a, b)| (a - b).amax() <= SMOOTH * a.amax().max(b.amax()))
}

/// The largest relative difference between slopes of a row that agree. It is far above the rounding of slopes, and far
/// below a corner.
const SMOOTH: f64 = 1e-3;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrators::method;

    #[test]
    fn true_growth_is_not_counted_unless_a_method_is_off_by_a_tenth() {
        let motion = SmallMotion { jacobian: DMatrix::from_row_slice(1, 2, &[4.0, 0.0]) };
        assert!(motion.normal_modes().is_none());
        let motion = motion.coupled().unwrap();
        assert!(motion.grows());
        let euler = method("explicit-euler").unwrap();
        // x″ = 4 x truly grows as e^2t, and each step of explicit Euler multiplies it by 1 + 2 h.
        for (h, excess) in [(0.05, 0.0), (0.5, libm::log(2.0) / 0.5 - 2.0)] {
            let found = motion.stability(euler, h, 1).unwrap();
            assert!((found.growth_per_s - excess).abs() < 1e-9, "{h}: {found:?}");
        }
    }

    #[test]
    fn a_free_drift_stays_neutral() {
        // Two masses of 1 and 3 kg with a spring and a damper between them.
        let (k, c) = (30.0, 2.0);
        let rows = [-k, k, -c, c, k / 3.0, -k / 3.0, c / 3.0, -c / 3.0];
        let motion = SmallMotion { jacobian: DMatrix::from_row_slice(2, 4, &rows) };
        assert!(motion.normal_modes().is_none());
        let motion = motion.coupled().unwrap();
        assert_eq!(motion.motion.truth.iter().filter(|mode| mode.is_still()).count(), 2);
        for id in ["semi-implicit-euler", "rk4", "implicit-midpoint", "bdf2"] {
            let found = motion.stability(method(id).unwrap(), 0.01, 1).unwrap();
            assert!(found.is_bounded(), "{id}: {found:?}");
            assert_eq!(found.spectral_radius, 1.0, "{id}");
        }
        // Explicit Euler multiplies the swing, of ω² = 40 and damping 8/3, by √(1 - 8/3 h + 40 h²).
        let found = motion.stability(method("explicit-euler").unwrap(), 0.1, 1).unwrap();
        let wanted = libm::log(1.0 - 8.0 / 30.0 + 0.4) / 0.2;
        assert!((found.growth_per_s - wanted).abs() < 1e-9, "{found:?}, not {wanted}");
    }
}
