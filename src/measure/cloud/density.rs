//! A picture of many points: how many fall on each pixel, made by the processor and so the same everywhere. Its cost
//! depends on the pixels, and hardly on the points.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use crate::run::race::ESCAPE;

/// The part of the phase plane that a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneView {
    /// The least and the largest coordinate.
    pub q: [f64; 2],
    /// The least and the largest velocity.
    pub v: [f64; 2],
    /// Whether the coordinate is an angle that is shown between -π and π.
    pub wraps: bool,
}

impl PlaneView {
    /// One that shows where the exact points come, with a margin, and the others as far as `beside` times the width of the
    /// exact ones beside these. An angle that turns over there is shown all around.
    pub fn around(exact: &[[f64; 2]], others: &[[f64; 2]], beside: f64, is_angle: bool) -> Self {
        let [q, v] = [0, 1].map(|i| {
            let (exact, others) = (Self::range(exact, i), Self::range(others, i));
            // Where all of one kind are lost the others are shown, or the middle.
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

    /// The least and the largest coordinate or velocity of points that have not blown up.
    pub(super) fn range<'p>(points: impl IntoIterator<Item = &'p [f64; 2]>, i: usize) -> [f64; 2] {
        let numbers =
            points.into_iter().map(|point| point[i]).filter(|number| number.abs() <= ESCAPE);
        numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], number| {
            [number.min(least), number.max(most)]
        })
    }

    /// How far they are apart.
    pub(super) fn width(points: &[[f64; 2]], i: usize) -> f64 {
        let [least, most] = Self::range(points, i);
        most - least
    }

    /// Where a point lies, from 0 to 1 to the right and up.
    pub fn place(&self, q: f64, v: f64) -> [f64; 2] {
        let q = if self.wraps { q - TAU * ((q + PI) / TAU).floor() } else { q };
        let part = |number: f64, [least, most]: [f64; 2]| (number - least) / (most - least);
        [part(q, self.q), part(v, self.v)]
    }
}

/// The longest line between two points of a border that is drawn, as a part of the picture's longer side.
pub const MAX_LINE_PART: f64 = 0.1;

/// The fewest points for which a thread has counts of its own, which are added up in the end.
const GRAIN: usize = 1 << 17;

/// How many points fall on each pixel.
#[derive(Clone, Debug)]
pub struct Density {
    size_px: [usize; 2],
    view: PlaneView,
    /// Rows from the top.
    counts: Vec<u32>,
}

impl Density {
    /// No points on a picture of this size.
    pub fn new(size_px: [usize; 2], view: PlaneView) -> Self {
        Self { size_px, view, counts: vec![0; size_px[0] * size_px[1]] }
    }

    /// Adds the points within the view; those that are not finite are nowhere. All cores share many points.
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

    /// The points within the view.
    pub fn points(&self) -> usize {
        self.counts.iter().map(|&count| count as usize).sum()
    }

    /// The counts, row by row from the top.
    pub fn counts(&self) -> &[u32] {
        &self.counts
    }

    /// Pixels across and from top to bottom.
    pub fn size_px(&self) -> [usize; 2] {
        self.size_px
    }
}
