//! A camera, or any value, that follows a target.
//!
//! A first-order law moves the value as `x′ = k (g - x)`, and a second-order law moves it as a critically damped
//! spring, `x″ = ω² (g - x) - 2 ω x′`. The target is `g(t) = s + r t + A sin(2π f t)` from time 0 on.

use std::f64::consts::TAU;

use super::prelude::*;

pub(super) fn kind() -> Kind {
    Kind {
        id: "follow",
        about: "x′ = k (g - x) or x″ = k² (g - x) - 2 k x′: a camera that follows a target g(t)"
            .into(),
        all_coordinates: vec![Coordinate::new("x", "v", "m")].into(),
        leading: "rate_per_s".into(),
        ..Kind::of_one(Follow::default())
    }
}

type Of = ParameterOf<Follow>;

/// The key of the order of the law.
pub(super) const LAW_ORDER: &str = "order";

const PARAMETERS: [Of; 9] = [
    Of::count(LAW_ORDER, 2, |follow| &mut follow.order)
        .or(2.0)
        .about("1 to move straight at the target, 2 with a velocity of its own"),
    Of::number("rate_per_s", RATES, |follow| &mut follow.rate)
        .about("k: it halves the distance in 0.693 / k by the law of order 1, in 1.678 / k by that of order 2"),
    Of::start("step_m", 1.0, |follow| &mut follow.step)
        .symbol("s")
        .about("the place of the target from the start on"),
    Of::start("ramp_m_per_s", 0.0, |follow| &mut follow.ramp)
        .symbol("r")
        .about("how fast the target moves away"),
    Of::start("sine_m", 0.0, |follow| &mut follow.sine)
        .symbol("A")
        .about("how far the target swings to either side"),
    Of::number("sine_hz", Range::NonNegative(MAX_SINE_HZ), |follow| &mut follow.sine_hz)
        .or(1.0)
        .at_start()
        .symbol("f")
        .about("how often the target swings"),
    Of::start("x0_m", 0.0, |follow| &mut follow.x0)
        .named("place at start")
        .about("where it starts"),
    Of::start("v0_m_per_s", 0.0, |follow| &mut follow.v0)
        .named("velocity at start")
        .about("its velocity at the start; with order 1 the law gives it"),
    Of::number("kick_m", Range::ANY, |follow| &mut follow.kick)
        .or(0.5)
        .about("how far one kick displaces it"),
];

/// The rates of a law, per second. A slower follower would lag so far behind a moving target that the closed form
/// cancels. A faster follower reaches its target within a tick at any tick rate.
const RATES: Range = Range::Between(1e-3, 1e6);

/// The highest frequency of the target in hertz. Above this frequency, the phase would be lost to rounding within a
/// day.
const MAX_SINE_HZ: f64 = 1e4;

/// A follower. Its coordinate is its place, in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Follow {
    /// The order of the law: 1 or 2.
    pub order: usize,
    /// k or ω, the rate of the law, per second.
    pub rate: f64,
    /// s, the target's place, in metres.
    pub step: f64,
    /// r, the target's speed, in metres per second.
    pub ramp: f64,
    /// A, the amplitude of the target's swing, in metres.
    pub sine: f64,
    /// f, the frequency of the target's swing, in hertz.
    pub sine_hz: f64,
    /// Place at the start, in metres.
    pub x0: f64,
    /// Velocity at the start, in metres per second. Under a first-order law, the velocity follows from the place.
    pub v0: f64,
    /// How far one kick displaces the follower, in metres.
    pub kick: f64,
}

impl Follow {
    /// Returns the place of the target at time `t` (s), in metres.
    pub fn target(&self, t: f64) -> f64 {
        self.step + self.ramp * t + self.sine * libm::sin(TAU * self.sine_hz * t)
    }

    /// Returns the velocity of the target at time `t` (s), in metres per second.
    pub fn target_velocity(&self, t: f64) -> f64 {
        let omega = TAU * self.sine_hz;
        self.ramp + self.sine * omega * libm::cos(omega * t)
    }

    /// Whether the target stays where it is.
    pub fn is_still(&self) -> bool {
        self.ramp == 0.0 && (self.sine == 0.0 || self.sine_hz == 0.0)
    }

