//! The panels round the stage: they read the lab and return commands, and touch nothing.

use egui::{Color32, CornerRadius, Frame, Margin, Rect, Stroke, Ui};

pub(super) use super::plot::colour;
use crate::lab::picture::palette;
use crate::lab::{Command, Lab, Severity, Word};

mod advice;
mod axes;
mod footer;
mod help;
mod inspector;
mod instruments;
mod lanes;
mod opening;
mod ranges;
mod timeline;
mod top_bar;
mod tracks;

/// What a frame shows beside the stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Panels {
    /// Every panel that fits.
    #[default]
    Shown,
    /// Nothing: the stage fills the frame.
    Off,
}

/// Below these sizes, in points, a panel gives its room to the stage.
const WIDTH_FOR_INSTRUMENTS: f32 = 420.0;
const HEIGHT_FOR_TOP_BAR: f32 = 120.0;
const HEIGHT_FOR_LANES: f32 = 260.0;
const HEIGHT_FOR_FOOTER: f32 = 200.0;
const HEIGHT_FOR_TIMELINE: f32 = 420.0;
const HEIGHT_FOR_TIMES: f32 = 560.0;

/// The part of the width that the instruments take.
const INSTRUMENTS: f32 = 0.38;

/// The part of their height that the inspector takes at first, the height in points from which on it leaves them some,
/// and the least that either has.
const INSPECTOR: f32 = 0.62;
const HEIGHT_FOR_INSPECTOR_BELOW: f32 = 330.0;
const LEAST_BESIDE: f32 = 110.0;

/// Shows all panels. Returns what was asked for and the rectangle left for the stage, in points.
pub(super) fn show(ui: &mut Ui, lab: &Lab) -> (Vec<Command>, Rect) {
    let mut commands = Vec::new();
    let size = ui.max_rect().size();
    if size.y >= HEIGHT_FOR_TOP_BAR {
        let panel = egui::Panel::top("top bar").exact_size(top_bar::HEIGHT).frame(frame(PANEL));
        panel.show(ui, |ui| top_bar::show(ui, lab, &mut commands));
    }
    if size.y >= HEIGHT_FOR_FOOTER {
        let panel = egui::Panel::bottom("footer").exact_size(footer::HEIGHT).frame(frame(PANEL));
        panel.show(ui, |ui| footer::show(ui, lab));
    }
    if size.y >= HEIGHT_FOR_LANES {
        let height = lanes::height(lab).min(size.y * 0.4);
        let panel = egui::Panel::bottom("lanes").exact_size(height).frame(frame(PANEL));
        panel.show(ui, |ui| lanes::show(ui, lab, &mut commands));
    }
    if size.y >= HEIGHT_FOR_TIMELINE {
        let height = match size.y >= HEIGHT_FOR_TIMES {
            true => timeline::HEIGHT,
            false => timeline::HEIGHT_OF_TRACK,
        };
        let frame = frame(PANEL).inner_margin(Margin::symmetric(8, 1));
        let panel = egui::Panel::bottom("timeline").exact_size(height).frame(frame);
        panel.show(ui, |ui| timeline::show(ui, lab, &mut commands));
    }
    if size.x >= WIDTH_FOR_INSTRUMENTS {
        let width = size.x * INSTRUMENTS;
        let panel = egui::Panel::right("instruments").exact_size(width).frame(frame(BACKDROP));
        panel.show(ui, |ui| beside_the_stage(ui, lab, &mut commands));
    }
    let stage = ui.available_rect_before_wrap();
    if lab.display().help {
        help::show(ui, &mut commands);
    }
    if let Some(dialog) = lab.viewer().dialog() {
        opening::show(ui, lab, dialog, &mut commands);
    }
    (commands, stage)
}

/// The instruments; with the inspector open they keep the upper part, where there is room for both.
fn beside_the_stage(ui: &mut Ui, lab: &Lab, commands: &mut Vec<Command>) {
    let height = ui.available_height();
    if !lab.display().inspector {
        instruments::show(ui, lab, commands);
    } else if height < HEIGHT_FOR_INSPECTOR_BELOW {
        inspector::show(ui, lab, commands);
    } else {
        let panel = egui::Panel::bottom("inspector").default_size(height * INSPECTOR);
        let panel = panel.size_range(LEAST_BESIDE..=height - LEAST_BESIDE).resizable(true);
        let frame = Frame::new().inner_margin(Margin { top: 6, ..Margin::ZERO });
        panel.frame(frame).show(ui, |ui| inspector::show(ui, lab, commands));
        instruments::show(ui, lab, commands);
    }
}

