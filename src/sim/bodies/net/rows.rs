//! A grid of springs, evaluated row by row: springs of one direction side by side, on all cores.
//!
//! The sum on a node follows the order of the plan, so that it has the same bits as the net given as lists. First
//! comes the force on the node alone. Then come the springs to up left, up, up right, left, down left, right, down and
//! down right, and then those to fixed nodes. No partial sum passes from one node to another, so neither the vector
//! width nor the number of threads changes a bit.

use std::ops::Range;
use std::slice;

use super::forces::Forces;
use crate::sim::batch::{InstructionSet, Kernel};
use crate::sim::cores::{self, split};
use crate::sim::net_plan::{Grid, SpringDirection, distance};

/// A vector over the nodes, as pairs of x and y.
pub(super) type Nodes<'a> = &'a [[f64; 2]];

/// Columns evaluated at a time. Their buffers, also those of a slope, fit into the first-level cache.
const TILE: usize = 63;

/// Springs of one direction evaluated side by side.
const WIDTH: usize = 8;

/// Lanes of a tile's buffer: its nodes and one more on either side, rounded up to whole blocks, and one more.
const LANES: usize = TILE + 1 + WIDTH;

/// Nodes that a thread takes at a time: some ten microseconds of work. One thread steps a smaller net.
const GRAIN: usize = cores::GRAIN / 4;

/// One number for each node of a part of a row.
type Lanes = [f64; LANES];

/// A part of a row of `N` vectors, as x and y.
type Row<const N: usize> = [[Lanes; 2]; N];

/// The index of each free node of a grid in a vector. The shown node comes first, and all others follow by their
/// number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rows {
    pub(super) grid: Grid,
    /// The number of the node that comes first.
    first: usize,
}

/// Rest lengths of the springs of a grid, by direction.
#[derive(Clone, Debug, Default)]
pub(super) struct RestLengths {
    /// Springs to the right of each column, after a dummy entry.
    across: Vec<f64>,
    /// Springs below each row.
    down: Vec<f64>,
    /// Both diagonals of each square, indexed as `across`, for each distinct row distance.
    diagonal: Vec<Vec<f64>>,
    /// The index into `diagonal` for the squares below each row.
    diagonal_of: Vec<u32>,
}

impl RestLengths {
    pub(super) fn new(grid: &Grid, rest_ratio: f64) -> Self {
        let column_ends = |column: usize| [0, 1].map(|next| grid.place(column + next));
        let row_ends = |row: usize| [0, 1].map(|next| grid.place((row + next) * grid.columns));
        let padding = std::iter::repeat_n(0.0, LANES);
        let springs = || (0..grid.columns - 1).map(column_ends);
        let padded = |lengths: &mut dyn Iterator<Item = f64>| -> Vec<f64> {
            std::iter::once(0.0).chain(lengths).chain(padding.clone()).collect()
        };
        let across = padded(&mut springs().map(|ends| rest_ratio * distance(ends)));
        let down = (0..grid.rows - 1).map(|row| rest_ratio * distance(row_ends(row))).collect();
        let (mut apart, mut diagonal, mut diagonal_of) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..if grid.shear { grid.rows - 1 } else { 0 } {
            let [above, below] = row_ends(row).map(|[_, y]| y);
            let dy = below - above;
            let known = apart.iter().position(|known: &f64| known.to_bits() == dy.to_bits());
            diagonal_of.push(known.unwrap_or(apart.len()) as u32);
            if known.is_none() {
                apart.push(dy);
                let lengths =
                    springs().map(|[from, to]| distance([[from[0], above], [to[0], below]]));
                diagonal.push(padded(&mut lengths.map(|length| rest_ratio * length)));
            }
        }
        Self { across, down, diagonal, diagonal_of }
    }

    /// Rest length of the spring that begins at a column of a row.
    pub(super) fn of(&self, row: usize, column: usize, way: SpringDirection) -> f64 {
        match way {
            SpringDirection::Right => self.across[column + 1],
            SpringDirection::Down => self.down[row],
            SpringDirection::Falling | SpringDirection::Rising => self.diagonals(row)[column + 1],
        }
    }

    fn diagonals(&self, row: usize) -> &[f64] {
        &self.diagonal[self.diagonal_of[row] as usize]
    }
}

impl Rows {
    pub(super) fn new(grid: Grid, kicked: Option<usize>) -> Self {
        let last = grid.free_before(grid.nodes()) - 1;
        Self { grid, first: kicked.unwrap_or_else(|| grid.free_node(last)) }
    }

    /// Number of free nodes.
    pub(super) fn len(&self) -> usize {
        self.grid.free_before(self.grid.nodes())
    }

