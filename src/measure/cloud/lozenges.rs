//! Measures a method's effect on small areas. The areas are lozenges, whose corners are stepped like every point.
//!
//! The product of a lozenge's changes over all ticks is the determinant of the total map at the lozenge's middle,
//! however far that map separates points. So the corners are reset wherever the method does not notice it.

use crate::sim::integrators::{Family, Method};

/// Positions of the corners around a middle.
const CORNERS: [[f64; 2]; 4] = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];

/// Distance of the corners from the middle, in units of the cloud's half-width. This distance is so small that the map
/// is linear between the corners.
const BESIDE: f64 = 1e-4;
/// Distance of the corners under a linear map, for which any distance works.
const BESIDE_LINEAR: f64 = 1.0;

/// Number of ticks after which a method with memory restarts around new corners. It is large because the first step is
/// another method's.
const TICKS_WITH_MEMORY: u64 = 32;

/// An area has significant digits if the longer diagonal exceeds the first fraction of the largest corner, and the area
/// exceeds the second fraction of the product of both.
const RESOLVED: f64 = 1e-9;
const RESOLVED_AREA: f64 = 1e-12;

/// The diagonals of a lozenge bisect each other. If their middles are further apart than this fraction of the lozenge's
/// width, the lozenge is folded and has no meaningful area.
const FOLDED: f64 = 0.1;

/// Small areas, each with four copies as corners.
pub(super) struct Lozenges {
    /// Distance of fresh corners from the middle, in coordinate and velocity.
    beside: [f64; 2],
    is_linear: bool,
    /// Number of ticks until the corners are reset; `None` if they never are, as under a linear map.
    renewed_every: Option<u64>,
    /// Change of each area up to the last reset.
    pub(super) factors: Vec<f64>,
}

impl Lozenges {
    /// Creates lozenges for this method. `reach` is that of the cloud, and `is_linear` is whether a tick is a linear
    /// map.
    pub(super) fn new(count: usize, method: &Method, is_linear: bool, reach: [f64; 2]) -> Self {
        let beside = if is_linear { BESIDE_LINEAR } else { BESIDE };
        let renewed_every = match (method.family, method.restart) {
            // These methods restart with the values in their memory.
            (Family::Symplectic, _) | (_, None) => Some(1),
            (_, Some(_)) => (!is_linear).then_some(TICKS_WITH_MEMORY),
        };
        let beside = reach.map(|reach| beside * reach);
        Self { beside, is_linear, renewed_every, factors: vec![1.0; count] }
    }

    /// Returns the coordinates and velocities of the corners around a middle.
    pub(super) fn corners(&self, [q, v]: [f64; 2]) -> [[f64; 2]; 4] {
        CORNERS.map(|[x, y]| [q + x * self.beside[0], v + y * self.beside[1]])
    }

    /// Whether the corners are ever reset.
    pub(super) fn is_renewed(&self) -> bool {
        self.renewed_every.is_some()
    }

    /// Returns the next tick after this one at which the corners are reset.
    pub(super) fn renewal_after(&self, tick: u64) -> u64 {
        self.renewed_every.map_or(u64::MAX, |every| (tick / every + 1) * every)
    }

    /// Returns the areas relative to the start, given the corners at a tick; `None` for a lost lozenge.
    pub(super) fn areas(&self, tick: u64, q: &[f64], v: &[f64]) -> Vec<Option<f64>> {
        let is_new = self.renewed_every.is_some_and(|every| tick.is_multiple_of(every));
        let now = |q: &[f64], v: &[f64]| if is_new { 1.0 } else { self.area(q, v) };
        let lozenges = q.chunks_exact(CORNERS.len()).zip(v.chunks_exact(CORNERS.len()));
        let areas = lozenges.zip(&self.factors).map(|((q, v), factor)| factor * now(q, v));
        areas.map(|area| Some(area).filter(|area| area.is_finite())).collect()
    }

    /// Records the change of the areas, and returns new corners around their middles. A linear map changes every area
    /// alike, so its corners are placed around 0, where rounding never hides them.
    pub(super) fn renew(&mut self, q: &[f64], v: &[f64]) -> [Vec<f64>; 2] {
        let lozenges = q.chunks_exact(CORNERS.len()).zip(v.chunks_exact(CORNERS.len()));
        let areas: Vec<f64> = lozenges.clone().map(|(q, v)| self.area(q, v)).collect();
        self.factors.iter_mut().zip(areas).for_each(|(factor, area)| *factor *= area);
        let middle = |numbers: &[f64]| match self.is_linear {
            true => 0.0,
            false => numbers.iter().sum::<f64>() / CORNERS.len() as f64,
        };
        lozenges
            .flat_map(|(q, v)| self.corners([middle(q), middle(v)]))
            .map(|[q, v]| (q, v))
            .unzip::<f64, f64, Vec<f64>, Vec<f64>>()
            .into()
    }

    /// Returns the area between four corners relative to their reset; NaN if the lozenge is lost, folded or finer than
    /// rounding.
    fn area(&self, q: &[f64], v: &[f64]) -> f64 {
        let corner = |n: usize| [q[n] / self.beside[0], v[n] / self.beside[1]];
        let corners = [0, 1, 2, 3].map(corner);
        let [a, b, c, d] = corners;
        let across = |[from, to]: [[f64; 2]; 2]| [to[0] - from[0], to[1] - from[1]];
        let between = |[from, to]: [[f64; 2]; 2]| [0, 1].map(|i| (from[i] + to[i]) / 2.0);
        let [first, second] = [across([a, b]), across([c, d])];
        let area = (first[0] * second[1] - first[1] * second[0]).abs() / 4.0;
        let off = across([between([a, b]), between([c, d])]);
        let length = |[x, y]: [f64; 2]| (x * x + y * y).sqrt();
        let longest = length(first).max(length(second));
        let largest =
            corners.iter().flatten().fold(0.0, |most: f64, number| most.max(number.abs()));
        // Both conditions are false for NaN.
        let is_resolved = longest > RESOLVED * largest
            && (area == 0.0 || area > RESOLVED_AREA * largest * longest);
        let is_whole = self.is_linear || length(off) * longest <= FOLDED * area;
        if is_resolved && is_whole { area } else { f64::NAN }
    }
}
