//! A plan prepared for stepping: the free nodes, and the index of each in a vector.

use std::sync::Arc;

use super::rows::Rows;
use crate::sim::net_plan::{Lists, NetLayout, NetPlan, PlannedSpring};

/// The index of a fixed node, which has no coordinates.
const FIXED: u32 = u32::MAX;

/// The fewest nodes of a grid that is stepped by rows: lists are as fast for smaller ones.
const MIN_ROWS_NODES: usize = 2048;

/// The data that all bodies of one plan share.
#[derive(Debug)]
pub(super) struct Topology {
    pub(super) plan: Arc<NetPlan>,
    pub(super) storage: Storage,
    /// Number of free nodes.
    pub(super) free: usize,
    /// For each spring with a fixed end: index of its free node, position of its anchor.
    pub(super) anchors: Vec<(u32, [f64; 2])>,
    /// Whether a kick hits only the first free node, rather than all of them.
    pub(super) kicks_first: bool,
}

/// The order of the free nodes in a vector. The kicked node, or else the last one, comes first, because plots show the
/// first coordinate; the others follow by their numbers.
#[derive(Debug)]
pub(super) enum Storage {
    /// A large grid.
    Rows(Rows),
    /// A net of lists, or a small grid converted to lists.
    Arrays(Arrays),
}

/// The nodes and springs of lists, in arrays.
#[derive(Debug)]
pub(super) struct Arrays {
    /// The number of each free node.
    free: Vec<u32>,
    /// The index of each node among the free ones, or [`FIXED`].
    index_of: Vec<u32>,
    /// The indices of the ends of each spring between free nodes.
    pub(super) ends: Vec<[u32; 2]>,
}

impl Topology {
    /// Prepares a plan without [faults](NetPlan::faults).
    pub(super) fn new(plan: Arc<NetPlan>) -> Self {
        let by_rows = matches!(plan.form, NetLayout::Grid(grid) if grid.nodes() >= MIN_ROWS_NODES);
        Self::laid_out(plan, by_rows)
    }

    /// Prepares a plan; a grid by rows, or as lists.
    pub(super) fn laid_out(plan: Arc<NetPlan>, by_rows: bool) -> Self {
        let storage = match &plan.form {
            NetLayout::Grid(grid) if by_rows => Storage::Rows(Rows::new(*grid, plan.kicked)),
            NetLayout::Grid(grid) => Storage::Arrays(Arrays::new(&grid.lists(), plan.kicked)),
            NetLayout::Lists(lists) => Storage::Arrays(Arrays::new(lists, plan.kicked)),
        };
        let free = match &storage {
            Storage::Rows(rows) => rows.len(),
            Storage::Arrays(arrays) => arrays.free.len(),
        };
        let kicks_first = plan.kicked.is_some();
        let mut topology = Self { plan, storage, free, anchors: Vec::new(), kicks_first };
        let anchors = topology.anchored().map(|PlannedSpring { between: [a, b], .. }| {
            let of = |node| topology.index_of(node).map(|index| index as u32);
            match (of(a), of(b)) {
                (Some(index), _) => (index, topology.place(b)),
                (None, index) => (index.expect("a free end"), topology.place(a)),
            }
        });
        topology.anchors = anchors.collect();
        topology
    }

    /// The springs whose constants are kept, in the order of the sums: all springs of lists, or those of rows with a
    /// fixed end.
    pub(super) fn kept_springs(&self) -> impl Iterator<Item = PlannedSpring> + '_ {
        let is_kept = |_: &PlannedSpring| matches!(self.storage, Storage::Arrays(_));
        let inner = self.plan.springs().filter(is_kept).filter(|it| !self.is_anchored(it));
        inner.chain(self.anchored())
    }

    /// The springs with a fixed end, in the order of the plan.
    fn anchored(&self) -> impl Iterator<Item = PlannedSpring> + '_ {
        self.plan.springs().filter(|spring| self.is_anchored(spring))
    }

    /// Whether either end of a spring is fixed.
    fn is_anchored(&self, spring: &PlannedSpring) -> bool {
        spring.between.iter().any(|&node| self.index_of(node).is_none())
    }

    /// The place of a node at the start.
    pub(super) fn place(&self, node: usize) -> [f64; 2] {
        match &self.plan.form {
            NetLayout::Grid(grid) => grid.place(node),
            NetLayout::Lists(lists) => lists.nodes[node],
        }
    }

    /// The index of a node among the free ones; `None` if it is fixed.
    #[inline]
    pub(super) fn index_of(&self, node: usize) -> Option<usize> {
        match &self.storage {
            Storage::Rows(rows) => (!rows.grid.is_fixed(node)).then(|| rows.index_of(node)),
            Storage::Arrays(arrays) => {
                Some(arrays.index_of[node]).filter(|&it| it != FIXED).map(|index| index as usize)
            }
        }
    }

    /// The number of the free node with this index.
    pub(super) fn node_at(&self, index: usize) -> usize {
        match &self.storage {
            Storage::Rows(rows) => rows.node_at(index),
            Storage::Arrays(arrays) => arrays.free[index] as usize,
        }
    }

    /// The places of the free nodes at the start.
    pub(super) fn start(&self) -> Vec<f64> {
        (0..self.free).flat_map(|index| self.place(self.node_at(index))).collect()
    }
}

impl Arrays {
    fn new(lists: &Lists, kicked: Option<usize>) -> Self {
        let mut index_of = vec![0; lists.nodes.len()];
        lists.fixed.iter().for_each(|&node| index_of[node] = FIXED);
        let mut free: Vec<u32> =
            (0..lists.nodes.len() as u32).filter(|&it| index_of[it as usize] != FIXED).collect();
        let first = kicked.and_then(|kicked| free.iter().position(|&node| node as usize == kicked));
        let first = first.unwrap_or(free.len() - 1);
        free[..=first].rotate_right(1);
        for (index, &node) in free.iter().enumerate() {
            index_of[node as usize] = index as u32;
        }
        let ends = lists.springs.iter().map(|spring| spring.between.map(|node| index_of[node]));
        let ends = ends.filter(|ends| !ends.contains(&FIXED)).collect();
        Self { free, index_of, ends }
    }
}
