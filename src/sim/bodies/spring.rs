//! A mass on a spring with a dash-pot: `m x″ = -k x - c x′`.

use glam::DVec2;

use super::{Body, Coordinate, Input, Kind, LARGEST, Parameter, Pen, Range, View};
use crate::sim::{State, System, stepper};

pub(super) const KIND: Kind = Kind {
    id: "spring",
    about: "m x″ = -k x - c x′: a mass on a spring with a dash-pot",
    coordinates: &[Coordinate { name: "x", velocity: "v", unit: "m" }],
    parameters: &[
        Parameter {
            key: "mass_kg",
            about: "m, the mass",
            default: None,
            range: Range::Positive(LARGEST),
        },
        Parameter {
            key: "stiffness_n_per_m",
            about: "k, the force for each metre of stretch",
            default: None,
            range: Range::Positive(LARGEST),
        },
        Parameter {
            key: "damping_n_s_per_m",
            about: "c, the force for each metre per second",
            default: Some(0.0),
            range: Range::NonNegative(LARGEST),
        },
        Parameter {
            key: "x0_m",
            about: "the stretch at the start",
            default: Some(1.0),
            range: Range::Within(LARGEST),
        },
        Parameter {
            key: "v0_m_per_s",
            about: "the velocity at the start",
            default: Some(0.0),
            range: Range::Within(LARGEST),
        },
        Parameter {
            key: "kick_n_s",
            about: "the impulse of one kick",
            default: Some(3.0),
            range: Range::Within(LARGEST),
        },
    ],
    inputs: &["kick"],
    build: |values, solver| {
        let &[mass, stiffness, damping, x0, v0, kick] = values else {
            unreachable!("one value a key")
        };
        stepper(Spring { mass, stiffness, damping, x0, v0, kick }, solver)
    },
};

/// A mass on a spring. Its coordinate is the stretch, in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// m, in kilograms.
    pub mass: f64,
    /// k, in newtons per metre.
    pub stiffness: f64,
    /// c, in newtons for each metre per second.
    pub damping: f64,
    /// Stretch at the start, in metres.
    pub x0: f64,
    /// Velocity at the start, in metres per second.
    pub v0: f64,
    /// The impulse of one kick, in newton seconds.
    pub kick: f64,
}

impl Spring {
    /// The undamped angular frequency √(k/m), in radians per second.
    pub fn angular_frequency(&self) -> f64 {
        (self.stiffness / self.mass).sqrt()
    }

    /// The amplitude that the undamped spring would swing with from its start, in metres.
    fn amplitude(&self) -> f64 {
        let amplitude = libm::hypot(self.x0, self.v0 / self.angular_frequency());
        if amplitude > 0.0 { amplitude } else { 1.0 }
    }
}

impl System for Spring {
    type Vector = f64;

    #[inline]
    fn acceleration(&self, _t: f64, x: &f64, v: &f64, a: &mut f64) {
        // Divided first, as these are the same at every stage: a division between one stage and the
        // next would nearly double the time of a step. The 0 changes no value, but makes the two
        // quotients unlike: the compiler would pack alike ones, and with them x and v, into one register,
        // and wait for both halves at each stage and for the store of both before the next tick.
        let (k, c) = (self.stiffness / self.mass, self.damping / self.mass + 0.0);
        *a = -k * x - c * v;
    }
}

impl Body for Spring {
    fn start(&self) -> State<f64> {
        State { q: self.x0, v: self.v0 }
    }

    fn exact(&self, dt: f64, from: &State<f64>) -> Option<State<f64>> {
        let State { q: x, v } = *from;
        let alpha = self.damping / self.mass / 2.0;
        let omega2 = self.stiffness / self.mass;
        let w2 = omega2 - alpha * alpha;
        let u = w2 * dt * dt;
        if u <= -NEAR_CRITICAL {
            // Two decays, at the rates of the creep and of the recoil, each kept whole: as hyperbolic
            // functions they would overflow, and cancel in the velocity.
            let w = (-w2).sqrt();
            let (slow, fast) = (omega2 / (alpha + w), alpha + w);
            let creep = (fast * x + v) * libm::exp(-slow * dt) / (2.0 * w);
            let recoil = (slow * x + v) * libm::exp(-fast * dt) / (2.0 * w);
            return Some(State { q: creep - recoil, v: fast * recoil - slow * creep });
        }
        // e^(-alpha t) (x C + (v + alpha x) S), with C = cos(w t) and S = sin(w t) / w.
        let (c, s) = if u < NEAR_CRITICAL {
            let (c, s) = near_critical(u);
            (c, s * dt)
        } else {
            let w = w2.sqrt();
            (libm::cos(w * dt), libm::sin(w * dt) / w)
        };
        let decay = libm::exp(-alpha * dt);
        Some(State {
            q: decay * (x * c + (v + alpha * x) * s),
            v: decay * (v * c - (omega2 * x + alpha * v) * s),
        })
    }

    fn energy(&self, state: &State<f64>) -> Option<f64> {
        let State { q: x, v } = *state;
        (self.damping == 0.0).then(|| (self.mass * v * v + self.stiffness * x * x) / 2.0)
    }

    fn input(&mut self, input: Input, state: &mut State<f64>) -> bool {
        match input {
            Input::Kick(times) => state.v += times * self.kick / self.mass,
            Input::Throttle(_) => return false,
        }
        true
    }

    fn outline(&self, state: &State<f64>, pen: &mut Pen) {
        let unit = self.amplitude();
        pen.at = DVec2::new(state.q, 0.0);
        let wall = DVec2::new(-1.9 * unit, 0.0);
        let half = 0.16 * unit;
        pen.line(wall - DVec2::Y * 0.45 * unit, wall + DVec2::Y * 0.45 * unit, 2.0);
        pen.coil(wall, pen.at - DVec2::X * half, 9, 0.14 * unit);
        pen.block(pen.at, half);
    }

    fn view(&self) -> View {
        View::Fixed { half_width_m: 2.0 * self.amplitude() }
    }
}

/// The `|w t|²` below which the flow is a series: much smaller, and `sin(w t) / w` loses digits beside
/// it; larger, and the series needs more terms.
const NEAR_CRITICAL: f64 = 1e-3;

/// `cos √u` and `sin √u / √u` as their Taylor series in `u`, which know no difference between swinging
/// and creeping; for |u| < [`NEAR_CRITICAL`] the first term left out is below 1e-19.
fn near_critical(u: f64) -> (f64, f64) {
    let c = 1.0 - u / 2.0 * (1.0 - u / 12.0 * (1.0 - u / 30.0 * (1.0 - u / 56.0)));
    let s = 1.0 - u / 6.0 * (1.0 - u / 20.0 * (1.0 - u / 42.0 * (1.0 - u / 72.0)));
    (c, s)
}
