//! A person's own methods and loops, in files that end in `.step` and in `.loop`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::argument::brief;
use super::error::Error;
use super::id::{Id, LOOP, METHOD, ends_in};
use crate::loops::{PolicyCard, own_loop};
use crate::regular_file;
use crate::scene::{LaneSpec, MAX_FILE_BYTES, SceneErrors};
use crate::sim::integrators::Method;

/// Parser for the id of a method, or for the path of a `.step` file.
pub(super) const METHOD_OR_FILE: Id<&Method> = Id { files: &[(STEP, load_method)], ..METHOD };

/// A method that an option names, and its file if it is a person's own.
pub(super) type NamedMethod = (&'static Method, Option<PathBuf>);

/// Parser as [`METHOD_OR_FILE`], which keeps the path.
pub(super) const NAMED_METHOD: Id<NamedMethod> = Id {
    lists: METHOD.lists,
    spellings: METHOD.spellings,
    files: &[(STEP, |path| Ok((load_method(path)?, Some(path.to_owned()))))],
    ..Id::new(METHOD.thing, || {
        (METHOD.all)().into_iter().map(|(id, method)| (id, (method, None))).collect()
    })
};

/// Parser for the id of a game loop, or for the path of a `.loop` file.
pub(super) const LOOP_OR_FILE: Id<Arc<PolicyCard>> = Id { files: &[(FRAMES, load_loop)], ..LOOP };

/// Ending of a file with the lines of a step, and of one with those of a loop.
pub(super) const STEP: &str = "step";
pub(super) const FRAMES: &str = "loop";

/// Whether the name of a file promises the lines of a step.
pub(super) fn is_step(path: &Path) -> bool {
    ends_in(path, STEP)
}

/// Loads a method from a file. The method is named after the file.
pub(super) fn load_method(path: &Path) -> Result<&'static Method, Error> {
    let (name, bytes) = read(path, "method")?;
    Ok(LaneSpec::from_step(&name, &bytes)?.method)
}

/// Loads a loop from a file, which it is named after.
pub(super) fn load_loop(path: &Path) -> Result<Arc<PolicyCard>, Error> {
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
