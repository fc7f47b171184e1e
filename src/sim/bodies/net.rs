//! Masses joined by springs in the plane, for example a rope, a cloth or a bridge.
//!
//! The coordinates are those of the free nodes. The forces on a node are summed in the order of the plan's springs,
//! first the springs to free nodes, then those to fixed nodes. That order is part of the definition, so that a grid has
//! the same bits as a net given as lists.

use std::array::from_fn;
use std::sync::{Arc, LazyLock};

use super::kind::{Coordinates, Origin};
use super::prelude::*;
use crate::net_plan::{NetFault, NetPlan, PlannedSpring, distance};
use crate::parameter::Parameter;
use forces::{Accelerations, Derivatives, Forces};
use topology::Topology;

mod forces;
mod topology;

type Of = ParameterOf<Net>;

const PARAMETERS: [Of; 8] = [
    Of::number("mass_kg", Range::POSITIVE, |net| &mut net.mass).symbol("m").about("each node"),
    Of::number("stiffness_n_per_m", Range::POSITIVE, |net| &mut net.stiffness)
        .symbol("k")
        .about("of each spring without its own"),
    Of::number("damping_n_s_per_m", Range::NON_NEGATIVE, |net| &mut net.damping)
        .or(0.0)
        .symbol("c")
        .about("along each spring without its own"),
    Of::number("drag_n_s_per_m", Range::NON_NEGATIVE, |net| &mut net.drag)
        .or(0.0)
        .symbol("b")
        .about("of each node"),
    Of::number("gravity_m_per_s2", Range::NON_NEGATIVE, |net| &mut net.gravity)
        .or(9.81)
        .symbol("g")
        .about("downwards"),
    Of::number("rest_ratio", Range::NON_NEGATIVE, |net| &mut net.rest_ratio)
        .or(1.0)
        .about("the length at rest over that at the start"),
    Of::number("kick_x_m_per_s", Range::ANY, |net| &mut net.kick.x)
        .or(3.0)
        .about("what one kick adds to the velocity to the right"),
    Of::number("kick_y_m_per_s", Range::ANY, |net| &mut net.kick.y)
        .or(0.0)
        .about("what one kick adds to the velocity upwards"),
];

/// A net of masses and springs. Its coordinates are the places of its free nodes, in metres.
#[derive(Clone, Debug)]
pub struct Net {
    topology: Arc<Topology>,
    /// m, the mass of each node, in kilograms.
    mass: f64,
    /// k, the stiffness of springs without their own, in newtons per metre.
    stiffness: f64,
    /// c, the damping of springs without their own, in N·s/m.
    damping: f64,
    /// b, the drag of each node, in N·s/m.
    drag: f64,
    /// g, the gravity, in metres per second squared.
    gravity: f64,
    /// Rest lengths of the springs, relative to their lengths at the start.
    rest_ratio: f64,
    /// The change of velocity by one kick.
    kick: DVec2,
    /// The springs, which all copies share until a parameter changes.
    springs: Arc<Springs>,
}

/// The springs of a net with its present parameters.
#[derive(Debug, Default)]
struct Springs {
    /// The constants of each spring. They are the stiffness and the damping, each divided by the mass of a node, and
    /// the rest length.
    constants: Vec<[f64; 3]>,
    /// Whether no spring is damped.
    are_elastic: bool,
    /// The bound that [`Net::fastest_rate`] returns.
    fastest_rate: f64,
}

/// The other end of a spring that starts at a free node.
#[derive(Clone, Copy)]
enum End {
    /// A free node, by its index.
    Free(usize),
    /// A fixed node, by its place.
    Fixed([f64; 2]),
}

/// Returns the length of a spring if the free nodes are at `q`.
fn length(from: usize, to: End, q: &[f64]) -> f64 {
    let at = |index: usize| Net::nodes(q)[index];
    let to = match to {
        End::Free(to) => at(to),
        End::Fixed(place) => place,
    };
    distance([at(from), to])
}

impl Net {
    fn blank(topology: Arc<Topology>) -> Self {
        Self {
            topology,
            mass: 1.0,
            stiffness: 1.0,
            damping: 0.0,
            drag: 0.0,
            gravity: 0.0,
            rest_ratio: 1.0,
            kick: DVec2::ZERO,
            springs: Arc::default(),
        }
    }

    /// Returns the free nodes as pairs of x and y, from a vector of coordinates or of velocities.
    #[inline]
    pub fn nodes(components: &[f64]) -> &[[f64; 2]] {
        components.as_chunks().0
    }

    /// Returns the free nodes as mutable pairs of x and y, from a vector of coordinates or of velocities.
    #[inline]
    pub fn nodes_mut(components: &mut [f64]) -> &mut [[f64; 2]] {
        components.as_chunks_mut().0
    }

