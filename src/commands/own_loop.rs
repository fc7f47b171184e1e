//! A person's own loops, in files that end in `.loop`.

use std::ffi::OsStr;
use std::path::Path;

use annotate_snippets::Renderer;
use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::ErrorKind;

use super::argument::{brief, number_that};
use super::error::Error;
use super::id::LOOP;
use crate::loops::{PolicyCard, own_loop};
use crate::regular_file;
use crate::scene::{MAX_FILE_BYTES, SceneErrors};

/// Parser for the id of a game loop, or for the path of a `.loop` file.
#[derive(Clone, Copy)]
pub(super) struct LoopOrFile;

impl TypedValueParser for LoopOrFile {
    type Value = &'static PolicyCard;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<Self::Value, clap::Error> {
        if !is_loop(Path::new(value)) {
            return LOOP.parse_ref(command, arg, value);
        }
        load(Path::new(value)).map_err(refusal)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((LOOP.all)().into_iter().map(|(id, _)| PossibleValue::new(id))))
    }
}

/// Returns the refusal of an argument for an error in its file.
pub(super) fn refusal(error: Error) -> clap::Error {
    let report = error.report(&Renderer::plain());
    let report = report.strip_prefix("error: ").unwrap_or(&report);
    clap::Error::raw(ErrorKind::ValueValidation, format!("{report}\n"))
}

/// Whether the name of a file promises the lines of a loop.
pub(super) fn is_loop(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("loop"))
}

/// Loads a loop from a file, which it is named after.
pub(super) fn load(path: &Path) -> Result<&'static PolicyCard, Error> {
    let name = brief(path);
    let bytes = regular_file::read(path, MAX_FILE_BYTES).map_err(|error| {
        Error::mistake(match error.is_missing() {
            true => format!("no file is called {name:?}; give its path, or the id of a loop"),
            false => format!("cannot read the loop {name}: {error}"),
        })
    })?;
    let text = String::from_utf8(bytes)
        .map_err(|_| Error::mistake(format!("the loop {name} is not text; save it as UTF-8")))?;
    let id = path.file_stem().unwrap_or_default().to_string_lossy();
    let card = own_loop(&id, &text);
    card.map_err(|fault| SceneErrors::of_step(&name, &text, fault).into())
}

/// Reads a constant of a loop and its number, such as `max_ticks=4`.
pub(super) fn setting(written: &str) -> Result<(String, f64), String> {
    let (name, value) =
        written.split_once('=').ok_or("write a constant and its number, such as max_ticks=4")?;
    Ok((name.trim().to_owned(), number_that(value, f64::is_finite, "a finite number")?))
}
