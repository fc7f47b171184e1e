//! A rigid body that turns freely in space: `ω′ = -I⁻¹(ω × Iω)`, and its attitude.
//!
//! The [coordinates](crate::spin) leave the step of ω to ω alone, so that a general method makes of it exactly
//! the map of the engine that steps ω so.

use glam::{DQuat, DVec3};

use super::euler_top;
use super::prelude::*;
use crate::spin::{
    Spin, axes_by_moment, free_acceleration, free_jerk, pure, quaternion_at, seen_from,
    unit_attitude,
};

mod copies;

pub(super) fn kind() -> Kind {
    let named =
        |name: &'static str, velocity: &'static str, unit| Coordinate::new(name, velocity, unit);
    Kind {
        id: "tumble",
        about: "I ω′ = -ω × I ω: a rigid body that turns freely in space".into(),
        all_coordinates: vec![
            named("turn_x", "wx", "rad"),
            named("turn_y", "wy", "rad"),
            named("turn_z", "wz", "rad"),
            named("qw", "vqw", "1"),
            named("qx", "vqx", "1"),
            named("qy", "vqy", "1"),
            named("qz", "vqz", "1"),
        ]
        .into(),
        leading: "spin_x_rad_per_s".into(),
        batch: copies::batch,
        ..Kind::checked(Tumble::default(), |mut blank, values| blank.check(values))
    }
}

type Of = ParameterOf<Tumble>;

/// Number of coordinates.
const COORDINATES: usize = 7;
/// The keys of a scene's lists.
const MOMENTS: &str = "moments_kg_m2";
const SPIN: &str = "spin_rad_per_s";
const ATTITUDE: &str = "attitude";
const KICK: &str = "kick_n_m_s";

/// A product of three moments must not underflow.
const SIZES: Range = Range::Between(1e-90, 1e15);

const fn moment(key: &'static str, field: fn(&mut Tumble) -> &mut f64) -> Of {
    Of::number(key, SIZES, field).in_list(MOMENTS)
}

const fn spin(key: &'static str, field: fn(&mut Tumble) -> &mut f64) -> Of {
    Of::number(key, Range::ANY, field).at_start().in_list(SPIN)
}

const fn attitude(key: &'static str, default: f64, field: fn(&mut Tumble) -> &mut f64) -> Of {
    Of::start(key, default, field).in_list(ATTITUDE)
}

const fn kick(key: &'static str, field: fn(&mut Tumble) -> &mut f64) -> Of {
    Of::number(key, Range::ANY, field).or(0.0).in_list(KICK)
}

const PARAMETERS: [Of; 14] = [
    moment("moment_x_kg_m2", |body| &mut body.moments.x)
        .symbol("I₁")
        .about("the moment of inertia about the body's x, a principal axis"),
    moment("moment_y_kg_m2", |body| &mut body.moments.y)
        .symbol("I₂")
        .about("the moment of inertia about its y"),
    moment("moment_z_kg_m2", |body| &mut body.moments.z)
        .symbol("I₃")
        .about("the moment of inertia about its z; none may exceed the sum of the others"),
    spin("spin_x_rad_per_s", |body| &mut body.spin.x)
        .about("the angular velocity about the body's x at the start"),
    spin("spin_y_rad_per_s", |body| &mut body.spin.y).about("about its y"),
    spin("spin_z_rad_per_s", |body| &mut body.spin.z).about("about its z"),
    attitude("attitude_w", 1.0, |body| &mut body.attitude.w)
        .about("the attitude at the start, a quaternion from the body to the world: its real part"),
    attitude("attitude_x", 0.0, |body| &mut body.attitude.x).about("and its part along x"),
    attitude("attitude_y", 0.0, |body| &mut body.attitude.y).about("along y"),
    attitude("attitude_z", 0.0, |body| &mut body.attitude.z)
        .about("along z; it is scaled to length 1"),
    Of::number("mass_kg", Range::POSITIVE, |body| &mut body.mass)
        .or(1.0)
        .at_start()
        .about("the mass, which only the size of the drawn box depends on"),
    kick("kick_x_n_m_s", |body| &mut body.kick.x)
        .about("the angular momentum added by one kick, along x of the world"),
    kick("kick_y_n_m_s", |body| &mut body.kick.y).about("along y of the world"),
    kick("kick_z_n_m_s", |body| &mut body.kick.z).about("along z of the world"),
];

