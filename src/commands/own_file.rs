//! A person's own methods and loops, in files that end in `.step` and in `.loop`.

use std::ffi::OsStr;
use std::path::Path;

use annotate_snippets::Renderer;
use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::ErrorKind;

use super::argument::brief;
use super::error::Error;
use super::id::{Id, LOOP, METHOD};
use crate::loops::{PolicyCard, own_loop};
use crate::regular_file;
use crate::scene::{LaneSpec, MAX_FILE_BYTES, SceneErrors};
use crate::sim::integrators::Method;

/// An ending of files, and the function that loads a value from such a file.
type Loader<T> = (&'static str, fn(&Path) -> Result<T, Error>);

/// Parser for an id, or for the path of a file that a person wrote.
#[derive(Clone, Copy)]
pub(super) struct IdOrFile<T: 'static> {
    pub(super) id: Id<T>,
    pub(super) files: &'static [Loader<T>],
}

/// Parser for the id of a method, or for the path of a `.step` file.
pub(super) const METHOD_OR_FILE: IdOrFile<&Method> =
    IdOrFile { id: METHOD, files: &[(STEP, load_method)] };

/// Parser for the id of a game loop, or for the path of a `.loop` file.
pub(super) const LOOP_OR_FILE: IdOrFile<&PolicyCard> =
    IdOrFile { id: LOOP, files: &[(FRAMES, load_loop)] };

/// Ending of a file with the lines of a step, and of one with those of a loop.
pub(super) const STEP: &str = "step";
pub(super) const FRAMES: &str = "loop";

impl<T: Copy + Send + Sync + 'static> TypedValueParser for IdOrFile<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<T, clap::Error> {
        let path = Path::new(value);
        match self.files.iter().find(|(ending, _)| ends_in(path, ending)) {
            Some((_, load)) => load(path).map_err(refusal),
            None => self.id.parse_ref(command, arg, value),
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.id.possible_values()
    }
}

/// Whether the name of a file promises the lines of a step.
pub(super) fn is_step(path: &Path) -> bool {
    ends_in(path, STEP)
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// Loads a method from a file. The method is named after the file.
pub(super) fn load_method(path: &Path) -> Result<&'static Method, Error> {
    let (name, bytes) = read(path, "method")?;
    Ok(LaneSpec::from_step(&name, &bytes)?.method)
}

/// Loads a loop from a file, which it is named after.
pub(super) fn load_loop(path: &Path) -> Result<&'static PolicyCard, Error> {
    let (name, bytes) = read(path, "loop")?;
    let text = String::from_utf8(bytes)
        .map_err(|_| Error::mistake(format!("the loop {name} is not text; save it as UTF-8")))?;
    let id = path.file_stem().unwrap_or_default().to_string_lossy();
    let card = own_loop(&id, &text);
    card.map_err(|fault| SceneErrors::of_step(&name, &text, fault).into())
}

/// Returns the name of a file for messages, and its bytes.
fn read(path: &Path, thing: &str) -> Result<(String, Vec<u8>), Error> {
    let name = brief(path);
    let bytes = regular_file::read(path, MAX_FILE_BYTES).map_err(|error| {
        Error::mistake(match error.is_missing() {
            true => format!("no file is called {name:?}; give its path, or the id of a {thing}"),
            false => format!("cannot read the {thing} {name}: {error}"),
        })
    })?;
    Ok((name, bytes))
}

/// Returns the refusal of an argument for an error in its file.
fn refusal(error: Error) -> clap::Error {
    let report = error.report(&Renderer::plain());
    let report = report.strip_prefix("error: ").unwrap_or(&report);
    clap::Error::raw(ErrorKind::ValueValidation, format!("{report}\n"))
}
