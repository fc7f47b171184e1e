//! Pixels: a graphics device, the pipelines that draw a [`Picture`](crate::lab::picture::Picture),
//! and the one function that draws a frame.
//!
//! A window, a screenshot and a capture all call [`FrameRenderer::draw`] on a texture view; what
//! differs between them is where that view comes from and where its pixels go. Colours are blended
//! as they are stored, in gamma space, so all targets have a format without `Srgb` in its name.

mod artist;
mod bands;
mod curves;
mod figure;
mod frame;
mod gpu;
mod lines;
mod meshes;
mod offscreen;
mod panels;
mod place;
mod plot;
pub mod png;
mod quads;
mod readback;
mod ribbons;
mod screen;
mod sea;
mod stage;
mod strips;
mod strokes;
#[cfg(test)]
mod testing;
mod ticks;
mod touch;
mod triangles;

pub use artist::Artist;
pub use figure::{Axis, Chart, Figure, FigureCurve, Legend, Marks};
pub use frame::{FrameOutput, FrameRenderer};
pub use gpu::{AdapterPreference, Gpu, GpuError};
pub use offscreen::Offscreen;
pub use panels::Panels;
pub use readback::{Readback, ReadbackError};
pub use screen::Screen;
