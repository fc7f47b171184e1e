//! The plan of a net: where its nodes stand at the start, which are fixed, and which springs join them.

/// The most nodes of a net. A longer list would be a net that no stage shows, and no lane steps at the rate
/// of a display.
pub const MAX_NODES: usize = 10_000;

/// The most springs of a net: eight to a node, twice what a grid with shear has.
pub const MAX_SPRINGS: usize = 8 * MAX_NODES;

/// What a net is made of, as a scene writes it.
#[derive(Clone, Debug, PartialEq)]
pub struct NetPlan {
    /// Its nodes and springs.
    pub form: Form,
    /// The node that a kick hits; `None` if it hits every free node.
    pub kicked: Option<usize>,
}

/// Nodes and springs, laid out by a rule or one by one.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A grid.
    Grid(Grid),
    /// Lists.
    Lists(Lists),
}

/// Nodes in rows and columns, each joined to the next in its row and in its column, unless both are
/// fixed. They are numbered from 0 at the top left, row by row; the first stands at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// How many columns there are.
    pub columns: usize,
    /// How many rows there are.
    pub rows: usize,
    /// The distance of neighbours, in metres.
    pub spacing: f64,
    /// Whether springs join the corners of each square too.
    pub shear: bool,
    /// Which nodes are fixed; `None` if all are free.
    pub pin: Option<Pin>,
}

/// The fixed nodes of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pin {
    /// The top row.
    Top,
    /// The first and the last node of the top row.
    Corners,
}

impl Pin {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Top, Self::Corners];

    /// Its name in scenes.
    pub fn id(self) -> &'static str {
        match self {
            Pin::Top => "top",
            Pin::Corners => "corners",
        }
    }
}

/// Nodes and springs one by one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lists {
    /// Where each node stands at the start, in metres.
    pub nodes: Vec<[f64; 2]>,
    /// The numbers of the fixed nodes, from 0.
    pub fixed: Vec<usize>,
    /// The springs.
    pub springs: Vec<PlannedSpring>,
}

/// A spring of a plan. What it does not give is as the net has it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlannedSpring {
    /// The numbers of the nodes at its ends.
    pub between: [usize; 2],
    /// Its own stiffness, in newtons per metre.
    pub stiffness: Option<f64>,
    /// Its own damping, in N·s/m.
    pub damping: Option<f64>,
    /// Its own length at rest, in metres.
    pub rest: Option<f64>,
}

/// What is wrong with a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct NetFault {
    /// The part of the plan at fault.
    pub part: NetPart,
    /// What is wrong, in lower case.
    pub what: String,
    /// How to fix it.
    pub remedy: String,
}

/// A part of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NetPart {
    /// The nodes or the counts of the grid.
    Nodes,
    /// The distance of neighbours in the grid.
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

/// What is wrong with a net without a free node.
const ALL_FIXED: &str = "every node is fixed, so that nothing moves";

impl NetPlan {
    /// The nodes and the springs one by one.
    pub fn lists(&self) -> Lists {
        match &self.form {
            Form::Grid(grid) => grid.lists(),
            Form::Lists(lists) => lists.clone(),
        }
    }

    /// One fault of the net as a whole, else all of its entries; empty if a net can be built.
    pub fn faults(&self) -> Vec<NetFault> {
        if let Form::Grid(grid) = &self.form
            && let Some(fault) = grid.fault()
        {
            return vec![fault];
        }
        let lists = self.lists();
        let mut faults = lists.faults();
        if let Some(kicked) = self.kicked
            && faults.is_empty()
        {
            faults.extend(lists.fault_of_kick(kicked));
        }
        faults
    }
}

impl Grid {
    /// The fault of the counts, the pin or the spacing, if there is one.
    fn fault(&self) -> Option<NetFault> {
        let Self { columns, rows, spacing, pin, .. } = *self;
        let nodes = columns.saturating_mul(rows);
        let (part, what, remedy) = if nodes > MAX_NODES {
            let remedy = format!("keep at most {MAX_NODES}: fewer `columns` or fewer `rows`");
            (NetPart::Nodes, format!("the grid has {nodes} nodes"), remedy)
        } else if nodes > 1 && pin.is_some_and(|pin| (0..nodes).all(|node| self.pins(pin, node))) {
            let remedy = "give the grid more `rows`, or remove `pin`".into();
            (NetPart::Nodes, ALL_FIXED.into(), remedy)
        } else if nodes > 1 && spacing * spacing < f64::MIN_POSITIVE {
            let what = "neighbours stand so near that a spring between them has no length".into();
            (NetPart::Spacing, what, "write a larger `spacing_m`".into())
        } else {
            return None;
        };
        Some(NetFault { part, what, remedy })
    }

    /// Whether `pin` fixes the node of this number.
    fn pins(&self, pin: Pin, node: usize) -> bool {
        match pin {
            Pin::Top => node < self.columns,
            Pin::Corners => node == 0 || node + 1 == self.columns,
        }
    }

