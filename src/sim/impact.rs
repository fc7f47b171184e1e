//! Impacts of a body on its walls: the walls, the rules by which the line after a step handles them, and a record.
//!
//! A rule is a choice beside the method, because a game has both: a step, and a line for the floor after it. Either may
//! add energy at an impact. With semi-implicit Euler (s = -1) a mirror (κ = 1) adds none, and a clamp or a turn of the
//! velocity alone takes some.

use std::fmt;

/// A wall, which a coordinate of a body cannot pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// The index of that coordinate.
    pub coordinate: usize,
    /// 1 if the body is above the wall, and -1 if it is below.
    pub side: f64,
    /// The place of the wall.
    pub at: f64,
    /// The velocity of the wall.
    pub velocity: f64,
    /// The acceleration of the wall.
    pub acceleration: f64,
    /// e, the part of the speed relative to the wall that an impact leaves, 0 to 1.
    pub restitution: f64,
}

/// Frequency of a soft wall in hertz, unless a ball has its own: k is 898 per second squared.
pub(super) const SOFT_HZ: f64 = 4.77;

/// A flight shorter than this, in seconds, ends the bouncing: the error is below 1e-17 m.
const SHORTEST_FLIGHT_S: f64 = 1e-9;

/// Whether a body that leaves a wall with this speed, and is pushed away from it by this acceleration, is back so soon
/// that it rests.
pub(super) fn comes_to_rest(speed: f64, push: f64) -> bool {
    push < 0.0 && 2.0 * speed < -push * SHORTEST_FLIGHT_S
}

impl Wall {
    /// Returns the wall at rest where it now is. Heights of flights are above the lower wall at rest where it is at
    /// time 0, because the distance from a wall that swings has many peaks in a flight.
    pub(super) fn at_rest(self) -> Self {
        Self { velocity: 0.0, acceleration: 0.0, ..self }
    }

    /// Returns the distance of coordinates from the wall, negative beyond it.
    pub(super) fn height(&self, q: &[f64]) -> f64 {
        self.side * (q[self.coordinate] - self.at)
    }

    /// Returns the velocity away from the wall.
    pub(super) fn speed(&self, v: &[f64]) -> f64 {
        self.side * (v[self.coordinate] - self.velocity)
    }

    /// Returns the acceleration by the wall under the rule `penalty`, as a spring of this frequency in hertz.
    pub(super) fn soft_push(&self, hz: f64, q: &[f64], v: &[f64]) -> f64 {
        let (depth, speed) = (-self.height(q), self.speed(v));
        if depth <= 0.0 {
            return 0.0;
        }
        let log = libm::log(self.restitution.max(1e-300));
        let turn = std::f64::consts::PI;
        let soft = 2.0 * turn * hz;
        let damping = -2.0 * soft * log / (turn * turn + log * log).sqrt();
        self.side * (soft * soft * depth - damping * speed).max(0.0)
    }
}

/// A rule for the impacts of a body, a second switch beside its method.
pub struct Impact {
    /// Name in scenes and on the command line.
    pub id: &'static str,
    /// What the rule does, in one line.
    pub about: &'static str,
    /// κ of the rule: under gravity g, an impact adds (s + κ) g h to the speed, with s of the method and h the step.
    /// `None` if the rule has no impacts.
    pub kappa: Option<f64>,
    /// The lines of the rule, in the language of a method of your own, for e = 0.8 and a floor at 0.
    pub code: &'static str,
    pub(super) rule: Rule,
}

impl Impact {
    /// Whether the rule makes a spring of the wall.
    pub(super) fn is_soft(&self) -> bool {
        self.rule == Rule::Penalty
    }

    /// Whether the rule takes the speed from the energy.
    pub(super) fn needs_energy(&self) -> bool {
        self.rule == Rule::After(Turn::Energy)
    }

    /// Whether the method's own step ends at the impact. Others handle it at the end of the step, and so does a
    /// straight line, on which the body moves as by a mirror.
    pub fn finds_the_time(&self) -> bool {
        matches!(self.rule, Rule::Within(_))
    }
}

