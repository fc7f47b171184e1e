//! Copies the instrument's values, and saves the instrument as a picture, a drawing and a table.

use std::path::PathBuf;

use super::App;
use crate::atomic_file::{IfExists, write_file};
use crate::lab::source_code::{Language, Precision};
use crate::lab::{Studio, source_code};
use crate::sim::integrators::Method;
use crate::view::{Gpu, OffscreenRenderer, Panels, instrument_csv, instrument_svg, png};

/// The size of the picture, in pixels, and its pixels per point.
const SIZE_PX: [u32; 2] = [1920, 1200];
const SCALE: f32 = 2.0;

impl App {
    /// Puts the values on the clipboard.
    pub(super) fn copy_instrument(&mut self) {
        let notice = match instrument_csv(&self.studio) {
            Some(lines) => {
                let rows = lines.len() - 1;
                match self.clipboard.set_text(lines.concat()) {
                    Ok(()) => format!("copied {rows} values as CSV"),
                    Err(reason) => format!("no clipboard: {reason}; Ctrl E saves the values"),
                }
            }
            None => "this instrument has no values to copy".into(),
        };
        self.studio.viewer_mut().set_notice(notice);
    }

    /// Puts the method at this index of the list on the clipboard, as source code.
    pub(super) fn copy_method(&mut self, entry: usize) {
        let language = self.studio.viewer().language();
        let Some(method) = self.studio.entries().get(entry).map(|spec| spec.method) else { return };
        self.studio.viewer_mut().set_notice(
            match source_code(method, language, Precision::Double) {
                Ok(code) => method_notice(self.clipboard.set_text(code), method, language),
                Err(refused) => refused.to_string(),
            },
        );
    }

    /// Puts the link to the run on the clipboard.
    pub(super) fn copy_link(&mut self) {
        let notice = match self.studio.link() {
            Ok(link) => match self.clipboard.set_text(link.clone()) {
                Ok(()) => format!("copied the run as a link of {} letters", link.len()),
                Err(reason) => format!(
                    "no clipboard: {reason}; Ctrl S saves the run, and `regatta link` prints it"
                ),
            },
            Err(error) => error.to_string(),
        };
        self.studio.viewer_mut().set_notice(notice);
        self.stand_still();
    }

    /// Puts the lines of code that tell an engine the displayed spring on the clipboard.
    pub(super) fn copy_joint(&mut self, entry: usize) {
        let Some(code) = self.studio.joint_code(entry) else { return };
        let method = self.studio.entries()[entry].method;
        self.studio.viewer_mut().set_notice(match self.clipboard.set_text(code) {
            Ok(()) => format!("copied the spring's settings of {}", method.name),
            Err(reason) => {
                format!("no clipboard: {reason}; `regatta port --to {}` prints them", method.id)
            }
        });
    }

    /// Saves three files under new names.
    pub(super) fn export_instrument(&mut self) {
        if let Some(canvas) = &self.canvas {
            let notice = save(&canvas.gpu, &self.studio);
            self.studio.viewer_mut().set_notice(notice);
        }
        self.stand_still();
    }
}

/// What is said of a method that was put on the clipboard, or was not.
fn method_notice(copied: Result<(), String>, method: &Method, language: Language) -> String {
    match copied {
        Ok(()) => format!("copied {} as {language}", method.name),
        Err(reason) => format!(
            "no clipboard: {reason}; `regatta show {} --as {}` prints it",
            method.id,
            language.id()
        ),
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
    let name = name(studio);
    let files = files.into_iter().filter_map(|(ending, bytes)| Some((ending, bytes?)));
    let written = files.map(|(ending, bytes)| {
        let path = format!("{name}.{ending}");
        write_file(path.as_ref(), &bytes, IfExists::Beside)
            .map_err(|error| format!("cannot write {path} here: {error}"))
    });
    written.collect()
}

/// A file name, without its ending, that says what the files show.
fn name(studio: &Studio) -> String {
    let instrument = studio.display().instrument.id();
    let scene = &studio.scene().name;
    match studio.loop_lab() {
        Some(loops) => {
            let ms = loops.now_ns() / 1_000_000;
            format!("regatta-{scene}-loops-{instrument}-at-{ms}-ms")
        }
        None => format!("regatta-{scene}-{instrument}-tick-{}", studio.race().tick()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::integrators::method;

    #[test]
    fn without_a_clipboard_a_notice_says_why_and_names_the_command_that_prints_the_method() {
        let rk4 = method("rk4").unwrap();
        let notice = method_notice(Err("there is no display".into()), rk4, Language::CSharp);
        let expected =
            "no clipboard: there is no display; `regatta show rk4 --as csharp` prints it";
        assert_eq!(notice, expected);
        assert_eq!(method_notice(Ok(()), rk4, Language::CSharp), "copied Runge-Kutta 4 as C#");
    }
}
