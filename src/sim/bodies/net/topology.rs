//! A plan prepared for stepping, with the free nodes and the index of each in a vector.

use std::sync::Arc;

use crate::net_plan::{Lists, NetPlan, PlannedSpring};

/// The index of a fixed node, which has no coordinates.
const FIXED: u32 = u32::MAX;

/// The data that all bodies of one plan share. The kicked node, or else the last free node, comes first in a vector,
/// because plots show the first coordinate. The others follow in the order of their numbers.
#[derive(Debug)]
pub(super) struct Topology {
    plan: Arc<NetPlan>,
    /// The place of each node at the start, in metres.
    places: Vec<[f64; 2]>,
    /// The number of each free node.
    free: Vec<u32>,
    /// The index of each node among the free nodes, or [`FIXED`].
    index_of: Vec<u32>,
    /// The indices of the ends of each spring between free nodes.
    pub(super) ends: Vec<[u32; 2]>,
    /// For each spring with a fixed end, the index of its free node and the position of its fixed end.
    pub(super) anchors: Vec<(u32, [f64; 2])>,
    /// Whether a kick hits only the first free node, rather than all free nodes.
    pub(super) kicks_first: bool,
}

impl Topology {
    /// Prepares a plan without [faults](NetPlan::faults).
    pub(super) fn new(plan: Arc<NetPlan>) -> Self {
        let Lists { nodes: places, fixed, springs } = plan.lists();
        let mut index_of = vec![0; places.len()];
        for node in fixed {
            index_of[node] = FIXED;
        }
        let mut free: Vec<u32> =
            (0..places.len() as u32).filter(|&it| index_of[it as usize] != FIXED).collect();
        let is_kicked = |&node: &u32| plan.kicked == Some(node as usize);
        let first = free.iter().position(is_kicked).unwrap_or(free.len() - 1);
        free[..=first].rotate_right(1);
        for (index, &node) in free.iter().enumerate() {
            index_of[node as usize] = index as u32;
        }
        let (mut ends, mut anchors) = (Vec::new(), Vec::new());
        for spring in springs {
            match spring.between.map(|node| index_of[node]) {
                [index, FIXED] => anchors.push((index, places[spring.between[1]])),
                [FIXED, index] => anchors.push((index, places[spring.between[0]])),
                free_ends => ends.push(free_ends),
            }
        }
        let kicks_first = plan.kicked.is_some();
        Self { plan, places, free, index_of, ends, anchors, kicks_first }
    }

    /// Returns the springs in the order of the sums, which is that of the plan, those between free nodes first.
    pub(super) fn springs(&self) -> impl Iterator<Item = PlannedSpring> + '_ {
        let with_fixed_end = |wanted: bool| {
            let is_wanted = move |spring: &PlannedSpring| self.is_anchored(spring) == wanted;
            self.plan.springs().filter(is_wanted)
        };
        with_fixed_end(false).chain(with_fixed_end(true))
    }

    /// Whether either end of a spring is fixed.
    fn is_anchored(&self, spring: &PlannedSpring) -> bool {
        spring.between.iter().any(|&node| self.index_of(node).is_none())
    }

    /// Returns the place of a node at the start.
    pub(super) fn place(&self, node: usize) -> [f64; 2] {
        self.places[node]
    }

    /// Returns the index of a node among the free nodes; `None` if the node is fixed.
    #[inline]
    pub(super) fn index_of(&self, node: usize) -> Option<usize> {
        Some(self.index_of[node]).filter(|&it| it != FIXED).map(|index| index as usize)
    }

    /// Returns the number of free nodes.
    pub(super) fn free(&self) -> usize {
        self.free.len()
    }

    /// Returns the number of the free node with this index.
    pub(super) fn node_at(&self, index: usize) -> usize {
        self.free[index] as usize
    }

    /// Returns the places of the free nodes at the start.
    pub(super) fn start(&self) -> Vec<f64> {
        self.free.iter().flat_map(|&node| self.place(node as usize)).collect()
    }
}
