//! The formats of a capture, and the choice of a format by the name of a file.

use std::path::Path;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use super::argument::brief;
use super::error::Error;
use super::file_names::{ending, holds_no_picture, is_of_pictures, mislabelled};
use super::movie::{self, Begin};
use super::output::STDOUT;
use Writing::{Folder, Movie, Sheet};

/// The kind of output that a capture writes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Writing {
    /// One picture for each frame, in a directory.
    Folder,
    /// One picture with all frames.
    Sheet,
    /// All frames in one stream.
    Movie(Begin),
}

#[derive(Debug)]
pub(super) struct PictureFormat {
    /// The value of `--format` that selects the format.
    pub(super) id: &'static str,
    about: &'static str,
    /// Endings of the names of files in this format.
    endings: &'static [&'static str],
    /// Maximum number of frames per second in this format.
    max_fps: Option<u32>,
    pub(super) writing: Writing,
}

pub(super) static FORMATS: [PictureFormat; 4] = [
    format("png", "Numbered pictures and a manifest in a directory", &[], Folder),
    PictureFormat {
        // Players show each frame for at least two hundredths of a second.
        max_fps: Some(50),
        ..format("gif", "One GIF, each frame with its own palette", &["gif"], Movie(movie::gif))
    },
    format("y4m", "YUV4MPEG2, for a video encoder", &["y4m"], Movie(movie::y4m)),
    format("sheet", "One picture, time across, lanes down", &["png"], Sheet),
];

const fn format(
    id: &'static str,
    about: &'static str,
    endings: &'static [&'static str],
    writing: Writing,
) -> PictureFormat {
    PictureFormat { id, about, endings, max_fps: None, writing }
}

/// Returns a parser for the id of a format, which offers all ids for shell completion.
pub(super) fn by_id() -> impl TypedValueParser<Value = &'static PictureFormat> {
    let ids = FORMATS.iter().map(|format| PossibleValue::new(format.id).help(format.about));
    PossibleValuesParser::new(ids).map(|id| PictureFormat::find(&id).expect("no other is taken"))
}

impl PictureFormat {
    fn find(id: &str) -> Option<&'static Self> {
        FORMATS.iter().find(|format| format.id == id)
    }

    /// Returns the requested format. Without a request, the format follows from the name of `out`, and is otherwise
    /// numbered pictures.
    pub(super) fn of(out: &Path, asked: Option<&'static Self>) -> Result<&'static Self, Error> {
        let path = brief(out);
        if out == Path::new(STDOUT) {
            return asked.filter(|format| !matches!(format.writing, Folder)).ok_or_else(|| {
                Error::mistake(
                    "numbered pictures need a directory; give --format y4m, gif or sheet with --out -",
                )
            });
        }
        let ending = ending(out);
        let Some(ending) = ending.as_deref() else { return Ok(asked.unwrap_or(&FORMATS[0])) };
        if holds_no_picture(ending) {
            return Err(Error::mistake(format!(
                "regatta capture writes no .{ending} files; give {path} without its ending for a directory, or a \
                 name that ends in .gif, .y4m or .png"
            )));
        }
        if !is_of_pictures(ending) {
            return Ok(asked.unwrap_or(&FORMATS[0]));
        }
        let held = FORMATS.iter().find(|format| format.endings.contains(&ending));
        match (asked, held) {
            (Some(asked), Some(held)) if asked.id == held.id => Ok(asked),
            (Some(asked), held) => {
                let of_name = held.map(|format| format!("--format {}", format.id));
                let of_name = of_name.unwrap_or("--format y4m and a video encoder".into());
                let remedy = match asked.endings {
                    [] => format!("give the name of a directory, or {of_name}"),
                    [ending, ..] => format!("give a name that ends in .{ending}, or {of_name}"),
                };
                Err(mislabelled(out, &remedy))
            }
            (None, Some(held)) => Ok(held),
            (None, None) => Err(Error::mistake(format!(
                "regatta writes no .{ending} files; give --format y4m --out -, and let a video encoder such as \
                 ffmpeg write {path}"
            ))),
        }
    }

    /// Fails if the format cannot show `fps` frames per second.
    pub(super) fn check(&self, fps: u32) -> Result<(), Error> {
        match self.max_fps {
            Some(most) if fps > most => Err(Error::mistake(format!(
                "a {} has at most {most} frames a second, not {fps}; give a lower --fps",
                self.id.to_uppercase()
            ))),
            _ => Ok(()),
        }
    }

    pub(super) fn is_sheet(&self) -> bool {
        matches!(self.writing, Sheet)
    }

    /// Returns `sheet` for a sheet, and `others` for every other format.
    pub(super) fn or_sheet<T>(&self, others: T, sheet: T) -> T {
        if self.is_sheet() { sheet } else { others }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_name_sets_its_format_and_must_not_contradict_it() {
        for (out, asked, expected) in [
            ("clip", None, Some("png")),
            ("clip", Some("gif"), Some("gif")),
            ("run.2026", None, Some("png")),
            ("run.raw", Some("y4m"), Some("y4m")),
            ("x.gif", None, Some("gif")),
            ("x.GIF", None, Some("gif")),
            ("x.apng", None, None),
            ("x.y4m", None, Some("y4m")),
            ("x.png", Some("sheet"), Some("sheet")),
            ("x.png", None, Some("sheet")),
            ("x.png", Some("gif"), None),
            ("x.png", Some("png"), None),
            ("x.gif", Some("png"), None),
            ("x.gif", Some("sheet"), None),
            ("x.mp4", None, None),
            ("x.txt", None, None),
            ("x.CSV", Some("gif"), None),
            ("x.sheet", Some("sheet"), None),
            ("x.mp4", Some("y4m"), None),
            ("-", Some("y4m"), Some("y4m")),
            ("-", Some("png"), None),
            ("-", None, None),
        ] {
            let format = asked.map(|id| PictureFormat::find(id).unwrap());
            let found = PictureFormat::of(Path::new(out), format).ok().map(|format| format.id);
            assert_eq!(found, expected, "{out} {asked:?}");
        }
    }
    #[test]
    fn every_format_extension_is_a_picture_extension() {
        for ending in FORMATS.iter().flat_map(|format| format.endings) {
            assert!(is_of_pictures(ending) && !holds_no_picture(ending), "{ending}");
        }
    }
}