    /// Calls `see` for each spring, in the order of the sums. Its arguments are the index of a free end, the other end,
    /// and the constants.
    fn each_spring(&self, springs: &Springs, mut see: impl FnMut(usize, End, &[f64; 3])) {
        let (inner, outer) = springs.constants.split_at(self.topology.ends.len());
        for ([from, to], constants) in self.topology.ends.iter().zip(inner) {
            see(*from as usize, End::Free(*to as usize), constants);
        }
        for ((index, anchor), constants) in self.topology.anchors.iter().zip(outer) {
            see(*index as usize, End::Fixed(*anchor), constants);
        }
    }

    /// Returns the place of the node with this number in the plan, if the free nodes are at `q`.
    pub fn place_of(&self, node: usize, q: &[f64]) -> DVec2 {
        let index = self.topology.index_of(node);
        DVec2::from(index.map_or_else(|| self.topology.place(node), |index| Self::nodes(q)[index]))
    }

    /// Returns the number of springs.
    pub fn springs(&self) -> usize {
        self.springs.constants.len()
    }

    /// Returns the length of the shortest spring at the start, in metres.
    pub fn shortest_spring(&self) -> f64 {
        let start = self.topology.start();
        let mut shortest = f64::INFINITY;
        self.each_spring(&self.springs, |from, to, _| {
            shortest = shortest.min(length(from, to, &start));
        });
        shortest
    }

    /// Returns an upper bound on the fastest angular frequency, in radians per second, and on the fastest rate of
    /// damping. The bound is positive.
    pub fn fastest_rate(&self) -> f64 {
        self.springs.fastest_rate.max(f64::MIN_POSITIVE)
    }

    /// Returns the fastest frequency or rate of damping of any node, if all its neighbours move against the node.
    fn fastest(&self, springs: &Springs) -> f64 {
        let mut sums = vec![[0.0; 2]; self.topology.free()];
        let mut add = |index: usize, [k, c, _]: &[f64; 3], times: f64| {
            let [stiffness, damping] = &mut sums[index];
            *stiffness += times * k;
            *damping += times * c;
        };
        self.each_spring(springs, |from, to, constants| match to {
            End::Free(to) => [from, to].iter().for_each(|end| add(*end, constants, 2.0)),
            End::Fixed(_) => add(from, constants, 1.0),
        });
        let most = |i: usize| sums.iter().map(|sums| sums[i]).fold(0.0, f64::max);
        most(0).sqrt().max(most(1) + self.drag / self.mass)
    }

    /// Overwrites `sums` with the force on each node. The first of `vectors` has the places of the free nodes.
    #[inline]
    fn sum<const N: usize>(
        &self,
        forces: impl Forces<N>,
        vectors: [&[[f64; 2]]; N],
        sums: &mut [[f64; 2]],
    ) {
        let at = |node: usize| from_fn(|n| vectors[n][node]);
        for (node, sum) in sums.iter_mut().enumerate() {
            *sum = forces.on_node(at(node));
        }
        let (inner, outer) = self.springs.constants.split_at(self.topology.ends.len());
        for ([i, j], constants) in self.topology.ends.iter().zip(inner) {
            let (i, j) = (*i as usize, *j as usize);
            let f = forces.spring_force(constants, at(i), at(j));
            sums[i] = [sums[i][0] + f[0], sums[i][1] + f[1]];
            sums[j] = [sums[j][0] - f[0], sums[j][1] - f[1]];
        }
        // These zeros are negative because `-0.0 - x == -x` for every `x`, including ±0.
        let mut to = [[-0.0; 2]; N];
        for ((i, anchor), constants) in self.topology.anchors.iter().zip(outer) {
            let i = *i as usize;
            to[0] = *anchor;
            let f = forces.spring_force(constants, at(i), to);
            sums[i] = [sums[i][0] + f[0], sums[i][1] + f[1]];
        }
    }
}

impl System for Net {
    type Vector = Vec<f64>;

    fn coupling(&self) -> Coupling {
        Coupling::Few
    }

    #[inline]
    fn acceleration(&self, _t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        let forces = Accelerations { drag: self.drag / self.mass, gravity: self.gravity };
        self.sum(forces, [q, v].map(|vector| Self::nodes(vector)), Self::nodes_mut(a));
    }

    #[inline]
    fn query(&self, _t: f64, query: Query<'_, Vec<f64>>) -> bool {
        let Query::Slope { state, along, slope } = query else { return false };
        let vectors = [&state.q, &state.v, &along.q, &along.v].map(|vector| Self::nodes(vector));
        let forces = Derivatives { drag: self.drag / self.mass };
        self.sum(forces, vectors, Self::nodes_mut(slope));
        true
    }
}

