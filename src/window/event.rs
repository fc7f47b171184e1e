//! The events that reach the window from outside the window system.

use std::path::PathBuf;

use winit::event_loop::ActiveEventLoop;

use super::App;
use super::opening::ReadFile;
use super::screen_reader::{self, Request};
use crate::scene::{LaneSpec, Scene, SceneErrors};
use crate::studio::{Dialog, Found, file_is_back, file_is_gone, open_advised_spring};

/// An event from the program's own threads or from a screen reader.
pub(super) enum Event {
    /// A request from a screen reader.
    ScreenReader(Request),
    /// A worker has found something.
    Found(Found),
    /// Timings of these lanes in nanoseconds per tick; `None` for a lane that halted.
    TicksTimed(Vec<(LaneSpec, Option<f64>)>),
    /// Advice on the spring that a person has described, as a scene.
    SpringAdvised(Box<Result<Scene, SceneErrors>>),
    /// Work on a separate thread met a bug, which this sentence describes. The thread goes on.
    WorkFailed(String),
    /// Ctrl-C was pressed in the terminal.
    Interrupted,
    /// The reason why the growing run is not recorded.
    NotRecorded(String),
    /// A requested file has been read.
    FileRead(ReadFile),
    /// A watched scene file can no longer be read.
    FileGone(PathBuf),
    /// A missing scene file exists again, unchanged.
    FileBack(PathBuf),
}

impl From<Request> for Event {
    fn from(request: Request) -> Self {
        Self::ScreenReader(request)
    }
}

impl From<Found> for Event {
    fn from(found: Found) -> Self {
        Self::Found(found)
    }
}

impl App {
    /// Handles the event.
    pub(super) fn handle(&mut self, event_loop: &ActiveEventLoop, event: Event) {
        match event {
            Event::ScreenReader(request) => {
                if let Some(canvas) = &mut self.canvas {
                    screen_reader::answer_request(&mut canvas.egui, request);
                    self.request_redraw();
                }
            }
            Event::Interrupted => {
                self.interrupted = true;
                self.end(event_loop, Ok(()));
            }
            Event::Found(found) => {
                self.frames.studio.accept(found);
                if !self.frames.studio.running() {
                    self.request_redraw();
                }
            }
            Event::SpringAdvised(scene) => {
                // If the dialog was closed meanwhile, the advice is no longer wanted.
                if matches!(self.frames.studio.viewer.dialog(), Some(Dialog::Spring { .. })) {
                    open_advised_spring(&mut self.frames.studio, *scene);
                    self.stand_still();
                    self.request_redraw();
                }
            }
            Event::WorkFailed(sentence) => {
                self.frames.studio.viewer.set_notice(sentence);
                self.request_redraw();
            }
            Event::NotRecorded(reason) => {
                self.frames
                    .studio
                    .viewer
                    .set_notice(format!("The recording cannot be saved as it grows: {reason}"));
                self.request_redraw();
            }
            Event::TicksTimed(times) => {
                self.frames.studio.viewer.tick_times = times;
                if !self.frames.studio.running() {
                    self.request_redraw();
                }
            }
            Event::FileRead(found) => {
                found.show(&mut self.frames.studio);
                // Simulate neither the time that this took nor that of its first frame.
                self.frames.skip_time();
                self.request_redraw();
            }
            Event::FileGone(path) => {
                file_is_gone(&mut self.frames.studio, &path);
                self.request_redraw();
            }
            Event::FileBack(path) => {
                file_is_back(&mut self.frames.studio, &path);
                self.request_redraw();
            }
        }
    }
}
