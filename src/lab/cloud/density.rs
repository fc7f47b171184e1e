//! A picture of many points: how many fall on each pixel, made by the processor and so the same everywhere. Its cost
//! depends on the pixels, and hardly on the points.

use std::f64::consts::{PI, TAU};

use crate::lab::palette::{Rgba, Theme, mixed};

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
    /// One that shows where the exact points come, with a margin, and the others as far as these are no further off than
    /// the exact ones are wide. An angle that turns over is shown all around.
    pub fn around(exact: &[[f64; 2]], others: &[[f64; 2]], is_angle: bool) -> Self {
        let range = |points: &[[f64; 2]], i: usize| {
            let numbers = points.iter().map(|point| point[i]).filter(|number| number.is_finite());
            numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], number| {
                [number.min(least), number.max(most)]
            })
        };
        let [q, v] = [0, 1].map(|i| {
            let ([least, most], [low, high]) = (range(exact, i), range(others, i));
            let width = (most - least).max(1e-9 * (1.0 + most.abs()));
            let shown = [low.clamp(least - width, least), high.clamp(most, most + width)];
            let margin = 0.06 * (shown[1] - shown[0]);
            [shown[0] - margin, shown[1] + margin]
        });
        let turns = |point: &[f64; 2]| point[0].abs() > PI;
        let wraps = is_angle && exact.iter().chain(others).any(turns);
        Self { q: if wraps { [-PI, PI] } else { q }, v, wraps }
    }

    /// Where a point lies, from 0 to 1 to the right and up.
    fn place(&self, q: f64, v: f64) -> [f64; 2] {
        let q = if self.wraps { q - TAU * ((q + PI) / TAU).floor() } else { q };
        let part = |number: f64, [least, most]: [f64; 2]| (number - least) / (most - least);
        [part(q, self.q), part(v, self.v)]
    }
}

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

    /// Adds the points within the view; those that are not finite are nowhere.
    pub fn add(&mut self, q: &[f64], v: &[f64]) {
        let [width, height] = self.size_px;
        for (&q, &v) in q.iter().zip(v) {
            let [x, y] = self.view.place(q, v);
            if (0.0..1.0).contains(&x) && (0.0..1.0).contains(&y) {
                let [x, y] = [(x * width as f64) as usize, (y * height as f64) as usize];
                self.counts[(height - 1 - y) * width + x] += 1;
            }
        }
    }

    /// The counts, row by row from the top.
    pub fn counts(&self) -> &[u32] {
        &self.counts
    }

    /// The picture in a method's colour, brighter by the logarithm of the count, and these lines over it.
    pub fn picture(&self, theme: Theme, colour: Rgba, lines: &[Vec<[f64; 2]>]) -> Vec<Rgba> {
        let palette = theme.palette();
        let most = f64::from(self.counts.iter().copied().max().unwrap_or(0).max(2));
        let tone = |count: u32| match count {
            0 => palette.plot,
            _ => {
                let part = (libm::log1p(f64::from(count)) / libm::log1p(most)) as f32;
                match part < 0.7 {
                    true => mixed(palette.plot, colour, 0.25 + 0.75 * part / 0.7),
                    false => mixed(colour, palette.text, (part - 0.7) / 0.5),
                }
            }
        };
        // Few counts are large.
        let usual: Vec<Rgba> = (0..256).map(tone).collect();
        let shown =
            |&count: &u32| usual.get(count as usize).copied().unwrap_or_else(|| tone(count));
        let mut pixels: Vec<Rgba> = self.counts.iter().map(shown).collect();
        for line in lines {
            for ends in line.windows(2) {
                self.draw_line(&mut pixels, [ends[0], ends[1]], palette.exact);
            }
        }
        pixels
    }

    /// A pixel for each step along a line.
    fn draw_line(&self, pixels: &mut [Rgba], ends: [[f64; 2]; 2], colour: Rgba) {
        let [from, to] = ends.map(|[q, v]| self.view.place(q, v));
        let [width, height] = self.size_px.map(|pixels| pixels as f64);
        let [dx, dy] = [(to[0] - from[0]) * width, (to[1] - from[1]) * height];
        let steps = dx.abs().max(dy.abs()).ceil();
        // A line across the whole picture is one around the back of an angle, or leads to infinity.
        if !steps.is_finite() || steps > width.max(height) / 2.0 {
            return;
        }
        for step in 0..=steps as usize {
            let part = if steps > 0.0 { step as f64 / steps } else { 0.0 };
            let at = [0, 1].map(|i| from[i] + part * (to[i] - from[i]));
            if at.iter().all(|place| (0.0..1.0).contains(place)) {
                let [x, y] = [(at[0] * width) as usize, (at[1] * height) as usize];
                pixels[(self.size_px[1] - 1 - y) * self.size_px[0] + x] = colour;
            }
        }
    }
}