    /// The index of a free node in a vector.
    #[inline]
    pub(super) fn index_of(&self, node: usize) -> usize {
        if node == self.first { 0 } else { 1 + self.rank(node) }
    }

    /// The number of the node at an index of a vector.
    pub(super) fn node_at(&self, index: usize) -> usize {
        if index == 0 {
            return self.first;
        }
        let free = index - 1 + usize::from(index > self.grid.free_before(self.first));
        self.grid.free_node(free)
    }

    /// Number of free nodes before a node, without the first one.
    fn rank(&self, node: usize) -> usize {
        self.grid.free_before(node) - usize::from(node > self.first)
    }

    /// Overwrites `sums` with the force on each node, by itself and by the springs to free nodes. `vectors` are over
    /// the free nodes. This processor must have the instruction set.
    pub(super) fn sum<const N: usize>(
        &self,
        set: InstructionSet,
        forces: impl Forces<N>,
        (constants, rest): ([f64; 2], &RestLengths),
        vectors: [Nodes<'_>; N],
        sums: &mut [[f64; 2]],
    ) {
        let Some((first, others)) = sums.split_first_mut() else { return };
        let part = GridForces { rows: *self, forces, constants, rest, vectors };
        let Grid { columns, rows, .. } = self.grid;
        let sink = Sink { first: Some(first), others };
        let all = Band { part, columns: 0..columns, rows: 0..rows, sink };
        split(all, Band::halve, |band| set.run(band));
    }

    /// Calls `see` for each spring between free nodes, in the order of the plan, with the indices of its ends, and its
    /// row, column and direction.
    pub(super) fn each_spring(
        &self,
        mut see: impl FnMut([usize; 2], (usize, usize, SpringDirection)),
    ) {
        for row in 0..self.grid.rows {
            for (column, way) in self.grid.springs(row) {
                let ends = self.grid.ends(row, column, way);
                if row > 0 || !ends.iter().any(|&end| self.grid.is_fixed(end)) {
                    see(ends.map(|end| self.index_of(end)), (row, column, way));
                }
            }
        }
    }

    /// The free nodes among these columns of a row, as runs that are contiguous in a vector, each with the index of
    /// its first node. The runs are those before the shown node, that node, and those after it.
    fn runs(&self, row: usize, columns: Range<usize>) -> [(Range<usize>, usize); 3] {
        let free = self.grid.free_columns(row);
        let start = columns.start.max(free.start);
        let columns = start..columns.end.min(free.end).max(start);
        let number = |column: usize| row * self.grid.columns + column;
        let after = |from: usize, to: usize| (from..to, 1 + self.rank(number(from)));
        let first = self.first.wrapping_sub(number(0));
        if columns.is_empty() {
            [(0..0, 0), (0..0, 0), (0..0, 0)]
        } else if columns.contains(&first) {
            [after(columns.start, first), (first..first + 1, 0), after(first + 1, columns.end)]
        } else {
            [after(columns.start, columns.end), (0..0, 0), (0..0, 0)]
        }
    }
}

/// The forces of a grid, and the vectors they are evaluated on.
#[derive(Clone, Copy)]
struct GridForces<'a, F, const N: usize> {
    rows: Rows,
    forces: F,
    /// Stiffness and damping of every spring, as for [`Forces::spring_force`].
    constants: [f64; 2],
    rest: &'a RestLengths,
    vectors: [Nodes<'a>; N],
}

/// The destination of the sums on some nodes.
struct Sink<'a> {
    /// The sum on the shown node, if it is among them.
    first: Option<&'a mut [f64; 2]>,
    /// The sums on all other nodes.
    others: &'a mut [[f64; 2]],
}

/// Some columns of some rows, evaluated by one thread.
struct Band<'a, F, const N: usize> {
    part: GridForces<'a, F, N>,
    columns: Range<usize>,
    rows: Range<usize>,
    sink: Sink<'a>,
}

impl<F: Forces<N>, const N: usize> Band<'_, F, N> {
    /// Splits the band into halves: by rows, or by columns if it is one row. `Err(self)` if it is small enough for one
    /// thread.
    fn halve(self) -> Result<[Self; 2], Self> {
        let (across, down) = (self.columns.len(), self.rows.len());
        if across * down <= GRAIN || self.rows.is_empty() {
            return Err(self);
        }
        let Self { part, columns, rows, sink } = self;
        let middle = rows.start + down / 2;
        let (near, far) = if down > 1 {
            ([columns.clone(), rows.start..middle], [columns, middle..rows.end])
        } else {
            let middle = columns.start + across / 2;
            ([columns.start..middle, rows.clone()], [middle..columns.end, rows])
        };
        let begin = |[columns, rows]: &[Range<usize>; 2]| {
            rows.start * part.rows.grid.columns + columns.start
        };
        let (from, to) = (part.rows.rank(begin(&near)), part.rows.rank(begin(&far)));
        let (of_near, of_far) = sink.others.split_at_mut(to - from);
        let is_near = part.rows.first < begin(&far);
        let (first_near, first_far) = if is_near { (sink.first, None) } else { (None, sink.first) };
        let half = |[columns, rows]: [Range<usize>; 2], first, others| {
            let sink = Sink { first, others };
            Band { part, columns, rows, sink }
        };
        Ok([half(near, first_near, of_near), half(far, first_far, of_far)])
    }
}

