//! The eigenvalues of the one-tick map, from its Jacobians. They include those of a method's memory.

use nalgebra::{ColPivQR, DMatrix, Schur};

use super::Tick;
use super::deviation::acceleration_at;
use crate::Stepper;
use crate::integrators::StepFailure;

/// An eigenvalue. Both eigenvalues of a conjugate pair are represented by the one in the upper half plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Eigenvalue {
    pub(super) modulus: f64,
    /// The angle, from 0 to π.
    pub(super) angle: f64,
}

impl Eigenvalue {
    fn new(re: f64, im: f64) -> Self {
        Self { modulus: libm::hypot(re, im), angle: libm::atan2(im.abs(), re) }
    }

    /// Returns the distance of the eigenvalue from a real number.
    pub(super) fn distance_from(self, real: f64) -> f64 {
        let re = self.modulus * libm::cos(self.angle);
        libm::hypot(re - real, self.modulus * libm::sin(self.angle))
    }

    /// Whether the eigenvalue is not real.
    pub(super) fn is_complex(self) -> bool {
        self.angle > 0.0 && self.angle < std::f64::consts::PI
    }
}

/// The maps of the state over 1, 2 and 3 ticks after a fresh start.
pub(super) type Maps = [DMatrix<f64>; 3];

/// Returns the maps of a linear body over 1, 2 and 3 ticks, in the span of `shapes`, which must be orthogonal and of
/// length 1. The rows have the displacements along the shapes first, then the velocities in units of `rate` per second.
/// Each run starts with `amplitude` in one of these numbers.
///
/// # Errors
/// The failure of the method in one of the ticks.
pub(super) fn linear_maps(
    body: &mut dyn Stepper,
    shapes: &[Vec<f64>],
    tick: Tick,
    [amplitude, rate]: [f64; 2],
) -> Result<Maps, StepFailure> {
    let (n, count) = (body.q().len(), shapes.len());
    let rest = vec![0.0; 2 * n];
    let stays_at_rest = stays_at_rest(body, tick.t);
    // Returns the components along the shapes after each of three ticks from a state.
    let mut run = |state: &[f64]| {
        body.set(tick.t, &state[..n], &state[n..]);
        let mut after = |k: u32| {
            body.advance(tick.t + tick.h * f64::from(k), tick.h, tick.substeps)?;
            let halves = [body.q(), body.v()].into_iter();
            let parts = halves.flat_map(|half| shapes.iter().map(|shape| part(shape, half)));
            Ok(parts.collect::<Vec<_>>())
        };
        Ok([after(0)?, after(1)?, after(2)?])
    };
    // The effect of a target on the body at rest is not part of the map.
    let driven = if stays_at_rest { [(); 3].map(|()| vec![0.0; 2 * count]) } else { run(&rest)? };
    let unit = |index: usize| if index < count { 1.0 } else { rate };
    let from = |column: usize| {
        let mut state = rest.clone();
        let half = state[column / count * n..].iter_mut();
        let scale = amplitude * unit(column);
        half.zip(&shapes[column % count]).for_each(|(x, shape)| *x = scale * shape);
        run(&state)
    };
    let runs = (0..2 * count).map(from).collect::<Result<Vec<_>, _>>()?;
    Ok([0, 1, 2].map(|k| {
        DMatrix::from_fn(2 * count, 2 * count, |row, column| {
            (runs[column][k][row] - driven[k][row]) / amplitude / unit(row)
        })
    }))
}

/// Returns the component of `values` along a shape of length 1.
pub(super) fn part(shape: &[f64], values: &[f64]) -> f64 {
    shape.iter().zip(values).map(|(shape, value)| shape * value).sum()
}

/// Whether no target moves `body` from rest at the origin.
fn stays_at_rest(body: &dyn Stepper, t: f64) -> bool {
    let rest = vec![0.0; 2 * body.q().len()];
    body.pursuit(t).is_none() && acceleration_at(body, t, &rest).iter().all(|&push| push == 0.0)
}

/// Whether the map over two ticks differs from the product of two one-tick maps.
pub(super) fn has_memory(maps: &Maps) -> bool {
    memory_defect(maps).1
}