    fn lists(&self) -> Lists {
        let Self { columns, rows, spacing, shear, pin } = *self;
        let node = |column: usize, row: usize| row * columns + column;
        let places = (0..rows).flat_map(|row| {
            (0..columns).map(move |column| [column as f64 * spacing, -(row as f64) * spacing])
        });
        let is_fixed = |node: usize| pin.is_some_and(|pin| self.pins(pin, node));
        let fixed = (0..columns).filter(|&node| is_fixed(node)).collect();
        let mut springs = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                let (right, down) = (column + 1 < columns, row + 1 < rows);
                let mut join = |from: usize, to: usize| {
                    if !(is_fixed(from) && is_fixed(to)) {
                        springs.push(PlannedSpring { between: [from, to], ..Default::default() });
                    }
                };
                if right {
                    join(node(column, row), node(column + 1, row));
                }
                if down {
                    join(node(column, row), node(column, row + 1));
                }
                if right && down && shear {
                    join(node(column, row), node(column + 1, row + 1));
                    join(node(column + 1, row), node(column, row + 1));
                }
            }
        }
        Lists { nodes: places.collect(), fixed, springs }
    }
}

impl Lists {
    /// The distance of the ends of a spring at the start, in metres.
    pub fn length(&self, [a, b]: [usize; 2]) -> f64 {
        let ([ax, ay], [bx, by]) = (self.nodes[a], self.nodes[b]);
        ((bx - ax) * (bx - ax) + (by - ay) * (by - ay)).sqrt()
    }

    fn faults(&self) -> Vec<NetFault> {
        let fault =
            |part, what: String, remedy: &str| NetFault { part, what, remedy: remedy.into() };
        let nodes = self.nodes.len();
        if !(2..=MAX_NODES).contains(&nodes) {
            let what = format!("the net has {nodes} node{}", if nodes == 1 { "" } else { "s" });
            let remedy = format!("give it 2 to {MAX_NODES}");
            return vec![fault(NetPart::Nodes, what, &remedy)];
        }
        if (0..nodes).all(|node| self.fixed.contains(&node)) {
            return vec![fault(NetPart::Nodes, ALL_FIXED.into(), "free a node")];
        }
        if !(1..=MAX_SPRINGS).contains(&self.springs.len()) {
            let what = format!("the net has {} springs", self.springs.len());
            let remedy = format!("give it 1 to {MAX_SPRINGS}");
            return vec![fault(NetPart::Springs, what, &remedy)];
        }
        let unknown = |node: usize| format!("node {node} does not exist");
        let numbers = format!("write a number from 0 to {}", nodes - 1);
        let mut faults = Vec::new();
        let mut is_fixed = vec![false; nodes];
        for (index, &node) in self.fixed.iter().enumerate() {
            match is_fixed.get_mut(node) {
                None => faults.push(fault(NetPart::Fixed(index), unknown(node), &numbers)),
                Some(true) => {
                    let what = format!("node {node} is in the list already");
                    faults.push(fault(NetPart::Fixed(index), what, "remove one of the two"));
                }
                Some(fixed) => *fixed = true,
            }
        }
        let mut joined: Vec<([usize; 2], usize)> = Vec::new();
        for (index, spring) in self.springs.iter().enumerate() {
            let [a, b] = spring.between;
            let mut refuse = |what: String, remedy: &str| {
                faults.push(fault(NetPart::Spring(index), what, remedy));
            };
            match [a, b].into_iter().find(|end| *end >= nodes) {
                Some(end) => refuse(unknown(end), &numbers),
                None if a == b => refuse(
                    format!("the spring joins node {a} to itself"),
                    "name two different nodes",
                ),
                None if is_fixed[a] && is_fixed[b] => refuse(
                    format!("nodes {a} and {b} are both fixed, so that the spring moves nothing"),
                    "remove the spring, or free one of the nodes",
                ),
                None if self.length(spring.between) == 0.0 => refuse(
                    format!(
                        "nodes {a} and {b} stand in one place, so that the spring has no direction"
                    ),
                    "move one of them",
                ),
                None => joined.push(([a.min(b), a.max(b)], index)),
            }
        }
        joined.sort_unstable();
        for pair in joined.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let [a, b] = pair[1].0;
            let what = format!("nodes {a} and {b} are joined by spring {} already", pair[0].1);
            let remedy = "remove one of the two, or give one the stiffness of both";
            faults.push(fault(NetPart::Spring(pair[1].1), what, remedy));
        }
        faults
    }

    fn fault_of_kick(&self, kicked: usize) -> Option<NetFault> {
        let (what, remedy) = if kicked >= self.nodes.len() {
            let most = self.nodes.len() - 1;
            (format!("node {kicked} does not exist"), format!("write a number from 0 to {most}"))
        } else if self.fixed.contains(&kicked) {
            let what = format!("node {kicked} is fixed, so that a kick does not move it");
            (what, "name a free node, or remove the key and every free node is kicked".into())
        } else {
            return None;
        };
        Some(NetFault { part: NetPart::Kicked, what, remedy })
    }
}
