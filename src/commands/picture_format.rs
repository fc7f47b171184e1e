//! The formats that a capture writes, and the one that a file's name asks for.

use std::path::Path;

use clap::ValueEnum;

use super::STDOUT;
use crate::commands::error::Error;

/// How pictures are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PictureFormat {
    /// Numbered pictures and a manifest in a directory
    Png,
    /// One animated PNG
    Apng,
    /// One GIF, each frame with a palette of its own
    Gif,
    /// YUV4MPEG2, for a video encoder
    Y4m,
    /// Raw RGBA bytes, for a video encoder
    Rgba,
    /// One picture, time across, lanes down
    Sheet,
}

/// Players show a GIF's frame for two hundredths of a second at least.
const MAX_GIF_FPS: u32 = 50;

/// What files with these endings hold, of what a capture writes; other endings promise nothing.
const ENDINGS: &[(&str, &[PictureFormat])] = &[
    ("png", &[PictureFormat::Sheet, PictureFormat::Apng]),
    ("apng", &[PictureFormat::Apng]),
    ("gif", &[PictureFormat::Gif]),
    ("y4m", &[PictureFormat::Y4m]),
    ("rgba", &[PictureFormat::Rgba]),
    ("avi", &[]),
    ("avif", &[]),
    ("bmp", &[]),
    ("jpeg", &[]),
    ("jpg", &[]),
    ("m4v", &[]),
    ("mkv", &[]),
    ("mov", &[]),
    ("mp4", &[]),
    ("mpeg", &[]),
    ("mpg", &[]),
    ("svg", &[]),
    ("tif", &[]),
    ("tiff", &[]),
    ("webm", &[]),
    ("webp", &[]),
];

/// Endings of files that hold no pictures, and so of none that a capture writes.
const NO_PICTURES: &[&str] =
    &["csv", "html", "json", "log", "md", "pdf", "sheet", "toml", "txt", "xml", "zip"];

/// What a name ends in, after its last dot, in small letters.
pub(crate) fn ending(path: &Path) -> Option<String> {
    path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase)
}

/// Whether files with this ending hold pictures.
pub(crate) fn is_of_pictures(ending: &str) -> bool {
    ENDINGS.iter().any(|(known, _)| *known == ending)
}

/// The error of a name that promises another format than the one asked for.
pub(crate) fn mislabelled(path: &Path, remedy: &str) -> Error {
    Error::mistake(format!("{} would not hold what its name says; {remedy}", path.display()))
}

impl PictureFormat {
    /// The format asked for, else the one that the name of `out` asks for, else numbered pictures.
    pub(crate) fn of(out: &Path, asked: Option<Self>) -> Result<Self, Error> {
        let path = out.display();
        if out == Path::new(STDOUT) {
            return asked.filter(|format| *format != Self::Png).ok_or_else(|| {
                Error::mistake(
                    "numbered pictures need a directory; give --format y4m, rgba, apng, gif or sheet with --out -",
                )
            });
        }
        let ending = ending(out);
        let strange = |known: &&&str| ending.as_deref() == Some(**known);
        if let Some(ending) = NO_PICTURES.iter().find(strange) {
            return Err(Error::mistake(format!(
                "regatta capture writes no .{ending} files; give {path} without its ending for a directory, or a \
                 name that ends in .gif, .apng or .y4m, or in .png with --format sheet"
            )));
        }
        let known = ending.and_then(|ending| ENDINGS.iter().find(|(known, _)| *known == ending));
        match (asked, known) {
            (None, None) => Ok(Self::Png),
            (Some(asked), None) => Ok(asked),
            (Some(asked), Some((_, held))) if held.contains(&asked) => Ok(asked),
            (Some(asked), Some((_, held))) => {
                let name = |format: &Self| {
                    let value = format.to_possible_value().expect("every format has a name");
                    value.get_name().to_owned()
                };
                let of_name = held.first().map(|format| format!("--format {}", name(format)));
                let of_name = of_name.unwrap_or("--format y4m and a video encoder".into());
                let remedy = match asked {
                    Self::Png => format!("give the name of a directory, or {of_name}"),
                    Self::Sheet => format!("give a name that ends in .png, or {of_name}"),
                    _ => format!("give a name that ends in .{}, or {of_name}", name(&asked)),
                };
                Err(mislabelled(out, &remedy))
            }
            (None, Some((_, [held]))) => Ok(*held),
            (None, Some((ending, []))) => Err(Error::mistake(format!(
                "regatta writes no .{ending} files; give --format y4m --out -, and let a video encoder such as \
                 ffmpeg write {path}"
            ))),
            (None, Some(_)) => Err(Error::mistake(format!(
                "{path} is the name of one picture; give --format sheet or --format apng for one, or the name of \
                 a directory for numbered ones"
            ))),
        }
    }

    /// Fails if a run cannot be written at this many frames per second.
    pub(crate) fn check(self, fps: u32) -> Result<(), Error> {
        match self {
            PictureFormat::Gif if fps > MAX_GIF_FPS => Err(Error::mistake(format!(
                "a GIF has at most {MAX_GIF_FPS} frames a second, not {fps}; give a lower --fps"
            ))),
            _ => Ok(()),
        }
    }

    /// What a sheet wants instead of what all others do.
    pub(crate) fn or_sheet<T>(self, others: T, sheet: T) -> T {
        if self == PictureFormat::Sheet { sheet } else { others }
    }
}

#[cfg(test)]
mod tests {
    use super::PictureFormat::*;
    use super::*;

    #[test]
    fn a_name_asks_for_its_format_and_contradicts_others() {
        for (out, asked, expected) in [
            ("clip", None, Some(Png)),
            ("clip", Some(Gif), Some(Gif)),
            ("run.2026", None, Some(Png)),
            ("run.raw", Some(Rgba), Some(Rgba)),
            ("x.gif", None, Some(Gif)),
            ("x.GIF", None, Some(Gif)),
            ("x.apng", None, Some(Apng)),
            ("x.y4m", None, Some(Y4m)),
            ("x.rgba", None, Some(Rgba)),
            ("x.png", Some(Sheet), Some(Sheet)),
            ("x.png", Some(Apng), Some(Apng)),
            ("x.png", None, None),
            ("x.png", Some(Gif), None),
            ("x.png", Some(Png), None),
            ("x.gif", Some(Png), None),
            ("x.gif", Some(Sheet), None),
            ("x.mp4", None, None),
            ("x.txt", None, None),
            ("x.CSV", Some(Gif), None),
            ("x.sheet", Some(Sheet), None),
            ("x.mp4", Some(Y4m), None),
            ("-", Some(Y4m), Some(Y4m)),
            ("-", Some(Png), None),
            ("-", None, None),
        ] {
            assert_eq!(PictureFormat::of(Path::new(out), asked).ok(), expected, "{out} {asked:?}");
        }
    }
}
