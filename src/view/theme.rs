//! The look of panels: the colours of the theme, the fonts, the box for a sign that no font has, and the font sizes.

use std::sync::LazyLock;

use egui::{
    Color32, ColorImage, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, FontTweak,
    GlyphBitmap, GlyphRasterizer, GlyphRasterizerRequest, RasterizedGlyph, Stroke, Ui, Vec2, vec2,
};

use crate::look::palette::{Palette, Rgba, Theme};
use crate::scene::LaneSpec;
use crate::studio::Display;

/// The colours of panels, as egui wants them.
#[derive(Debug)]
pub(super) struct PanelPalette {
    pub(super) background: Color32,
    pub(super) panel: Color32,
    pub(super) raised: Color32,
    pub(super) line: Color32,
    pub(super) plot: Color32,
    pub(super) grid: Color32,
    pub(super) text: Color32,
    pub(super) dim: Color32,
    pub(super) accent: Color32,
    pub(super) on_accent: Color32,
    pub(super) exact: Color32,
    pub(super) bad: Color32,
    pub(super) warn: Color32,
    pub(super) good: Color32,
    pub(super) theme: Theme,
}

impl PanelPalette {
    fn of(theme: Theme) -> Self {
        let &Palette { background, panel, raised, line, plot, grid, text, dim, .. } =
            theme.palette();
        let &Palette { accent, on_accent, exact, bad, warn, good, .. } = theme.palette();
        Self {
            background: colour(background),
            panel: colour(panel),
            raised: colour(raised),
            line: colour(line),
            plot: colour(plot),
            grid: colour(grid),
            text: colour(text),
            dim: colour(dim),
            accent: colour(accent),
            on_accent: colour(on_accent),
            exact: colour(exact),
            bad: colour(bad),
            warn: colour(warn),
            good: colour(good),
            theme,
        }
    }

    /// Colour and dash pattern of a lane in this list.
    pub(super) fn style(&self, lanes: &[LaneSpec], spec: &LaneSpec) -> (Color32, [f32; 2]) {
        let (rgba, dash) = self.theme.lane_style(lanes, spec);
        (colour(rgba), dash)
    }

    /// Colour and dash pattern of the loop with this index in the loop lab.
    pub(super) fn loop_style(&self, index: usize) -> (Color32, [f32; 2]) {
        let (rgba, dash) = self.theme.loop_style(index);
        (colour(rgba), dash)
    }
}

static DARK: LazyLock<PanelPalette> = LazyLock::new(|| PanelPalette::of(Theme::Dark));
static LIGHT: LazyLock<PanelPalette> = LazyLock::new(|| PanelPalette::of(Theme::Light));

pub(super) fn palette_of(theme: Theme) -> &'static PanelPalette {
    match theme {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    }
}

/// The colours of the theme of a panel.
pub(super) fn palette(ui: &Ui) -> &'static PanelPalette {
    palette_of(if ui.visuals().dark_mode { Theme::Dark } else { Theme::Light })
}

pub(super) fn colour([r, g, b, a]: Rgba) -> Color32 {
    Color32::from_rgba_unmultiplied(r, g, b, a)
}

/// The font size of panels at 1280×720, in points.
pub(super) const TYPE: f32 = 13.0;
/// The window size for that font size, in points, and the maximum enlargement.
const USUAL_SIZE: [f32; 2] = [1280.0, 720.0];
const MAX_ZOOM: f32 = 2.0;

/// Enlargement in a window of this size, in points, relative to the usual one. Type grows with the square root of the
/// window's size, in steps too small to notice.
pub(super) fn auto_zoom(size: [f32; 2]) -> f32 {
    let times = (size[0] / USUAL_SIZE[0]).min(size[1] / USUAL_SIZE[1]).max(1.0);
    (8.0 * times.sqrt().min(MAX_ZOOM)).round() / 8.0
}

/// Minimum window in which every text is readable at the usual font size, in points.
const MIN_ROOM: [f32; 2] = [800.0, 480.0];

