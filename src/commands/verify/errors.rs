//! The reasons why a capture does not pass or cannot be judged.

use std::path::PathBuf;

use super::super::error::Cause;
use super::super::frame_folder::FrameFolderError;
use super::super::output::{FileError, OutputError};
use super::super::recording::RecordingError;

/// The reason why a capture does not pass or cannot be judged.
#[derive(Debug, thiserror::Error)]
pub(in crate::commands) enum VerifyError {
    /// The capture is not reproduced.
    #[error("{what} differ from {}; if that is meant, --bless", .manifest.display())]
    Different {
        /// Physics, pixels or both.
        what: &'static str,
        /// The manifest of the capture.
        manifest: PathBuf,
    },
    /// The capture cannot be judged.
    #[error("cannot judge {}: {reason}", .manifest.display())]
    Unjudged {
        /// The manifest of the capture.
        manifest: PathBuf,
        /// The reason.
        reason: String,
    },
    /// `--report` names an unknown format.
    #[error("no report format is called {0:?}; give junit or json")]
    Format(String),
    /// Two reports would go to the same file.
    #[error("two reports would go to {}; give each a file of its own", .path.display())]
    SameReport {
        /// The file.
        path: PathBuf,
    },
    /// A report would replace a frame or a manifest.
    #[error("{} is a file of a capture; give another --report", .path.display())]
    ReportOverCapture {
        /// The file.
        path: PathBuf,
    },
    /// Pictures of differences would replace the frames.
    #[error("{} holds the frames that are judged; give another --diff", .path.display())]
    DifferencesAmongFrames {
        /// The folder.
        path: PathBuf,
    },
    /// Pictures of differences would replace the frames of another capture.
    #[error("{} holds another capture; give another --diff", .path.display())]
    DifferencesInCapture {
        /// The folder.
        path: PathBuf,
    },
    /// A report, or a line for people, could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// A difference could not be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A folder cannot take what would be written there.
    #[error(transparent)]
    Folder(#[from] FrameFolderError),
    /// The frames could not be drawn.
    #[error("the pixels cannot be judged: {0}")]
    Capture(#[from] RecordingError),
    /// The frames could not be drawn again.
    #[error("not blessed: {0}")]
    Bless(RecordingError),
}

impl Cause for VerifyError {
    fn exit_code(&self) -> u8 {
        match self {
            VerifyError::Different { .. } | VerifyError::File(_) => 1,
            VerifyError::Output(error) => error.exit_code(),
            VerifyError::Folder(error) => error.exit_code(),
            VerifyError::Bless(error) => error.exit_code(),
            VerifyError::Capture(RecordingError::Interrupted(_)) => 130,
            VerifyError::Unjudged { .. }
            | VerifyError::Format(_)
            | VerifyError::SameReport { .. }
            | VerifyError::ReportOverCapture { .. }
            | VerifyError::DifferencesAmongFrames { .. }
            | VerifyError::DifferencesInCapture { .. }
            | VerifyError::Capture(_) => 2,
        }
    }
}
