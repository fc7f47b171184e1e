//! A ball above a floor, or between two walls: `y″ = -g - c y′`, and `y′ → -e y′` at a wall.
//!
//! The true impacts under gravity are a geometric series, so that any of them is known without those before it. With
//! drag each flight is solved in turn. On a floor that moves the truth is a reference solution.

use std::array::from_ref;
use std::cell::RefCell;
use std::f64::consts::TAU;

use super::prelude::*;
use crate::impact::{SOFT_HZ, Wall};

pub(super) fn kind() -> Kind {
    Kind {
        id: "ball",
        about: "y″ = -g - c y′ above the floor; y′ → -e y′ at it: a ball that bounces".into(),
        all_coordinates: vec![Coordinate::new("y", "v", "m")].into(),
        leading: "gravity_m_per_s2".into(),
        ..Kind::checked(Ball::default(), |mut ball, values| ball.check(values))
    }
}

type Of = ParameterOf<Ball>;

const CEILING: &str = "ceiling_m";

/// The key of the amplitude of a floor that moves.
pub(super) const FLOOR_AMPLITUDE: &str = "floor_amplitude_m";

const PARAMETERS: [Of; 10] = [
    Of::number("height_m", Range::NON_NEGATIVE, |ball| &mut ball.height)
        .at_start()
        .named("height at start")
        .about("the height of the lowest point at the start"),
    Of::start("speed_m_per_s", 0.0, |ball| &mut ball.speed)
        .named("speed at start")
        .about("the velocity at the start; up is positive"),
    Of::number("restitution", Range::Between(0.0, 1.0), |ball| &mut ball.restitution)
        .or(0.8)
        .symbol("e")
        .about("the part of the speed that an impact leaves; a bumper that adds energy is a law"),
    Of::number("gravity_m_per_s2", Range::NON_NEGATIVE, |ball| &mut ball.gravity)
        .or(9.81)
        .symbol("g")
        .about("the acceleration of gravity; 0 only between two walls"),
    Of::number("drag_per_s", Range::NON_NEGATIVE, |ball| &mut ball.drag)
        .or(0.0)
        .symbol("c")
        .about("the drag: deceleration per speed"),
    Of::number(FLOOR_AMPLITUDE, Range::NON_NEGATIVE, |ball| &mut ball.floor_amplitude)
        .or(0.0)
        .symbol("a")
        .at_start()
        .about("the amplitude of a floor at a sin(2π f t); 0 is a floor at rest"),
    Of::number("floor_frequency_hz", Range::NON_NEGATIVE, |ball| &mut ball.floor_frequency)
        .or(0.0)
        .symbol("f")
        .at_start()
        .about("the frequency of the floor"),
    Of::number(CEILING, Range::NON_NEGATIVE, |ball| &mut ball.ceiling)
        .or(0.0)
        .at_start()
        .about("the height of a second wall; 0 is none, and without gravity there must be one"),
    Of::number("kick_m_per_s", Range::ANY, |ball| &mut ball.kick)
        .or(4.905)
        .symbol("K")
        .about("the change of velocity by one kick"),
    Of::number("penalty_hz", Range::POSITIVE, |ball| &mut ball.penalty_hz)
        .or(SOFT_HZ)
        .named("soft walls")
        .about("the frequency of walls that are springs, as under the rule `penalty`"),
];

/// The largest number of flights that a truth follows one by one. After more flights the state is not known: under drag
/// alone their number grows exponentially with time.
const MAX_FLIGHTS: u32 = 40_000;

/// A bounce with less than this speed, in g/c, is computed by [`FLIGHT`].
const SLOW: f64 = 0.01;

/// The duration of a flight from the floor with the speed z, in units of z, by powers of z: the root x of
/// (1 + z) (1 - e⁻ˣ) = x. Speeds are in g/c, and times in 1/c. The next power is less than a rounding below [`SLOW`].
const FLIGHT: [f64; 8] = [
    2.0,
    -2.0 / 3.0,
    4.0 / 9.0,
    -44.0 / 135.0,
    104.0 / 405.0,
    -40.0 / 189.0,
    7648.0 / 42525.0,
    -2848.0 / 18225.0,
];

/// A flight shorter than this, in seconds, ends the bouncing.
const SHORTEST_FLIGHT_S: f64 = 1e-9;

