//! What a player sees of a spring in an engine, read off the map of its tick.

use crate::lab::identify::{Candidate, Effective, LoggedBody, SLOW, run};
use crate::sim::integrators::{JointMode, Method};

/// How an engine is told a spring, and how often it ticks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// The engine.
    pub method: &'static Method,
    /// How it is told.
    pub mode: &'static JointMode,
    /// Its ticks per second.
    pub tick_hz: f64,
    /// Its substeps.
    pub substeps: u32,
}

/// A map of coordinate and velocity: rows of a matrix.
pub(super) type Map = [[f64; 2]; 2];

/// Iterations of Newton on the eigenvalue that a memory adds; it is near 0, and three are enough.
const ITERATIONS: u32 = 20;

impl Setup {
    /// What a player sees of a joint of this stiffness in 1/s² and damping in 1/s, each per unit of mass. `None` if nothing
    /// swings or decays so: the body jumps to the other side at every tick, say.
    pub fn sees(&self, joint: [f64; 2]) -> Option<Effective> {
        let [trace, determinant] = self.invariants(joint)?;
        seen(trace, determinant, 1.0 / self.tick_hz)
    }

    /// The trace and the determinant of the map of a tick; of an engine with a memory those of the two slowest motions.
    fn invariants(&self, joint: [f64; 2]) -> Option<[f64; 2]> {
        let has_memory = self.method.restart.is_some();
        let maps = self.maps(joint, if has_memory { 3 } else { 1 })?;
        match maps[..] {
            [once] => Some([trace(&once), determinant(&once)]),
            [once, twice, thrice] => with_memory(&once, &twice, &thrice),
            _ => None,
        }
    }

    /// The largest part of the state that a tick keeps: the swing grows if it is more than 1.
    pub(super) fn growth(&self, joint: [f64; 2]) -> Option<f64> {
        let [trace, determinant] = self.invariants(joint)?;
        Some(spectral_radius(trace, determinant))
    }

    /// The maps of 1 to `ticks` ticks, from a start without memory.
    fn maps(&self, spring: [f64; 2], ticks: u64) -> Option<Vec<Map>> {
        let &Self { method, mode, tick_hz, substeps } = self;
        let body = LoggedBody { spring: Some(spring), drag: 0.0, push: 0.0 };
        let (candidate, tick_s, every) = match mode.is_explicit {
            false => (Candidate { method, substeps, is_held: false }, 1.0 / tick_hz, 1),
            // The force is read anew in each substep, as if that were a tick.
            true => {
                let candidate = Candidate { method, substeps: 1, is_held: true };
                (candidate, 1.0 / tick_hz / f64::from(substeps), u64::from(substeps))
            }
        };
        let from = |start| run(candidate, &body, start, tick_s, (0..=ticks).map(|i| i * every));
        columns(&from([SLOW, 0.0])?, &from([0.0, SLOW])?)
    }

    /// The map of `ticks` ticks through which user code holds the spring's force.
    pub(super) fn held_map(&self, [stiffness, damping]: [f64; 2], ticks: u32) -> Option<Map> {
        let &Self { method, tick_hz, substeps, .. } = self;
        let candidate = Candidate { method, substeps, is_held: false };
        let after = |start, push| {
            let body = LoggedBody { spring: Some([0.0; 2]), drag: 0.0, push };
            run(candidate, &body, start, 1.0 / tick_hz, [0, u64::from(ticks)].into_iter())
        };
        let free = columns(&after([SLOW, 0.0], 0.0)?, &after([0.0, SLOW], 0.0)?)?;
        // What a force of 1 N/kg that is held does to a body at rest.
        let pushed = *after([0.0; 2], 1.0)?.last()?;
        let row =
            |i: usize| [free[0][i][0] - pushed[i] * stiffness, free[0][i][1] - pushed[i] * damping];
        Some([row(0), row(1)])
    }

    /// What a player sees of a spring whose force user code holds through `ticks` ticks.
    pub fn sees_held(&self, joint: [f64; 2], ticks: u32) -> Option<Effective> {
        let map = self.held_map(joint, ticks)?;
        seen(trace(&map), determinant(&map), f64::from(ticks) / self.tick_hz)
    }

