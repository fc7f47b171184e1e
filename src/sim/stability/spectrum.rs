//! Eigenvalues of a map that is known by its derivatives, and of one that remembers more than it shows.

use nalgebra::{ColPivQR, DMatrix, Schur};

/// An eigenvalue, with its conjugate turned to this side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Eigenvalue {
    pub(super) modulus: f64,
    /// 0 to π.
    pub(super) angle: f64,
}

impl Eigenvalue {
    fn new(re: f64, im: f64) -> Self {
        Self { modulus: libm::hypot(re, im), angle: libm::atan2(im.abs(), re) }
    }

    /// Whether it turns, and not only stretches or flips.
    pub(super) fn turns(self) -> bool {
        self.angle > 0.0 && self.angle < std::f64::consts::PI
    }
}

/// Derivatives of the state after some ticks with respect to the state before them, `ahead[k]` being
/// after k + 1 ticks: three from the present, two from one tick later.
pub(super) struct Derivatives {
    pub(super) now: [DMatrix<f64>; 3],
    pub(super) later: [DMatrix<f64>; 2],
}

impl Derivatives {
    /// Whether two ticks are more than one after the other.
    pub(super) fn has_memory(&self) -> bool {
        remembers(&self.now, &self.later).1
    }

    /// Whether the map changes as the body moves.
    pub(super) fn bends(&self) -> bool {
        (&self.now[0] - &self.later[0]).amax() > BEND * (1.0 + self.now[0].amax())
    }
}

/// How far two ticks are from the product of the two, and whether that is memory.
fn remembers(now: &[DMatrix<f64>; 3], later: &[DMatrix<f64>; 2]) -> (f64, bool) {
    let off = (&now[1] - &later[0] * &now[0]).amax();
    (off, off > MEMORY * (1.0 + now[1].amax()))
}

/// A map that differs by more than this a tick later is that of a nonlinear body.
const BEND: f64 = 1e-9;
/// How far two ticks may be from the product of the two before it is memory: well above the rounding
/// of the differences, well below what a step of a multistep method adds where its order can be seen.
const MEMORY: f64 = 1e-10;
/// Directions that the states reached fill less than this, against the most filled, are rounding.
const RANK: f64 = 1e-10;
/// Sweeps of the eigenvalue iteration; it takes some 3 for each row.
const SWEEPS_A_ROW: usize = 60;

/// Eigenvalues of the true map: one of the state alone where two ticks are the product of the two, and
/// else of the state and what the method carries, found from how the states reached go on.
///
/// `None` where they are not finite or cannot be found.
pub(super) fn eigenvalues(derivatives: &Derivatives) -> Option<Vec<Eigenvalue>> {
    let Derivatives { now, later } = derivatives;
    let all = now.iter().chain(later);
    if all.clone().any(|matrix| matrix.iter().any(|x| !x.is_finite())) {
        return None;
    }
    // Parts that do not feel each other in turn are taken apart: exact noughts keep what is neutral
    // exactly neutral, where an iteration over the whole would blur double eigenvalues.
    let mut values = Vec::new();
    for part in parts(&all.collect::<Vec<_>>()) {
        let cut = |matrix: &DMatrix<f64>| matrix.select_rows(&part).select_columns(&part);
        let (now, later) = (now.each_ref().map(cut), later.each_ref().map(cut));
        let (off, has_memory) = remembers(&now, &later);
        let (map, blur) = match has_memory {
            true => (&with_memory(&now, &later)?, NEUTRAL_WITH_MEMORY),
            false => (&now[0], BLUR * off),
        };
        values.extend(of_matrix(map)?.into_iter().map(|value| sharpened(value, blur)));
    }
    Some(values)
}

/// Eigenvalues of a map without memory.
pub(super) fn of_map(map: &DMatrix<f64>) -> Option<Vec<Eigenvalue>> {
    if map.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let mut values = Vec::new();
    for part in parts(&[map]) {
        values.extend(of_matrix(&map.select_rows(&part).select_columns(&part))?);
    }
    Some(values)
}

