//! Pixels: a graphics device, the pipelines that draw a [`Picture`](crate::stage::Picture), and the one function that
//! draws a frame.
//!
//! A window, a screenshot and a capture all call [`FrameRenderer::draw`] on a texture view. They differ in the source
//! of that view and in the destination of its pixels. Colours are blended as they are stored, in gamma space, so all
//! targets have a format without `Srgb` in its name.

mod backdrop;
mod chart;
mod copying;
mod frame;
mod gpu;
mod keyboard;
#[cfg(test)]
mod legibility;
mod lines;
mod mesh_buffer;
mod meshes;
mod offscreen_renderer;
mod panels;
pub mod png;
mod readback;
mod screen;
mod screen_transform;
mod sea;
mod shapes;
mod stage;
mod strokes;
#[cfg(test)]
mod testing;
mod textures;
mod theme;
mod touch;

/// The crates in this module's signatures, in their versions.
pub use {egui, wgpu};

pub use chart::AxisScale;
pub use chart::figure::{Axis, Chart, Figure, FigureCurve, Legend};
pub use copying::{ClipboardText, clipboard_text};
pub use frame::{FrameOutput, FrameRenderer, LaidOutFrame};
pub use gpu::{AdapterPreference, Gpu, GpuError};
pub use keyboard::{Meaning, Modifiers, bound_key, command_of};
pub use offscreen_renderer::{Offscreen, OffscreenRenderer};
pub use panels::Panels;
pub use readback::{Readback, ReadbackError};
pub use screen::Screen;

/// The values of the selected instrument, as lines of comma-separated text under a heading; `None` if it has no
/// plots.
pub fn instrument_csv(studio: &crate::studio::Studio) -> Option<Vec<String>> {
    panels::csv(studio)
}

/// The verdict on the active method and the status line, as sentences for a screen reader.
pub fn spoken(studio: &crate::studio::Studio) -> String {
    panels::spoken(studio)
}

/// The plots of the selected instrument as an SVG file; `None` if it has none.
pub fn instrument_svg(studio: &crate::studio::Studio) -> Option<String> {
    panels::svg(studio)
}