pub(super) const BACKDROP: Color32 = Color32::from_rgb(8, 14, 23);
const PANEL: Color32 = Color32::from_rgb(16, 26, 40);
const RAISED: Color32 = Color32::from_rgb(29, 44, 65);
const HOVERED: Color32 = Color32::from_rgb(38, 58, 85);
const PRESSED: Color32 = Color32::from_rgb(46, 74, 108);
pub(super) const TEXT: Color32 = Color32::from_rgb(206, 218, 232);
pub(super) const QUIET: Color32 = Color32::from_rgb(138, 156, 180);
const WELL: Color32 = Color32::from_rgb(122, 204, 164);
const DOUBTFUL: Color32 = Color32::from_rgb(230, 190, 110);
pub(super) const ACCENT: Color32 = Color32::from_rgb(86, 180, 233);

/// The look of every widget: a night chart. Set once for each context.
pub(super) fn dress(ctx: &egui::Context) {
    ctx.set_theme(egui::Theme::Dark);
    let mut fonts = egui::FontDefinitions::default();
    if let Some(fallback) = fonts.families.get(&egui::FontFamily::Monospace).cloned()
        && let Some(faces) = fonts.families.get_mut(&egui::FontFamily::Proportional)
    {
        // The proportional face lacks arrows and raised signs.
        faces.extend(fallback);
    }
    ctx.set_fonts(fonts);
    ctx.all_styles_mut(|style| {
        // The same input makes the same frame, whenever it is drawn.
        style.animation_time = 0.0;
        style.visuals.text_cursor.blink = false;
        style.spacing.item_spacing = egui::vec2(6.0, 3.0);
        style.spacing.button_padding = egui::vec2(6.0, 2.0);
        for (text_style, size) in [
            (egui::TextStyle::Body, 12.5),
            (egui::TextStyle::Button, 12.5),
            (egui::TextStyle::Monospace, 12.0),
            (egui::TextStyle::Small, 10.5),
            (egui::TextStyle::Heading, 16.0),
        ] {
            if let Some(font) = style.text_styles.get_mut(&text_style) {
                font.size = size;
            }
        }
        let visuals = &mut style.visuals;
        visuals.panel_fill = PANEL;
        visuals.window_fill = PANEL;
        visuals.extreme_bg_color = BACKDROP;
        visuals.override_text_color = Some(TEXT);
        visuals.selection.bg_fill = Color32::from_rgb(38, 76, 110);
        visuals.selection.stroke = Stroke::new(1.0, ACCENT);
        visuals.widgets.noninteractive.bg_stroke = Stroke::new(1.0, RAISED);
        visuals.widgets.inactive.weak_bg_fill = RAISED;
        visuals.widgets.inactive.bg_fill = RAISED;
        for (widget, fill) in [
            (&mut visuals.widgets.hovered, HOVERED),
            (&mut visuals.widgets.active, PRESSED),
            (&mut visuals.widgets.open, RAISED),
        ] {
            widget.weak_bg_fill = fill;
            widget.bg_fill = fill;
            widget.bg_stroke = Stroke::new(1.0, ACCENT.gamma_multiply(0.6));
        }
        for widget in [
            &mut visuals.widgets.inactive,
            &mut visuals.widgets.hovered,
            &mut visuals.widgets.active,
            &mut visuals.widgets.open,
        ] {
            widget.corner_radius = CornerRadius::same(4);
        }
    });
}

fn frame(fill: Color32) -> Frame {
    Frame::new().fill(fill).inner_margin(Margin::symmetric(8, 4))
}

/// The colour of a verdict.
fn tone(word: Word) -> Color32 {
    match word.severity() {
        Severity::Fine => WELL,
        Severity::Doubtful => DOUBTFUL,
        Severity::Bad => colour(palette::ALARM),
        Severity::Unknown => QUIET,
    }
}