/// Enlargement in a window of this size, in points, with the user's choice of the size of type and panels in percent.
/// If the window is too small for the choice, the largest enlargement that fits.
pub(super) fn zoom(size: [f32; 2], percent: u32) -> f32 {
    let grown = auto_zoom(size);
    let largest = (size[0] / MIN_ROOM[0]).min(size[1] / MIN_ROOM[1]);
    (grown * percent as f32 / 100.0).min(largest.max(grown))
}

/// Font family of words that stand out.
pub(super) fn strong() -> FontFamily {
    FontFamily::Name("strong".into())
}

/// Font of words that stand out.
pub(super) fn strong_font(size: f32) -> FontId {
    FontId::new(size, strong())
}

/// Font of digits and words in formulas: upright serif.
pub(super) fn formula_font(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name("formula".into()))
}

/// Font of quantities in formulas: serif italic.
pub(super) fn quantity_font(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name("quantity".into()))
}

/// Sets the look of every widget. Call it once for each context.
pub(super) fn apply_style(context: &egui::Context) {
    context.set_fonts(fonts());
    context.add_glyph_rasterizer(missing_glyph());
    // The program has its own keys for the font size.
    context.options_mut(|options| options.zoom_with_keyboard = false);
    for theme in [Theme::Dark, Theme::Light] {
        let egui_theme = in_egui(theme);
        let palette = PanelPalette::of(theme);
        context.style_mut_of(egui_theme, |style| dress_style(style, &palette));
    }
}

/// Applies the theme and the font size of a display to the context, in a window of this size in points.
pub(super) fn show(context: &egui::Context, display: &Display, size: [f32; 2]) {
    context.set_theme(in_egui(display.theme));
    set_zoom(context, zoom(size, display.scale_percent));
}

/// Sets the enlargement from the next frame on. egui's own setter would lay out that frame in the points of the one
/// before.
pub(super) fn set_zoom(context: &egui::Context, zoom: f32) {
    context.options_mut(|options| options.zoom_factor = zoom);
}

fn in_egui(theme: Theme) -> egui::Theme {
    match theme {
        Theme::Dark => egui::Theme::Dark,
        Theme::Light => egui::Theme::Light,
    }
}

/// A font file of `assets/fonts`.
macro_rules! face {
    ($file:literal) => {
        FontData::from_static(include_bytes!(concat!("../../assets/fonts/", $file)))
    };
}

/// Inter for all words and numbers, with digits of equal width; a serif for formulas; a fixed-width font for lines
/// quoted from a file. Each falls back on the others. `assets/fonts/subset.py` lists their sources.
fn fonts() -> FontDefinitions {
    // Otherwise its signs are larger than the letters beside them.
    let transport = FontTweak { scale: 0.9, ..FontTweak::default() };
    let font_data = [
        ("Inter", face!("Inter-Regular.otf")),
        ("Inter SemiBold", face!("Inter-SemiBold.otf")),
        ("Formula", face!("Formula-Regular.otf")),
        ("Quantity", face!("Formula-Italic.otf")),
        ("Names", face!("Names-Regular.ttf")),
        ("Quoted", face!("Quoted-Regular.ttf")),
        ("Transport", face!("Transport.ttf").tweak(transport)),
    ];
    let families = [
        (FontFamily::Proportional, ["Inter"].as_slice()),
        (strong(), &["Inter SemiBold"]),
        (FontFamily::Monospace, &["Quoted", "Inter"]),
        (formula_font(TYPE).family, &["Formula", "Inter"]),
        (quantity_font(TYPE).family, &["Quantity", "Inter"]),
    ];
    let with_others = |first: &[&str]| {
        first.iter().chain(&["Names", "Transport", "Quoted"]).map(ToString::to_string).collect()
    };
    FontDefinitions {
        font_data: font_data.map(|(name, data)| (name.into(), data.into())).into(),
        families: families.map(|(family, first)| (family, with_others(first))).into(),
    }
}