/// Part by which a moment may exceed the sum of the others, as rounded decimals do.
const ROUNDED: f64 = 1e-9;

/// A rigid body without torque.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tumble {
    /// The principal moments of inertia, in kg m².
    pub moments: DVec3,
    /// The angular velocity at the start, in the frame of the principal axes, in rad/s.
    pub spin: DVec3,
    /// The rotation at the start from that frame to the world; of any length but 0.
    pub attitude: DQuat,
    /// The mass, in kg.
    pub mass: f64,
    /// The angular momentum added by one kick, in the frame of the world, in N m s.
    pub kick: DVec3,
}

impl Tumble {
    /// Returns ω of a state with these velocities, in the frame of the principal axes, in rad/s.
    pub fn spin_of(v: &[f64]) -> DVec3 {
        DVec3::new(v[0], v[1], v[2])
    }

    /// Returns the attitude of a state with these coordinates, a quaternion of length 1 from the body to the world.
    pub fn attitude_of(q: &[f64]) -> DQuat {
        unit_attitude(q)
    }

    /// Returns the angle between the attitudes of two states, in radians, from 0 to half a turn.
    pub fn angle_between(a: &[f64], b: &[f64]) -> f64 {
        let between = unit_attitude(a).conjugate() * unit_attitude(b);
        2.0 * libm::atan2(between.xyz().length(), between.w.abs())
    }

    /// Returns the angle between two vectors, in radians; 0 if one has no direction.
    pub fn turn_between(a: DVec3, b: DVec3) -> f64 {
        libm::atan2(a.cross(b).length(), a.dot(b))
    }

    /// Returns L of a state with these velocities, in the frame of the principal axes, in N m s.
    pub fn momentum_in_body(&self, v: &[f64]) -> DVec3 {
        self.moments * Self::spin_of(v)
    }

    /// Returns the indices of the principal axes, from the least moment to the greatest.
    pub fn axes_by_moment(&self) -> [usize; 3] {
        axes_by_moment(self.moments)
    }

    /// Returns the direction of L from the body, as seen along its middle axis. It is L/|L| along the axes of the least
    /// and the greatest moment, and not finite if L is 0.
    pub fn pole(&self, v: &[f64]) -> [f64; 2] {
        let [least, _, greatest] = self.axes_by_moment();
        let momentum = self.momentum_in_body(v);
        [least, greatest].map(|axis| momentum[axis] / momentum.length())
    }

    /// Returns L of a state in the frame of the world, in N m s.
    pub fn momentum(&self, q: &[f64], v: &[f64]) -> DVec3 {
        unit_attitude(q) * self.momentum_in_body(v)
    }

    fn check(&mut self, values: &[f64]) -> Result<(), Fault> {
        *self = std::mem::take(self).with_parameters(values);
        let fault = |key: &'static str, what: String, remedy: &str| {
            Err(Fault { key: key.into(), what, remedy: remedy.into() })
        };
        let [x, y, z] = self.moments.to_array();
        for (moment, others) in [(x, y + z), (y, x + z), (z, x + y)] {
            if moment > others * (1.0 + ROUNDED) {
                let what =
                    format!("no body has a moment of {moment} beside two of {others} in all");
                return fault(MOMENTS, what, "write no moment above the sum of the other two");
            }
        }
        if self.attitude.length_squared() == 0.0 {
            let what = "the attitude has no direction".to_owned();
            return fault(ATTITUDE, what, "write [1.0, 0.0, 0.0, 0.0], or leave it out");
        }
        Ok(())
    }
}

impl System for Tumble {
    type Vector = Vec<f64>;

