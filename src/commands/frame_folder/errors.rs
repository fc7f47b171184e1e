//! The errors of writing frames to a folder.

use std::path::PathBuf;

use crate::commands::error::Cause;
use crate::commands::output::FileError;

/// The reason why frames cannot be written to a folder.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FrameFolderError {
    /// The path is that of a file or another thing that is no directory.
    #[error("{} is not a directory; give another --out", .path.display())]
    NotADirectory {
        /// The path.
        path: PathBuf,
    },
    /// The folder is in use.
    #[error(
        "{} is not empty; give another --out, or --force to replace the frames in it",
        .path.display()
    )]
    NotEmpty {
        /// The folder.
        path: PathBuf,
    },
    /// Another process writes there.
    #[error("another regatta is writing to {}; wait until it has finished, or give another {option}", .path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
        /// What names it on the command line.
        option: &'static str,
    },
    /// A file has the name of a frame or of the manifest, and no capture made it.
    #[error(
        "{} was not made by regatta and is not replaced; move it away, or give another {option}",
        .path.display()
    )]
    NotOurs {
        /// The file.
        path: PathBuf,
        /// What names its folder on the command line.
        option: &'static str,
    },
    /// The system refused.
    #[error(transparent)]
    File(#[from] FileError),
}

impl Cause for FrameFolderError {
    fn exit_code(&self) -> u8 {
        match self {
            FrameFolderError::File(_) => 1,
            _ => 2,
        }
    }
}
