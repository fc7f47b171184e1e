//! Computes the visible motion of a spring in an engine from the map of a tick.

use std::ops::RangeInclusive;

use nalgebra::{Matrix2, RowVector2, Vector2};

use crate::identify::{Candidate, Effective, LoggedBody, SLOW, SpringForm, run};
use crate::sim::integrators::{Engine, JointMode, Method, OtherEngine};

/// An engine's settings for a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// The engine.
    pub method: &'static Method,
    /// The engine's mode for the joint.
    pub mode: &'static JointMode,
    /// Tick rate of the engine, in hertz.
    pub tick_hz: f64,
    /// Number of substeps per tick.
    pub substeps: u32,
}

/// A map of coordinate and velocity.
type Map = Matrix2<f64>;

/// Maximum number of Newton iterations for the eigenvalue that a memory adds. This eigenvalue is near 0, and three
/// iterations are enough.
const ITERATIONS: u32 = 20;

/// Number of turns from which the motion of a spring is read whose tick is not linear, and the number of ticks beyond
/// which one turn is enough.
const TURNS: f64 = 4.0;
const MAX_TICKS: f64 = 2000.0;
/// Maximum number of ticks of one turn, which is more than any [wish](super::Wish::check) takes.
const LONGEST: f64 = 1e5;

