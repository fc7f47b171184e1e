//! Shared test code: drawn pixels, and frames of panels.

use std::num::NonZero;

use egui::epaint::TextShape;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Ui, Vec2};

use crate::backdrop::BackdropFinder;
use crate::panels::RING;
use crate::stage::{Picture, Rect};
use crate::stage_area::Stage;
use crate::stage_area::draw_stage;
use crate::studio::{Command, Studio};
use crate::{CpuExecutor, Drawing, panels, theme};

/// Tightly packed RGBA rows.
pub(crate) struct Pixels {
    pub(crate) size_px: [u32; 2],
    pub(crate) rows: Vec<u8>,
}

impl Pixels {
    pub(crate) fn at(&self, x: u32, y: u32) -> [u8; 4] {
        let first = 4 * (y * self.size_px[0] + x) as usize;
        self.rows[first..first + 4].try_into().expect("four bytes are four bytes")
    }

    /// Number of pixels that are not black.
    pub(crate) fn count_lit(&self) -> usize {
        self.rows.chunks_exact(4).filter(|pixel| pixel[..3] != [0, 0, 0]).count()
    }

    /// The sum of a channel over all pixels, 1 for a full one.
    pub(crate) fn sum(&self, channel: usize) -> f32 {
        self.rows.iter().skip(channel).step_by(4).map(|&value| f32::from(value) / 255.0).sum()
    }
}

/// Draws a picture alone on black, with a stage that fills the target at `scale` pixels per point.
pub(crate) fn draw_picture(size_px: [u32; 2], scale: f32, picture: &Picture) -> Pixels {
    let drawing = stage_alone(&mut BackdropFinder::default(), size_px, scale, picture);
    paint(&mut executor(), &drawing)
}

pub(crate) fn executor() -> CpuExecutor {
    CpuExecutor::new(NonZero::<usize>::MIN)
}

/// The pixels of the next drawing of an executor's renderer.
pub(crate) fn paint(executor: &mut CpuExecutor, drawing: &Drawing) -> Pixels {
    let mut rows = Vec::new();
    executor.execute(drawing, &mut rows);
    Pixels { size_px: drawing.size_px, rows }
}

/// The drawing of a picture alone, with a stage that fills the target at `scale` pixels per point.
pub(crate) fn stage_alone(
    backdrops: &mut BackdropFinder,
    size_px: [u32; 2],
    scale: f32,
    picture: &Picture,
) -> Drawing {
    let size = egui::vec2(size_px[0] as f32, size_px[1] as f32) / scale;
    let rect = egui::Rect::from_min_size(Pos2::ZERO, size);
    let mut drawing = Drawing { size_px, ..Drawing::default() };
    draw_stage(&mut drawing, backdrops, Stage { rect, picture: picture.clone() }, scale);
    drawing
}

/// A clip rectangle that clips nothing.
pub(crate) const EVERYWHERE: Rect = Rect { min: [-1e4; 2], max: [1e4; 2] };

/// A window of this size in points. It lays frames out without drawing them.
///
/// `egui_kittest` finds the texts of a screen reader. These tests instead judge every painted text with its place and
/// its clip, and point at places of plots.
pub(crate) struct TestWindow {
    pub(crate) context: Context,
    pub(crate) size: Vec2,
    /// Time of the last frame, and time between frames, in seconds.
    pub(crate) time_s: f64,
    pub(crate) frame_s: f64,
}

impl TestWindow {
    pub(crate) fn new(size: impl Into<Vec2>) -> Self {
        let context = Context::default();
        theme::apply_style(&context);
        Self { context, size: size.into(), time_s: 0.0, frame_s: 1.0 / 60.0 }
    }

    /// Lays out a frame after these events. Returns the result of `layout`, and the texts of the frame.
    pub(crate) fn show<T>(
        &mut self,
        events: Vec<Event>,
        mut layout: impl FnMut(&mut Ui) -> T,
    ) -> (T, Shown) {
        self.time_s += self.frame_s;
        let screen_rect = Some(egui::Rect::from_min_size(Pos2::ZERO, self.size));
        let time = Some(self.time_s);
        let input = RawInput { screen_rect, events, time, ..RawInput::default() };
        let mut made = None;
        let mut output = self.context.run_ui(input, |ui| made = Some(layout(ui)));
        output.textures_delta.clear();
        let mut shown = Shown { texts: Vec::new(), rings: Vec::new(), heard: Vec::new() };
        for clipped in output.shapes {
            collect(clipped.shape, clipped.clip_rect, &mut shown);
        }
        let update = output.platform_output.accesskit_update.take();
        let nodes = update.into_iter().flat_map(|update| update.nodes);
        let heard = nodes.filter_map(|(_, node)| Some(node.label().or(node.value())?.to_owned()));
        shown.heard.extend(heard);
        (made.expect("a frame is laid out"), shown)
    }

    /// Lays out all panels after these events. Returns their commands and the texts of the frame.
    pub(crate) fn panels(&mut self, studio: &Studio, events: Vec<Event>) -> (Vec<Command>, Shown) {
        self.show(events, |ui| panels::show(ui, studio).0)
    }

    /// The commands of the panels in the frames of a click.
    pub(crate) fn click(&mut self, studio: &Studio, at: Pos2) -> Vec<Command> {
        let frames = [Event::PointerMoved(at), button(at, true), button(at, false)];
        frames.into_iter().flat_map(|event| self.panels(studio, vec![event]).0).collect()
    }
}

/// A press or a release of the first mouse button.
pub(crate) fn button(pos: Pos2, pressed: bool) -> Event {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    Event::PointerButton { pos, button, pressed, modifiers }
}

/// Texts of a frame, and the output for a screen reader if the window's context has it enabled.
pub(crate) struct Shown {
    pub(crate) texts: Vec<ShownText>,
    /// Visible parts of the rings around the focused widget.
    pub(crate) rings: Vec<egui::Rect>,
    pub(crate) heard: Vec<String>,
}

/// A text and its clip.
pub(crate) struct ShownText {
    pub(crate) shape: TextShape,
    pub(crate) clip: egui::Rect,
}

impl ShownText {
    fn placed(&self) -> (egui::Rect, String) {
        (self.shape.visual_bounding_rect(), self.shape.galley.text().to_owned())
    }
}

impl Shown {
    /// Every text, with its place.
    pub(crate) fn all(&self) -> Vec<(egui::Rect, String)> {
        self.texts.iter().map(ShownText::placed).collect()
    }

    /// Every text that is not clipped, with its place.
    pub(crate) fn whole(&self) -> Vec<(egui::Rect, String)> {
        let is_whole = |text: &&ShownText| {
            text.clip.expand(0.5).contains_rect(text.shape.visual_bounding_rect())
        };
        self.texts.iter().filter(is_whole).map(ShownText::placed).collect()
    }

    /// The words of every text.
    pub(crate) fn words(&self) -> Vec<String> {
        self.all().into_iter().map(|(_, words)| words).collect()
    }
}

fn collect(shape: egui::Shape, clip: egui::Rect, shown: &mut Shown) {
    match shape {
        egui::Shape::Vec(all) => all.into_iter().for_each(|shape| collect(shape, clip, shown)),
        egui::Shape::Text(shape) => shown.texts.push(ShownText { shape, clip }),
        egui::Shape::Rect(shape) if shape.stroke.width == RING => {
            shown.rings.push(shape.rect.intersect(clip));
        }
        _ => {}
    }
}