/// A ball of 1 kg. Its coordinate is the height of its lowest point above the floor, in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ball {
    /// Height at the start, in metres.
    pub height: f64,
    /// Velocity at the start, in metres per second, upwards.
    pub speed: f64,
    /// e, the part of the speed that an impact leaves, 0 to 1.
    pub restitution: f64,
    /// g, in m/s²; 0 only with a ceiling.
    pub gravity: f64,
    /// c, the drag, per second; 0 with a ceiling.
    pub drag: f64,
    /// a, the amplitude of a floor at a sin(2π f t), in metres; 0 for a floor at rest.
    pub floor_amplitude: f64,
    /// f, the frequency of the floor, in hertz.
    pub floor_frequency: f64,
    /// Height of a second wall, in metres; 0 if there is none.
    pub ceiling: f64,
    /// K, the change of velocity by one kick, in metres per second.
    pub kick: f64,
    /// Frequency in hertz of walls that are springs.
    pub penalty_hz: f64,
    /// Whether the walls are springs, as under the rule `penalty`.
    pub is_soft: bool,
    /// A memory that saves work and changes nothing.
    pub walk: Walk,
}

/// The last impacts of a walk from flight to flight, one for each number of zeros at which the binary count of flights
/// ends. So a moment a few flights earlier or later costs few flights.
#[derive(Clone, Debug, Default)]
pub struct Walk(RefCell<[Flights; 17]>);

impl PartialEq for Walk {
    /// Balls that differ only in their memory are equal.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Flights {
    /// The state and the numbers with which the walk began.
    from: [f64; 5],
    /// Seconds since then, and the rounding of their sum.
    t: [f64; 2],
    /// The state right after the last impact, or at the start.
    at: [f64; 2],
    /// The number of flights before that.
    flights: u32,
    /// Whether the flights have become too short to follow.
    rests: bool,
}