fn dress_style(style: &mut egui::Style, palette: &PanelPalette) {
    // The same input must make the same frame, whenever it is drawn.
    style.animation_time = 0.0;
    style.visuals.text_cursor.blink = false;
    style.spacing.item_spacing = vec2(6.0, 3.0);
    style.spacing.button_padding = vec2(8.0, 4.0);
    style.spacing.interact_size.y = 24.0;
    for (text_style, size) in [
        (egui::TextStyle::Body, TYPE),
        (egui::TextStyle::Button, TYPE),
        (egui::TextStyle::Monospace, TYPE),
        (egui::TextStyle::Small, 11.0),
        (egui::TextStyle::Heading, 15.0),
    ] {
        if let Some(font) = style.text_styles.get_mut(&text_style) {
            font.size = size;
        }
    }
    let visuals = &mut style.visuals;
    visuals.panel_fill = palette.panel;
    visuals.window_fill = palette.panel;
    visuals.window_stroke = Stroke::new(1.0, palette.line);
    visuals.extreme_bg_color = palette.plot;
    visuals.faint_bg_color = palette.raised;
    visuals.override_text_color = Some(palette.text);
    visuals.hyperlink_color = palette.accent;
    visuals.selection.bg_fill = palette.accent.gamma_multiply(0.35);
    visuals.selection.stroke = Stroke::new(1.0, palette.accent);
    visuals.widgets.noninteractive.bg_stroke = Stroke::new(1.0, palette.line);
    for (widget, fill, rim) in [
        (&mut visuals.widgets.inactive, palette.raised, palette.line),
        (&mut visuals.widgets.hovered, palette.raised, palette.accent),
        (&mut visuals.widgets.active, palette.line, palette.accent),
        (&mut visuals.widgets.open, palette.raised, palette.accent),
    ] {
        widget.weak_bg_fill = fill;
        widget.bg_fill = fill;
        widget.bg_stroke = Stroke::new(1.0, rim);
        widget.fg_stroke = Stroke::new(1.0, palette.text);
        widget.corner_radius = CornerRadius::same(5);
        widget.expansion = 0.0;
    }
}

/// Width and height of the box for a sign that no font has, the width of its line, and the room on each side. All are
/// relative to the font size.
const BOX_WIDTH: f32 = 0.5;
const BOX_HEIGHT: f32 = 0.7;
const BOX_LINE: f32 = 1.0 / 14.0;
const BOX_MARGIN: f32 = 0.1;

/// Draws a box for every sign that no font has, such as a Chinese character in a body's name. The fonts are subsets,
/// and their own box is empty.
fn missing_glyph() -> GlyphRasterizer {
    GlyphRasterizer::new("regatta::missing_glyph", missing_glyph_box)
}

