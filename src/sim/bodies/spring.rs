//! A mass on a spring with a dash-pot: `m x″ = -k x - c x′`.

use super::oscillator;
use super::prelude::*;

pub(super) fn kind() -> Kind {
    Kind {
        id: "spring",
        about: "m x″ = -k x - c x′: a mass on a spring with a dash-pot".into(),
        all_coordinates: vec![Coordinate::new("x", "v", "m")].into(),
        leading: "stiffness_n_per_m".into(),
        ..Kind::of_one(Spring::default())
    }
}

type Of = ParameterOf<Spring>;

const PARAMETERS: [Of; 6] = [
    Of::number("mass_kg", Range::POSITIVE, |spring| &mut spring.mass).symbol("m").about("the mass"),
    Of::number("stiffness_n_per_m", Range::POSITIVE, |spring| &mut spring.stiffness)
        .symbol("k")
        .about("the stiffness: force per metre of stretch"),
    Of::number("damping_n_s_per_m", Range::NON_NEGATIVE, |spring| &mut spring.damping)
        .or(0.0)
        .symbol("c")
        .about("the damping coefficient: force per metre per second"),
    Of::start("x0_m", 1.0, |spring| &mut spring.x0)
        .named("stretch at start")
        .about("the stretch at the start"),
    Of::start("v0_m_per_s", 0.0, |spring| &mut spring.v0)
        .named("velocity at start")
        .about("the velocity at the start"),
    Of::number("kick_n_s", Range::ANY, |spring| &mut spring.kick)
        .or(3.0)
        .about("the impulse of one kick"),
];

/// A mass on a spring. Its coordinate is the stretch, in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spring {
    /// m, the mass, in kilograms.
    pub mass: f64,
    /// k, the stiffness, in newtons per metre.
    pub stiffness: f64,
    /// c, the damping, in N·s/m.
    pub damping: f64,
    /// Stretch at the start, in metres.
    pub x0: f64,
    /// Velocity at the start, in metres per second.
    pub v0: f64,
    /// The impulse of one kick, in newton seconds.
    pub kick: f64,
}

impl Spring {
    /// Returns the undamped angular frequency √(k/m), in radians per second.
    pub fn angular_frequency(&self) -> f64 {
        (self.stiffness / self.mass).sqrt()
    }
}

impl System for Spring {
    type Vector = f64;

    #[inline]
    fn acceleration(&self, _t: f64, x: &f64, v: &f64, a: &mut f64) {
        // This form is only for speed (`--bench step -- spring`). The quotients come before the stages that share them,
        // and adding 0 keeps the compiler from packing both into one register.
        let (k, c) = (self.stiffness / self.mass, self.damping / self.mass + 0.0);
        *a = -k * x - c * v;
    }

    /// Gives an engine the settings of a joint that equals the spring.
    #[inline]
    fn query(&self, _t: f64, query: Query<'_, f64>) -> bool {
        let Query::Engine { settings, force, .. } = query else { return false };
        settings.stiffness = self.stiffness / self.mass;
        settings.damping = self.damping / self.mass;
        *force = 0.0;
        true
    }
}

impl Body for Spring {
    const CLASS: BodyClass = BodyClass::Joint;
    const HAS_EXACT: bool = true;
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn start(&self) -> State<f64> {
        State { q: self.x0, v: self.v0 }
    }

    fn exact_into(&self, _t: f64, dt: f64, from: &State<f64>, to: &mut State<f64>) {
        let alpha = self.damping / self.mass / 2.0;
        *to = oscillator::flow(self.stiffness / self.mass, alpha, dt, from);
    }

    fn exact_error(&self, _t: f64, dt: f64, from: &State<f64>, _to: &State<f64>) -> [f64; 2] {
        let alpha = self.damping / self.mass / 2.0;
        oscillator::flow_error(self.stiffness / self.mass, alpha, dt, from)
    }

    fn is_linear(&self) -> bool {
        true
    }

    fn energy(&self, state: &State<f64>) -> Option<f64> {
        let State { q: x, v } = *state;
        (self.damping == 0.0).then(|| (self.mass * v * v + self.stiffness * x * x) / 2.0)
    }

    fn mechanical_energy(&self, state: &State<f64>) -> Option<[f64; 2]> {
        let State { q: x, v } = *state;
        Some([self.mass * v * v / 2.0, self.stiffness * x * x / 2.0])
    }

    fn input(&mut self, input: Input, state: &mut State<f64>) -> bool {
        let Input::Kick(times) = input else { return false };
        state.v += times * self.kick / self.mass;
        true
    }
}
