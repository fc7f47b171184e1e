//! A pendulum at any amplitude: `m l² θ″ = -m g l sin θ - c θ′`.

use super::prelude::*;

pub(super) fn kind() -> Kind {
    Kind {
        id: "pendulum",
        about: "m l² θ″ = -m g l sin θ - c θ′: a bob on a rod, at any angle".into(),
        all_coordinates: vec![Coordinate::new("theta", "omega", "rad")].into(),
        leading: "gravity_m_per_s2".into(),
        ..Kind::of_one(Pendulum::default())
    }
}

type Of = ParameterOf<Pendulum>;

const PARAMETERS: [Of; 7] = [
    Of::number("length_m", Range::POSITIVE, |pendulum| &mut pendulum.length)
        .symbol("l")
        .about("from the pivot to the bob"),
    Of::number("mass_kg", Range::POSITIVE, |pendulum| &mut pendulum.mass)
        .or(1.0)
        .symbol("m")
        .about("the bob"),
    Of::number("gravity_m_per_s2", Range::NON_NEGATIVE, |pendulum| &mut pendulum.gravity)
        .or(9.81)
        .symbol("g")
        .about("downwards"),
    Of::number("damping_n_m_s", Range::NON_NEGATIVE, |pendulum| &mut pendulum.damping)
        .or(0.0)
        .symbol("c")
        .about("the damping coefficient: torque per radian per second"),
    Of::start("theta0_rad", 1.0, |pendulum| &mut pendulum.theta0)
        .named("angle at start")
        .about("the angle at the start, from hanging down, counter-clockwise"),
    Of::start("omega0_rad_per_s", 0.0, |pendulum| &mut pendulum.omega0)
        .named("spin at start")
        .about("the angular velocity at the start"),
    Of::number("kick_n_m_s", Range::ANY, |pendulum| &mut pendulum.kick)
        .or(1.0)
        .about("the angular impulse of one kick"),
];

/// A pendulum. Its coordinate is the angle from hanging down, in radians, counter-clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pendulum {
    /// l, the length from the pivot to the bob, in metres.
    pub length: f64,
    /// m, the mass of the bob, in kilograms.
    pub mass: f64,
    /// g, the gravity, in metres per second squared.
    pub gravity: f64,
    /// c, the damping, in N·m·s.
    pub damping: f64,
    /// Angle at the start, in radians.
    pub theta0: f64,
    /// Angular velocity at the start, in radians per second.
    pub omega0: f64,
    /// The angular impulse of one kick, in newton metre seconds.
    pub kick: f64,
}

impl Pendulum {
    /// Returns m l², the moment of inertia, in kilogram square metres.
    fn inertia(&self) -> f64 {
        self.mass * self.length * self.length
    }

    /// Returns the position of the bob relative to the pivot, in metres.
    fn bob(&self, theta: f64) -> DVec2 {
        self.length * DVec2::new(libm::sin(theta), -libm::cos(theta))
    }
}

impl System for Pendulum {
    type Vector = f64;

    #[inline]
    fn acceleration(&self, _t: f64, theta: &f64, omega: &f64, a: &mut f64) {
        let (pull, drag) = (self.gravity / self.length, self.damping / self.inertia());
        *a = -pull * libm::sin(*theta) - drag * omega;
    }
}

impl Body for Pendulum {
    const CLASS: BodyClass = BodyClass::NoEngine(
        "in an engine a pendulum is a hinge, whose rod the solver holds by constraint forces",
    );
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn start(&self) -> State<f64> {
        State { q: self.theta0, v: self.omega0 }
    }

    fn is_angle(&self, _coordinate: usize) -> bool {
        true
    }

    fn energy(&self, state: &State<f64>) -> Option<f64> {
        let State { q: theta, v: omega } = *state;
        // This is 1 - cos θ, without cancellation.
        let half = libm::sin(theta / 2.0);
        let height = 2.0 * self.length * half * half;
        let energy = self.inertia() * omega * omega / 2.0 + self.mass * self.gravity * height;
        (self.damping == 0.0).then_some(energy)
    }

    fn input(&mut self, input: Input, state: &mut State<f64>) -> bool {
        let Input::Kick(times) = input else { return false };
        state.v += times * self.kick / self.inertia();
        true
    }

    fn place(&self, theta: &f64) -> DVec2 {
        self.bob(*theta)
    }
}
