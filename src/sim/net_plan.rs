//! The plan of a net: the places of its nodes at the start, the fixed nodes, and the springs that join nodes.

use std::collections::BTreeSet;

use super::number::counted;

/// The maximum number of nodes of a net. The command `trace` of a grid with shear of this size takes some 130 MB under
/// semi-implicit Euler.
pub const MAX_NODES: usize = 100_000;

/// The maximum number of springs of a net. At eight per node, it is twice the number in a grid with shear.
pub const MAX_SPRINGS: usize = 8 * MAX_NODES;

/// The plan of a net, as a scene writes it.
#[derive(Clone, Debug, PartialEq)]
pub struct NetPlan {
    /// The nodes and springs of the net.
    pub form: NetLayout,
    /// The node that a kick hits; `None` if a kick hits every free node.
    pub kicked: Option<usize>,
}

/// Nodes and springs, laid out by a rule or one by one.
#[derive(Clone, Debug, PartialEq)]
pub enum NetLayout {
    /// A grid.
    Grid(Grid),
    /// Nodes and springs as lists.
    Lists(Lists),
}

/// Nodes in rows and columns. Springs join each node to the next one in its row and in its column, unless both nodes
/// are fixed. The numbers of the nodes start from 0 at the top left and run row by row; the first node is at the
/// origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// The distance between neighbours, in metres.
    pub spacing: f64,
    /// Whether springs also run along the diagonals of each square.
    pub shear: bool,
    /// The fixed nodes; `None` if all are free.
    pub pin: Option<Pin>,
}

/// The fixed nodes of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pin {
    /// The whole top row.
    Top,
    /// The first and the last node of the top row.
    Corners,
}

impl Pin {
    /// All pins.
    pub const ALL: [Self; 2] = [Self::Top, Self::Corners];

    /// Returns the name of the pin in scenes.
    pub fn id(self) -> &'static str {
        match self {
            Pin::Top => "top",
            Pin::Corners => "corners",
        }
    }
}

/// Nodes and springs, listed one by one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lists {
    /// The place of each node at the start, in metres.
    pub nodes: Vec<[f64; 2]>,
    /// The numbers of the fixed nodes, from 0.
    pub fixed: Vec<usize>,
    /// The springs.
    pub springs: Vec<PlannedSpring>,
}

/// A spring of a plan. A missing number defaults to the number of the net.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlannedSpring {
    /// The numbers of the nodes at the spring's ends.
    pub between: [usize; 2],
    /// The spring's own stiffness, in newtons per metre.
    pub stiffness: Option<f64>,
    /// The spring's own damping, in N·s/m.
    pub damping: Option<f64>,
    /// The spring's own length at rest, in metres.
    pub rest: Option<f64>,
}

/// A fault of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct NetFault {
    /// The part of the plan at fault.
    pub part: NetPart,
    /// The error message, in lower case.
    pub what: String,
    /// How to fix the fault.
    pub remedy: String,
}

/// A part of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NetPart {
    /// The nodes or the counts of the grid.
    Nodes,
    /// The distance between neighbours in the grid.
    Spacing,
    /// An entry of the fixed nodes.
    Fixed(usize),
    /// The springs as a whole.
    Springs,
    /// A spring.
    Spring(usize),
    /// The kicked node.
    Kicked,
}

/// The message about a net without a free node.
const ALL_FIXED: &str = "every node is fixed, so that nothing moves";

impl NetPlan {
    /// Returns the nodes and the springs as lists.
    pub fn lists(&self) -> Lists {
        match &self.form {
            NetLayout::Grid(grid) => grid.lists(),
            NetLayout::Lists(lists) => lists.clone(),
        }
    }

    /// Returns the springs, in the order in which they act.
    pub fn springs(&self) -> Box<dyn Iterator<Item = PlannedSpring> + '_> {
        match &self.form {
            NetLayout::Grid(grid) => Box::new(grid.planned_springs()),
            NetLayout::Lists(lists) => Box::new(lists.springs.iter().copied()),
        }
    }

    /// Returns the places of the fixed nodes, in metres.
    pub fn fixed_places(&self) -> Box<dyn Iterator<Item = [f64; 2]> + '_> {
        match &self.form {
            NetLayout::Grid(grid) => {
                let fixed = (0..grid.columns).filter(|&node| grid.is_fixed(node));
                Box::new(fixed.map(|node| grid.place(node)))
            }
            NetLayout::Lists(lists) => Box::new(lists.fixed.iter().map(|&node| lists.nodes[node])),
        }
    }

    /// Returns one fault of the net as a whole, or else the faults of all its entries. The result is empty if a net can
    /// be built.
    pub fn faults(&self) -> Vec<NetFault> {
        let faults = match &self.form {
            NetLayout::Grid(grid) => grid.fault().into_iter().collect(),
            NetLayout::Lists(lists) => lists.faults(),
        };
        match self.kicked {
            Some(kicked) if faults.is_empty() => self.fault_of_kick(kicked).into_iter().collect(),
            _ => faults,
        }
    }

    fn fault_of_kick(&self, kicked: usize) -> Option<NetFault> {
        let (nodes, is_fixed) = match &self.form {
            NetLayout::Grid(grid) => (grid.nodes(), grid.is_fixed(kicked)),
            NetLayout::Lists(lists) => (lists.nodes.len(), lists.fixed.contains(&kicked)),
        };
        let (what, remedy) = if kicked >= nodes {
            unknown(kicked, nodes)
        } else if is_fixed {
            let what = format!("node {kicked} is fixed, so that a kick does not move it");
            (what, "name a free node, or remove the key and every free node is kicked".into())
        } else {
            return None;
        };
        Some(NetFault { part: NetPart::Kicked, what, remedy })
    }
}

