//! A person's own methods, in files that end in `.step`.

use std::ffi::OsStr;
use std::path::Path;

use clap::builder::{PossibleValue, TypedValueParser};

use super::argument::brief;
use super::error::Error;
use super::id::{Id, METHOD};
use super::own_loop::{self, refusal};
use crate::loops::PolicyCard;
use crate::regular_file;
use crate::scene::{LaneSpec, MAX_FILE_BYTES};
use crate::sim::integrators::Method;

/// Parser for an id, or for the path of a `.step` file with a method.
#[derive(Clone, Copy)]
pub(super) struct OrStepFile<T: 'static> {
    pub(super) id: Id<T>,
    /// Converts a method to the type that is parsed.
    pub(super) of: fn(&'static Method) -> T,
    /// Converts the loop of a `.loop` file, if one is accepted.
    pub(super) of_loop: Option<fn(&'static PolicyCard) -> T>,
}

/// Parser for the id of a method, or for the path of a `.step` file.
pub(super) const METHOD_OR_FILE: OrStepFile<&Method> =
    OrStepFile { id: METHOD, of: |method| method, of_loop: None };

impl<T: Copy + Send + Sync + 'static> TypedValueParser for OrStepFile<T> {
    type Value = T;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<T, clap::Error> {
        let path = Path::new(value);
        let loaded = match self.of_loop.filter(|_| own_loop::is_loop(path)) {
            Some(of) => own_loop::load(path).map(of),
            None if !is_step(path) => return self.id.parse_ref(command, arg, value),
            None => load(path).map(self.of),
        };
        loaded.map_err(refusal)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.id.all)().into_iter().map(|(id, _)| PossibleValue::new(id))))
    }
}

/// Whether the name of a file promises the lines of a step.
pub(super) fn is_step(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("step"))
}

/// Loads a method from a file. The method is named after the file.
fn load(path: &Path) -> Result<&'static Method, Error> {
    let name = brief(path);
    let bytes = regular_file::read(path, MAX_FILE_BYTES).map_err(|error| {
        Error::mistake(match error.is_missing() {
            true => format!("no file is called {name:?}; give its path, or the id of a method"),
            false => format!("cannot read the method {name}: {error}"),
        })
    })?;
    Ok(LaneSpec::from_step(&name, &bytes)?.method)
}