impl Setup {
    /// Returns the id of the engine, or of the [other engine](JointMode::engine) that the mode is of.
    pub fn engine_id(&self) -> &'static str {
        self.mode.engine.map_or(self.method.id, |engine| engine.id)
    }

    /// Returns the engine's part of the card, with the version of the engine that the mode is of.
    pub fn engine(&self) -> Option<Engine> {
        let engine = self.method.engine?;
        Some(match self.mode.engine {
            Some(OtherEngine { version, logged, .. }) => Engine { version, logged, ..engine },
            None => engine,
        })
    }

    /// Whether the engine goes by this id, which is the card's or that of another engine with the same map. An engine
    /// without a mode of its own has those of the card.
    pub fn is_of(&self, id: &str) -> bool {
        let modes = self.method.engine.map_or(&[][..], |engine| engine.modes);
        let is_known = id == self.method.id || self.method.also.contains(&id);
        let own = modes.iter().find_map(|mode| mode.engine.filter(|engine| engine.id == id));
        is_known && self.mode.engine == own
    }

    /// Returns the code for these values, with the substeps unless they are the engine's default.
    pub fn code(&self, values: [f64; 2]) -> String {
        let &Self { method, mode, tick_hz, substeps } = self;
        let of_substeps = method.engine.and_then(|engine| engine.substeps_code(substeps, tick_hz));
        [Some(mode.code_with(values)), of_substeps]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join("\n")
    }

    /// Returns the visible motion of a joint with this stiffness in 1/s² and damping in 1/s, each per unit of mass.
    /// `None` if no damped spring moves like the joint, for example because the body changes sides at every tick.
    pub fn visible_motion(&self, joint: [f64; 2]) -> Option<Effective> {
        let [trace, determinant] = self.invariants(joint)?;
        spring_of_map(trace, determinant, 1.0 / self.tick_hz)
    }

    /// Returns the trace and the determinant of a tick's map. In an engine with a memory, they are those of the two
    /// slowest motions; where a tick is not linear, those of its [`mean_map`](Self::mean_map).
    fn invariants(&self, joint: [f64; 2]) -> Option<[f64; 2]> {
        let has_memory = self.method.restart.is_some();
        let joint = self.mode.possible(joint);
        if !self.mode.is_linear(joint[1]) {
            let map = self.mean_map(joint)?;
            return Some([map.trace(), map.determinant()]);
        }
        let maps = self.maps(joint, if has_memory { 3 } else { 1 })?;
        match maps[..] {
            [once] => Some([once.trace(), once.determinant()]),
            [once, twice, thrice] => with_memory(&once, &twice, &thrice),
            _ => None,
        }
    }

    /// Returns the spectral radius of a tick's map. The swing grows if the radius exceeds 1.
    pub(super) fn growth(&self, joint: [f64; 2]) -> Option<f64> {
        let [trace, determinant] = self.invariants(joint)?;
        Some(spectral_radius(trace, determinant))
    }

    /// Returns the maps of 1 to `ticks` ticks, from a start without memory.
    fn maps(&self, spring: [f64; 2], ticks: u64) -> Option<Vec<Map>> {
        let from = |start| self.run(spring, start, 0..=ticks);
        columns(&from([SLOW, 0.0])?, &from([0.0, SLOW])?)
    }

    /// Returns the states at these ticks from a start.
    pub(super) fn run(
        &self,
        spring: [f64; 2],
        start: [f64; 2],
        ticks: RangeInclusive<u64>,
    ) -> Option<Vec<[f64; 2]>> {
        let &Self { method, mode, tick_hz, substeps } = self;
        let body = LoggedBody { spring: Some(spring), ..LoggedBody::default() };
        let candidate = Candidate { method, substeps, spring: SpringForm::Joint(mode) };
        run(candidate, &body, start, 1.0 / tick_hz, ticks)
    }

    /// Returns the linear map nearest to the ticks of the first turns after a release. By least squares, what it leaves
    /// takes no energy in the mean, so that its swing dies as fast. The ticks count less and less towards the end, so
    /// that the map has no jumps where the joint changes a little.
    fn mean_map(&self, spring: [f64; 2]) -> Option<Map> {
        let turn = std::f64::consts::TAU / libm::sqrt(spring[0]) * self.tick_hz;
        let end = turn * (MAX_TICKS / turn).clamp(1.0, TURNS);
        let states = self.run(spring, [SLOW, 0.0], 0..=end.min(LONGEST) as u64)?;
        let [mut from, mut to] = [Map::zeros(); 2];
        for (n, pair) in states.windows(2).enumerate() {
            let left = 1.0 - libm::pow(n as f64 / end, 2.0);
            let [state, next] = [pair[0], pair[1]].map(|state| Vector2::from(state) / SLOW);
            from += left * left * state * state.transpose();
            to += left * left * next * state.transpose();
        }
        Some(to * from.try_inverse()?)
    }

    /// Returns the map of `ticks` ticks through which user code holds the spring's force.
    fn held_map(&self, [stiffness, damping]: [f64; 2], ticks: u32) -> Option<Map> {
        let &Self { method, tick_hz, substeps, .. } = self;
        let candidate = Candidate { method, substeps, spring: SpringForm::Acceleration };
        let after = |start, push| {
            let body = LoggedBody { spring: Some([0.0; 2]), push, ..LoggedBody::default() };
            run(candidate, &body, start, 1.0 / tick_hz, [0, u64::from(ticks)].into_iter())
        };
        let free = columns(&after([SLOW, 0.0], 0.0)?, &after([0.0, SLOW], 0.0)?)?;
        // This is the response of a body at rest to a held force of 1 N/kg.
        let pushed = Vector2::from(*after([0.0; 2], 1.0)?.last()?);
        Some(free[0] - pushed * RowVector2::new(stiffness, damping))
    }

    /// Returns the visible motion of a spring whose force user code holds through `ticks` ticks.
    pub fn sees_held(&self, joint: [f64; 2], ticks: u32) -> Option<Effective> {
        let map = self.held_map(joint, ticks)?;
        spring_of_map(map.trace(), map.determinant(), f64::from(ticks) / self.tick_hz)
    }

    /// Like [`Setup::growth`], for a force held through `ticks` ticks.
    pub(super) fn held_growth(&self, joint: [f64; 2], ticks: u32) -> Option<f64> {
        let map = self.held_map(joint, ticks)?;
        Some(spectral_radius(map.trace(), map.determinant()))
    }
}

