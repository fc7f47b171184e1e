//! What the names of a sweep's files promise.

use std::path::Path;

use super::SweepError;
use crate::commands::RowFormat;
use crate::commands::picture_format::{ending, is_of_pictures};

/// The format asked for, else the one that the name of `out` asks for, else CSV.
pub(super) fn row_format(out: &Path, asked: Option<RowFormat>) -> Result<RowFormat, SweepError> {
    let mislabelled = |remedy| Err(SweepError::Mislabelled { path: out.to_owned(), remedy });
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

/// Whether a PNG may have this name: one that ends in .png, or in nothing.
pub(super) fn check_picture_name(plot: &Path) -> Result<(), SweepError> {
    match plot.extension() {
        Some(ending) if !ending.eq_ignore_ascii_case("png") => {
            Err(SweepError::PictureMislabelled { path: plot.to_owned() })
        }
        _ => Ok(()),
    }
}