impl Ball {
    fn check(&mut self, values: &[f64]) -> Result<(), Fault> {
        *self = std::mem::take(self).with_parameters(values);
        let fault = |key: &'static str, what: &str, remedy: &str| {
            Err(Fault { key: key.into(), what: what.into(), remedy: remedy.into() })
        };
        let has_ceiling = self.ceiling > 0.0;
        if has_ceiling && self.gravity > 0.0 {
            return fault(
                "gravity_m_per_s2",
                "the truth between two walls is known without gravity only",
                "write `gravity_m_per_s2 = 0.0`, or remove `ceiling_m`",
            );
        }
        if has_ceiling && self.drag > 0.0 {
            return fault(
                "drag_per_s",
                "the truth between two walls is known without drag only",
                "remove `drag_per_s`, or `ceiling_m`",
            );
        }
        if !has_ceiling && self.gravity == 0.0 {
            return fault(
                "gravity_m_per_s2",
                "without gravity the ball never comes back",
                "write a number greater than 0, or a second wall such as `ceiling_m = 3.0`",
            );
        }
        if self.has_moving_floor() && self.floor_frequency == 0.0 {
            return fault(
                FLOOR_AMPLITUDE,
                "the floor moves at no frequency",
                "write `floor_frequency_hz = 9.5`, or remove it",
            );
        }
        if has_ceiling && self.height > self.ceiling {
            return fault("height_m", "the ball starts beyond `ceiling_m`", "start it below");
        }
        Ok(())
    }

    fn has_moving_floor(&self) -> bool {
        self.floor_amplitude > 0.0
    }

    /// Returns the place, the velocity and the acceleration of a floor that moves, at time `t` (s).
    #[cold]
    fn moved_floor(&self, t: f64) -> [f64; 3] {
        let (size, per_s) = (self.floor_amplitude, TAU * self.floor_frequency);
        let (sin, cos) = libm::sincos(per_s * t);
        [size * sin, size * per_s * cos, -size * per_s * per_s * sin]
    }

    /// Returns the state after a flight of `dt` (s) through the air.
    fn fly(&self, [y, v]: [f64; 2], dt: f64) -> [f64; 2] {
        let x = self.drag * dt;
        let phi = if x == 0.0 { 1.0 } else { -libm::expm1(-x) / x };
        let g = self.gravity;
        [y + v * dt * phi - g * dt * dt * psi(x), v * (1.0 - x * phi) - g * dt * phi]
    }

    /// Returns the time in seconds from a state at or above the floor to the next impact.
    fn fall_s(&self, [y, v]: [f64; 2]) -> f64 {
        let at_floor = (v * v + 2.0 * self.gravity * y).sqrt();
        // The other form of the root has no difference of near numbers.
        let free = if v < 0.0 { 2.0 * y / (at_floor - v) } else { (v + at_floor) / self.gravity };
        if self.drag == 0.0 || free == 0.0 {
            return free;
        }
        let (mut low, mut high) = (0.0, free);
        while self.fly([y, v], high)[0] > 0.0 {
            (low, high) = (high, 2.0 * high);
        }
        let mut t = high;
        for _ in 0..60 {
            let [height, speed] = self.fly([y, v], t);
            if height <= 0.0 {
                high = t;
            } else {
                low = t;
            }
            let next = t - height / speed;
            let next = if low < next && next < high { next } else { low + (high - low) / 2.0 };
            if next == t || next == low || next == high {
                break;
            }
            t = next;
        }
        t
    }

    /// Returns the first impact from a state under gravity alone: its time (s) and speed.
    fn first(&self, from: [f64; 2]) -> [f64; 2] {
        let [y, v] = from;
        [self.fall_s(from), (v * v + 2.0 * self.gravity * y).sqrt()]
    }

    /// Returns the state `dt` (s) after `from` above a floor, without drag.
    fn bounced(&self, from: [f64; 2], dt: f64) -> [f64; 2] {
        let (g, e) = (self.gravity, self.restitution);
        let [t1, v1] = self.first(from);
        let since = dt - t1;
        if since < 0.0 {
            return self.fly(from, dt);
        }
        if e == 0.0 || v1 == 0.0 {
            return [0.0; 2];
        }
        if e == 1.0 {
            let flight = 2.0 * v1 / g;
            let n = libm::floor(since / flight);
            return self.fly([0.0, v1], since - n * flight);
        }
        let zeno = 2.0 * e * v1 / (g * (1.0 - e));
        if since >= zeno {
            return [0.0; 2];
        }
        let log = libm::log(e);
        let near = libm::floor(libm::log1p(-since / zeno) / log).max(0.0);
        // The power of e that the flight begins with, and the time since its beginning.
        let flight = |n: f64| (libm::exp(n * log), since + zeno * libm::expm1(n * log));
        let earlier = if flight(near).1 < 0.0 { (near - 1.0).max(0.0) } else { near };
        let n = if flight(near + 1.0).1 >= 0.0 { near + 1.0 } else { earlier };
        let (power, time) = flight(n);
        self.fly([0.0, power * e * v1], time.max(0.0))
    }

    /// Returns the last remembered impact of the flights from this state that is before a wanted one, or else their
    /// start.
    fn resumed(&self, from: [f64; 2], is_before: impl Fn(&Flights) -> bool) -> Flights {
        let begun = [from[0], from[1], self.gravity, self.drag, self.restitution];
        let known = self.walk.0.borrow();
        let before = known.iter().filter(|known| known.from == begun && is_before(known));
        let last = before.max_by_key(|known| known.flights).copied();
        last.unwrap_or(Flights { from: begun, at: from, ..Flights::default() })
    }

    /// Returns the acceleration by soft walls.
    #[cold]
    fn soft_push(&self, t: f64, y: f64, v: f64) -> f64 {
        let walls = (0..).map_while(|index| self.wall(index, t));
        walls.map(|wall| wall.soft_push(self.penalty_hz, from_ref(&y), from_ref(&v))).sum()
    }

    /// Returns how long the flight from a state at or above the floor lasts, in seconds, and the speed at its end.
    fn flight(&self, at: [f64; 2]) -> [f64; 2] {
        let slow = self.drag * at[1] / self.gravity;
        if at[0] == 0.0 && 0.0 < slow && slow < SLOW {
            let ratio = FLIGHT.iter().rev().fold(0.0, |sum, factor| factor + slow * sum);
            return [ratio * at[1] / self.gravity, at[1] * (ratio - 1.0)];
        }
        let flight_s = self.fall_s(at);
        [flight_s, -self.fly(at, flight_s)[1]]
    }

    /// Walks on by a flight, and remembers its end.
    fn land(&self, walk: &mut Flights, [flight, speed]: [f64; 2]) {
        let up = self.restitution * speed;
        // The rounding of each sum is carried along.
        let [t, lost] = walk.t;
        let next = t + (flight + lost);
        walk.t = [next, (flight + lost) - (next - t)];
        walk.at = [0.0, up];
        walk.flights += 1;
        walk.rests = 2.0 * up < self.gravity * SHORTEST_FLIGHT_S;
        self.walk.0.borrow_mut()[walk.flights.trailing_zeros().min(16) as usize] = *walk;
    }

    /// Returns the state `dt` (s) after `from` above a floor, flight by flight, unless there are too many flights.
    fn dragged(&self, from: [f64; 2], dt: f64) -> Option<[f64; 2]> {
        let mut walk = self.resumed(from, |walk| walk.t[0] <= dt);
        while walk.flights < MAX_FLIGHTS {
            let left = (dt - walk.t[0]) - walk.t[1];
            if walk.rests {
                return Some([0.0; 2]);
            }
            let flight = self.flight(walk.at);
            if left < flight[0] {
                return Some(self.fly(walk.at, left.max(0.0)));
            }
            self.land(&mut walk, flight);
        }
        None
    }

    /// Returns the state `dt` (s) after `from` between two walls, without forces, unless there are too many flights.
    fn reflected(&self, [y, v]: [f64; 2], dt: f64) -> Option<[f64; 2]> {
        let (wide, e) = (self.ceiling, self.restitution);
        let to_wall = if v > 0.0 { wide - y } else { y };
        let speed = v.abs();
        if speed * dt < to_wall || speed == 0.0 {
            return Some([y + v * dt, v]);
        }
        let way = |beyond: f64, is_up: bool, speed: f64| match is_up {
            true => [beyond, speed],
            false => [wide - beyond, -speed],
        };
        if e == 1.0 {
            let beyond = speed * dt - to_wall;
            let n = libm::floor(beyond / wide);
            return Some(way(beyond - n * wide, (v < 0.0) == (n % 2.0 == 0.0), speed));
        }
        let (mut left, mut speed, mut is_up) = (dt - to_wall / speed, e * speed, v < 0.0);
        for _ in 0..MAX_FLIGHTS {
            if speed * left < wide {
                return Some(way(speed * left, is_up, speed));
            }
            (left, speed, is_up) = (left - wide / speed, e * speed, !is_up);
        }
        None
    }

    /// Returns the time (s) of an impact after `from` between two walls, without forces. Each flight lasts 1/e of the
    /// one before.
    fn reflection_s(&self, [y, v]: [f64; 2], impact: u64) -> Option<f64> {
        let (wide, e, speed) = (self.ceiling, self.restitution, v.abs());
        let Some(later) = impact.checked_sub(1) else { return Some(0.0) };
        let first_s = (if v > 0.0 { wide - y } else { y }) / speed;
        let flights = match e {
            _ if later == 0 => 0.0,
            1.0 => later as f64,
            _ => libm::expm1(-(later as f64) * libm::log(e)) / (1.0 - e),
        };
        Some(first_s + flights * (wide / speed)).filter(|at_s| at_s.is_finite())
    }

    /// Returns the state `dt` (s) after `from`, unless too many flights lie between them.
    fn after(&self, from: &State<f64>, dt: f64) -> Option<[f64; 2]> {
        let highest = if self.ceiling > 0.0 { self.ceiling } else { f64::INFINITY };
        let from = [from.q.clamp(0.0, highest), from.v];
        let [y, v] = if self.ceiling > 0.0 {
            self.reflected(from, dt)?
        } else if self.drag > 0.0 {
            self.dragged(from, dt)?
        } else {
            self.bounced(from, dt)
        };
        Some([y.clamp(0.0, highest), v])
    }
}