/// The classes of indices that feel each other, by however many steps, in any of the matrices.
fn parts(matrices: &[&DMatrix<f64>]) -> Vec<Vec<usize>> {
    let n = matrices[0].nrows();
    let felt = |i: usize, j: usize| matrices.iter().any(|matrix| matrix[(i, j)] != 0.0);
    let mut reaches: Vec<Vec<bool>> =
        (0..n).map(|i| (0..n).map(|j| i == j || felt(i, j)).collect()).collect();
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

fn of_matrix(matrix: &DMatrix<f64>) -> Option<Vec<Eigenvalue>> {
    match matrix.nrows() {
        1 => Some(vec![Eigenvalue::new(matrix[0], 0.0)]),
        2 => Some(of_two_rows(matrix).to_vec()),
        rows => {
            let sweeps = SWEEPS_A_ROW * rows;
            let schur = Schur::try_new(matrix.clone(), f64::EPSILON, sweeps)?;
            Some(schur.complex_eigenvalues().iter().map(|z| Eigenvalue::new(z.re, z.im)).collect())
        }
    }
}

fn of_two_rows(matrix: &DMatrix<f64>) -> [Eigenvalue; 2] {
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

/// A modulus this near 1 is 1, where a memory had to be found out.
pub(super) const NEUTRAL_WITH_MEMORY: f64 = 1e-9;
/// And without memory, in units of what two ticks are off from their product, which is the rounding of
/// the differences: much for a method that makes velocities of differences of positions.
const BLUR: f64 = 10.0;

fn sharpened(value: Eigenvalue, blur: f64) -> Eigenvalue {
    let neutral = (value.modulus - 1.0).abs() < blur;
    Eigenvalue { modulus: if neutral { 1.0 } else { value.modulus }, ..value }
}

/// The map of (state, state one tick ago), restricted to what is reached: its action on two pairs of
/// states that came of a fresh start, one and two ticks ago, is known. What a method carries, be it
/// forces, slopes or an older state, follows from two states in a row.
fn with_memory(now: &[DMatrix<f64>; 3], later: &[DMatrix<f64>; 2]) -> Option<DMatrix<f64>> {
    let n = now[0].nrows();
    let identity = DMatrix::identity(n, n);
    let pairs = |blocks: [[&DMatrix<f64>; 2]; 2]| {
        DMatrix::from_fn(2 * n, 2 * n, |i, j| blocks[i / n][j / n][(i % n, j % n)])
    };
    let reached = pairs([[&later[0], &now[1]], [&identity, &now[0]]]);
    let mut next = pairs([[&later[1], &now[2]], [&later[0], &now[1]]]);

    let factors = ColPivQR::new(reached);
    let (q, r) = (factors.q(), factors.r());
    let rank = (0..2 * n).take_while(|&i| r[(i, i)].abs() > RANK * r[(0, 0)].abs()).count();
    // Not a number, or past all numbers.
    if rank == 0 {
        return None;
    }
    factors.p().permute_columns(&mut next);
    let basis = q.columns(0, rank);
    let square = r.view((0, 0), (rank, rank)).into_owned();
    // basisᵀ next square⁻¹, by the transposed triangle.
    let image = basis.transpose() * next.columns(0, rank);
    let solved = square.transpose().solve_lower_triangular(&image.transpose())?;
    Some(solved.transpose())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_those_that_feel_each_other() {
        let map = DMatrix::from_row_slice(
            4,
            4,
            &[1.0, 0.1, 0.0, 0.0, 0.0, 0.9, 0.0, 0.2, 0.3, 0.0, 1.0, 0.0, 0.0, 0.5, 0.0, 1.0],
        );
        assert_eq!(parts(&[&map]), [vec![0], vec![1, 3], vec![2]]);
        // Two neutral coordinates, one driving the other, stay neutral to the bit.
        let values = of_map(&map).unwrap();
        assert_eq!(values.iter().filter(|value| value.modulus == 1.0).count(), 2);
    }

    #[test]
    fn a_map_that_remembers_gives_up_its_hidden_eigenvalue() {
        // x' = 1.2 x + 0.3 x_before, which begins as if x_before were x.
        let recur = |states: &[f64]| {
            let before = if states.len() > 1 { states[states.len() - 2] } else { states[0] };
            1.2 * states[states.len() - 1] + 0.3 * before
        };
        let mut states = vec![1.0];
        for _ in 0..3 {
            states.push(recur(&states));
        }
        let scalar = |x: f64| DMatrix::from_element(1, 1, x);
        let now = [scalar(states[1]), scalar(states[2]), scalar(states[3])];
        let later = [scalar(states[1]), scalar(states[2])];
        let mut found = eigenvalues(&Derivatives { now, later }).unwrap();
        found.sort_by(|a, b| a.modulus.total_cmp(&b.modulus));
        let root = (0.36_f64 + 0.3).sqrt();
        assert!((found[1].modulus - (0.6 + root)).abs() < 1e-12, "{found:?}");
        assert!((found[0].modulus - (root - 0.6)).abs() < 1e-12, "{found:?}");
        assert_eq!(found[0].angle, std::f64::consts::PI);
    }

    #[test]
    fn what_rounding_alone_fills_is_no_memory() {
        // One of two coordinates remembers, x' = 1.2 x + 0.3 x_before; the other one, x' = 0.8 x, does not. Both are
        // seen at an angle, and blurred.
        for size in [1.0, 30.0] {
            let one = [1.5, 2.1, 2.97].map(|x| x * size);
            let other = [0.8, 0.64, 0.512].map(|x| x * size);
            let (cos, sin) = (libm::cos(0.7), libm::sin(0.7));
            let turn = DMatrix::from_row_slice(2, 2, &[cos, -sin, sin, cos]);
            let mut blur = 0.0;
            let mut seen = |k: usize, power: i32| {
                let own = DMatrix::from_row_slice(2, 2, &[one[k], 0.0, 0.0, other[k]]);
                let map: DMatrix<f64> = &turn * own * turn.transpose() * size.powi(power);
                map.map(|x| {
                    blur += 1.0;
                    x * (1.0 + 1e-12 * libm::sin(blur))
                })
            };
            let now = [seen(0, 0), seen(1, 1), seen(2, 2)];
            let later = [seen(0, 0), seen(1, 1)];
            let mut found = eigenvalues(&Derivatives { now, later }).unwrap();
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
    fn what_only_stretches_or_flips_does_not_turn() {
        for (re, im, turns) in
            [(0.9, 0.0, false), (-0.9, 0.0, false), (0.5, 0.1, true), (-0.5, -0.1, true)]
        {
            assert_eq!(Eigenvalue::new(re, im).turns(), turns, "{re} {im}");
        }
    }

    /// Derivatives of a body whose map is `first`, a tick later `then`, and then that for ever.
    fn without_memory(first: &DMatrix<f64>, then: &DMatrix<f64>) -> Derivatives {
        let now = [first.clone(), then * first, then * then * first];
        Derivatives { now, later: [then.clone(), then * then] }
    }

    #[test]
    fn memory_and_bends_are_told_from_rounding_whatever_the_size_of_the_map() {
        for size in [1.0, 1e5] {
            let map = DMatrix::from_row_slice(2, 2, &[0.8, 0.3 * size, -0.5 / size, 0.9]);
            let still = without_memory(&map, &map);
            assert!(!still.has_memory() && !still.bends(), "{size}");
            let turned = without_memory(&map, &(&map * (1.0 + 1e-8)));
            assert!(!turned.has_memory() && turned.bends(), "{size}");
            let blurred = without_memory(&map, &(&map * (1.0 + 1e-11)));
            assert!(!blurred.has_memory() && !blurred.bends(), "{size}");
            for (off, remembers) in [(1e-8, true), (1e-12, false)] {
                let Derivatives { mut now, later } = without_memory(&map, &map);
                now[1] *= 1.0 + off;
                let found = Derivatives { now, later };
                assert_eq!(found.has_memory(), remembers, "{size}: {off}");
                assert!(!found.bends(), "{size}: {off}");
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
            for value in eigenvalues(&without_memory(&map, &map)).unwrap() {
                assert!((value.modulus - 0.9).abs() < 1e-12, "{size}: {value:?}");
                assert!((value.angle - 0.3).abs() < 1e-12, "{size}: {value:?}");
            }
        }
    }
}