fn missing_glyph_box(request: &GlyphRasterizerRequest<'_>) -> Option<RasterizedGlyph> {
    if request.cluster.chars().all(|sign| sign.is_whitespace() || sign.is_control()) {
        return None;
    }
    let pixels = |part: f32, least: f32| (part * request.font_size_px).round().max(least) as usize;
    let ([width, height], line) =
        ([BOX_WIDTH, BOX_HEIGHT].map(|side| pixels(side, 3.0)), pixels(BOX_LINE, 1.0));
    let mut image = ColorImage::filled([width, height], Color32::TRANSPARENT);
    for y in 0..height {
        for x in 0..width {
            let is_inside = (line..width - line).contains(&x) && (line..height - line).contains(&y);
            if !is_inside {
                image[(x, y)] = Color32::WHITE;
            }
        }
    }
    let margin = pixels(BOX_MARGIN, 0.0) as f32;
    // The box stands on the baseline.
    let offset_px: Vec2 = vec2(margin, -(height as f32));
    let bitmap = GlyphBitmap { image, offset_px, is_color: false };
    Some(RasterizedGlyph { bitmap, advance_px: width as f32 + 2.0 * margin })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::{Path, PathBuf};

    use egui::{Context, RawInput};

    use super::*;

    #[test]
    fn type_grows_with_the_window_and_never_shrinks() {
        assert_eq!(auto_zoom([1280.0, 720.0]), 1.0);
        assert_eq!(auto_zoom([800.0, 600.0]), 1.0);
        assert_eq!(auto_zoom([1920.0, 720.0]), 1.0);
        assert!((1.2..1.3).contains(&auto_zoom([1920.0, 1080.0])));
        assert!((1.6..1.8).contains(&auto_zoom([3840.0, 2160.0])));
        assert_eq!(auto_zoom([1e5, 1e5]), MAX_ZOOM);
    }

    #[test]
    fn a_chosen_type_size_is_limited_by_the_window() {
        for (size, percent, expected) in [
            ([1280.0, 720.0], 100, 1.0),
            ([1280.0, 720.0], 75, 0.75),
            ([1280.0, 720.0], 150, 1.5),
            ([1280.0, 720.0], 200, 1.5),
            ([800.0, 600.0], 200, 1.0),
            ([400.0, 300.0], 200, 1.0),
            ([1920.0, 1080.0], 150, 1.875),
            ([1920.0, 1080.0], 200, 2.25),
        ] {
            assert_eq!(zoom(size, percent), expected, "{size:?} at {percent} %");
        }
    }

    /// Adds the signs of the texts under a folder of the package, without comments and tests.
    fn signs_under(folder: PathBuf, signs: &mut BTreeSet<char>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                signs_under(path, signs);
            } else if let Ok(text) = std::fs::read_to_string(&path) {
                let shown = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
                let lines = shown.lines().map(|line| line.split("//").next().unwrap_or_default());
                signs.extend(lines.flat_map(str::chars).filter(|sign| !sign.is_control()));
            }
        }
    }

    #[test]
    fn fonts_have_every_character_of_the_project_and_of_european_names() {
        let context = Context::default();
        apply_style(&context);
        context.run_ui(RawInput::default(), |_| {}).textures_delta.clear();
        let mut signs = BTreeSet::new();
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        for folder in ["src", "assets"] {
            signs_under(root.join(folder), &mut signs);
        }
        assert!("∛⌈⅛ωé⏸↺".chars().all(|sign| signs.contains(&sign)), "{signs:?}");
        signs.extend("Пружина в гавані Ґ Ёлка Ναυαγός Łódź Öre Ŝipo".chars());
        context.fonts_mut(|fonts| {
            let words = [FontFamily::Proportional, strong(), FontFamily::Monospace];
            let words = words.map(|family| FontId::new(13.0, family));
            for font in words.into_iter().chain([formula_font(13.0), quantity_font(13.0)]) {
                let lacking: String =
                    signs.iter().filter(|sign| !fonts.has_glyph(&font, **sign)).collect();
                assert_eq!(lacking, "", "{font:?}; add them to assets/fonts/subset.py");
            }
        });
    }

    #[test]
    fn a_missing_character_is_drawn_as_a_box_and_a_blank_as_nothing() {
        let context = Context::default();
        apply_style(&context);
        context.run_ui(RawInput::default(), |_| {}).textures_delta.clear();
        let inked = |words: &str, font: FontId| {
            let layout = |fonts: &mut egui::epaint::text::FontsView<'_>| {
                fonts.layout_no_wrap(words.into(), font, Color32::WHITE)
            };
            context.fonts_mut(layout).mesh_bounds
        };
        for font in [FontId::proportional(13.0), strong_font(13.0)] {
            for words in ["船", "ロープ", "🦭"] {
                let bounds = inked(words, font.clone());
                assert!(bounds.width() > 5.0 && bounds.height() > 8.0, "{words}: {bounds:?}");
            }
            assert!(!inked("\u{3000}", font).is_positive());
        }
    }
}