/// Returns (x - 1 + e⁻ˣ)/x², from its series where the difference would lose digits.
fn psi(x: f64) -> f64 {
    if x >= 0.5 {
        return (x + libm::expm1(-x)) / (x * x);
    }
    // The terms fall below an ulp before the seventeenth.
    let series = (2..18).rev().fold(0.0, |sum, n| (1.0 - x * sum) / f64::from(n + 1));
    (1.0 - x * series) / 2.0
}

impl System for Ball {
    type Vector = f64;

    #[inline]
    fn acceleration(&self, t: f64, y: &f64, v: &f64, a: &mut f64) {
        *a = -self.gravity - self.drag * v;
        if self.is_soft {
            *a += self.soft_push(t, *y, *v);
        }
    }
}

impl Body for Ball {
    const CLASS: BodyClass =
        BodyClass::Ball("how it bounces a ball, with slop and thresholds, is not reproduced");
    const HAS_EXACT: bool = true;
    const HAS_WALLS: bool = true;
    const PARAMETERS: &'static [Of] = &PARAMETERS;

    fn start(&self) -> State<f64> {
        State { q: self.height, v: self.speed }
    }

    fn has_exact(&self) -> bool {
        !self.has_moving_floor()
    }

    // Every tick asks for its walls.
    #[inline]
    fn wall(&self, index: usize, t: f64) -> Option<Wall> {
        let (side, [at, velocity, acceleration]) = match index {
            0 if self.has_moving_floor() => (1.0, self.moved_floor(t)),
            0 => (1.0, [0.0; 3]),
            1 if self.ceiling > 0.0 => (-1.0, [self.ceiling, 0.0, 0.0]),
            _ => return None,
        };
        let restitution = self.restitution;
        Some(Wall { coordinate: 0, side, at, velocity, acceleration, restitution })
    }

