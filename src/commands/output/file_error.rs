//! The error of using a file or a directory, with the option that named it and a remedy.

use std::io;
use std::path::{Path, PathBuf};

use crate::commands::error::Cause;

/// The system refused an operation on a file or a directory.
#[derive(Debug, thiserror::Error)]
#[error("cannot {doing} {}: {source}{}", .path.display(), remedy(.source, .option))]
pub(crate) struct FileError {
    /// The operation, such as `write`.
    pub(crate) doing: &'static str,
    /// The file or directory.
    pub(crate) path: PathBuf,
    /// The option that names it, such as `--out`.
    pub(crate) option: &'static str,
    /// The system's error.
    pub(crate) source: io::Error,
}

impl FileError {
    /// A conversion of the system's errors about `path`, which `option` names.
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