/// Returns the message and the remedy for a node number out of range.
fn unknown(node: usize, nodes: usize) -> (String, String) {
    (format!("node {node} does not exist"), format!("write a number from 0 to {}", nodes - 1))
}

/// Returns the fault of too few or too many nodes, if there is one.
fn fault_of_count(nodes: usize) -> Option<NetFault> {
    if (2..=MAX_NODES).contains(&nodes) {
        return None;
    }
    let what = format!("the net has {}", counted(nodes, "node"));
    Some(NetFault { part: NetPart::Nodes, what, remedy: format!("give it 2 to {MAX_NODES}") })
}

impl Grid {
    /// Returns the fault of the counts, the pin or the spacing, if there is one.
    fn fault(&self) -> Option<NetFault> {
        let Self { columns, rows, spacing, .. } = *self;
        let nodes = columns.saturating_mul(rows);
        let (part, what, remedy) = if nodes > MAX_NODES {
            let remedy = format!("keep at most {MAX_NODES}: fewer `columns` or fewer `rows`");
            (NetPart::Nodes, format!("the grid has {nodes} nodes"), remedy)
        } else if nodes < 2 {
            return fault_of_count(nodes);
        } else if self.free_before(nodes) == 0 {
            let remedy = "give the grid more `rows`, or remove `pin`".into();
            (NetPart::Nodes, ALL_FIXED.into(), remedy)
        } else if spacing * spacing < f64::MIN_POSITIVE {
            let what = "neighbours stand so near that a spring between them has no length".into();
            (NetPart::Spacing, what, "write a larger `spacing_m`".into())
        } else {
            return None;
        };
        Some(NetFault { part, what, remedy })
    }

    /// Returns the nodes and the springs as lists.
    pub fn lists(&self) -> Lists {
        let nodes = (0..self.nodes()).map(|node| self.place(node)).collect();
        let fixed = (0..self.columns).filter(|&node| self.is_fixed(node)).collect();
        Lists { nodes, fixed, springs: self.planned_springs().collect() }
    }

    fn planned_springs(self) -> impl Iterator<Item = PlannedSpring> {
        let of_row = move |row| self.springs(row).map(move |(column, way)| (row, column, way));
        let spring = move |(row, column, way)| PlannedSpring {
            between: self.ends(row, column, way),
            ..Default::default()
        };
        (0..self.rows).flat_map(of_row).map(spring)
    }

    /// Returns the number of nodes.
    pub fn nodes(&self) -> usize {
        self.columns * self.rows
    }

    /// Returns the place of a node at the start, in metres.
    pub fn place(&self, node: usize) -> [f64; 2] {
        let (column, row) = (node % self.columns, node / self.columns);
        [column as f64 * self.spacing, -(row as f64) * self.spacing]
    }

    /// Whether a node is fixed.
    #[inline]
    pub(super) fn is_fixed(&self, node: usize) -> bool {
        match self.pin {
            None => false,
            Some(Pin::Top) => node < self.columns,
            Some(Pin::Corners) => node == 0 || node + 1 == self.columns,
        }
    }

    /// Returns the number of free nodes before a node.
    #[inline]
    fn free_before(&self, node: usize) -> usize {
        let fixed = match self.pin {
            None => 0,
            Some(Pin::Top) => node.min(self.columns),
            Some(Pin::Corners) => {
                node.min(1) + usize::from(self.columns > 1 && node >= self.columns)
            }
        };
        node - fixed
    }

    /// Returns the springs that begin in a row, each with the column from which it runs [right or
    /// below](SpringDirection). Leaves out springs between fixed nodes.
    fn springs(&self, row: usize) -> impl Iterator<Item = (usize, SpringDirection)> + use<> {
        let grid = *self;
        let ways = move |column: usize| {
            let (right, down) = (column + 1 < grid.columns, row + 1 < grid.rows);
            let is_there = move |way: &SpringDirection| match way {
                SpringDirection::Right => right,
                SpringDirection::Down => down,
                SpringDirection::Falling | SpringDirection::Rising => right && down && grid.shear,
            };
            let moves = move |way: &SpringDirection| {
                row > 0 || grid.ends(row, column, *way).iter().any(|&end| !grid.is_fixed(end))
            };
            SpringDirection::ALL
                .into_iter()
                .filter(is_there)
                .filter(moves)
                .map(move |way| (column, way))
        };
        (0..self.columns).flat_map(ways)
    }