    fn first_wall(&self) -> usize {
        0
    }

    fn switches(&self) -> usize {
        1 + usize::from(self.ceiling > 0.0)
    }

    fn has_jumps(&self) -> bool {
        true
    }

    fn soften(&mut self, is_soft: bool) {
        self.is_soft = is_soft;
    }

    fn bounce(&self, from: &State<f64>, impact: u64) -> Option<[f64; 2]> {
        let (g, e) = (self.gravity, self.restitution);
        let at = [from.q.max(0.0), from.v];
        if self.ceiling > 0.0 {
            return self.reflection_s(at, impact).map(|at_s| [at_s, f64::NAN]);
        }
        // The drag stops the way up where e^(c t) = 1 + c v/g.
        let up = |v: f64| match self.drag {
            0.0 => v / g,
            drag => libm::log1p(drag * v / g) / drag,
        };
        if impact == 0 {
            return Some([0.0, self.fly(at, up(at[1].max(0.0)))[0]]);
        }
        if self.drag > 0.0 {
            let mut walk = self.resumed(at, |walk| u64::from(walk.flights) <= impact);
            while u64::from(walk.flights) < impact && !walk.rests && walk.flights < MAX_FLIGHTS {
                let flight = self.flight(walk.at);
                self.land(&mut walk, flight);
            }
            let is_there = u64::from(walk.flights) == impact;
            return is_there.then(|| [walk.t[0], self.fly(walk.at, up(walk.at[1]))[0]]);
        }
        let [t1, v1] = self.first(at);
        // A ball that lies on the floor meets it no more.
        if v1 == 0.0 {
            return None;
        }
        let n = (impact - 1) as f64;
        let late = match e {
            1.0 => n * (2.0 * v1 / g),
            0.0 if impact > 1 => return None,
            0.0 => 0.0,
            _ => -2.0 * e * v1 / (g * (1.0 - e)) * libm::expm1(n * libm::log(e)),
        };
        let after = libm::pow(e, n + 1.0) * v1;
        Some([t1 + late, after * after / (2.0 * g)])
    }

    /// A state beyond a wall counts as one at the wall.
    fn exact_into(&self, _t: f64, dt: f64, from: &State<f64>, to: &mut State<f64>) {
        let [q, v] = self.after(from, dt).unwrap_or_default();
        *to = State { q, v };
    }

    fn exact_error(&self, _t: f64, dt: f64, from: &State<f64>, _to: &State<f64>) -> [f64; 2] {
        if self.after(from, dt).is_none() {
            return [f64::INFINITY; 2];
        }
        let fastest = from.v.abs() + (2.0 * self.gravity * from.q.max(0.0)).sqrt();
        let rounding = 8.0 * f64::EPSILON;
        // The roundings of many flights add up.
        let from_floor = [from.q.max(0.0), from.v];
        let flights = self.resumed(from_floor, |walk| walk.t[0] <= dt).flights;
        let late = f64::EPSILON * dt * f64::from(flights).sqrt().max(8.0);
        let highest = from.q.abs() + fastest * fastest / (2.0 * self.gravity).max(1.0);
        let pull = self.gravity + self.drag * fastest;
        [rounding * highest + late * fastest, rounding * fastest + late * pull]
    }

    fn energy(&self, state: &State<f64>) -> Option<f64> {
        let is_kept = self.restitution == 1.0 && self.drag == 0.0 && self.has_exact();
        is_kept.then(|| state.v * state.v / 2.0 + self.gravity * state.q)
    }

    fn mechanical_energy(&self, state: &State<f64>) -> Option<[f64; 2]> {
        self.has_exact().then(|| [state.v * state.v / 2.0, self.gravity * state.q])
    }

    fn input(&mut self, input: Input, state: &mut State<f64>) -> bool {
        let Input::Kick(times) = input else { return false };
        state.v += times * self.kick;
        true
    }

    fn place(&self, y: &f64) -> DVec2 {
        if self.ceiling > 0.0 { DVec2::new(*y, 0.0) } else { DVec2::new(0.0, *y) }
    }
}