    /// As [`Setup::growth`], of a force that is held through `ticks` ticks.
    pub(super) fn held_growth(&self, joint: [f64; 2], ticks: u32) -> Option<f64> {
        let map = self.held_map(joint, ticks)?;
        Some(spectral_radius(trace(&map), determinant(&map)))
    }
}

/// The maps whose columns are these runs, without their starts.
fn columns(first: &[[f64; 2]], second: &[[f64; 2]]) -> Option<Vec<Map>> {
    let map = |(a, b): (&[f64; 2], &[f64; 2])| [0, 1].map(|i| [a[i] / SLOW, b[i] / SLOW]);
    let maps: Vec<Map> = first.iter().zip(second).skip(1).map(map).collect();
    maps.iter().flatten().flatten().all(|x| x.is_finite()).then_some(maps)
}

fn trace(map: &Map) -> f64 {
    map[0][0] + map[1][1]
}

fn determinant(map: &Map) -> f64 {
    map[0][0] * map[1][1] - map[0][1] * map[1][0]
}

fn product(a: &Map, b: &Map) -> Map {
    let cell = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
    [[cell(0, 0), cell(0, 1)], [cell(1, 0), cell(1, 1)]]
}

/// The largest modulus of an eigenvalue.
fn spectral_radius(trace: f64, determinant: f64) -> f64 {
    let half = trace / 2.0;
    match half * half - determinant {
        square if square < 0.0 => libm::sqrt(determinant),
        square => half.abs() + libm::sqrt(square),
    }
}

/// The damped spring whose map over `tick_s` has these invariants.
pub(super) fn seen(trace: f64, determinant: f64, tick_s: f64) -> Option<Effective> {
    let half = trace / 2.0;
    let square = half * half - determinant;
    if determinant <= 0.0 || square >= 0.0 && half <= 0.0 {
        return None;
    }
    let decay = -libm::log(determinant) / 2.0 / tick_s;
    let apart = libm::sqrt(square.abs());
    // Of a pair of eigenvalues the angle, of two real ones half the difference of their logarithms.
    let omega_square = match square < 0.0 {
        true => decay * decay + libm::pow(libm::atan2(apart, half) / tick_s, 2.0),
        false => decay * decay - libm::pow(libm::atanh(apart / half) / tick_s, 2.0),
    };
    (omega_square > 0.0).then(|| Effective { omega: libm::sqrt(omega_square), decay })
}

/// The invariants of the two slowest motions of a map with one number of memory, from its first three ticks.
///
/// With A the map of state alone, what the memory adds to a tick is w: none at the first, C of the state there at the
/// second, and ρ times the last beside at the third. All w have one direction.
fn with_memory(once: &Map, twice: &Map, thrice: &Map) -> Option<[f64; 2]> {
    let less = |a: &Map, b: Map| [0, 1].map(|i| [0, 1].map(|j| a[i][j] - b[i][j]));
    let added = less(twice, product(once, once));
    let rest = less(&less(thrice, product(once, twice)), product(&added, once));
    // Along the direction, which is that of the larger column.
    let length = |j: usize| libm::hypot(added[0][j], added[1][j]);
    let larger = usize::from(length(1) > length(0));
    if length(larger) == 0.0 {
        return Some([trace(once), determinant(once)]);
    }
    let along = [0, 1].map(|i| added[i][larger] / length(larger));
    let on = |map: &Map| [0, 1].map(|j| along[0] * map[0][j] + along[1] * map[1][j]);
    let (from_state, last) = (on(&added), on(&rest));
    let kept = last[larger] / from_state[larger];
    let (a, [b0, b1], [c0, c1]) = (once, along, from_state);
    // λ³ - s λ² + m λ - d of the state with its memory.
    let s = trace(a) + kept;
    let m = determinant(a) + kept * trace(a) - b0 * c0 - b1 * c1;
    let d = kept * determinant(a) - c0 * (b0 * a[1][1] - b1 * a[0][1])
        + c1 * (b0 * a[1][0] - b1 * a[0][0]);
    let mut root = 0.0_f64;
    for _ in 0..ITERATIONS {
        let value = ((root - s) * root + m) * root - d;
        root -= value / ((3.0 * root - 2.0 * s) * root + m);
    }
    let [trace, determinant] = [s - root, m - root * (s - root)];
    let is_slower = root * root <= determinant.abs();
    (root.is_finite() && is_slower).then_some([trace, determinant])
}
