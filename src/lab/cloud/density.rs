//! A picture of many points: how many fall on each pixel, made by the processor and so the same everywhere. Its cost
//! depends on the pixels, and hardly on the points.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use crate::lab::palette::{Rgba, Theme, mixed};
use crate::lab::race::ESCAPE;

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

/// Parts of a point that have a tone of their own, and the points up to which they have.
const PARTS: f32 = 8.0;
const USUAL: usize = 256;

/// How many times denser than on average a place is that has the brightest tone, if one is.
const DENSE: f32 = 8.0;

/// Counts, which have this sum, as colours: brighter by the logarithm of the count.
fn shaded(
    counts: impl Iterator<Item = f32> + Clone,
    sum: f32,
    theme: Theme,
    colour: Rgba,
) -> Vec<Rgba> {
    let (most, covered) = counts
        .clone()
        .fold((0.0_f32, 0_u32), |(most, n), count| (most.max(count), n + u32::from(count > 0.0)));
    let (mean, palette) = (sum / covered.max(1) as f32, theme.palette());
    // An even cover has the plain colour.
    let whole = libm::log1pf(most.max(2.0).max(DENSE * mean));
    let tone = |count: f32| {
        let part = libm::log1pf(count) / whole;
        match part < 0.7 {
            true => mixed(palette.plot, colour, 0.25 * count.min(1.0) + 0.75 * part / 0.7),
            false => mixed(colour, palette.text, (part - 0.7) / 0.5),
        }
    };
    let usual: Vec<Rgba> =
        (0..USUAL * PARTS as usize).map(|parts| tone(parts as f32 / PARTS)).collect();
    let shown = |count: f32| {
        let parts = (count * PARTS + 0.5) as i32 as usize;
        usual.get(parts).copied().unwrap_or_else(|| tone(count))
    };
    counts.map(shown).collect()
}

/// Every `stride`th of these counts, spread evenly over so many places.
fn spread(counts: &[f32], stride: usize, places: usize) -> Vec<f32> {
    let count = counts.len().div_ceil(stride);
    let wide = places as f32 / count as f32;
    let mut spread = vec![0.0; places];
    for (n, &count) in counts.iter().step_by(stride).enumerate().filter(|(_, count)| **count > 0.0)
    {
        let (from, to) = (n as f32 * wide, (n + 1) as f32 * wide);
        let touched = (from as usize..places).zip(&mut spread[(from as usize).min(places)..]);
        for (place, sum) in touched.take_while(|(place, _)| (*place as f32) < to) {
            let within = to.min(place as f32 + 1.0) - from.max(place as f32);
            *sum += count * (within / wide).max(0.0);
        }
    }
    spread
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

    /// The picture in a method's colour, brighter by the logarithm of the count, in another size and transparent where no
    /// point is: what lies between two pixels falls on both.
    pub fn picture_of_size(&self, size_px: [usize; 2], theme: Theme, colour: Rgba) -> Vec<Rgba> {
        let [width, height] = self.size_px;
        let counts: Vec<f32> = self.counts.iter().map(|&count| count as f32).collect();
        let narrowed: Vec<f32> =
            counts.chunks(width).flat_map(|row| spread(row, 1, size_px[0])).collect();
        let column = |x: usize| spread(&narrowed[x..], size_px[0], size_px[1]);
        debug_assert_eq!(narrowed.len(), size_px[0] * height);
        let columns: Vec<Vec<f32>> = (0..size_px[0]).map(column).collect();
        let all = (0..size_px[1]).flat_map(|y| columns.iter().map(move |column| column[y]));
        let all: Vec<f32> = all.collect();
        let mut pixels = shaded(all.iter().copied(), all.iter().sum(), theme, colour);
        let counted = pixels.iter_mut().zip(&all);
        counted.filter(|(_, count)| **count == 0.0).for_each(|(pixel, _)| pixel[3] = 0);
        pixels
    }
}
