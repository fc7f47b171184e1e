//! Finds the settings of a spring whose tick is not linear, by the first second after a release from rest.

use super::ui_spring::part_left;
use super::{Setup, Wish};
use crate::identify::SLOW;
use crate::sim::numerics::bisect;

/// The errors of a motion after a release from rest, as fractions of the release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FirstSecond {
    /// The error after 1 s.
    pub end: f64,
    /// Root mean square of the errors in this second, or in half a swing if it takes longer.
    pub rms: f64,
}

/// Largest error after 1 s between which and 0 the least root mean square counts.
const NEAR: f64 = 8e-4;
/// Maximum number of ticks of a run.
const MAX_TICKS: f64 = 2000.0;
/// Rate at which the damping of a joint is that of its motion. At another rate it differs by the square.
const USUAL_HZ: f64 = 60.0;
/// The first grid, in the logarithms of stiffness and damping around those of the motion: its middle, the sizes of its
/// cells, and their number on each side. Then the number of cells of the grids that follow, the ratio of their sizes,
/// and the number of all grids. The last is how often the interval around a wanted end is halved.
const MIDDLE: [f64; 2] = [-0.4, 0.0];
const SIZES: [f64; 2] = [0.025, 0.0625];
const FIRST_CELLS: [i32; 2] = [45, 40];
const CELLS: [i32; 2] = [4, 3];
const ZOOM: f64 = 0.6;
const ROUNDS: u32 = 12;
const HALVINGS: u32 = 12;

/// A joint at a place of the grid, with its errors.
#[derive(Clone, Copy)]
struct Tried {
    place: [f64; 2],
    joint: [f64; 2],
    errors: FirstSecond,
}

impl Tried {
    fn cost(&self) -> f64 {
        1e3 * (self.errors.end.abs() - NEAR).max(0.0) + self.errors.rms
    }
}

/// The exact motion of a wish after a release from rest.
struct Release {
    /// Fraction of the release that is left after each tick.
    left: Vec<f64>,
    /// Number of ticks in a second.
    second: usize,
}

impl Release {
    fn of(wish: &Wish, tick_hz: f64) -> Self {
        let ticks = |seconds: f64| (seconds * tick_hz).round().clamp(1.0, MAX_TICKS) as usize;
        let end = ticks(f64::max(1.0, 0.5 / wish.frequency_hz));
        let left = |n| part_left(wish.damping_ratio, wish.omega() * n as f64 / tick_hz);
        Self { left: (1..=end).map(left).collect(), second: ticks(1.0) }
    }

    fn errors(&self, setup: &Setup, joint: [f64; 2]) -> Option<FirstSecond> {
        let states = setup.run(joint, [SLOW, 0.0], 0..=self.left.len() as u64)?;
        let error = |([x, _], left): (&[f64; 2], &f64)| x / SLOW - left;
        let errors: Vec<f64> = states[1..].iter().zip(&self.left).map(error).collect();
        let square: f64 = errors.iter().map(|error| error * error).sum();
        let rms = libm::sqrt(square / errors.len() as f64);
        Some(FirstSecond { end: errors[self.second - 1], rms })
    }
}

/// Returns the joint that is right after a second and has the least errors until then, or comes nearest to it.
pub(super) fn nearest(setup: &Setup, wish: &Wish) -> Option<([f64; 2], FirstSecond)> {
    let release = Release::of(wish, setup.tick_hz);
    let [stiffness, damping] = wish.joint();
    let pace = setup.tick_hz * f64::from(setup.substeps) / USUAL_HZ;
    let at = |place: [f64; 2]| {
        let [k, c] = place.map(libm::exp);
        let joint = [stiffness * k, damping * pace * pace * c];
        Some(Tried { place, joint, errors: release.errors(setup, joint)? })
    };
    let mut best: Option<Tried> = None;
    let (mut middle, mut sizes, mut cells) = (MIDDLE, SIZES, FIRST_CELLS);
    for _ in 0..ROUNDS {
        for j in -cells[1]..=cells[1] {
            let c = middle[1] + sizes[1] * f64::from(j);
            let place = |i: i32| [middle[0] + sizes[0] * f64::from(i), c];
            let row: Vec<Tried> = (-cells[0]..=cells[0]).filter_map(|i| at(place(i))).collect();
            let is_below = |tried: &Tried| tried.errors.end < 0.0;
            let crossed = row.windows(2).filter(|pair| is_below(&pair[0]) != is_below(&pair[1]));
            let right = crossed.flat_map(|pair| {
                let is_low = |k| at([k, c]).is_some_and(|it| is_below(&it) == is_below(&pair[0]));
                let ends = bisect([pair[0].place[0], pair[1].place[0]], HALVINGS, is_low);
                ends.into_iter().filter_map(|k| at([k, c]))
            });
            let all = row.iter().copied().chain(right).chain(best);
            best = all.min_by(|a, b| a.cost().total_cmp(&b.cost()));
        }
        middle = best?.place;
        sizes = sizes.map(|size| ZOOM * size);
        cells = CELLS;
    }
    best.map(|best| (best.joint, best.errors))
}
