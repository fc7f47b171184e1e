//! A plan prepared for stepping: the free nodes, and the springs in arrays.

use crate::sim::net_plan::{Lists, NetPlan};

/// The index of a fixed node, which is no coordinate.
pub(super) const FIXED: u32 = u32::MAX;

/// What the bodies of one plan share.
#[derive(Debug)]
pub(super) struct Frame {
    pub(super) lists: Lists,
    /// The number of each free node, in the order of the coordinates: the kicked node, or else the last one,
    /// comes first, because plots show the first coordinate.
    pub(super) free: Vec<usize>,
    /// The index of each node among the free ones, or [`FIXED`].
    pub(super) index_of: Vec<u32>,
    /// Where the free nodes stand at the start.
    pub(super) start: Vec<f64>,
    /// The indices of the ends, among the free nodes, of each spring between two of them.
    pub(super) ends: Vec<[u32; 2]>,
    /// For each anchored spring: index of its free node, position of its anchor.
    pub(super) anchors: Vec<(u32, [f64; 2])>,
    /// The springs of the plan in the order of the arrays: those of `ends`, then those of `anchors`.
    pub(super) order: Vec<usize>,
    /// Whether a kick hits only the first of the free nodes, and not all of them.
    pub(super) kicks_first: bool,
}

impl Frame {
    /// Prepares a plan without [faults](NetPlan::faults).
    pub(super) fn new(plan: &NetPlan) -> Self {
        let lists = plan.lists();
        let mut is_fixed = vec![false; lists.nodes.len()];
        lists.fixed.iter().for_each(|&node| is_fixed[node] = true);
        let mut free: Vec<usize> = (0..lists.nodes.len()).filter(|&node| !is_fixed[node]).collect();
        let first = plan.kicked.and_then(|kicked| free.iter().position(|&node| node == kicked));
        let first = first.unwrap_or(free.len() - 1);
        free[..=first].rotate_right(1);
        let mut index_of = vec![FIXED; lists.nodes.len()];
        for (index, &node) in free.iter().enumerate() {
            index_of[node] = index as u32;
        }
        let (mut ends, mut anchors) = (Vec::new(), Vec::new());
        let (mut order, mut anchored) = (Vec::new(), Vec::new());
        for (index, spring) in lists.springs.iter().enumerate() {
            let [a, b] = spring.between;
            if is_fixed[a] || is_fixed[b] {
                let (free, fixed) = if is_fixed[a] { (b, a) } else { (a, b) };
                anchors.push((index_of[free], lists.nodes[fixed]));
                anchored.push(index);
            } else {
                ends.push([index_of[a], index_of[b]]);
                order.push(index);
            }
        }
        order.append(&mut anchored);
        let start = free.iter().flat_map(|&node| lists.nodes[node]).collect();
        let kicks_first = plan.kicked.is_some();
        Self { lists, free, index_of, start, ends, anchors, order, kicks_first }
    }

    /// As many zeros as there are coordinates.
    pub(super) fn zeros(&self) -> Vec<f64> {
        vec![0.0; self.start.len()]
    }
}
