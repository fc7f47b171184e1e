//! What a failure to use a file or a directory means for whoever named it.

use std::io;
use std::path::{Path, PathBuf};

use crate::commands::error::Cause;

/// The system refused to do something with a file or a directory.
#[derive(Debug, thiserror::Error)]
#[error("cannot {doing} {}: {source}{}", .path.display(), remedy(.source, .option))]
pub(crate) struct FileError {
    /// What was tried.
    pub(crate) doing: &'static str,
    /// On what.
    pub(crate) path: PathBuf,
    /// What names it on the command line, such as `--out`.
    pub(crate) option: &'static str,
    /// What the system said.
    pub(crate) source: io::Error,
}

impl FileError {
    /// Turns what the system says into an error about `path`, which `option` names.
    pub(crate) fn of(
        doing: &'static str,
        path: &Path,
        option: &'static str,
    ) -> impl Fn(io::Error) -> Self + use<> {
        let path = path.to_owned();
        move |source| Self { doing, path: path.clone(), option, source }
    }
}

impl Cause for FileError {
    fn exit_code(&self) -> u8 {
        1
    }
}

fn remedy(error: &io::Error, option: &str) -> String {
    match error.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            format!("; free some space, or give another {option}")
        }
        io::ErrorKind::NotFound => format!("; give another {option}, in a directory that is there"),
        _ => format!("; give another {option} that you may write to"),
    }
}
