//! Pixels: a graphics device, what it draws on, and the way back from there.
//!
//! Colours are blended
//! as they are stored, in gamma space, so all targets have a format without `Srgb` in its name.

mod gpu;
mod offscreen;
mod readback;
mod screen;
#[cfg(test)]
mod testing;

pub use gpu::{AdapterPreference, Gpu, GpuError};
pub use offscreen::Offscreen;
pub use readback::{Readback, ReadbackError};
pub use screen::Screen;
