//! A steered ship, with surge and sway of its centre of mass, and yaw. The thrust is interpolated from a table over
//! speed.
//!
//! The motion is described in the frame of the water, where the equation is of second order in the coordinates: `m (vx,
//! vy)′ = (δₜ T(u) - C u) bow - S w port` and `I r′ = δᵣ L u - D r`, with the surge speed `u` along the bow and the
//! sway speed `w` to port.

use glam::DVec3;

use super::Curve;
use super::prelude::*;
use crate::body::{Distances, NO_BOUNDARIES, Piece};

pub(super) fn kind() -> Kind {
    Kind {
    id: "helm",
    about: "m v′ = thrust(u) - C u ahead, - S w abeam; I r′ = rudder L u - D r: a ship that is steered".into(),
    all_coordinates: vec![Coordinate::new("x", "vx", "m"), Coordinate::new("y", "vy", "m"), Coordinate::new("psi", "r", "rad")].into(),
    leading: "side_drag_n_s_per_m".into(),
        ..Kind::of(Helm { throttle: 1.0, ..Helm::default() })
    }
}

type Of = ParameterOf<Helm>;

const PARAMETERS: [Of; 12] = [
    Of::number("mass_kg", Range::POSITIVE, |helm| &mut helm.mass).symbol("m").about("the mass"),
    Of::number("inertia_kg_m2", Range::POSITIVE, |helm| &mut helm.inertia)
        .symbol("I")
        .about("the moment of inertia about the upright axis"),
    Of::number("drag_n_s_per_m", Range::NON_NEGATIVE, |helm| &mut helm.drag)
        .symbol("C")
        .about("the drag coefficient ahead: force per metre per second"),
    Of::number("side_drag_n_s_per_m", Range::NON_NEGATIVE, |helm| &mut helm.side_drag)
        .symbol("S")
        .about("the drag coefficient sideways: force per metre per second"),
    Of::number("yaw_drag_n_m_s", Range::NON_NEGATIVE, |helm| &mut helm.yaw_drag)
        .symbol("D")
        .about("the damping coefficient of turning: moment per radian per second"),
    Of::number("rudder_n_s", Range::NON_NEGATIVE, |helm| &mut helm.rudder_moment)
        .symbol("L")
        .about("the moment of the full rudder per metre per second ahead"),
    Of::start("x0_m", 0.0, |helm| &mut helm.q0.x).named("x at start").about("x at the start"),
    Of::start("y0_m", 0.0, |helm| &mut helm.q0.y).named("y at start").about("y at the start"),
    Of::start("psi0_rad", 0.0, |helm| &mut helm.q0.z)
        .named("heading at start")
        .about("the heading at the start, counter-clockwise from x"),
    Of::start("u0_m_per_s", 0.0, |helm| &mut helm.u0)
        .named("speed at start")
        .about("the speed ahead at the start"),
    Of::number("kick_n_s", Range::ANY, |helm| &mut helm.kick)
        .or(20_000.0)
        .about("the impulse of one kick, ahead"),
    Of::curve("thrust_curve", ["m/s", "N"], |helm, points| {
        helm.thrust = Curve::new(points.iter().copied())
    })
    .about("the full thrust at speeds ahead: straight between them, level beyond them"),
];

/// A steered ship. Its coordinates are x and y in metres and the heading ψ, in radians counter-clockwise from x.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Helm {
    /// m, the mass, in kilograms.
    pub mass: f64,
    /// I, the moment of inertia about the upright axis, in kilogram square metres.
    pub inertia: f64,
    /// C, the drag ahead, in N·s/m.
    pub drag: f64,
    /// S, the drag sideways, in N·s/m.
    pub side_drag: f64,
    /// D, the damping of turning, in N·m·s.
    pub yaw_drag: f64,
    /// L, the moment of the full rudder per speed ahead, in N·s.
    pub rudder_moment: f64,
    /// T, the thrust in newtons, over the speed ahead in m/s.
    pub thrust: Curve,
    /// The throttle, which is the fraction of full thrust, from -1 to 1.
    pub throttle: f64,
    /// The rudder, which is the fraction of its full angle, from -1 to 1. A positive fraction turns left.
    pub rudder: f64,
    /// Place and heading at the start.
    pub q0: DVec3,
    /// Speed ahead at the start, in metres per second.
    pub u0: f64,
    /// The impulse of one kick, in newton seconds.
    pub kick: f64,
}

