//! Marching squares, which finds the region of a plane in which a condition holds, from a grid of points and bisection
//! between them.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use super::{Coverage, Meter, Region};
use crate::sim::numerics::bisect;

/// Number of bisections between two points of the grid. They find a boundary to a five-hundredth of the points'
/// distance, which is less than a pixel of a map that fills a screen.
const HALVINGS: u32 = 9;

/// A grid of points over a rectangle. The outermost points are on the rectangle's border.
pub(super) struct Corners {
    counts: [usize; 2],
    ends: [[f64; 2]; 2],
}

impl Corners {
    pub(super) fn new(counts: [usize; 2], ends: [[f64; 2]; 2]) -> Self {
        Self { counts, ends }
    }

    pub(super) fn counts(&self) -> [usize; 2] {
        self.counts
    }

    /// Returns the position of the point with these indices.
    pub(super) fn at(&self, index: [usize; 2]) -> [f64; 2] {
        std::array::from_fn(|axis| {
            let [low, high] = self.ends[axis];
            low + (high - low) * index[axis] as f64 / (self.counts[axis] - 1) as f64
        })
    }
}

/// A side of a square of the grid, given by its first corner and the axis along which it lies.
type Side = ([usize; 2], usize);

/// Returns the region in which a condition holds. `at_corner` evaluates the condition at the corners of the grid,
/// `on_row` at any x of a row, and `anywhere` at any point. The meter counts the work of a point on a row, and of a
/// point anywhere.
pub(super) async fn contour(
    corners: &Corners,
    at_corner: impl Fn([usize; 2]) -> bool,
    on_row: impl Fn(f64, usize) -> bool,
    anywhere: impl Fn([f64; 2]) -> bool,
    (meter, [of_row, of_any]): (&Meter, [u64; 2]),
) -> Region {
    let [columns, rows] = corners.counts;
    let mut holds = vec![Vec::with_capacity(columns); rows];
    for (j, row) in holds.iter_mut().enumerate() {
        for i in 0..columns {
            row.push(at_corner([i, j]));
            meter.yield_after(of_row).await;
        }
    }
    let inside = |[i, j]: [usize; 2]| holds[j][i];
    let crossing = |([i, j], axis): Side| {
        let end = if axis == 0 { [i + 1, j] } else { [i, j + 1] };
        let [from, to] = [[i, j], end].map(|corner| corners.at(corner)[axis]);
        let [x, y] = corners.at([i, j]);
        if axis == 0 {
            [between(from, to, inside([i, j]), |x| on_row(x, j)), y]
        } else {
            [x, between(from, to, inside([i, j]), |y| anywhere([x, y]))]
        }
    };
    let mut crossings: BTreeMap<Side, [f64; 2]> = BTreeMap::new();

    let (mut pieces, mut segments) = (Vec::new(), Vec::new());
    for j in 0..rows - 1 {
        // This is the first of a run of squares that are wholly inside.
        let mut run: Option<usize> = None;
        for i in 0..columns {
            let round = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
            let is_square = i + 1 < columns;
            if is_square && round.iter().all(|&corner| inside(corner)) {
                run = run.or(Some(i));
                continue;
            }
            if let Some(first) = run.take() {
                let rectangle = [[first, j], [i, j], [i, j + 1], [first, j + 1]];
                pieces.push(rectangle.map(|corner| corners.at(corner)).to_vec());
            }
            if !is_square || !round.iter().any(|&corner| inside(corner)) {
                continue;
            }
            let sides: [Side; 4] = [([i, j], 0), ([i + 1, j], 1), ([i, j + 1], 0), ([i, j], 1)];
            let (mut piece, mut crossed) = (Vec::new(), Vec::new());
            for k in 0..4 {
                if inside(round[k]) {
                    piece.push(corners.at(round[k]));
                }
                if inside(round[k]) != inside(round[(k + 1) % 4]) {
                    let side = sides[k];
                    if let Entry::Vacant(unknown) = crossings.entry(side) {
                        unknown.insert(crossing(side));
                        let work = if side.1 == 0 { of_row } else { of_any };
                        meter.yield_after(u64::from(HALVINGS) * work).await;
                    }
                    piece.push(crossings[&side]);
                    crossed.push(side);
                }
            }
            pieces.push(piece);
            segments.extend(crossed.chunks(2).map(|pair| [pair[0], pair[1]]));
        }
    }
    let all = holds.iter().flatten();
    let coverage = match (all.clone().all(|&holds| holds), all.clone().any(|&holds| holds)) {
        (true, _) => Coverage::Everywhere,
        (false, true) => Coverage::Part,
        (false, false) => Coverage::Nowhere,
    };
    let lines = chains(segments).into_iter();
    let boundary = lines.map(|line| line.into_iter().map(|side| crossings[&side]).collect());
    Region { coverage, pieces, boundary: boundary.collect(), limit: None, seen: Vec::new() }
}