/// Returns the largest difference of the two-tick map from the product of two one-tick maps, and whether it shows
/// memory.
fn memory_defect([once, twice, _]: &Maps) -> (f64, bool) {
    let off = (twice - once * once).amax();
    (off, off > MEMORY * (1.0 + twice.amax()))
}

/// A relative defect above this number shows memory. The number is well above the rounding of the differences, and well
/// below the contribution of a multistep method at any useful step.
const MEMORY: f64 = 1e-10;
/// Pivots below this fraction of the largest pivot are rounding.
const RANK: f64 = 1e-10;
/// The maximum number of QR sweeps per row. About 3 are usual.
const SWEEPS_PER_ROW: usize = 60;

/// Returns the eigenvalues of the one-tick map. If the method has memory, the map is that of state and memory together,
/// reconstructed from successive states; otherwise it is that of the state alone.
///
/// Returns `None` if a map is not finite or the iteration does not converge.
pub(super) fn eigenvalues(maps: &Maps) -> Option<Vec<Eigenvalue>> {
    if maps.iter().any(|map| map.iter().any(|x| !x.is_finite())) {
        return None;
    }
    // Strongly connected components are solved separately. Exact zeros then keep neutral eigenvalues exactly neutral,
    // while an iteration over the whole map would perturb double eigenvalues.
    let mut values = Vec::new();
    for part in strongly_connected_components(&maps.each_ref()) {
        let maps =
            maps.each_ref().map(|map: &DMatrix<f64>| map.select_rows(&part).select_columns(&part));
        let (off, has_memory) = memory_defect(&maps);
        let (map, tolerance) = match has_memory {
            true => (&with_memory(&maps)?, NEUTRAL_WITH_MEMORY),
            false => (&maps[0], (NEUTRAL_IN_DEFECTS * off).min(MAX_NEUTRAL)),
        };
        values.extend(
            eigenvalues_of_matrix(map)?
                .into_iter()
                .map(|value| snapped_to_neutral(value, tolerance)),
        );
    }
    Some(values)
}

/// Returns the eigenvalues of a map without memory.
pub(super) fn eigenvalues_of_map(map: &DMatrix<f64>) -> Option<Vec<Eigenvalue>> {
    if map.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let mut values = Vec::new();
    for part in strongly_connected_components(&[map]) {
        values.extend(eigenvalues_of_matrix(&map.select_rows(&part).select_columns(&part))?);
    }
    Some(values)
}

/// Returns the strongly connected components of the indices. A nonzero entry in any of the matrices couples two
/// indices.
fn strongly_connected_components(matrices: &[&DMatrix<f64>]) -> Vec<Vec<usize>> {
    let n = matrices[0].nrows();
    let couples = |i: usize, j: usize| matrices.iter().any(|matrix| matrix[(i, j)] != 0.0);
    let mut reaches: Vec<Vec<bool>> =
        (0..n).map(|i| (0..n).map(|j| i == j || couples(i, j)).collect()).collect();
    for k in 0..n {
        let through = reaches[k].clone();
        for row in reaches.iter_mut().filter(|row| row[k]) {
            row.iter_mut().zip(&through).for_each(|(reaches, through)| *reaches |= through);
        }
    }
    let mutual = |i: usize, j: usize| reaches[i][j] && reaches[j][i];
    let first = |&i: &usize| (0..i).all(|j| !mutual(i, j));
    (0..n).filter(first).map(|i| (i..n).filter(|&j| mutual(i, j)).collect()).collect()
}

fn eigenvalues_of_matrix(matrix: &DMatrix<f64>) -> Option<Vec<Eigenvalue>> {
    match matrix.nrows() {
        1 => Some(vec![Eigenvalue::new(matrix[0], 0.0)]),
        2 => Some(eigenvalues_of_two_rows(matrix).to_vec()),
        rows => {
            let sweeps = SWEEPS_PER_ROW * rows;
            let schur = Schur::try_new(matrix.clone(), f64::EPSILON, sweeps)?;
            Some(schur.complex_eigenvalues().iter().map(|z| Eigenvalue::new(z.re, z.im)).collect())
        }
    }
}

