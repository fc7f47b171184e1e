//! Schedules the next frame.

use std::time::{Duration, Instant};

use winit::event_loop::{ActiveEventLoop, ControlFlow};

use super::{App, MAX_WAIT};

/// Frame rate in millihertz if neither the display nor the driver sets one.
const USUAL_REFRESH_MHZ: u32 = 60_000;

impl App {
    /// Requests the next frame `after` the start of this one, but no faster than the display shows frames.
    pub(super) fn schedule_frame(
        &mut self,
        event_loop: &ActiveEventLoop,
        began: Instant,
        after: Duration,
    ) {
        let Some(canvas) = &self.canvas else { return };
        let refresh = canvas.refresh_mhz.unwrap_or(USUAL_REFRESH_MHZ);
        // A driver that waits for the display has already used this time; a software driver and the processor have not.
        let shortest = Duration::from_secs_f64(1000.0 / f64::from(refresh)).mul_f64(0.95);
        match began.checked_add(shortest.max(after)) {
            Some(due) if due <= Instant::now() => {
                self.request_redraw();
                self.wait_for_event(event_loop);
            }
            Some(due) => event_loop.set_control_flow(ControlFlow::WaitUntil(due)),
            None => event_loop.set_control_flow(ControlFlow::Wait),
        }
    }

    /// Waits for an event, but at most for [`MAX_WAIT`] while time runs.
    pub(super) fn wait_for_event(&self, event_loop: &ActiveEventLoop) {
        event_loop.set_control_flow(if self.frames.studio.running() {
            ControlFlow::WaitUntil(Instant::now() + MAX_WAIT)
        } else {
            ControlFlow::Wait
        });
    }

    pub(super) fn request_redraw(&mut self) {
        if let Some(canvas) = &self.canvas {
            self.redraw_owed = true;
            canvas.window.request_redraw();
        }
    }

    pub(super) fn is_hidden(&self) -> bool {
        self.occluded || self.minimised
    }
}
