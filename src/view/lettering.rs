//! Words in a picture that the processor draws, without a graphics device.

use egui::{Color32, Context, FontId, RawInput};

use super::theme::{apply_style, strong_font};
use crate::lab::palette::{Rgba, mixed};

/// The size of type in a picture, in pixels.
const TYPE_PX: f32 = 16.0;

/// Writes words with the fonts of the panels.
pub struct Lettering {
    context: Context,
}

impl Default for Lettering {
    fn default() -> Self {
        let context = Context::default();
        apply_style(&context);
        // Fonts are there from the first frame on.
        context.run_ui(RawInput::default(), |_| ()).textures_delta.clear();
        Self { context }
    }
}

impl Lettering {
    /// The height of a line, in pixels.
    pub const LINE_PX: usize = 22;

    /// Writes a line into a picture of rows of `width` pixels, from this pixel on to the right and down, as far as the
    /// picture goes.
    pub fn write(
        &self,
        pixels: &mut [Rgba],
        width: usize,
        [left, top]: [usize; 2],
        words: &str,
        (colour, is_strong): (Rgba, bool),
    ) {
        let font = if is_strong { strong_font(TYPE_PX) } else { FontId::proportional(TYPE_PX) };
        let (galley, atlas) = self.context.fonts_mut(|fonts| {
            let galley = fonts.layout_no_wrap(words.to_owned(), font, Color32::WHITE);
            (galley, fonts.image())
        });
        for row in &galley.rows {
            // Each glyph is a rectangle of the atlas.
            for corners in row.visuals.mesh.vertices.as_chunks::<4>().0 {
                let corner = corners[0].pos + row.pos.to_vec2();
                let [x0, y0] = [corner.x, corner.y].map(|at| at.round().max(0.0) as usize);
                let [from, to] = [corners[0].uv, corners[3].uv];
                let texels = |from: f32, to: f32| (from as usize..to as usize).enumerate();
                for (y, v) in texels(from.y, to.y) {
                    for (x, u) in texels(from.x, to.x) {
                        let at = [left + x0 + x, top + y0 + y];
                        let pixel = pixels.get_mut(at[1] * width + at[0]);
                        let Some(pixel) = pixel.filter(|_| at[0] < width) else { continue };
                        let inked = f32::from(atlas[(u, v)].a()) / 255.0;
                        *pixel = mixed(*pixel, colour, inked);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_inked_where_they_stand_and_cut_off_at_the_edge() {
        const SIZE: [usize; 2] = [90, 40];
        let written = |words: &str, at: [usize; 2]| {
            let mut pixels = vec![[0, 0, 0, 255]; SIZE[0] * SIZE[1]];
            let style = ([250, 200, 150, 255], true);
            Lettering::default().write(&mut pixels, SIZE[0], at, words, style);
            let inked = pixels.iter().enumerate().filter(|(_, pixel)| pixel[0] > 120);
            inked.map(|(n, _)| [n % SIZE[0], n / SIZE[0]]).collect::<Vec<_>>()
        };
        assert!(written(" ", [0, 0]).is_empty());
        let word = written("Euler", [20, 10]);
        assert!((60..400).contains(&word.len()), "{}", word.len());
        assert!(word.iter().all(|[x, y]| (20..70).contains(x) && (10..32).contains(y)));
        let cut = written("Euler", [70, 30]);
        assert!(!cut.is_empty() && cut.iter().all(|[x, y]| *x >= 70 && *y >= 30), "{cut:?}");
    }
}
