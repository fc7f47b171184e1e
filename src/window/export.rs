//! Copies what a person asks for, and saves the instrument as a picture, a drawing and a table.

use std::path::PathBuf;

use super::App;
use crate::atomic_file::{IfExists, write_file};
use crate::studio::{DriverRequest, Studio, instrument_file_name};
use crate::view::{Gpu, OffscreenRenderer, Panels, copied, instrument_csv, instrument_svg, png};

/// The size of the picture, in pixels, and its pixels per point.
const SIZE_PX: [u32; 2] = [1920, 1200];
const SCALE: f32 = 2.0;

impl App {
    /// Puts what is asked for on the clipboard, if it is something to copy.
    pub(super) fn copy(&mut self, request: DriverRequest) {
        let Some(copied) = copied(&self.frames.studio, request) else { return };
        let notice = match copied {
            Ok(copied) => copied.notice(self.clipboard.set_text(copied.text.clone())),
            Err(refused) => refused,
        };
        self.frames.studio.viewer.set_notice(notice);
        self.stand_still();
    }

    /// Saves three files under new names.
    pub(super) fn export_instrument(&mut self) {
        if let Some(canvas) = &self.canvas {
            let notice = save(&canvas.gpu, &self.frames.studio);
            self.frames.studio.viewer.set_notice(notice);
        }
        self.stand_still();
    }
}

/// Saves the files, and returns a notice with their names or the error.
fn save(gpu: &Gpu, studio: &Studio) -> String {
    match try_save(gpu, studio) {
        Ok(paths) => {
            let names: Vec<_> = paths.iter().map(|path| path.display().to_string()).collect();
            format!("saved {}", names.join(", "))
        }
        Err(reason) => format!("nothing saved: {reason}"),
    }
}

/// Saves a picture and a table, and a drawing of an instrument whose plots can be drawn.
fn try_save(gpu: &Gpu, studio: &Studio) -> Result<Vec<PathBuf>, String> {
    let csv = instrument_csv(studio).ok_or("this instrument has no plots")?;
    let mut rgba = Vec::new();
    OffscreenRenderer::new(gpu.clone(), SIZE_PX, SCALE)
        .map_err(|error| error.to_string())?
        .with_panels(Panels::Instrument)
        .draw(studio, &mut rgba)
        .map_err(|error| error.to_string())?;
    let png = png::encode(SIZE_PX, &rgba);
    let svg = instrument_svg(studio).map(String::into_bytes);
    let files = [("png", Some(png)), ("svg", svg), ("csv", Some(csv.concat().into_bytes()))];
    let name = instrument_file_name(studio);
    let files = files.into_iter().filter_map(|(ending, bytes)| Some((ending, bytes?)));
    let written = files.map(|(ending, bytes)| {
        let path = format!("{name}.{ending}");
        write_file(path.as_ref(), &bytes, IfExists::Beside)
            .map_err(|error| format!("cannot write {path} here: {error}"))
    });
    written.collect()
}
