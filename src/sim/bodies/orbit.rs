//! A satellite about a fixed centre of gravity: `r″ = -μ r / |r|³`.

use super::kepler;
use super::prelude::*;

pub(super) fn kind() -> Kind {
    Kind {
    id: "orbit",
    about: "r″ = -μ r / |r|³: a satellite about a fixed centre, on an ellipse, parabola or hyperbola".into(),
    all_coordinates: vec![Coordinate::new("x", "vx", "m"), Coordinate::new("y", "vy", "m")].into(),
    leading: "mu_m3_per_s2".into(),
    check: Box::new(|values| match values {
        [_, 0.0, 0.0, ..] => Err(Fault {
            key: "x0_m".into(),
            what: "the orbit starts at its centre, where the pull is infinite".into(),
            remedy: "write an `x0_m` or a `y0_m` other than 0".into(),
        }),
        _ => Ok(()),
    }),
        ..Kind::of(Orbit::default())
    }
}

type Of = ParameterOf<Orbit>;

const PARAMETERS: [Of; 6] = [
    Of::number("mu_m3_per_s2", Range::POSITIVE, |orbit| &mut orbit.mu)
        .symbol("μ")
        .about("the pull of the centre, at the origin, times the distance squared"),
    Of::number("x0_m", Range::ANY, |orbit| &mut orbit.q0.x)
        .at_start()
        .named("x at start")
        .about("x at the start"),
    Of::start("y0_m", 0.0, |orbit| &mut orbit.q0.y).named("y at start").about("y at the start"),
    Of::start("vx0_m_per_s", 0.0, |orbit| &mut orbit.v0.x)
        .named("vx at start")
        .about("the velocity along x at the start"),
    Of::number("vy0_m_per_s", Range::ANY, |orbit| &mut orbit.v0.y)
        .at_start()
        .named("vy at start")
        .about("the velocity along y at the start"),
    Of::number("kick_m_per_s", Range::ANY, |orbit| &mut orbit.kick)
        .or(0.1)
        .about("what one kick adds to the speed, along the path"),
];

/// A satellite of negligible mass; its energy is per kilogram. Its coordinates are its position relative to the
/// centre, in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Orbit {
    /// μ, the pull of the centre times the distance squared, in cubic metres per second squared.
    pub mu: f64,
    /// Position at the start, in metres; not the centre.
    pub q0: DVec2,
    /// Velocity at the start, in metres per second.
    pub v0: DVec2,
    /// The change of speed by one kick, in metres per second.
    pub kick: f64,
}

/// An elliptic orbit about the centre of gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// The centre of the ellipse, in metres.
    pub middle: DVec2,
    /// Half the extent of the ellipse along x and along y, in metres.
    pub half: DVec2,
    /// The orbital period, in seconds.
    pub period_s: f64,
}

impl Orbit {
    /// Returns the ellipse of the initial state; `None` if the satellite is on a parabola or hyperbola.
    pub fn ellipse(&self) -> Option<Ellipse> {
        let Self { mu, q0, v0, .. } = *self;
        let beta = 2.0 * mu / q0.length() - v0.length_squared();
        let period_s = kepler::period(mu, beta)?;
        let semi_major = mu / beta;
        // The eccentricity vector points to the periapsis.
        let momentum = q0.perp_dot(v0);
        let eccentricity = -v0.perp() * momentum / mu - q0 / q0.length();
        let minor_squared = (1.0 - eccentricity.length_squared()).max(0.0);
        let along = eccentricity.try_normalize().unwrap_or(DVec2::X);
        let reach = |along: f64, across: f64| {
            semi_major * (along * along + minor_squared * across * across).sqrt()
        };
        let half = DVec2::new(reach(along.x, along.y), reach(along.y, along.x));
        Some(Ellipse { middle: -semi_major * eccentricity, half, period_s })
    }
}

impl System for Orbit {
    type Vector = DVec2;

    #[inline]
    fn acceleration(&self, _t: f64, q: &DVec2, _v: &DVec2, a: &mut DVec2) {
        let r2 = q.dot(*q);
        *a = *q * (-self.mu / (r2 * r2.sqrt()));
    }
}

impl Body for Orbit {
    const HAS_EXACT: bool = true;
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn start(&self) -> State<DVec2> {
        State { q: self.q0, v: self.v0 }
    }

    fn exact_into(&self, _t: f64, dt: f64, from: &State<DVec2>, to: &mut State<DVec2>) {
        *to = kepler::flow(self.mu, dt, from);
    }

    /// The error is infinite if the satellite is so close to the centre that the rounding of the time exceeds the time
    /// of passage.
    fn exact_error(&self, _t: f64, dt: f64, _from: &State<DVec2>, to: &State<DVec2>) -> [f64; 2] {
        if 100.0 * f64::EPSILON * dt.abs() * to.v.length() > to.q.length() {
            return [f64::INFINITY; 2];
        }
        [to.q, to.v].map(|half| f64::EPSILON * half.abs().max_element())
    }

    fn energy(&self, state: &State<DVec2>) -> Option<f64> {
        Some(state.v.length_squared() / 2.0 - self.mu / libm::hypot(state.q.x, state.q.y))
    }

    fn input(&mut self, input: Input, state: &mut State<DVec2>) -> bool {
        let Input::Kick(times) = input else { return false };
        state.v += times * self.kick * state.v.normalize_or_zero();
        true
    }

    fn place(&self, q: &DVec2) -> DVec2 {
        *q
    }
}
