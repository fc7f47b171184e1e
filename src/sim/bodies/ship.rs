//! The chapter's ship, which thrust drives against a drag proportional to speed, `m v′ = T - C v`.

use super::prelude::*;

pub(super) fn kind() -> Kind {
    Kind {
        id: "ship",
        about: "m s″ = T - C s′: full thrust times throttle, against linear drag".into(),
        all_coordinates: vec![Coordinate::new("s", "v", "m")].into(),
        leading: "drag_n_s_per_m".into(),
        ..Kind::of_one(Ship::BLANK)
    }
}

type Of = ParameterOf<Ship>;

const PARAMETERS: [Of; 6] = [
    Of::number("thrust_n", Range::ANY, |ship| &mut ship.thrust)
        .symbol("T")
        .about("the full thrust"),
    Of::number("drag_n_s_per_m", Range::NON_NEGATIVE, |ship| &mut ship.drag)
        .symbol("C")
        .about("the drag coefficient: force per metre per second"),
    Of::number("mass_kg", Range::POSITIVE, |ship| &mut ship.mass).symbol("m").about("the mass"),
    Of::start("s0_m", 0.0, |ship| &mut ship.s0)
        .named("distance at start")
        .about("the distance run at the start"),
    Of::start("v0_m_per_s", 0.0, |ship| &mut ship.v0)
        .named("speed at start")
        .about("the speed at the start"),
    Of::number("kick_n_s", Range::ANY, |ship| &mut ship.kick)
        .or(20_000.0)
        .about("the impulse of one kick"),
];

/// A ship on a straight course. Its coordinate is the distance run, in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Ship {
    /// T, the full thrust, in newtons.
    pub thrust: f64,
    /// The throttle, which is the fraction of full thrust, from -1 to 1.
    pub throttle: f64,
    /// C, the drag, in N·s/m.
    pub drag: f64,
    /// m, the mass, in kilograms.
    pub mass: f64,
    /// Distance run at the start, in metres.
    pub s0: f64,
    /// Speed at the start, in metres per second.
    pub v0: f64,
    /// The impulse of one kick, in newton seconds.
    pub kick: f64,
}

impl Ship {
    /// A ship with full throttle and all other fields 0, which [`Body::with_parameters`] then sets.
    pub const BLANK: Self =
        Self { thrust: 0.0, throttle: 1.0, drag: 0.0, mass: 0.0, s0: 0.0, v0: 0.0, kick: 0.0 };
}

impl System for Ship {
    type Vector = f64;

    #[inline]
    fn acceleration(&self, _t: f64, _s: &f64, v: &f64, a: &mut f64) {
        // The divisions come first, because these quotients are the same at every stage, and a division between two
        // stages would double the time of a step.
        let (push, rate) = (self.thrust * self.throttle / self.mass, self.drag / self.mass);
        *a = push - rate * v;
    }

    /// Gives the drag to an engine as the damping setting of the body, and the thrust as a force that the engine holds.
    #[inline]
    fn query(&self, _t: f64, query: Query<'_, f64>) -> bool {
        let Query::Engine { settings, force, .. } = query else { return false };
        settings.drag = self.drag / self.mass;
        *force = self.thrust * self.throttle / self.mass;
        true
    }
}

impl Body for Ship {
    const INPUTS: &'static [&'static str] = &["throttle", "kick"];
    const HAS_EXACT: bool = true;
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn start(&self) -> State<f64> {
        State { q: self.s0, v: self.v0 }
    }

    fn exact_into(&self, _t: f64, dt: f64, from: &State<f64>, to: &mut State<f64>) {
        let push = self.thrust * self.throttle / self.mass;
        let rate = self.drag / self.mass;
        // With z = rate dt:  phi1 = (1 - e^-z) / z,  phi2 = (1 - phi1) / z.
        let z = rate * dt;
        let (phi1, phi2) = if z.abs() < 0.1 { phi_series(z) } else { phi(z) };
        let State { q: s, v } = *from;
        to.q = s + v * dt * phi1 + push * dt * dt * phi2;
        to.v = v + (push - rate * v) * dt * phi1;
    }

    fn exact_error(&self, _t: f64, dt: f64, from: &State<f64>, _to: &State<f64>) -> [f64; 2] {
        let push = self.thrust * self.throttle / self.mass;
        let rate = self.drag / self.mass;
        // φ₁ ≤ min(1, 1/|z|) and φ₂ ≤ min(½, 1/|z|).
        let z = (rate * dt).abs();
        let [phi1, phi2] = [1.0, 0.5].map(|most: f64| most.min(1.0 / z));
        let run = (from.v * dt * phi1).abs() + (push * dt * dt * phi2).abs();
        let gained = (push.abs() + (rate * from.v).abs()) * dt.abs() * phi1;
        // The largest amplification is just above the limit of the series, where 1 - φ₁ is about a twentieth.
        [from.q.abs() + 32.0 * run, from.v.abs() + 8.0 * gained].map(|size| f64::EPSILON * size)
    }

    fn is_linear(&self) -> bool {
        true
    }

    fn energy(&self, state: &State<f64>) -> Option<f64> {
        let thrust = self.thrust * self.throttle;
        (self.drag == 0.0).then(|| self.mass * state.v * state.v / 2.0 - thrust * state.q)
    }

    fn mechanical_energy(&self, state: &State<f64>) -> Option<[f64; 2]> {
        Some([self.mass * state.v * state.v / 2.0, 0.0])
    }

    fn input(&mut self, input: Input, state: &mut State<f64>) -> bool {
        match input {
            Input::Throttle(part) => self.throttle = part,
            Input::Kick(times) => state.v += times * self.kick / self.mass,
            Input::Rudder(_) => return false,
        }
        true
    }
}

fn phi(z: f64) -> (f64, f64) {
    let phi1 = -libm::expm1(-z) / z;
    (phi1, (1.0 - phi1) / z)
}

/// Computes φ₁ and φ₂ by their Taylor series, where the closed forms would cancel. For |z| < 0.1 the first omitted term
/// is below 1e-20.
fn phi_series(z: f64) -> (f64, f64) {
    let (mut term1, mut term2) = (1.0, 0.5);
    let (mut phi1, mut phi2) = (0.0, 0.0);
    for n in 0..12 {
        phi1 += term1;
        phi2 += term2;
        term1 *= -z / f64::from(n + 2);
        term2 *= -z / f64::from(n + 3);
    }
    (phi1, phi2)
}
