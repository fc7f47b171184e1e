//! Draws a cloud: the number of points on each pixel sets the tone of the method's colour.

use super::palette::{Rgba, Theme, mix};
use crate::measure::cloud::Density;

/// Tones are precomputed for counts up to `USUAL`, in steps of 1/`PARTS` of a point.
const PARTS: f32 = 8.0;
const USUAL: usize = 256;

/// Density at which a pixel has the brightest tone, relative to the mean density. If the densest pixel exceeds it, that
/// pixel has the brightest tone.
const DENSE: f32 = 8.0;

/// Returns the colours of the counts, which brighten with the logarithm of the count. `sum` is the sum of all counts.
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
    // A uniform density shows the plain colour.
    let whole = libm::log1pf(most.max(2.0).max(DENSE * mean));
    let tone = |count: f32| {
        let part = libm::log1pf(count) / whole;
        match part < 0.7 {
            true => mix(palette.plot, colour, 0.25 * count.min(1.0) + 0.75 * part / 0.7),
            false => mix(colour, palette.text, (part - 0.7) / 0.5),
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

/// Resamples every `stride`th count to `places` bins and keeps the total.
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

/// Returns the picture of a cloud in a method's colour. A pixel brightens with the logarithm of its count, and is
/// transparent where no point is. The picture is scaled to `size_px`, and a point that falls between two pixels counts
/// for both in part.
pub fn density_picture(
    density: &Density,
    size_px: [usize; 2],
    theme: Theme,
    colour: Rgba,
) -> Vec<Rgba> {
    let [width, height] = density.size_px();
    let counts: Vec<f32> = density.counts().iter().map(|&count| count as f32).collect();
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
