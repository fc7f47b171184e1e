//! Saves a picture of the studio in the size of the window. It is drawn to a texture of its own, because a surface may
//! not be readable.

use std::path::PathBuf;

use crate::atomic_file::{IfExists, write_file};
use crate::studio::{Studio, picture_file_name};
use crate::view::{Gpu, OffscreenRenderer, png};

/// Saves a picture under a new name, and returns a notice with the name or the error.
pub(super) fn save(gpu: &Gpu, size_px: [u32; 2], scale: f32, studio: &Studio) -> String {
    match try_save(gpu, size_px, scale, studio) {
        Ok(path) => format!("saved {}", path.display()),
        Err(reason) => format!("no screenshot: {reason}"),
    }
}

fn try_save(gpu: &Gpu, size_px: [u32; 2], scale: f32, studio: &Studio) -> Result<PathBuf, String> {
    let mut rgba = Vec::new();
    OffscreenRenderer::new(gpu.clone(), size_px, scale)
        .map_err(|error| error.to_string())?
        .draw(studio, &mut rgba)
        .map_err(|error| error.to_string())?;
    let path = format!("{}.png", picture_file_name(studio));
    write_file(path.as_ref(), &png::encode(size_px, &rgba), IfExists::Beside)
        .map_err(|error| format!("cannot write {path} here: {error}"))
}
