//! The events that reach the window from outside the window system.

use std::path::PathBuf;

#[cfg(feature = "accessibility")]
use super::screen_reader::Request;
use crate::lab::{Findings, FoundLoop, LaneSpec, Scene};

/// An event from the program's own threads or from a screen reader.
pub(super) enum Event {
    /// A screen reader asks for something.
    #[cfg(feature = "accessibility")]
    ScreenReader(Request),
    /// The analysis has found more.
    Analysed(Findings),
    /// A loop of the loop lab was run.
    LoopRun(FoundLoop),
    /// The ticks of these lanes were timed: nanoseconds per tick, `None` of a lane that halted.
    TicksTimed(Vec<(LaneSpec, Option<f64>)>),
    /// Ctrl-C was pressed in the terminal.
    Interrupted,
    /// A watched scene file has changed; `read` is what it holds now.
    FileChanged { path: PathBuf, read: Result<(Scene, String), String> },
    /// A watched scene file cannot be read any more.
    FileGone(PathBuf),
    /// A scene file that was gone exists again, unchanged.
    FileBack(PathBuf),
}
