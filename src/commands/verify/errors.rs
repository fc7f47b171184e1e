//! The reasons why a capture does not pass or cannot be judged.

use std::path::PathBuf;

use super::super::error::Cause;
use super::super::output::OutputError;
#[cfg(feature = "view")]
use super::pixels::PixelError;

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
    /// A report, or a line for people, could not be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The frames were not judged, or not drawn again.
    #[cfg(feature = "view")]
    #[error(transparent)]
    Pixels(#[from] PixelError),
    /// This build draws nothing.
    #[cfg(not(feature = "view"))]
    #[error("this build has no graphics; give --physics-only")]
    NoGraphics,
}

impl Cause for VerifyError {
    fn exit_code(&self) -> u8 {
        match self {
            VerifyError::Different { .. } => 1,
            VerifyError::Output(error) => error.exit_code(),
            #[cfg(feature = "view")]
            VerifyError::Pixels(error) => error.exit_code(),
            #[cfg(not(feature = "view"))]
            VerifyError::NoGraphics => 2,
            VerifyError::Unjudged { .. }
            | VerifyError::Format(_)
            | VerifyError::SameReport { .. }
            | VerifyError::ReportOverCapture { .. } => 2,
        }
    }
}
