//! The error that ends a command, whatever its cause.

use annotate_snippets::{Group, Level, Renderer};

#[cfg(feature = "view")]
use crate::view::{GpuError, ReadbackError};
#[cfg(feature = "window")]
use crate::window::WindowError;

/// An error that can end a command. Each is declared beside the code that raises it.
pub trait Cause: std::error::Error + Send + Sync + 'static {
    /// The exit code of the process: 1 for a run that failed, 2 for a mistake in the request, 130 for an
    /// interrupt.
    fn exit_code(&self) -> u8;

    /// Whether the reader of the command's output closed the pipe.
    fn is_closed_pipe(&self) -> bool {
        false
    }

    /// The message as it is shown.
    fn report(&self, renderer: &Renderer) -> String {
        message(self, renderer)
    }
}

/// An error's message alone.
pub(super) fn message(error: &(impl std::error::Error + ?Sized), renderer: &Renderer) -> String {
    renderer.render(&[Group::with_title(Level::ERROR.primary_title(error.to_string()))])
}

/// The error that ends a command.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Error(Box<dyn Cause>);

impl Error {
    /// The exit code of the process: 1 for a run that failed, 2 for a mistake in the request, 130 for an
    /// interrupt.
    pub fn exit_code(&self) -> u8 {
        self.0.exit_code()
    }

    /// Whether the reader of the command's output closed the pipe.
    pub(super) fn is_closed_pipe(&self) -> bool {
        self.0.is_closed_pipe()
    }

    /// The message, with the lines of the scene file that it refers to.
    pub fn report(&self, renderer: &Renderer) -> String {
        self.0.report(renderer)
    }
}

impl<C: Cause> From<C> for Error {
    fn from(cause: C) -> Self {
        Self(Box::new(cause))
    }
}

#[cfg(feature = "view")]
impl Cause for GpuError {
    fn exit_code(&self) -> u8 {
        match self {
            GpuError::TooLarge { .. } | GpuError::Empty { .. } => 2,
            _ => 1,
        }
    }
}

#[cfg(feature = "view")]
impl Cause for ReadbackError {
    fn exit_code(&self) -> u8 {
        1
    }
}

#[cfg(feature = "window")]
impl Cause for WindowError {
    fn exit_code(&self) -> u8 {
        1
    }
}