fn eigenvalues_of_two_rows(matrix: &DMatrix<f64>) -> [Eigenvalue; 2] {
    let (a, b, c, d) = (matrix[(0, 0)], matrix[(0, 1)], matrix[(1, 0)], matrix[(1, 1)]);
    let (mean, half) = ((a + d) / 2.0, (a - d) / 2.0);
    let square = half * half + b * c;
    let root = square.abs().sqrt();
    if square < 0.0 {
        [Eigenvalue::new(mean, root), Eigenvalue::new(mean, -root)]
    } else {
        [Eigenvalue::new(mean + root, 0.0), Eigenvalue::new(mean - root, 0.0)]
    }
}

/// If the method has memory, a modulus this close to 1 counts as 1.
pub(super) const NEUTRAL_WITH_MEMORY: f64 = 1e-9;
/// The tolerance of a modulus of 1 for a method without memory, in units of the two-tick defect. That defect is the
/// rounding of the differences, which is large if a method computes velocities from differences of positions.
const NEUTRAL_IN_DEFECTS: f64 = 10.0;
/// A modulus further from 1 than this number never counts as 1, because the defect of a map that grows without limit
/// does not measure rounding.
const MAX_NEUTRAL: f64 = 1e-3;

fn snapped_to_neutral(value: Eigenvalue, tolerance: f64) -> Eigenvalue {
    let neutral = (value.modulus - 1.0).abs() < tolerance;
    Eigenvalue { modulus: if neutral { 1.0 } else { value.modulus }, ..value }
}