impl PartialEq for Impact {
    fn eq(&self, other: &Self) -> bool {
        self.rule == other.rule
    }
}

impl fmt::Debug for Impact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id)
    }
}

/// How an impact is handled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// Finds the impact within the step, and steps the rest by the method.
    Within(Locating),
    /// The straight line gives the time; the rest is straight with the new velocity.
    Swept,
    /// Changes the state after the step that ends beyond the wall.
    After(Turn),
    /// Before the next step, by the velocity from before the force of that step.
    BeforeTick,
    /// The wall is a spring.
    Penalty,
    /// The whole tick is the engine's.
    Engine,
    /// The whole tick is that of p2-es, which steps as cannon-es does.
    EngineP2,
    /// The lines of the method turn the body.
    OwnLines,
}

/// How an impact within a step is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Locating {
    /// By shorter steps of the method.
    Method,
    /// On the cubic through both ends of the step.
    Cubic,
    /// On the straight line, which also gives the speed.
    Chord,
    /// On the straight line, with the speed at the end of the step.
    SpeedAtEnd,
}

/// The part of the state that a rule changes after a step, as it turns the body back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    /// The velocity, if the body still moves into the wall.
    Velocity,
    /// The velocity, always.
    VelocityBlind,
    /// The velocity, and the coordinate is the wall's.
    Clamp,
    /// The velocity, and the coordinate is mirrored.
    Mirror,
    /// As a clamp, with the speed that the energy at the wall gives.
    Energy,
}

macro_rules! impacts {
    ($($id:literal $kappa:expr, $rule:expr, $about:literal;)+) => {
        &[$(Impact {
            id: $id,
            about: $about,
            kappa: $kappa,
            code: include_str!(concat!("../../assets/impacts/", $id, ".step")),
            rule: $rule,
        },)+]
    };
}

/// Every rule for impacts. The first is the default.
pub static IMPACTS: &[Impact] = impacts! {
    "locate" Some(0.0), Rule::Within(Locating::Method),
        "finds the impact within the step by shorter steps of the method, which then steps the rest";
    "velocity" Some(0.0), Rule::After(Turn::Velocity),
        "below the floor and falling: only the velocity is turned";
    "velocity-blind" Some(0.0), Rule::After(Turn::VelocityBlind),
        "below the floor: the velocity is turned, even if it points up already";
    "clamp" Some(0.5), Rule::After(Turn::Clamp),
        "below the floor: back to the floor, and the velocity is turned";
    "mirror" Some(1.0), Rule::After(Turn::Mirror),
        "below the floor: as far above it, and the velocity is turned";
    "energy" Some(0.0), Rule::After(Turn::Energy),
        "as clamp, with the speed that the energy at the floor gives";
    "before-tick" Some(1.0), Rule::BeforeTick,
        "at the next tick, the velocity from before gravity is turned; the position stays (Jolt, Chipmunk, Godot)";
    "locate-cubic" Some(0.0), Rule::Within(Locating::Cubic),
        "as locate, on the cubic through both ends of the step";
    "locate-chord" Some(0.0), Rule::Within(Locating::Chord),
        "as locate, on the straight line through both ends of the step, which gives the speed too";
    "swept" Some(1.0), Rule::Swept,
        "the straight line gives the time of impact; the rest of the step is straight with the turned velocity";
    "swept-step" Some(0.5), Rule::Within(Locating::SpeedAtEnd),
        "the straight line gives the time of impact, the end of the step the speed; the method steps the rest";
    "penalty" None, Rule::Penalty,
        "no impact: a damped spring, of 4.77 Hz or of the ball's `penalty_hz`, pushes out of the floor";
    "none" None, Rule::OwnLines,
        "the lines of the method turn the ball themselves; for methods of your own with such a line, and no others";
    "engine" None, Rule::Engine,
        "the engine's own rule, with its slop and threshold; for lanes of Chipmunk, Jolt, Box2D, Rapier, pybullet, MuJoCo and \
         cannon-es";
    "engine-p2" None, Rule::EngineP2,
        "p2-es's own rule for a ball of 1 kg, of which a heavier one loses more; for the lane of cannon-es, which steps as p2-es does";
};

