//! The box that stands for a sign that no font has, such as a Chinese character in a body's name.

use egui::{Color32, ColorImage, Vec2, vec2};
use egui::{GlyphBitmap, GlyphRasterizer, GlyphRasterizerRequest, RasterizedGlyph};

/// Width and height of the box, the width of its line, and the room on each side, in units of the size of type.
const WIDTH: f32 = 0.5;
const HEIGHT: f32 = 0.7;
const LINE: f32 = 1.0 / 14.0;
const MARGIN: f32 = 0.1;

/// Draws the box for every sign that no font has. The fonts are cut down, and their own box is empty.
pub(super) fn rasterizer() -> GlyphRasterizer {
    GlyphRasterizer::new("regatta::missing_glyph", rasterize)
}

fn rasterize(request: &GlyphRasterizerRequest<'_>) -> Option<RasterizedGlyph> {
    if request.cluster.chars().all(|sign| sign.is_whitespace() || sign.is_control()) {
        return None;
    }
    let pixels = |part: f32, least: f32| (part * request.font_size_px).round().max(least) as usize;
    let ([width, height], line) =
        ([WIDTH, HEIGHT].map(|side| pixels(side, 3.0)), pixels(LINE, 1.0));
    let mut image = ColorImage::filled([width, height], Color32::TRANSPARENT);
    for y in 0..height {
        for x in 0..width {
            let is_inside = (line..width - line).contains(&x) && (line..height - line).contains(&y);
            if !is_inside {
                image[(x, y)] = Color32::WHITE;
            }
        }
    }
    let margin = pixels(MARGIN, 0.0) as f32;
    // It stands on the baseline.
    let offset_px: Vec2 = vec2(margin, -(height as f32));
    let bitmap = GlyphBitmap { image, offset_px, is_color: false };
    Some(RasterizedGlyph { bitmap, advance_px: width as f32 + 2.0 * margin })
}

#[cfg(test)]
mod tests {
    use egui::{Context, FontId, RawInput};

    use crate::view::theme;

    #[test]
    fn a_sign_that_no_font_has_is_drawn_as_a_box_and_a_blank_as_nothing() {
        let context = Context::default();
        theme::apply_style(&context);
        context.run_ui(RawInput::default(), |_| {}).textures_delta.clear();
        let inked = |words: &str, font: FontId| {
            let layout = |fonts: &mut egui::epaint::text::FontsView<'_>| {
                fonts.layout_no_wrap(words.into(), font, egui::Color32::WHITE)
            };
            context.fonts_mut(layout).mesh_bounds
        };
        for font in [FontId::proportional(13.0), theme::strong_font(13.0)] {
            for words in ["船", "ロープ", "🦭"] {
                let bounds = inked(words, font.clone());
                assert!(bounds.width() > 5.0 && bounds.height() > 8.0, "{words}: {bounds:?}");
            }
            assert!(!inked("\u{3000}", font).is_positive());
        }
    }
}