/// Returns the map of pairs (state, state one tick ago), restricted to the reachable subspace. The map is found from
/// the pairs one and two ticks after a fresh start, and the pairs a tick after each of these. Two successive states
/// determine a method's memory, whether it consists of forces, slopes or an older state.
fn with_memory([once, twice, thrice]: &Maps) -> Option<DMatrix<f64>> {
    let n = once.nrows();
    let identity = DMatrix::identity(n, n);
    let pairs = |blocks: [[&DMatrix<f64>; 2]; 2]| {
        DMatrix::from_fn(2 * n, 2 * n, |i, j| blocks[i / n][j / n][(i % n, j % n)])
    };
    let reached = pairs([[once, twice], [&identity, once]]);
    let mut next = pairs([[twice, thrice], [once, twice]]);

    let factors = ColPivQR::new(reached);
    let (q, r) = (factors.q(), factors.r());
    let rank = (0..2 * n).take_while(|&i| r[(i, i)].abs() > RANK * r[(0, 0)].abs()).count();
    // This happens if `once` has a NaN or overflows.
    if rank == 0 {
        return None;
    }
    factors.p().permute_columns(&mut next);
    let basis = q.columns(0, rank);
    let square = r.view((0, 0), (rank, rank)).into_owned();
    // Computes basisᵀ next square⁻¹ by solving with the transposed triangle.
    let image = basis.transpose() * next.columns(0, rank);
    let solved = square.transpose().solve_lower_triangular(&image.transpose())?;
    Some(solved.transpose())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_are_the_strongly_connected_ones() {
        let map = DMatrix::from_row_slice(
            4,
            4,
            &[1.0, 0.1, 0.0, 0.0, 0.0, 0.9, 0.0, 0.2, 0.3, 0.0, 1.0, 0.0, 0.0, 0.5, 0.0, 1.0],
        );
        assert_eq!(strongly_connected_components(&[&map]), [vec![0], vec![1, 3], vec![2]]);
        // Two neutral coordinates, of which one drives the other, stay neutral to the bit.
        let values = eigenvalues_of_map(&map).unwrap();
        assert_eq!(values.iter().filter(|value| value.modulus == 1.0).count(), 2);
    }

    #[test]
    fn the_eigenvalue_of_a_memory_is_found() {
        // x' = 1.2 x + 0.3 x_before, with x_before = x at the start.
        let recur = |states: &[f64]| {
            let before = if states.len() > 1 { states[states.len() - 2] } else { states[0] };
            1.2 * states[states.len() - 1] + 0.3 * before
        };
        let mut states = vec![1.0];
        for _ in 0..3 {
            states.push(recur(&states));
        }
        let scalar = |x: f64| DMatrix::from_element(1, 1, x);
        let maps = [scalar(states[1]), scalar(states[2]), scalar(states[3])];
        let mut found = eigenvalues(&maps).unwrap();
        found.sort_by(|a, b| a.modulus.total_cmp(&b.modulus));
        let root = (0.36_f64 + 0.3).sqrt();
        assert!((found[1].modulus - (0.6 + root)).abs() < 1e-12, "{found:?}");
        assert!((found[0].modulus - (root - 0.6)).abs() < 1e-12, "{found:?}");
        assert_eq!(found[0].angle, std::f64::consts::PI);
    }

    #[test]
    fn a_direction_at_rounding_level_is_no_memory() {
        // The first coordinate has memory, x' = 1.2 x + 0.3 x_before; the second has none, x' = 0.8 x. Both coordinates
        // are rotated and perturbed.
        for size in [1.0, 30.0] {
            let one = [1.5, 2.1, 2.97].map(|x| x * size);
            let other = [0.8, 0.64, 0.512].map(|x| x * size);
            let (cos, sin) = (libm::cos(0.7), libm::sin(0.7));
            let turn = DMatrix::from_row_slice(2, 2, &[cos, -sin, sin, cos]);
            let mut entry = 0.0;
            let mut seen = |k: usize, power: i32| {
                let own = DMatrix::from_row_slice(2, 2, &[one[k], 0.0, 0.0, other[k]]);
                let map: DMatrix<f64> = &turn * own * turn.transpose() * size.powi(power);
                map.map(|x| {
                    entry += 1.0;
                    x * (1.0 + 1e-12 * libm::sin(entry))
                })
            };
            let maps = [seen(0, 0), seen(1, 1), seen(2, 2)];
            let mut found = eigenvalues(&maps).unwrap();
            found.sort_by(|a, b| a.modulus.total_cmp(&b.modulus));
            let root = 0.66_f64.sqrt();
            let wanted = [root - 0.6, 0.8, root + 0.6].map(|x| x * size);
            assert_eq!(found.len(), wanted.len(), "{size}: {found:?}");
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found.modulus / wanted - 1.0).abs() < 1e-9, "{size}: {found:?}, {wanted}");
            }
        }
    }

    #[test]
    fn a_real_eigenvalue_is_not_complex() {
        for (re, im, is_complex) in
            [(0.9, 0.0, false), (-0.9, 0.0, false), (0.5, 0.1, true), (-0.5, -0.1, true)]
        {
            assert_eq!(Eigenvalue::new(re, im).is_complex(), is_complex, "{re} {im}");
        }
    }

    fn without_memory(map: &DMatrix<f64>) -> Maps {
        [map.clone(), map * map, map * map * map]
    }

    #[test]
    fn memory_is_distinguished_from_rounding_at_any_scale() {
        for size in [1.0, 1e5] {
            let map = DMatrix::from_row_slice(2, 2, &[0.8, 0.3 * size, -0.5 / size, 0.9]);
            for (off, wanted) in [(0.0, false), (1e-8, true), (1e-12, false)] {
                let mut maps = without_memory(&map);
                maps[1] *= 1.0 + off;
                assert_eq!(has_memory(&maps), wanted, "{size}: {off}");
            }
        }
    }

    #[test]
    fn a_map_without_memory_keeps_its_own_eigenvalues() {
        let (cos, sin) = (libm::cos(0.3), libm::sin(0.3));
        for size in [1.0, 1e6] {
            let map = DMatrix::from_row_slice(
                2,
                2,
                &[0.9 * cos, 0.9 * sin * size, -0.9 * sin / size, 0.9 * cos],
            );
            for value in eigenvalues(&without_memory(&map)).unwrap() {
                assert!((value.modulus - 0.9).abs() < 1e-12, "{size}: {value:?}");
                assert!((value.angle - 0.3).abs() < 1e-12, "{size}: {value:?}");
            }
        }
    }
}
