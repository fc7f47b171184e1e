//! Formats of a table and of its picture. They follow from the names of the files.

use std::path::Path;

use crate::commands::argument::brief;
use crate::commands::error::Error;
use crate::commands::output::same_file_path;
use crate::commands::output::table::RowFormat;

/// Endings of file names that promise a picture.
const PICTURES: [&str; 21] = [
    "apng", "avi", "avif", "bmp", "gif", "jpeg", "jpg", "m4v", "mkv", "mov", "mp4", "mpeg", "mpg",
    "png", "rgba", "svg", "tif", "tiff", "webm", "webp", "y4m",
];

/// Endings of files that are not pictures. A capture never writes such files.
const NO_PICTURES: [&str; 11] =
    ["csv", "html", "json", "log", "md", "pdf", "sheet", "toml", "txt", "xml", "zip"];

/// Returns the file name's extension in lower case.
pub(super) fn ending(path: &Path) -> Option<String> {
    path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase)
}

/// Whether files with this ending are pictures.
pub(super) fn is_of_pictures(ending: &str) -> bool {
    PICTURES.contains(&ending)
}

/// Whether files with this ending are never pictures.
pub(super) fn holds_no_picture(ending: &str) -> bool {
    NO_PICTURES.contains(&ending)
}

/// Returns the error for a file name that promises another format than the requested one.
pub(super) fn mislabelled(path: &Path, remedy: &str) -> Error {
    Error::mistake(format!("{} would not hold what its name says; {remedy}", brief(path)))
}

/// Returns the requested format. Without a request, the format follows from the name of `out`, and is otherwise CSV.
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

/// Checks that a PNG file may be named `plot`. The name must end in .png or have no ending, and must differ from `out`.
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