    /// Returns the nodes that a spring joins.
    #[inline]
    fn ends(&self, row: usize, column: usize, way: SpringDirection) -> [usize; 2] {
        let ([from, to], down) = way.ends();
        [row * self.columns + column + from, (row + down) * self.columns + column + to]
    }
}

/// The directions of the springs of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SpringDirection {
    /// The spring runs to the right.
    Right,
    /// The spring runs down.
    Down,
    /// The spring runs down and to the right.
    Falling,
    /// The spring runs from the next column down and to the left.
    Rising,
}

impl SpringDirection {
    /// All directions, in the order of a plan's springs.
    const ALL: [Self; 4] = [Self::Right, Self::Down, Self::Falling, Self::Rising];

    /// Returns the columns of both ends, relative to the spring's column, and the number of rows that the spring goes
    /// down.
    #[inline(always)]
    const fn ends(self) -> ([usize; 2], usize) {
        match self {
            Self::Right => ([0, 1], 0),
            Self::Down => ([0, 0], 1),
            Self::Falling => ([0, 1], 1),
            Self::Rising => ([1, 0], 1),
        }
    }
}

/// Returns the distance between two places, in metres.
pub(super) fn distance([[ax, ay], [bx, by]]: [[f64; 2]; 2]) -> f64 {
    ((bx - ax) * (bx - ax) + (by - ay) * (by - ay)).sqrt()
}

impl Lists {
    /// Returns the length of a spring at the start, in metres.
    pub fn length(&self, [a, b]: [usize; 2]) -> f64 {
        distance([self.nodes[a], self.nodes[b]])
    }

    fn faults(&self) -> Vec<NetFault> {
        if let Some(fault) = self.fault_as_a_whole() {
            return vec![fault];
        }
        let mut faults = Vec::new();
        let mut is_fixed = vec![false; self.nodes.len()];
        for (index, &node) in self.fixed.iter().enumerate() {
            let (what, remedy) = match is_fixed.get_mut(node) {
                None => unknown(node, is_fixed.len()),
                Some(true) => {
                    (format!("node {node} is in the list already"), "remove one of the two".into())
                }
                Some(fixed) => {
                    *fixed = true;
                    continue;
                }
            };
            faults.push(NetFault { part: NetPart::Fixed(index), what, remedy });
        }
        let mut joined: Vec<([usize; 2], usize)> = Vec::new();
        for (index, spring) in self.springs.iter().enumerate() {
            let [a, b] = spring.between;
            match self.fault_of_ends(spring.between, &is_fixed) {
                Some((what, remedy)) => {
                    faults.push(NetFault { part: NetPart::Spring(index), what, remedy });
                }
                None => joined.push(([a.min(b), a.max(b)], index)),
            }
        }
        joined.sort_unstable();
        for pair in joined.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let [a, b] = pair[1].0;
            let what = format!("nodes {a} and {b} are joined by spring {} already", pair[0].1);
            let remedy = "remove one of the two, or give one the stiffness of both".into();
            faults.push(NetFault { part: NetPart::Spring(pair[1].1), what, remedy });
        }
        faults
    }

    /// Returns the fault of the counts of nodes and springs, if there is one.
    fn fault_as_a_whole(&self) -> Option<NetFault> {
        let (nodes, springs) = (self.nodes.len(), self.springs.len());
        if let Some(fault) = fault_of_count(nodes) {
            return Some(fault);
        }
        let fixed: BTreeSet<_> = self.fixed.iter().filter(|&&node| node < nodes).collect();
        let (part, what, remedy) = if fixed.len() == nodes {
            (NetPart::Nodes, ALL_FIXED.into(), "free a node".into())
        } else if (1..=MAX_SPRINGS).contains(&springs) {
            return None;
        } else {
            let remedy = format!("give it 1 to {MAX_SPRINGS}");
            (NetPart::Springs, format!("the net has {springs} springs"), remedy)
        };
        Some(NetFault { part, what, remedy })
    }

    /// Returns the message and the remedy for a spring between these nodes; `None` if there is no fault.
    fn fault_of_ends(&self, [a, b]: [usize; 2], is_fixed: &[bool]) -> Option<(String, String)> {
        let (what, remedy) =
            if let Some(end) = [a, b].into_iter().find(|&end| end >= is_fixed.len()) {
                return Some(unknown(end, is_fixed.len()));
            } else if a == b {
                (format!("the spring joins node {a} to itself"), "name two different nodes")
            } else if is_fixed[a] && is_fixed[b] {
                let what =
                    format!("nodes {a} and {b} are both fixed, so that the spring moves nothing");
                (what, "remove the spring, or free one of the nodes")
            } else if self.length([a, b]) == 0.0 {
                let what = format!(
                    "nodes {a} and {b} stand in one place, so that the spring has no direction"
                );
                (what, "move one of them")
            } else {
                return None;
            };
        Some((what, remedy.into()))
    }
}
