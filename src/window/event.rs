//! The events that reach the window from outside the window system.

use std::path::PathBuf;

use egui_winit::accesskit_winit;

use crate::lab::{Findings, LaneSpec, Scene};

/// An event from the program's own threads or from AccessKit.
pub(super) enum Event {
    /// A screen reader asks for something.
    Accessibility(accesskit_winit::Event),
    /// The analysis has found more.
    Analysed(Findings),
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

impl From<accesskit_winit::Event> for Event {
    fn from(event: accesskit_winit::Event) -> Self {
        Event::Accessibility(event)
    }
}
