//! Masses joined by springs in the plane: a rope, a cloth, a bridge.
//!
//! The coordinates are those of the free nodes. The springs are in arrays, and the forces on a node are
//! summed in the order of the springs: those to free nodes, then those to fixed ones. That order is part of
//! the definition, so that a sum by node in parallel would have the same bits.

use std::sync::Arc;

use glam::DVec2;

use crate::sim::body::{Body, Input};
use crate::sim::parameter::{ParameterOf, Range};
use crate::sim::state::State;
use crate::sim::system::{BodyClass, Coupling, Question, System};
use frame::{FIXED, Frame};

mod frame;
mod kind;

pub use kind::net_kind;

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
    frame: Arc<Frame>,
    /// m, in kilograms.
    mass: f64,
    /// k, in newtons per metre.
    stiffness: f64,
    /// c, in N·s/m.
    damping: f64,
    /// b, in N·s/m.
    drag: f64,
    /// g, in metres per second squared.
    gravity: f64,
    /// The rest lengths in units of the lengths at the start.
    rest_ratio: f64,
    /// The change of velocity by one kick.
    kick: DVec2,
    /// Shared by all copies until a parameter changes.
    springs: Arc<Springs>,
}

/// The springs, in the order of the frame's arrays.
#[derive(Clone, Debug, Default)]
struct Springs {
    /// Stiffness and damping divided by the mass of a node, and the length at rest.
    constants: Vec<[f64; 3]>,
    /// Whether none of them is damped.
    are_elastic: bool,
    /// An estimate of [`Body::reference_work`].
    reference_work: f64,
}

