//! Pixels: the one function that makes the [`Drawing`] of a frame, and the executors that draw it.
//!
//! A window, a screenshot and a capture all call [`FrameRenderer::draw`]. They differ in the executor of the drawing
//! and in the destination of its pixels. Colours are blended as they are stored, in gamma space, so all textures to
//! draw on have a format without `Srgb` in its name.

// The rules of a room: see `src/lib.rs` and clippy.toml.
#![warn(clippy::exit, clippy::print_stderr, clippy::print_stdout)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

use regatta_look as look;
use regatta_loops as loops;
use regatta_measure as measure;
use regatta_run as run;
use regatta_scene as scene;
use regatta_stage as stage;
use regatta_studio as studio;
use regatta_tools as tools;

mod backdrop;
mod chart;
mod copying;
mod cpu_executor;
mod drawing;
mod frame;
mod gpu;
mod gpu_executor;
mod keyboard;
mod lines;
mod meshes;
mod offscreen_renderer;
mod panels;
mod pipelines;
mod pixel_difference;
pub mod png;
mod readback;
mod screen;
mod screen_transform;
mod shapes;
mod stage_area;
mod strokes;
mod theme;
mod touch;

/// The crates in this module's signatures, in their versions.
pub use {egui, wgpu};

pub use chart::AxisScale;
pub use chart::figure::{Axis, Chart, Figure, FigureCurve, Legend, span};
pub use copying::{ClipboardText, clipboard_text};
pub use cpu_executor::{CpuExecutor, KeptFrame, Rasterizer, letter_instructions};
pub use drawing::Drawing;
pub use frame::{FrameOutput, FrameRenderer, LaidOutFrame};
pub use gpu::{Gpu, GpuError, RendererChoice};
pub use gpu_executor::GpuExecutor;
pub use keyboard::{Meaning, Modifiers, bound_key, command_of};
pub use offscreen_renderer::{FrameSizeError, OffscreenRenderer, PreparedFrame};
pub use panels::Panels;
pub use pixel_difference::{PixelDifference, PixelLimits};
pub use readback::{Readback, ReadbackError};
pub use screen::Screen;

/// The values of the selected instrument, as lines of comma-separated text under a heading; `None` if it has no
/// plots.
pub fn instrument_csv(studio: &studio::Studio) -> Option<Vec<String>> {
    panels::csv(studio)
}

/// The verdict on the active method and the status line, as sentences for a screen reader.
pub fn spoken(studio: &studio::Studio) -> String {
    panels::spoken(studio)
}

/// The plots of the selected instrument as an SVG file; `None` if it has none.
pub fn instrument_svg(studio: &studio::Studio) -> Option<String> {
    panels::svg(studio)
}

/// Whole frames, and the tools of the tests of this room.
#[cfg(test)]
mod tests {
    mod legibility;
    pub(crate) mod testing;
}
