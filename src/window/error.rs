//! The errors of opening and running the window.

use crate::view::GpuError;

/// The reason why the window could not be opened or was lost.
#[derive(Debug, thiserror::Error)]
pub enum WindowError {
    /// There is no display to open a window on.
    #[error("no display to open a window on: {0}")]
    NoDisplay(String),
    /// The window system refused.
    #[error("the window system refused: {0}")]
    Refused(String),
    /// The window system refused a picture drawn by the processor.
    #[error(
        "the window system takes no picture by the processor: {0}; give it a display of 24 bits a pixel, or draw \
         without a window: regatta capture"
    )]
    NoPicture(String),
    /// The window system ended before the window.
    #[error("the connection to the window system was lost")]
    Lost,
    /// There is no graphics device for the window.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// The message of the window system, without the place in winit's source that winit puts before it. winit's error
/// gives no other access to the message.
pub(super) fn reason(error: &dyn std::error::Error) -> String {
    let text = error.to_string();
    let said = match text.split_once(": ") {
        Some((place, said)) if place.starts_with("os error at ") => said,
        _ => &text,
    };
    said.trim_end_matches('.').into()
}