/// Returns the place between `from` and `to` where the condition changes. `holds` is the value of the condition at
/// `from`.
fn between(from: f64, to: f64, holds: bool, holds_at: impl Fn(f64) -> bool) -> f64 {
    let [from, to] = bisect([from, to], HALVINGS, |at| holds_at(at) == holds);
    (from + to) / 2.0
}

/// Joins segments that share an end into lines.
fn chains(mut segments: Vec<[Side; 2]>) -> Vec<Vec<Side>> {
    let mut lines = Vec::new();
    while let Some([first, last]) = segments.pop() {
        let mut line = std::collections::VecDeque::from([first, last]);
        loop {
            let (front, back) = (line[0], line[line.len() - 1]);
            let touches = |segment: &[Side; 2]| segment.contains(&front) || segment.contains(&back);
            let Some(index) = segments.iter().position(touches) else { break };
            let [a, b] = segments.swap_remove(index);
            if a == back {
                line.push_back(b);
            } else if b == back {
                line.push_back(a);
            } else if a == front {
                line.push_front(b);
            } else {
                line.push_front(a);
            }
        }
        lines.push(line.into());
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::slices::block_on;

    #[test]
    fn a_disc_has_one_round_boundary_and_its_own_area() {
        let corners = Corners::new([21, 17], [[-2.0, 2.0], [-1.5, 1.5]]);
        let holds = |[x, y]: [f64; 2]| x * x + y * y < 1.0;
        let region = block_on(contour(
            &corners,
            |index| holds(corners.at(index)),
            |x, j| holds([x, corners.at([0, j])[1]]),
            holds,
            (&Meter::default(), [1; 2]),
        ));
        assert_eq!(region.coverage, Coverage::Part);
        assert_eq!(region.boundary.len(), 1);
        let line = &region.boundary[0];
        assert_eq!(line.first(), line.last());
        for [x, y] in line {
            assert!((libm::hypot(*x, *y) - 1.0).abs() < 1e-3, "{x}, {y}");
        }
        let area = |piece: &Vec<[f64; 2]>| -> f64 {
            let next = piece.iter().cycle().skip(1);
            piece.iter().zip(next).map(|(a, b)| (a[0] * b[1] - b[0] * a[1]) / 2.0).sum()
        };
        let area: f64 = region.pieces.iter().map(area).sum();
        // The polygon is inside the circle.
        assert!((3.08..std::f64::consts::PI).contains(&area), "{area}");
    }

    #[test]
    fn a_condition_that_holds_everywhere_or_nowhere_has_no_boundary() {
        let corners = Corners::new([5, 4], [[0.0, 1.0], [0.0, 1.0]]);
        for (holds, coverage, pieces) in
            [(true, Coverage::Everywhere, 3), (false, Coverage::Nowhere, 0)]
        {
            let effort = (&Meter::default(), [1; 2]);
            let region = block_on(contour(&corners, |_| holds, |_, _| holds, |_| holds, effort));
            assert_eq!((region.coverage, region.pieces.len()), (coverage, pieces));
            assert!(region.boundary.is_empty());
        }
    }
}
