//! One frame: lays out the panels, composes the stage in the room they leave, and makes a drawing of the stage with
//! the panels over it.
//!
//! The panels go first because they determine the size of the picture.

use std::time::Duration;

use super::backdrop::BackdropFinder;
use super::chart::figure::{self, Figure};
use super::drawing::Drawing;
use super::meshes::draw_panels;
use super::panels::{self, Panels};
use super::stage_area::{Stage, draw_stage};
use super::theme::{self, auto_zoom, colour};
use super::touch::Touch;
use crate::stage;
use crate::stage::{Align, Label};
use crate::studio::{Command, Studio, ViewCommand};

/// Offsets of a label's copies that form its halo, in points.
const HALO: [[f32; 2]; 4] = [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];

/// Work left to the caller to show a frame.
#[must_use]
pub struct FrameOutput {
    /// Its pixels, for an executor.
    pub drawing: Drawing,
    /// Cursor shape, clipboard, accessibility tree.
    pub platform: egui::PlatformOutput,
    /// Delay until egui needs the next frame; [`Duration::MAX`] if nothing changes.
    pub repaint_delay: Duration,
}

/// A frame after its layout and before its drawing.
#[must_use]
pub struct LaidOutFrame {
    panels: egui::FullOutput,
    stage: Option<Stage>,
}

/// Makes the drawings of frames.
pub struct FrameRenderer {
    context: egui::Context,
    shown: Panels,
    backdrops: BackdropFinder,
    touch: Touch,
    max_texture_side_px: u32,
}

impl FrameRenderer {
    /// Creates a renderer for executors whose textures have at most this number of pixels on a side.
    pub fn new(max_texture_side_px: u32) -> Self {
        let context = egui::Context::default();
        theme::apply_style(&context);
        // Draws discs as polygons: those in the atlas would need filtering.
        context.tessellation_options_mut(|options| options.prerasterized_discs = false);
        Self {
            context,
            shown: Panels::Shown,
            backdrops: BackdropFinder::default(),
            touch: Touch::default(),
            max_texture_side_px,
        }
    }

    /// Sets which panels the renderer shows. The default is [`Panels::Shown`].
    pub fn with_panels(self, shown: Panels) -> Self {
        Self { shown, ..self }
    }

    /// The panels that the renderer shows.
    pub fn panels(&self) -> Panels {
        self.shown
    }

    /// The egui context of the panels, for their style and for translating a window's events.
    pub fn context(&self) -> &egui::Context {
        &self.context
    }

    /// The drawing of the studio on `size_px` pixels at `scale` pixels per point. Also returns the commands that the
    /// panels issued. Overwrites the size fields of `input`.
    pub fn draw(
        &mut self,
        size_px: [u32; 2],
        scale: f32,
        input: egui::RawInput,
        studio: &Studio,
    ) -> (Vec<Command>, FrameOutput) {
        let (commands, layout) = self.lay_out(size_px, scale, input, studio);
        (commands, self.paint(size_px, layout))
    }

    /// The first half of [`draw`](Self::draw): lays out the panels and composes the picture of the stage.
    pub fn lay_out(
        &mut self,
        size_px: [u32; 2],
        scale: f32,
        input: egui::RawInput,
        studio: &Studio,
    ) -> (Vec<Command>, LaidOutFrame) {
        let mut commands = Vec::new();
        theme::show(&self.context, studio.display(), size_px.map(|side| side as f32 / scale));
        let shown = self.shown;
        let mut touch = std::mem::take(&mut self.touch);
        let layout = self.lay_out_with(size_px, scale, input, |ui| {
            let was_down = studio.viewer.pointer_is_down();
            let is_down = ui.input(|input| input.pointer.any_down()) || panels::is_sweep_active(ui);
            if is_down && !was_down {
                commands.push(Command::View(ViewCommand::PointerDown(true)));
            }
            let rect = match shown {
                Panels::Shown => {
                    let (asked, rect) = panels::show(ui, studio);
                    commands.extend(asked);
                    rect
                }
                Panels::Off => ui.max_rect(),
                Panels::Instrument => {
                    panels::show_instrument(ui, studio);
                    return None;
                }
            };
            let size = rect.size().max(egui::Vec2::ZERO);
            let picture = stage::compose(studio, size.into());
            touch.show(ui, rect, &picture, studio, &mut commands);
            if was_down && !is_down {
                commands.push(Command::View(ViewCommand::PointerDown(false)));
            }
            Some(Stage { rect, picture })
        });
        self.touch = touch;
        (commands, layout)
    }