    /// Returns the steady motion at time `t` (s), which every other motion approaches. The steady motion lags a ramp by
    /// a constant distance, and follows a sine with a smaller amplitude and a delay.
    fn steady(&self, t: f64) -> State<f64> {
        let omega = TAU * self.sine_hz;
        // The response to a sine is 1 / (1 + iβ), squared for the second-order law.
        let beta = omega / self.rate;
        let size = 1.0 / (1.0 + beta * beta);
        let once = (size, -beta * size);
        let (re, im) = match self.order {
            1 => once,
            _ => (once.0 * once.0 - once.1 * once.1, 2.0 * once.0 * once.1),
        };
        let (sin, cos) = (libm::sin(omega * t), libm::cos(omega * t));
        let late = t - self.order as f64 / self.rate;
        State {
            q: self.step + self.ramp * late + self.sine * (re * sin + im * cos),
            v: self.ramp + self.sine * omega * (re * cos - im * sin),
        }
    }

    /// Returns bounds on the rounding errors of the coordinate and the velocity of [`Follow::steady`] at time `t`, in
    /// units of the rounding of 1. The bounds include the rounding of the phase.
    fn steady_size(&self, t: f64) -> [f64; 2] {
        let omega = TAU * self.sine_hz;
        let phase = 8.0 + 2.0 * (omega * t).abs();
        let late = t.abs() + self.order as f64 / self.rate;
        let swing = self.sine.abs() * phase;
        [8.0 * (self.step.abs() + self.ramp.abs() * late) + swing, self.ramp.abs() + omega * swing]
    }
}

impl System for Follow {
    type Vector = f64;

    /// For a first-order law, this is the law differentiated once, `x″ = k g′ - k x′ - k (x′ - k (g - x))`. The last
    /// term lets the defect `v - k (g - x)` decay at the rate k. The homogeneous part is that of the second-order law.
    #[inline]
    fn acceleration(&self, t: f64, x: &f64, v: &f64, a: &mut f64) {
        let k = self.rate;
        let push = if self.order == 1 { k * self.target_velocity(t) } else { 0.0 };
        *a = k * k * (self.target(t) - x) - 2.0 * k * v + push;
    }

    #[inline]
    fn query(&self, t: f64, query: Query<'_, f64>) -> bool {
        let Query::Target(pursuit) = query else { return false };
        let order = if self.order == 1 { 1 } else { 2 };
        let (rate, is_still) = (self.rate, self.is_still());
        *pursuit = Some(Pursuit { target: self.target(t), rate, order, is_still });
        true
    }
}

impl Body for Follow {
    const CLASS: BodyClass = BodyClass::Follower(
        "a follower moves towards its target by a rule, and an engine moves bodies by forces",
    );
    const HAS_EXACT: bool = true;
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn start(&self) -> State<f64> {
        let straight = self.rate * (self.target(0.0) - self.x0);
        State { q: self.x0, v: if self.order == 1 { straight } else { self.v0 } }
    }

    fn exact_into(&self, t: f64, dt: f64, from: &State<f64>, to: &mut State<f64>) {
        if dt == 0.0 {
            return to.assign(from);
        }
        let (here, there, k) = (self.steady(t), self.steady(t + dt), self.rate);
        // The deviation from the steady motion decays as a critically damped spring comes to rest.
        let (x, v) = (from.q - here.q, from.v - here.v);
        let (decay, b) = (libm::exp(-k * dt), v + k * x);
        to.q = there.q + decay * (x + b * dt);
        to.v = there.v + decay * (v - k * b * dt);
    }

    fn exact_error(&self, t: f64, dt: f64, from: &State<f64>, _to: &State<f64>) -> [f64; 2] {
        let ([q0, v0], [q1, v1]) = (self.steady_size(t), self.steady_size(t + dt));
        let (k, z) = (self.rate, (self.rate * dt).abs());
        let (x, v) = (8.0 * from.q.abs() + q0, 8.0 * from.v.abs() + v0);
        let decay = (1.0 + z) * libm::exp(-k * dt);
        let deviation = decay * (x * (1.0 + z) + v * dt.abs());
        let slope = decay * (v * (1.0 + z) + k * z * x);
        [q1 + deviation, v1 + slope].map(|size| f64::EPSILON * size)
    }

    fn is_linear(&self) -> bool {
        true
    }

    /// Under a first-order law, a displacement changes the velocity too.
    fn input(&mut self, input: Input, state: &mut State<f64>) -> bool {
        let Input::Kick(times) = input else { return false };
        state.q += times * self.kick;
        if self.order == 1 {
            state.v -= self.rate * times * self.kick;
        }
        true
    }
}
