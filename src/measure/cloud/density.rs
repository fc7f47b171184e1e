//! Counts the points on each pixel of a picture. The processor does this, so that the result is the same everywhere.
//! The cost of the image depends on the pixels, and hardly on the points.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use crate::run::race::ESCAPE;

/// The part of the phase plane in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneView {
    /// Minimum and maximum coordinate.
    pub q: [f64; 2],
    /// Minimum and maximum velocity.
    pub v: [f64; 2],
    /// Whether the coordinate is an angle between -π and π.
    pub wraps: bool,
}

impl PlaneView {
    /// Creates a view of all exact points with a margin. The view also shows other points up to `beside` times the
    /// width of the exact ones to each side. An angle that turns over is shown all around.
    pub fn around(exact: &[[f64; 2]], others: &[[f64; 2]], beside: f64, is_angle: bool) -> Self {
        let [q, v] = [0, 1].map(|i| {
            let (exact, others) = (Self::range(exact, i), Self::range(others, i));
            // If all exact points are lost, the other points are shown; if both are lost, the middle is shown.
            let is_some = |range: &[f64; 2]| range[0] <= range[1];
            let [least, most] = [exact, others].into_iter().find(is_some).unwrap_or([-1.0, 1.0]);
            let [low, high] = Some(others).filter(is_some).unwrap_or([least, most]);
            let width = (most - least).max(1e-9 * (1.0 + most.abs()));
            let wide = beside * width;
            let shown = [low.clamp(least - wide, least), high.clamp(most, most + wide)];
            let margin = 0.06 * (shown[1] - shown[0]).max(width);
            [shown[0] - margin, shown[1] + margin]
        });
        let wraps = is_angle && (q[0] < -PI || q[1] > PI);
        Self { q: if wraps { [-PI, PI] } else { q }, v, wraps }
    }

    /// Returns the minimum and maximum coordinate or velocity of points that have not blown up.
    pub(super) fn range<'p>(points: impl IntoIterator<Item = &'p [f64; 2]>, i: usize) -> [f64; 2] {
        let numbers =
            points.into_iter().map(|point| point[i]).filter(|number| number.abs() <= ESCAPE);
        numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], number| {
            [number.min(least), number.max(most)]
        })
    }

    /// Returns the distance between the minimum and maximum of `range`.
    pub(super) fn width(points: &[[f64; 2]], i: usize) -> f64 {
        let [least, most] = Self::range(points, i);
        most - least
    }

    /// Returns the position of a point in the view, from 0 to 1 to the right and up.
    pub fn place(&self, q: f64, v: f64) -> [f64; 2] {
        let q = if self.wraps { q - TAU * ((q + PI) / TAU).floor() } else { q };
        let part = |number: f64, [least, most]: [f64; 2]| (number - least) / (most - least);
        [part(q, self.q), part(v, self.v)]
    }
}

/// Longest line drawn between two points of a border, relative to the picture's longer side.
pub const MAX_LINE_PART: f64 = 0.1;

/// Minimum number of points per thread. Each thread counts separately, and the counts are added up in the end.
const GRAIN: usize = 1 << 17;

/// The number of points on each pixel.
#[derive(Clone, Debug)]
pub struct Density {
    size_px: [usize; 2],
    view: PlaneView,
    /// Number of points on each pixel, row by row from the top.
    counts: Vec<u32>,
}

impl Density {
    /// Creates an empty picture of this size.
    pub fn new(size_px: [usize; 2], view: PlaneView) -> Self {
        Self { size_px, view, counts: vec![0; size_px[0] * size_px[1]] }
    }

    /// Adds the points within the view and ignores points that are not finite. Large numbers of points are shared among
    /// all cores.
    pub fn add(&mut self, q: &[f64], v: &[f64]) {
        if q.len() <= GRAIN {
            return self.add_here(q, v);
        }
        let part = q.len().div_ceil(rayon::current_num_threads()).max(GRAIN);
        let counted = q.par_chunks(part).zip(v.par_chunks(part)).map(|(q, v)| {
            let mut density = Self::new(self.size_px, self.view);
            density.add_here(q, v);
            density.counts
        });
        for counts in counted.collect::<Vec<_>>() {
            self.counts.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
        }
    }

    fn add_here(&mut self, q: &[f64], v: &[f64]) {
        let Self { size_px: [width, height], view, ref mut counts } = *self;
        let [wide, high] = [width, height].map(|side| side as f64);
        for (&q, &v) in q.iter().zip(v) {
            let [x, y] = view.place(q, v);
            if (0.0..1.0).contains(&x) && (0.0..1.0).contains(&y) {
                let [x, y] = [(x * wide) as i32 as usize, (y * high) as i32 as usize];
                counts[(height - 1 - y) * width + x] += 1;
            }
        }
    }

    /// Returns the number of points within the view.
    pub fn points(&self) -> usize {
        self.counts.iter().map(|&count| count as usize).sum()
    }

    /// Returns the counts, row by row from the top.
    pub fn counts(&self) -> &[u32] {
        &self.counts
    }

    /// Returns the width and the height in pixels.
    pub fn size_px(&self) -> [usize; 2] {
        self.size_px
    }
}