    /// The second half of [`draw`](Self::draw): makes the drawing of a layout.
    pub fn paint(&mut self, size_px: [u32; 2], layout: LaidOutFrame) -> FrameOutput {
        let LaidOutFrame { panels, stage } = layout;
        let px_per_point = panels.pixels_per_point;
        let textures = panels.textures_delta.into();
        let mut drawing = Drawing { size_px, textures, ..Drawing::default() };
        if let Some(stage) = stage {
            draw_stage(&mut drawing, &mut self.backdrops, stage, px_per_point);
        }
        let meshes = self.context.tessellate(panels.shapes, px_per_point);
        draw_panels(&mut drawing, &meshes, px_per_point);
        let repaint_delay = panels
            .viewport_output
            .get(&egui::ViewportId::ROOT)
            .map_or(Duration::MAX, |viewport| viewport.repaint_delay);
        FrameOutput { drawing, platform: panels.platform_output, repaint_delay }
    }

    /// The drawing of a diagram on `size_px` pixels at `scale` pixels per point.
    pub fn draw_figure(&mut self, size_px: [u32; 2], scale: f32, figure: &Figure) -> Drawing {
        theme::set_zoom(&self.context, auto_zoom(size_px.map(|side| side as f32 / scale)));
        let input = egui::RawInput::default();
        let layout = self.lay_out_with(size_px, scale, input, |ui| {
            figure::show(ui, figure);
            None
        });
        self.paint(size_px, layout).drawing
    }

    /// Lays out panels and a stage.
    ///
    /// `show` lays out the panels and returns the stage that they leave. egui may call it twice for a frame, when a
    /// widget first has to learn its size. Only the first call gets events, so a caller must accumulate commands over
    /// the calls.
    fn lay_out_with(
        &mut self,
        size_px: [u32; 2],
        scale: f32,
        input: egui::RawInput,
        mut show: impl FnMut(&mut egui::Ui) -> Option<Stage>,
    ) -> LaidOutFrame {
        let mut stage = None;
        let input = self.sized_input(size_px, scale, input);
        let panels = self.context.run_ui(input, |ui| {
            stage = show(ui);
            if let Some(Stage { rect, picture }) = &stage {
                let painter = ui.painter().with_clip_rect(*rect);
                picture.labels.iter().for_each(|label| write(&painter, *rect, label));
            }
        });
        LaidOutFrame { panels, stage }
    }

    fn sized_input(
        &self,
        size_px: [u32; 2],
        scale: f32,
        mut input: egui::RawInput,
    ) -> egui::RawInput {
        let scale_with_zoom = scale * self.context.zoom_factor();
        let size_points = egui::vec2(size_px[0] as f32, size_px[1] as f32) / scale_with_zoom;
        input.viewport_id = egui::ViewportId::ROOT;
        input.screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, size_points));
        input.max_texture_side = Some(self.max_texture_side_px as usize);
        let viewport = input.viewports.entry(egui::ViewportId::ROOT).or_default();
        viewport.native_pixels_per_point = Some(scale);
        input
    }
}

pub(super) fn write(painter: &egui::Painter, stage: egui::Rect, label: &Label) {
    let anchor = match label.align {
        Align::Left => egui::Align2::LEFT_CENTER,
        Align::Centre => egui::Align2::CENTER_CENTER,
        Align::Right => egui::Align2::RIGHT_CENTER,
    };
    let font = match label {
        Label { is_code: true, .. } => egui::FontId::monospace(label.size),
        Label { is_strong: true, .. } => theme::strong_font(label.size),
        _ => egui::FontId::proportional(label.size),
    };
    let inked = colour(label.colour);
    let text = painter.layout_no_wrap(label.text.clone(), font, inked);
    let at = stage.min + egui::Vec2::from(label.at);
    let corner = anchor.anchor_size(at, text.size()).min;
    if label.halo[3] > 0 {
        let halo = colour(label.halo);
        for offset in HALO {
            let corner = corner + egui::Vec2::from(offset);
            painter.galley_with_override_text_color(corner, text.clone(), halo);
        }
    }
    painter.galley(corner, text, inked);
}

#[cfg(test)]
mod tests;