/// Returns the maps whose columns are these runs, without the starts of the runs; `None` if the maps are not finite.
fn columns(first: &[[f64; 2]], second: &[[f64; 2]]) -> Option<Vec<Map>> {
    let map = |(a, b): (&[f64; 2], &[f64; 2])| Map::from([*a, *b]) / SLOW;
    let maps: Vec<Map> = first.iter().zip(second).skip(1).map(map).collect();
    maps.iter().flatten().all(|x| x.is_finite()).then_some(maps)
}

/// Largest spectral radius of a step that does not count as growth.
pub(crate) const NO_GROWTH: f64 = 1.0 + 1e-9;

/// Whether no motion of a map with this trace and determinant grows.
pub(super) fn is_stable(trace: f64, determinant: f64) -> bool {
    spectral_radius(trace, determinant) <= NO_GROWTH
}

/// Returns the largest modulus of an eigenvalue of a map with this trace and determinant.
pub(crate) fn spectral_radius(trace: f64, determinant: f64) -> f64 {
    let half = trace / 2.0;
    match half * half - determinant {
        square if square < 0.0 => libm::sqrt(determinant),
        square => half.abs() + libm::sqrt(square),
    }
}

/// Returns the damped spring whose map over `tick_s` has this trace and determinant.
pub(crate) fn spring_of_map(trace: f64, determinant: f64, tick_s: f64) -> Option<Effective> {
    let half = trace / 2.0;
    let square = half * half - determinant;
    if determinant <= 0.0 || square >= 0.0 && half <= 0.0 {
        return None;
    }
    let decay = -libm::log(determinant) / 2.0 / tick_s;
    let apart = libm::sqrt(square.abs());
    // A pair of eigenvalues has an angle; for two real eigenvalues, it is half the difference of their logarithms.
    let omega_square = match square < 0.0 {
        true => decay * decay + libm::pow(libm::atan2(apart, half) / tick_s, 2.0),
        false => decay * decay - libm::pow(libm::atanh(apart / half) / tick_s, 2.0),
    };
    (omega_square > 0.0).then(|| Effective { omega: libm::sqrt(omega_square), decay })
}

/// Returns the trace and determinant of the two slowest motions of a map with one number of memory, from its first
/// three ticks.
///
/// Let A be the map of the state alone. The memory adds w to a tick, which is nothing in the first tick, and C times
/// the state in the second. In the third tick it is the same and ρ times the previous w. All w have one direction.
fn with_memory(once: &Map, twice: &Map, thrice: &Map) -> Option<[f64; 2]> {
    let added = twice - once * once;
    let rest = thrice - once * twice - added * once;
    // The direction is that of the larger column.
    let lengths = added.column_iter().map(|column| column.norm()).collect::<Vec<_>>();
    let larger = usize::from(lengths[1] > lengths[0]);
    if lengths[larger] == 0.0 {
        return Some([once.trace(), once.determinant()]);
    }
    let along = added.column(larger) / lengths[larger];
    let [from_state, last] = [added, rest].map(|map| along.transpose() * map);
    let kept = last[larger] / from_state[larger];
    // Characteristic polynomial λ³ - s λ² + m λ - d of the state with its memory.
    let s = once.trace() + kept;
    let m = once.determinant() + kept * once.trace() - along.dot(&from_state.transpose());
    let d = kept * once.determinant() - (from_state * adjugate(once) * along).x;
    let mut root = 0.0_f64;
    for _ in 0..ITERATIONS {
        let value = ((root - s) * root + m) * root - d;
        root -= value / ((3.0 * root - 2.0 * s) * root + m);
    }
    let [trace, determinant] = [s - root, m - root * (s - root)];
    let is_slower = root * root <= determinant.abs();
    (root.is_finite() && is_slower).then_some([trace, determinant])
}

/// Returns the matrix whose product with `map` is the determinant.
fn adjugate(map: &Map) -> Map {
    Map::new(map.m22, -map.m12, -map.m21, map.m11)
}