impl<F: Forces<N>, const N: usize> Kernel for Band<'_, F, N> {
    #[inline(always)]
    fn run(self) {
        let Self { part, columns, rows, sink: Sink { mut first, others } } = self;
        let before = part.rows.rank(rows.start * part.rows.grid.columns + columns.start);
        let mut start = columns.start;
        while start < columns.end {
            let end = columns.end.min(start + TILE);
            let mut tile = Tile::new(part, start..end);
            tile.begin(rows.start);
            for row in rows.clone() {
                tile.evaluate_row(row);
                for (run, index) in part.rows.runs(row, start..end) {
                    if run.is_empty() {
                        continue;
                    }
                    let to = match (index, &mut first) {
                        (0, Some(first)) => slice::from_mut(&mut **first),
                        _ => &mut others[index - 1 - before..][..run.len()],
                    };
                    tile.sum(row, run.start + 1 - start, to);
                }
            }
            start = end;
        }
    }
}

/// Some columns, evaluated from the top row down. Lane 0 is the column before the first of them.
struct Tile<'a, F, const N: usize> {
    part: GridForces<'a, F, N>,
    columns: Range<usize>,
    /// The nodes of the current row and of the one below, in turn.
    nodes: [Row<N>; 2],
    /// The forces on the first end of the springs to the right in the current row.
    right: [Lanes; 2],
    /// The forces of the springs that go down from the current row and from the one above, in turn: straight, falling
    /// and rising.
    down: [[[Lanes; 2]; 3]; 2],
}

impl<'a, F: Forces<N>, const N: usize> Tile<'a, F, N> {
    #[inline(always)]
    fn new(part: GridForces<'a, F, N>, columns: Range<usize>) -> Self {
        let none = [[0.0; LANES]; 2];
        Self { part, columns, nodes: [[none; N]; 2], right: none, down: [[none; 3]; 2] }
    }

    /// Prepares the first row.
    #[inline(always)]
    fn begin(&mut self, row: usize) {
        self.load(row);
        if row > 0 {
            self.load(row - 1);
            self.evaluate_springs_below(row - 1);
        }
    }

    /// Evaluates the springs that begin in the row.
    #[inline(always)]
    fn evaluate_row(&mut self, row: usize) {
        self.evaluate_springs(row, SpringDirection::Right);
        if row + 1 < self.part.rows.grid.rows {
            self.load(row + 1);
            self.evaluate_springs_below(row);
        } else {
            // The bottom row: zeros that change no sum.
            self.down[row % 2].as_flattened_mut().iter_mut().for_each(|lanes| lanes.fill(-0.0));
        }
    }

    /// The sums on nodes of the current row, from this lane on.
    #[inline(always)]
    fn sum(&self, row: usize, lane: usize, to: &mut [[f64; 2]]) {
        let (forces, count) = (self.part.forces, to.len());
        let here = lane_ranges(&self.nodes[row % 2], lane, count);
        let [right, left] = [lane, lane - 1].map(|at| lane_range(&self.right, at, count));
        let [down, falling, rising] = &self.down[row % 2];
        let [down, falling] = [down, falling].map(|pulls| lane_range(pulls, lane, count));
        let rising = lane_range(rising, lane - 1, count);
        let [up, from_left, from_right] = &self.down[(row + 1) % 2];
        let [up, from_right] = [up, from_right].map(|pulls| lane_range(pulls, lane, count));
        let from_left = lane_range(from_left, lane - 1, count);
        if self.part.rows.grid.shear {
            for i in 0..count {
                let sum = forces.on_node(node(&here, i));
                for axis in 0..2 {
                    let sum = sum[axis] - from_left[axis][i] - up[axis][i] - from_right[axis][i];
                    let sum = sum - left[axis][i] + rising[axis][i] + right[axis][i];
                    to[i][axis] = sum + down[axis][i] + falling[axis][i];
                }
            }
        } else {
            for i in 0..count {
                let sum = forces.on_node(node(&here, i));
                for axis in 0..2 {
                    let sum = sum[axis] - up[axis][i] - left[axis][i];
                    to[i][axis] = sum + right[axis][i] + down[axis][i];
                }
            }
        }
    }