/// Words that people use for a rule, with its id.
const OTHER_WORDS: [(&str, &str); 4] =
    [("reflect", "mirror"), ("snap", "clamp"), ("soft", "penalty"), ("time-of-impact", "locate")];

/// Returns the ids of the rules and other words for them, each with the id.
pub fn impact_spellings() -> impl Iterator<Item = (&'static str, &'static str)> {
    IMPACTS.iter().map(|impact| (impact.id, impact.id)).chain(OTHER_WORDS)
}

/// Returns the rule with this id.
pub fn impact(id: &str) -> Option<&'static Impact> {
    IMPACTS.iter().find(|impact| impact.id == id)
}

impl Default for &'static Impact {
    fn default() -> Self {
        &IMPACTS[0]
    }
}

/// A record of a body's impacts and flights.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounces {
    /// The index of the coordinate that meets the lower wall.
    pub coordinate: usize,
    /// The number of impacts since the start, or since the last input, edit or placement.
    pub impacts: u64,
    /// The time in seconds of the last impact, as the rule handled it.
    pub landed_at_s: f64,
    /// The velocities away from the wall before and after that impact; NaN after it for a soft wall.
    pub speeds: [f64; 2],
    /// The height of the last completed flight above the lower wall, where that is at time 0: the vertex of the
    /// parabola through its highest ticks. `None` before the first.
    pub apex: Option<f64>,
    /// The number of impacts before that flight.
    pub apex_after: u64,
    /// The distance from the lower wall at the end of the last tick, below 0 beyond it.
    pub distance: f64,
    /// The deepest that the body was below the lower wall at the end of a tick; 0 or more.
    pub depth: f64,
    /// How far the body was beyond the wall where the rule met it at the last impact; 0 if it found the impact itself.
    pub beyond: f64,
    /// The last two heights, newest last, and how many of this flight are known.
    heights: [f64; 2],
    known: u8,
}

impl Bounces {
    /// Records an impact at time `t` (s), which ends a flight, with the velocities before and after it.
    pub(super) fn land(&mut self, t: f64, speeds: [f64; 2]) {
        self.impacts += 1;
        self.speeds = speeds;
        self.landed_at_s = t;
        (self.beyond, self.known) = (0.0, 0);
    }

    /// Counts from 0 again, after a change of the body.
    pub(super) fn restart(&mut self) {
        *self = Self { depth: self.depth, coordinate: self.coordinate, ..Self::default() };
    }

    /// Returns the height above the lower wall, where that is at time 0, at the end of the last tick.
    pub fn height(&self) -> f64 {
        self.heights[1]
    }

    /// Forgets the heights of this flight.
    pub(super) fn part(&mut self) {
        self.known = 0;
    }

    /// Copies the record of the next tick, which seldom has more than another height.
    #[inline]
    pub(super) fn follow(&mut self, now: &Self) {
        let seldom = |it: &Self| (it.impacts, it.apex_after, it.apex, it.coordinate);
        if seldom(self) != seldom(now) {
            *self = *now;
        }
        (self.distance, self.depth) = (now.distance, now.depth);
        (self.heights, self.known) = (now.heights, now.known);
    }

    /// Adds the height of a flight at the end of a tick, and the distance from the lower wall.
    #[inline]
    pub(super) fn add(&mut self, height: f64, distance: f64) {
        (self.depth, self.distance) = (self.depth.max(-distance), distance);
        let [before, last] = self.heights;
        self.heights = [last, height];
        self.known = (self.known + 1).min(3);
        // Half of the curvature, and the slope, in heights per tick.
        let (bend, slope) = ((before - last + (height - last)) / 2.0, (height - before) / 2.0);
        let is_peak = before <= last && last > height;
        if self.known == 3 && is_peak && bend < 0.0 {
            self.apex = Some(last - slope * slope / (4.0 * bend));
            self.apex_after = self.impacts;
        }
    }
}
