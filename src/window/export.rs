//! Copied texts and saved files: the instrument as a picture, a drawing and a table, a screenshot, the run as a scene
//! file.

use std::path::PathBuf;

use super::App;
use crate::atomic_file::{IfExists, write_file};
use crate::studio::{DriverRequest, Studio, instrument_file_name, picture_file_name};
use crate::view::{
    FrameSizeError, OffscreenRenderer, Panels, clipboard_text, instrument_csv, instrument_svg, png,
};

/// Size of the picture in pixels, and its pixels per point.
const SIZE_PX: [u32; 2] = [1920, 1200];
const SCALE: f32 = 2.0;

impl App {
    /// Copies the requested text to the clipboard, if the request is one to copy.
    pub(super) fn copy(&mut self, request: DriverRequest) {
        let Some(copied) = clipboard_text(&self.frames.studio, request) else { return };
        let notice = match copied {
            Ok(copied) => copied.notice(self.clipboard.set_text(copied.text.clone())),
            Err(refused) => refused,
        };
        self.frames.studio.viewer.set_notice(notice);
        self.stand_still();
    }

    /// Saves the instrument in up to three files with new names.
    pub(super) fn export_instrument(&mut self) {
        let notice = save(&self.frames.studio);
        self.frames.studio.viewer.set_notice(notice);
        self.stand_still();
    }
}

/// Saves the files. Returns a notice with their names or the error.
fn save(studio: &Studio) -> String {
    match try_save(studio) {
        Ok(paths) => {
            let names: Vec<_> = paths.iter().map(|path| path.display().to_string()).collect();
            format!("saved {}", names.join(", "))
        }
        Err(reason) => format!("nothing saved: {reason}"),
    }
}

/// Saves a picture and a table, and a drawing if the instrument's plots can be drawn.
fn try_save(studio: &Studio) -> Result<Vec<PathBuf>, String> {
    let csv = instrument_csv(studio).ok_or("this instrument has no plots")?;
    let png = picture(SIZE_PX, SCALE, Panels::Instrument, studio, None)?;
    let svg = instrument_svg(studio).map(String::into_bytes);
    let files = [("png", Some(png)), ("svg", svg), ("csv", Some(csv.concat().into_bytes()))];
    let name = instrument_file_name(studio);
    let files = files.into_iter().filter_map(|(ending, bytes)| Some((ending, bytes?)));
    files.map(|(ending, bytes)| write(&format!("{name}.{ending}"), &bytes)).collect()
}

/// Writes a file of this name, or of a free one beside it, and returns its path.
fn write(name: &str, bytes: &[u8]) -> Result<PathBuf, String> {
    write_file(name.as_ref(), bytes, IfExists::Beside)
        .map_err(|error| format!("cannot write {name} here: {error}"))
}

/// Saves a picture of the studio in the window's size under a new name. Returns a notice with the name or the error.
pub(super) fn save_screenshot(size_px: [u32; 2], scale: f32, studio: &Studio) -> String {
    match screenshot(size_px, scale, studio) {
        Ok(path) => format!("saved {}", path.display()),
        Err(reason) => format!("no screenshot: {reason}"),
    }
}

fn screenshot(size_px: [u32; 2], scale: f32, studio: &Studio) -> Result<PathBuf, String> {
    let picture = picture(size_px, scale, Panels::Shown, studio, None)?;
    write(&format!("{}.png", picture_file_name(studio)), &picture)
}

/// Saves a screenshot that carries the recording of the run. Returns a notice with its name or the error.
pub(super) fn save_report(size_px: [u32; 2], scale: f32, studio: &Studio) -> String {
    let saved = || {
        let recording = studio.deck.recording().map_err(|error| error.to_string())?;
        let report = picture(size_px, scale, Panels::Shown, studio, Some(&recording))?;
        write(&format!("{}-report.png", picture_file_name(studio)), &report)
    };
    match saved() {
        Ok(path) => format!(
            "Saved {0}, with the run in it. Attach it to an issue, or open it here",
            path.display()
        ),
        Err(reason) => format!("no report: {reason}"),
    }
}

/// Draws the studio into a PNG file, which carries the recording.
fn picture(
    size_px: [u32; 2],
    scale: f32,
    shown: Panels,
    studio: &Studio,
    recording: Option<&str>,
) -> Result<Vec<u8>, String> {
    let no_room = |error: FrameSizeError| error.to_string();
    let mut renderer = OffscreenRenderer::new(size_px, scale).map_err(no_room)?.with_panels(shown);
    let mut rgba = renderer.buffer().map_err(no_room)?;
    renderer.draw(studio, &mut rgba).map_err(|error| error.to_string())?;
    Ok(match recording {
        Some(recording) => png::encode_report(size_px, &rgba, recording),
        None => png::encode(size_px, &rgba),
    })
}

/// Saves the run so far as a scene file under a new name. Returns a notice with the name or the error.
pub(super) fn save_recording(studio: &mut Studio) -> String {
    let text = studio.deck.recording().map_err(|error| error.to_string());
    let name = studio.deck.recording_file_name();
    match text.and_then(|text| write(&name, text.as_bytes())) {
        Ok(path) => {
            studio.deck.note_saved();
            format!("Saved {0}. Check it with: regatta verify {0}", path.display())
        }
        Err(reason) => format!("no recording: {reason}"),
    }
}