impl Net {
    fn blank(frame: Arc<Frame>) -> Self {
        Self {
            frame,
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

    /// The free nodes, each as x and y, of coordinates or velocities.
    #[inline]
    pub fn nodes(components: &[f64]) -> &[[f64; 2]] {
        components.as_chunks().0
    }

    /// The same, mutable.
    #[inline]
    pub fn nodes_mut(components: &mut [f64]) -> &mut [[f64; 2]] {
        components.as_chunks_mut().0
    }

    /// The places of both ends of each spring with the free nodes at `q`, in the order of the arrays.
    fn spring_ends<'a>(&'a self, q: &'a [f64]) -> impl Iterator<Item = [DVec2; 2]> + 'a {
        let Frame { ends, anchors, .. } = &*self.frame;
        let at = |index: u32| DVec2::from(Self::nodes(q)[index as usize]);
        let free = ends.iter().map(move |[a, b]| [at(*a), at(*b)]);
        free.chain(anchors.iter().map(move |(a, anchor)| [at(*a), DVec2::from(*anchor)]))
    }

    /// The place of a node, by its number in the plan, with the free nodes at `q`.
    pub fn place_of(&self, node: usize, q: &[f64]) -> DVec2 {
        let Frame { lists, index_of, .. } = &*self.frame;
        match index_of[node] {
            FIXED => DVec2::from(lists.nodes[node]),
            index => DVec2::from(Self::nodes(q)[index as usize]),
        }
    }

    /// A bound on the fastest frequency, in radians per second, and on the fastest rate of damping; positive.
    pub fn fastest_rate(&self) -> f64 {
        let [stiffness, damping] = self.fastest(&self.springs.constants);
        stiffness.sqrt().max(damping).max(f64::MIN_POSITIVE)
    }

    /// A bound on the square of the fastest frequency, and on the fastest rate of damping, per node: those
    /// of a node whose neighbours all move against it.
    fn fastest(&self, constants: &[[f64; 3]]) -> [f64; 2] {
        let Frame { ends, anchors, free, .. } = &*self.frame;
        let mut sums = vec![[0.0; 2]; free.len()];
        let mut add = |index: u32, [k, c, _]: &[f64; 3], times: f64| {
            let [stiffness, damping] = &mut sums[index as usize];
            *stiffness += times * k;
            *damping += times * c;
        };
        for (ends, constants) in ends.iter().zip(constants) {
            ends.iter().for_each(|end| add(*end, constants, 2.0));
        }
        for ((end, _), constants) in anchors.iter().zip(&constants[ends.len()..]) {
            add(*end, constants, 1.0);
        }
        let most = |i: usize| sums.iter().map(|sums| sums[i]).fold(0.0, f64::max);
        [most(0), most(1) + self.drag / self.mass]
    }
}

impl System for Net {
    type Vector = Vec<f64>;

    fn coupling() -> Coupling {
        Coupling::Few
    }

    #[inline]
    fn acceleration(&self, _t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        let (q, v, a) = (Self::nodes(q), Self::nodes(v), Self::nodes_mut(a));
        let Frame { ends, anchors, .. } = &*self.frame;
        let drag = self.drag / self.mass;
        for (a, v) in a.iter_mut().zip(v) {
            *a = [-drag * v[0], -self.gravity - drag * v[1]];
        }
        let (inner, outer) = self.springs.constants.split_at(ends.len());
        for ([i, j], constants) in ends.iter().zip(inner) {
            let (i, j) = (*i as usize, *j as usize);
            let d = [q[j][0] - q[i][0], q[j][1] - q[i][1]];
            let w = [v[j][0] - v[i][0], v[j][1] - v[i][1]];
            let f = pull(constants, d, w);
            a[i] = [a[i][0] + f[0], a[i][1] + f[1]];
            a[j] = [a[j][0] - f[0], a[j][1] - f[1]];
        }
        for ((i, anchor), constants) in anchors.iter().zip(outer) {
            let i = *i as usize;
            let d = [anchor[0] - q[i][0], anchor[1] - q[i][1]];
            let f = pull(constants, d, [-v[i][0], -v[i][1]]);
            a[i] = [a[i][0] + f[0], a[i][1] + f[1]];
        }
    }

    #[inline]
    fn answer(&self, _t: f64, question: Question<'_, Vec<f64>>) -> bool {
        let Question::Slope { state, along, slope } = question else { return false };
        let (q, v) = (Self::nodes(&state.q), Self::nodes(&state.v));
        let (dq, dv, slope) =
            (Self::nodes(&along.q), Self::nodes(&along.v), Self::nodes_mut(slope));
        let Frame { ends, anchors, .. } = &*self.frame;
        let drag = self.drag / self.mass;
        for (slope, dv) in slope.iter_mut().zip(dv) {
            *slope = [-drag * dv[0], -drag * dv[1]];
        }
        let (inner, outer) = self.springs.constants.split_at(ends.len());
        let between = |x: &[[f64; 2]], i: usize, j: usize| [x[j][0] - x[i][0], x[j][1] - x[i][1]];
        for ([i, j], constants) in ends.iter().zip(inner) {
            let (i, j) = (*i as usize, *j as usize);
            let apart = |x: &[[f64; 2]]| between(x, i, j);
            let f = pull_slope(constants, [apart(q), apart(v)], [apart(dq), apart(dv)]);
            slope[i] = [slope[i][0] + f[0], slope[i][1] + f[1]];
            slope[j] = [slope[j][0] - f[0], slope[j][1] - f[1]];
        }
        for ((i, anchor), constants) in anchors.iter().zip(outer) {
            let i = *i as usize;
            let d = [anchor[0] - q[i][0], anchor[1] - q[i][1]];
            let against = |x: &[[f64; 2]]| [-x[i][0], -x[i][1]];
            let f = pull_slope(constants, [d, against(v)], [against(dq), against(dv)]);
            slope[i] = [slope[i][0] + f[0], slope[i][1] + f[1]];
        }
        true
    }
}

/// The acceleration of the first end of a spring, whose other end is `d` away and moves by `w` against it.
/// A spring of no length has no direction, and does not pull.
#[inline(always)]
fn pull([k, c, rest]: &[f64; 3], d: [f64; 2], w: [f64; 2]) -> [f64; 2] {
    let length = (d[0] * d[0] + d[1] * d[1]).sqrt();
    let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
    let u = [d[0] * inverse, d[1] * inverse];
    let pull = k * (length - rest) + c * (u[0] * w[0] + u[1] * w[1]);
    [pull * u[0], pull * u[1]]
}

/// The derivative of [`pull`] at `[d, w]` in the direction `[dd, dw]`.
#[inline(always)]
fn pull_slope([k, c, rest]: &[f64; 3], [d, w]: [[f64; 2]; 2], [dd, dw]: [[f64; 2]; 2]) -> [f64; 2] {
    let length = (d[0] * d[0] + d[1] * d[1]).sqrt();
    let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
    let u = [d[0] * inverse, d[1] * inverse];
    let pull = k * (length - rest) + c * (u[0] * w[0] + u[1] * w[1]);
    let longer = u[0] * dd[0] + u[1] * dd[1];
    let turned = [(dd[0] - u[0] * longer) * inverse, (dd[1] - u[1] * longer) * inverse];
    let faster = turned[0] * w[0] + turned[1] * w[1] + u[0] * dw[0] + u[1] * dw[1];
    let more = k * longer + c * faster;
    [more * u[0] + pull * turned[0], more * u[1] + pull * turned[1]]
}

impl Body for Net {
    const CLASS: BodyClass = BodyClass::NoEngine(
        "an engine solves a net joint by joint in sweeps, and its formula here is of one joint alone",
    );
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn prepare(&mut self) {
        let Frame { lists, order, .. } = &*self.frame;
        let constants = order.iter().map(|&index| {
            let spring = &lists.springs[index];
            let stiffness = spring.stiffness.unwrap_or(self.stiffness);
            let damping = spring.damping.unwrap_or(self.damping);
            let rest = || self.rest_ratio * lists.length(spring.between);
            [stiffness / self.mass, damping / self.mass, spring.rest.unwrap_or_else(rest)]
        });
        let constants: Vec<[f64; 3]> = constants.collect();
        let are_elastic = constants.iter().all(|[_, c, _]| *c == 0.0);
        let [stiffness, damping] = self.fastest(&constants);
        let rate = stiffness.sqrt().max(damping);
        let reference_work = EVALUATIONS_PER_RADIAN * rate * constants.len() as f64;
        self.springs = Arc::new(Springs { constants, are_elastic, reference_work });
    }

    fn start(&self) -> State<Vec<f64>> {
        State { q: self.frame.start.clone(), v: self.frame.zeros() }
    }

    fn reference_work(&self) -> f64 {
        self.springs.reference_work
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
        let kicked = if self.frame.kicks_first { 1 } else { self.frame.free.len() };
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

/// Evaluations of both solutions of a reference for each radian of the fastest motion, as measured on the
/// nets of the scenes.
const EVALUATIONS_PER_RADIAN: f64 = 16.0;

impl Net {
    fn kinetic(&self, state: &State<Vec<f64>>) -> f64 {
        let squares = Self::nodes(&state.v).iter().map(|v| v[0] * v[0] + v[1] * v[1]);
        self.mass * squares.sum::<f64>() / 2.0
    }

    fn potential(&self, state: &State<Vec<f64>>) -> f64 {
        let heights = Self::nodes(&state.q).iter().map(|q| q[1]);
        let stretched = self.spring_ends(&state.q).zip(&self.springs.constants);
        let elastic = stretched.map(|([a, b], [k, _, rest])| {
            let stretch = (b - a).length() - rest;
            k * stretch * stretch
        });
        self.mass * (self.gravity * heights.sum::<f64>() + elastic.sum::<f64>() / 2.0)
    }
}