    /// Number of lanes to evaluate: whole blocks with all columns, and the springs to the first of them.
    #[inline(always)]
    fn lanes(&self) -> usize {
        (self.columns.len() + 1).next_multiple_of(WIDTH).min(TILE + 1)
    }

    /// Loads the nodes of a row, with one more column on either side. Leaves fixed nodes and those beyond the border
    /// unchanged.
    #[inline(always)]
    fn load(&mut self, row: usize) {
        let Range { start, end } = self.columns;
        let Rows { grid, .. } = self.part.rows;
        let seen = start.saturating_sub(1)..grid.columns.min(end + 1);
        let to = &mut self.nodes[row % 2];
        for (run, index) in self.part.rows.runs(row, seen.clone()) {
            if run.is_empty() {
                continue;
            }
            let lane = run.start + 1 - start;
            for (vector, [x, y]) in self.part.vectors.iter().zip(to.iter_mut()) {
                let from = &vector[index..index + run.len()];
                let [x, y] = [x, y].map(|lanes| &mut lanes[lane..lane + run.len()]);
                for ((from, x), y) in from.iter().zip(x).zip(y) {
                    (*x, *y) = (from[0], from[1]);
                }
            }
        }
    }

    /// Evaluates the springs from a row to the one below; both must be loaded.
    #[inline(always)]
    fn evaluate_springs_below(&mut self, row: usize) {
        self.evaluate_springs(row, SpringDirection::Down);
        if self.part.rows.grid.shear {
            self.evaluate_springs(row, SpringDirection::Falling);
            self.evaluate_springs(row, SpringDirection::Rising);
        }
    }

    /// Evaluates the springs of one direction that begin in a row.
    #[inline(always)]
    fn evaluate_springs(&mut self, row: usize, way: SpringDirection) {
        let GridForces { rows, forces, constants: [k, c], rest, .. } = self.part;
        let ([from, to], rows_down) = way.ends();
        let (above, below) = (&self.nodes[row % 2], &self.nodes[(row + rows_down) % 2]);
        let lanes = self.lanes();
        let ends = [lane_ranges(above, from, lanes), lane_ranges(below, to, lanes)];
        let [straight, falling, rising] = &mut self.down[row % 2];
        let (pulls, rest) = match way {
            SpringDirection::Right => (&mut self.right, &rest.across[..]),
            SpringDirection::Down => (straight, &[][..]),
            SpringDirection::Falling => (falling, rest.diagonals(row)),
            SpringDirection::Rising => (rising, rest.diagonals(row)),
        };
        let [x, y] = pulls.each_mut().map(|numbers| &mut numbers[..lanes]);
        if let SpringDirection::Down = way {
            let constants = [k, c, self.part.rest.down[row]];
            for i in 0..lanes {
                [x[i], y[i]] =
                    forces.spring_force(&constants, node(&ends[0], i), node(&ends[1], i));
            }
        } else {
            let rest = &rest[self.columns.start..][..lanes];
            for i in 0..lanes {
                let constants = [k, c, rest[i]];
                [x[i], y[i]] =
                    forces.spring_force(&constants, node(&ends[0], i), node(&ends[1], i));
            }
        }
        // Missing and anchored springs contribute a zero whose sign leaves every sum unchanged.
        let last = self.columns.len();
        let is_free = |lane: usize, row: usize| {
            let column = (self.columns.start + lane).wrapping_sub(1);
            rows.grid.free_columns(row).contains(&column)
        };
        let step = if row == 0 && rows.grid.pin.is_some() { 1 } else { last };
        for lane in (0..=last).step_by(step) {
            let begins = is_free(lane + from, row);
            if !(begins && is_free(lane + to, row + rows_down)) {
                (x[lane], y[lane]) = if begins { (-0.0, -0.0) } else { (0.0, 0.0) };
            }
        }
    }
}

/// Numbers of neighbouring lanes.
#[inline(always)]
fn lane_range(pairs: &[Lanes; 2], from: usize, count: usize) -> [&[f64]; 2] {
    pairs.each_ref().map(|numbers| &numbers[from..from + count])
}

/// Numbers of neighbouring lanes of every vector.
#[inline(always)]
fn lane_ranges<const N: usize>(row: &Row<N>, from: usize, count: usize) -> [[&[f64]; 2]; N] {
    row.each_ref().map(|vector| lane_range(vector, from, count))
}

/// The numbers of one node.
#[inline(always)]
fn node<const N: usize>(nodes: &[[&[f64]; 2]; N], i: usize) -> [[f64; 2]; N] {
    let mut node = [[0.0; 2]; N];
    for (node, numbers) in node.iter_mut().zip(nodes) {
        *node = [numbers[0][i], numbers[1][i]];
    }
    node
}