impl Body for Net {
    const CLASS: BodyClass = BodyClass::NoEngine(
        "an engine solves a net joint by joint in sweeps, and its formula here models one joint alone",
    );
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn prepare(&mut self) {
        let of = |spring: PlannedSpring| {
            let length = distance(spring.between.map(|node| self.topology.place(node)));
            let stiffness = spring.stiffness.unwrap_or(self.stiffness);
            let damping = spring.damping.unwrap_or(self.damping);
            let rest = spring.rest.unwrap_or(self.rest_ratio * length);
            [stiffness / self.mass, damping / self.mass, rest]
        };
        let constants: Vec<[f64; 3]> = self.topology.springs().map(of).collect();
        let are_elastic = constants.iter().all(|[_, c, _]| *c == 0.0);
        let mut springs = Springs { constants, are_elastic, fastest_rate: 0.0 };
        springs.fastest_rate = self.fastest(&springs);
        self.springs = Arc::new(springs);
    }

    fn start(&self) -> State<Vec<f64>> {
        State { q: self.topology.start(), v: vec![0.0; 2 * self.topology.free()] }
    }

    fn reference_work(&self) -> f64 {
        EVALUATIONS_PER_RADIAN * self.springs.fastest_rate * self.springs() as f64
    }

    fn energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        let is_conserved = self.springs.are_elastic && self.drag == 0.0;
        is_conserved.then(|| self.kinetic(state) + self.potential(state))
    }

    fn kinetic_energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        (self.springs.are_elastic && self.drag == 0.0).then(|| self.kinetic(state))
    }

    fn mechanical_energy(&self, state: &State<Vec<f64>>) -> Option<[f64; 2]> {
        Some([self.kinetic(state), self.potential(state)])
    }

    fn input(&mut self, input: Input, state: &mut State<Vec<f64>>) -> bool {
        let Input::Kick(times) = input else { return false };
        let kicked = if self.topology.kicks_first { 1 } else { self.topology.free() };
        for [vx, vy] in &mut Self::nodes_mut(&mut state.v)[..kicked] {
            *vx += times * self.kick.x;
            *vy += times * self.kick.y;
        }
        true
    }

    fn place(&self, q: &Vec<f64>) -> DVec2 {
        DVec2::from(Self::nodes(q)[0])
    }
}

/// Number of evaluations of both solutions of a reference for each radian of the fastest motion, measured on the nets
/// of the scenes.
const EVALUATIONS_PER_RADIAN: f64 = 16.0;

impl Net {
    fn kinetic(&self, state: &State<Vec<f64>>) -> f64 {
        let squares = Self::nodes(&state.v).iter().map(|v| v[0] * v[0] + v[1] * v[1]);
        self.mass * squares.sum::<f64>() / 2.0
    }

    fn potential(&self, state: &State<Vec<f64>>) -> f64 {
        let heights = Self::nodes(&state.q).iter().map(|q| q[1]);
        let mut elastic = 0.0;
        self.each_spring(&self.springs, |from, to, [k, _, rest]| {
            let stretch = length(from, to, &state.q) - rest;
            elastic += k * stretch * stretch;
        });
        self.mass * (self.gravity * heights.sum::<f64>() + elastic / 2.0)
    }
}

impl Net {
    /// Returns the parameters of every net.
    pub fn descriptions() -> &'static [Parameter] {
        static DESCRIPTIONS: LazyLock<Vec<Parameter>> =
            LazyLock::new(|| PARAMETERS.iter().map(ParameterOf::parameter).collect());
        &DESCRIPTIONS
    }
}

/// Returns the kind of nets with this plan.
///
/// # Errors
/// All faults of the plan.
pub fn net_kind(plan: NetPlan) -> Result<Arc<Kind>, Vec<NetFault>> {
    let faults = plan.faults();
    if !faults.is_empty() {
        return Err(faults);
    }
    let plan = Arc::new(plan);
    let topology = Arc::new(Topology::new(plan.clone()));
    Ok(Arc::new(Kind {
        id: "net",
        about:
            "m xᵢ″ = Σ (k (ℓ - ℓ₀) + c ℓ′) u - b xᵢ′ + m g: masses joined by springs in the plane"
                .into(),
        all_coordinates: coordinates(&topology),
        leading: "stiffness_n_per_m".into(),
        origin: Origin::Net(plan),
        ..Kind::of(Net::blank(topology))
    }))
}

/// The number of free nodes from which the names of coordinates are computed rather than listed.
const MANY_NODES: usize = 2048;

/// Returns the names of the coordinates. A large net computes the names. A smaller net lists them, so that halting
/// allocates nothing.
fn coordinates(topology: &Arc<Topology>) -> Coordinates {
    let (of, count) = (topology.clone(), 2 * topology.free());
    let names = move |index: usize| {
        let (axis, node) = (['x', 'y'][index % 2], of.node_at(index / 2));
        [format!("{axis}{node}"), format!("v{axis}{node}")]
    };
    let by_rule = Coordinates::by_rule(count, "m", Arc::new(names));
    if topology.free() < MANY_NODES { by_rule.iter().collect::<Vec<_>>().into() } else { by_rule }
}
