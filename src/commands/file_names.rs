//! Formats of a table and of its picture, from their file names.

use std::path::Path;

use crate::commands::argument::brief;
use crate::commands::error::Error;
use crate::commands::output::same_file_path;
use crate::commands::output::table::RowFormat;

/// File name endings that promise a picture. All others promise nothing.
const PICTURES: [&str; 21] = [
    "apng", "avi", "avif", "bmp", "gif", "jpeg", "jpg", "m4v", "mkv", "mov", "mp4", "mpeg", "mpg",
    "png", "rgba", "svg", "tif", "tiff", "webm", "webp", "y4m",
];

/// Endings of files without pictures, which a capture never writes.
#[cfg(feature = "view")]
const NO_PICTURES: [&str; 11] =
    ["csv", "html", "json", "log", "md", "pdf", "sheet", "toml", "txt", "xml", "zip"];

/// The file name's extension in lower case.
pub(super) fn ending(path: &Path) -> Option<String> {
    path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase)
}

/// Whether files with this ending hold pictures.
pub(super) fn is_of_pictures(ending: &str) -> bool {
    PICTURES.contains(&ending)
}

/// Whether files with this ending never hold pictures.
#[cfg(feature = "view")]
pub(super) fn holds_no_picture(ending: &str) -> bool {
    NO_PICTURES.contains(&ending)
}

/// The error for a file name that promises another format than the requested one.
pub(super) fn mislabelled(path: &Path, remedy: &str) -> Error {
    Error::mistake(format!("{} would not hold what its name says; {remedy}", brief(path)))
}

/// The requested format, else the one that the name of `out` implies, else CSV.
pub(super) fn row_format(out: &Path, asked: Option<RowFormat>) -> Result<RowFormat, Error> {
    let mislabelled = |remedy| Err(mislabelled(out, remedy));
    let ending = ending(out);
    let named = match ending.as_deref() {
        Some("csv") => Some(RowFormat::Csv),
        Some("json") => Some(RowFormat::Json),
        Some(ending) if is_of_pictures(ending) => {
            return mislabelled("give --out a name that ends in .csv or .json");
        }
        _ => None,
    };
    match (asked, named) {
        (Some(RowFormat::Csv), Some(RowFormat::Json)) => {
            mislabelled("give --out a name that ends in .csv, or --format json")
        }
        (Some(RowFormat::Json), Some(RowFormat::Csv)) => {
            mislabelled("give --out a name that ends in .json, or --format csv")
        }
        _ => Ok(asked.or(named).unwrap_or(RowFormat::Csv)),
    }
}

/// Checks that a PNG may be named `plot`: it ends in .png or has no ending, and differs from `out`.
pub(super) fn check_picture_name(plot: &Path, out: &Path) -> Result<(), Error> {
    match plot.extension() {
        Some(ending) if !ending.eq_ignore_ascii_case("png") => {
            let plot = brief(plot);
            let remedy = "give --plot a name that ends in .png";
            Err(Error::mistake(format!("{plot} would hold PNG; {remedy}")))
        }
        _ if same_file_path(plot) == same_file_path(out) => Err(Error::mistake(
            "rows and picture would go to the same place; give another --out or --plot",
        )),
        _ => Ok(()),
    }
}