    /// The acceleration of the attitude is ½ q ⊗ ω′ - ¼ |ω|² q.
    #[inline]
    fn acceleration(&self, _t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &mut Vec<f64>) {
        let omega = Self::spin_of(v);
        let attitude = quaternion_at(q);
        let rate = free_acceleration(self.moments, omega);
        let bend = attitude * pure(rate) * 0.5 - attitude * (0.25 * omega.length_squared());
        a.copy_from_slice(&[rate.x, rate.y, rate.z, bend.w, bend.x, bend.y, bend.z]);
    }

    fn query(&self, _t: f64, query: Query<'_, Vec<f64>>) -> bool {
        match query {
            Query::Spin(moments) => *moments = Some(self.moments),
            Query::Slope { state: State { q, v }, along, slope } => {
                let [omega, toward] = [v, &along.v].map(|v| Self::spin_of(v));
                let [attitude, turned] = [q, &along.q].map(|q| quaternion_at(q));
                let rate = free_acceleration(self.moments, omega);
                let change = free_jerk(self.moments, omega, toward);
                let bend = (turned * pure(rate) + attitude * pure(change)) * 0.5
                    - attitude * (0.5 * omega.dot(toward))
                    - turned * (0.25 * omega.length_squared());
                slope.copy_from_slice(&[
                    change.x, change.y, change.z, bend.w, bend.x, bend.y, bend.z,
                ]);
            }
            _ => return false,
        }
        true
    }
}

impl Body for Tumble {
    const CLASS: BodyClass = BodyClass::Spin;
    const HAS_EXACT: bool = true;
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn start(&self) -> State<Vec<f64>> {
        let attitude = self.attitude * (1.0 / self.attitude.length());
        let mut state = State { q: vec![0.0; COORDINATES], v: vec![0.0; COORDINATES] };
        let spin = Spin { turns: DVec3::ZERO, omega: self.spin, attitude };
        spin.write(&mut state.q, &mut state.v);
        state
    }

    fn settle(&self, state: &mut State<Vec<f64>>) {
        Spin::of(&state.q, &state.v).write(&mut state.q, &mut state.v);
    }

    fn exact_into(&self, _t: f64, dt: f64, from: &State<Vec<f64>>, to: &mut State<Vec<f64>>) {
        let from = Spin::of(&from.q, &from.v);
        euler_top::flow(self.moments, &from, dt).write(&mut to.q, &mut to.v);
    }

    /// The rounding of the angles through which the body has turned, and that of the time, during which ω turns too.
    fn exact_error(
        &self,
        _t: f64,
        dt: f64,
        from: &State<Vec<f64>>,
        to: &State<Vec<f64>>,
    ) -> [f64; 2] {
        let fastest = self.momentum_in_body(&from.v).length() / self.moments.min_element();
        let turned = std::f64::consts::TAU + fastest * dt.abs();
        let farthest = to.q.iter().fold(turned, |most, x| most.max(x.abs()));
        let rounding = 8.0 * f64::EPSILON;
        [rounding * farthest, rounding * fastest * turned]
    }

    fn is_angle(&self, coordinate: usize) -> bool {
        coordinate < 3
    }

    fn energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        Some(Self::spin_of(&state.v).dot(self.momentum_in_body(&state.v)) / 2.0)
    }

    fn kinetic_energy(&self, state: &State<Vec<f64>>) -> Option<f64> {
        self.energy(state)
    }

    fn mechanical_energy(&self, state: &State<Vec<f64>>) -> Option<[f64; 2]> {
        Some([self.energy(state)?, 0.0])
    }

    fn input(&mut self, input: Input, state: &mut State<Vec<f64>>) -> bool {
        let Input::Kick(times) = input else { return false };
        let mut spin = Spin::of(&state.q, &state.v);
        spin.omega += seen_from(spin.attitude, times * self.kick) / self.moments;
        spin.write(&mut state.q, &mut state.v);
        true
    }

    fn place(&self, _q: &Vec<f64>) -> DVec2 {
        DVec2::ZERO
    }
}
