//! A pendulum that may swing as far as it likes: `m l² θ″ = -m g l sin θ - c θ′`.

use glam::DVec2;

use super::{Body, Coordinate, Input, Kind, LARGEST, Parameter, Pen, Range, Truth, View};
use crate::sim::{State, System, stepper};

pub(super) const KIND: Kind = Kind {
    id: "pendulum",
    about: "m l² θ″ = -m g l sin θ - c θ′: a bob on a rod, at any angle",
    coordinates: |_| &[Coordinate { name: "theta", velocity: "omega", unit: "rad" }],
    parameters: &[
        Parameter {
            key: "length_m",
            about: "l, from the pivot to the bob",
            default: None,
            range: Range::Positive(LARGEST),
        },
        Parameter {
            key: "mass_kg",
            about: "m, the bob",
            default: Some(1.0),
            range: Range::Positive(LARGEST),
        },
        Parameter {
            key: "gravity_m_per_s2",
            about: "g, downwards",
            default: Some(9.81),
            range: Range::NonNegative(LARGEST),
        },
        Parameter {
            key: "damping_n_m_s",
            about: "c, the torque for each radian per second",
            default: Some(0.0),
            range: Range::NonNegative(LARGEST),
        },
        Parameter {
            key: "theta0_rad",
            about: "the angle at the start, from hanging down, counter-clockwise",
            default: Some(1.0),
            range: Range::Within(LARGEST),
        },
        Parameter {
            key: "omega0_rad_per_s",
            about: "the angular velocity at the start",
            default: Some(0.0),
            range: Range::Within(LARGEST),
        },
        Parameter {
            key: "kick_n_m_s",
            about: "the angular impulse of one kick",
            default: Some(1.0),
            range: Range::Within(LARGEST),
        },
    ],
    inputs: &["kick"],
    leading: "gravity_m_per_s2",
    truth: Truth::Reference,
    check: |_| Ok(()),
    build: |values, solver| {
        let &[length, mass, gravity, damping, theta0, omega0, kick] = values else {
            unreachable!("one value a key")
        };
        stepper(Pendulum { length, mass, gravity, damping, theta0, omega0, kick }, solver)
    },
};

/// A pendulum. Its coordinate is the angle from hanging down, in radians, counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Pendulum {
    /// l, in metres.
    pub length: f64,
    /// m, in kilograms.
    pub mass: f64,
    /// g, in metres per second squared.
    pub gravity: f64,
    /// c, in newton metres for each radian per second.
    pub damping: f64,
    /// Angle at the start, in radians.
    pub theta0: f64,
    /// Angular velocity at the start, in radians per second.
    pub omega0: f64,
    /// The angular impulse of one kick, in newton metre seconds.
    pub kick: f64,
}

impl Pendulum {
    /// m l², in kilogram square metres.
    fn inertia(&self) -> f64 {
        self.mass * self.length * self.length
    }

    /// Where the bob hangs from the pivot, in metres.
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
    fn start(&self) -> State<f64> {
        State { q: self.theta0, v: self.omega0 }
    }

    fn exact(&self, _dt: f64, _from: &State<f64>) -> Option<State<f64>> {
        None
    }

    fn is_angle(&self, _coordinate: usize) -> bool {
        true
    }

    fn energy(&self, state: &State<f64>) -> Option<f64> {
        let State { q: theta, v: omega } = *state;
        // 1 - cos θ, without its cancellation.
        let half = libm::sin(theta / 2.0);
        let height = 2.0 * self.length * half * half;
        let energy = self.inertia() * omega * omega / 2.0 + self.mass * self.gravity * height;
        (self.damping == 0.0).then_some(energy)
    }

    fn input(&mut self, input: Input, state: &mut State<f64>) -> bool {
        match input {
            Input::Kick(times) => state.v += times * self.kick / self.inertia(),
            Input::Throttle(_) | Input::Rudder(_) => return false,
        }
        true
    }

    fn place(&self, theta: &f64) -> DVec2 {
        self.bob(*theta)
    }

    fn outline(&self, _state: &State<f64>, pen: &mut Pen) {
        let (pivot, bob, unit) = (DVec2::ZERO, pen.at, self.length);
        pen.line(pivot, bob, 1.4);
        pen.taper(pivot, 0.035 * unit, pivot, 0.035 * unit);
        pen.taper(bob, 0.12 * unit, bob, 0.12 * unit);
    }

    fn view(&self) -> View {
        let half_m = DVec2::splat(1.2 * self.length);
        View::Fixed { centre_m: DVec2::ZERO, half_m, trail_s: 1.0 }
    }
}