fn bow(heading: f64) -> DVec2 {
    DVec2::new(libm::cos(heading), libm::sin(heading))
}

/// Returns the speed ahead, in metres per second.
fn surge(state: &State<DVec3>) -> f64 {
    bow(state.q.z).dot(state.v.truncate())
}

impl Helm {
    /// Returns the largest magnitude of a speed in the thrust table; 1 if all speeds are 0.
    fn fastest(&self) -> f64 {
        let fastest = self.thrust.points().iter().map(|[speed, _]| speed.abs()).fold(0.0, f64::max);
        if fastest > 0.0 { fastest } else { 1.0 }
    }

    /// Returns the acceleration, given a function that returns the full thrust at a surge speed.
    #[inline]
    fn acceleration_under(&self, thrust: impl Fn(f64) -> f64, q: &DVec3, v: &DVec3) -> DVec3 {
        let (bow, r) = (bow(q.z), v.z);
        let port = bow.perp();
        let (u, w) = (bow.dot(v.truncate()), port.dot(v.truncate()));
        let ahead = self.throttle * thrust(u) - self.drag * u;
        let abeam = -self.side_drag * w;
        let turning = self.rudder * self.rudder_moment * u - self.yaw_drag * r;
        ((ahead * bow + abeam * port) / self.mass).extend(turning / self.inertia)
    }
}

impl System for Helm {
    type Vector = DVec3;

    #[inline]
    fn acceleration(&self, _t: f64, q: &DVec3, v: &DVec3, a: &mut DVec3) {
        *a = self.acceleration_under(|u| self.thrust.at(u), q, v);
    }
}

impl Body for Helm {
    const INPUTS: &'static [&'static str] = &["throttle", "rudder", "kick"];
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn heap_bytes(&self) -> usize {
        size_of_val(self.thrust.points())
    }

    fn start(&self) -> State<DVec3> {
        State { q: self.q0, v: (self.u0 * bow(self.q0.z)).extend(0.0) }
    }

    fn is_angle(&self, coordinate: usize) -> bool {
        coordinate == 2
    }

    fn switches(&self) -> usize {
        1
    }

    fn piece(&self, _t: f64, state: &State<DVec3>) -> Piece {
        let mut piece = Piece::FIRST;
        piece.modes[0] = self.thrust.piece(surge(state));
        piece
    }

    fn distances_to_ends(&self, piece: &Piece, _t: f64, state: &State<DVec3>) -> Distances {
        let mut distances = NO_BOUNDARIES;
        let speeds = self.thrust.distances(piece.modes[0], surge(state));
        distances[0] = speeds.map(|distance| distance / self.fastest());
        distances
    }

    #[inline]
    fn acceleration_on(&self, piece: &Piece, _t: f64, q: &DVec3, v: &DVec3, a: &mut DVec3) {
        *a = self.acceleration_under(|u| self.thrust.on(piece.modes[0], u), q, v);
    }

    fn input(&mut self, input: Input, state: &mut State<DVec3>) -> bool {
        match input {
            Input::Throttle(part) => self.throttle = part,
            Input::Rudder(part) => self.rudder = part,
            Input::Kick(times) => {
                state.v += (times * self.kick / self.mass * bow(state.q.z)).extend(0.0);
            }
        }
        true
    }

    fn place(&self, q: &DVec3) -> DVec2 {
        q.truncate()
    }
}
