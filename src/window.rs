//! The window: real time, keys, a surface to draw on. The only place that reads a wall clock to
//! drive a [`Lab`].
//!
//! A frame is drawn when something changed: always while time runs, and after an event while it is
//! paused. A window that is hidden draws nothing and keeps simulating.

use std::sync::Arc;
use std::time::{Duration, Instant};

use egui_winit::accesskit_winit;
use winit::application::ApplicationHandler;
use winit::event::{ElementState, KeyEvent, StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::{Fullscreen, Window, WindowId};

use crate::lab::{Ask, Command, Lab, command_for};
use crate::view::GpuError;

mod canvas;
mod keys;
mod pace;
mod screenshot;

use canvas::{Canvas, Drawn};
use pace::Meter;

/// Between ticks of a hidden window: well inside the clock's longest frame, so that none is dropped.
const HIDDEN_FRAME: Duration = Duration::from_millis(100);
/// The frame rate where neither the display nor the driver sets one.
const USUAL_REFRESH_MHZ: u32 = 60_000;
/// The first frame of a window and the first after a pause count as this long: how long it really was
/// says nothing about the simulation.
const FIRST_FRAME: Duration = Duration::ZERO;

/// Why the window could not be opened or kept.
#[derive(Debug, thiserror::Error)]
pub enum WindowError {
    /// There is no display to open a window on.
    #[error("no display to open a window on: {0}")]
    NoDisplay(String),
    /// The window system refused.
    #[error("the window system refused: {0}")]
    Refused(String),
    /// There is no graphics device for the window.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// Opens a window on `lab` and runs it until it is closed, or until `seconds` of simulated time.
///
/// # Errors
/// [`WindowError::NoDisplay`] before anything else is tried; the others at any time.
pub fn run(lab: Lab, seconds: Option<f64>) -> Result<(), WindowError> {
    let event_loop = EventLoop::<accesskit_winit::Event>::with_user_event()
        .build()
        .map_err(|error| WindowError::NoDisplay(reason(&error)))?;
    let mut app = App {
        lab,
        seconds,
        proxy: event_loop.create_proxy(),
        canvas: None,
        asked: Vec::new(),
        shift: false,
        other_modifier: false,
        last_frame: None,
        hidden: false,
        meter: Meter::default(),
        title: String::new(),
        screenshot: false,
        started: Instant::now(),
        outcome: Ok(()),
    };
    event_loop.run_app(&mut app).map_err(|error| WindowError::Refused(reason(&error)))?;
    app.outcome
}

/// What the window system said, without the place in winit's source that winit puts before it.
fn reason(error: &dyn std::error::Error) -> String {
    let text = error.to_string();
    let said = match text.split_once(": ") {
        Some((place, said)) if place.starts_with("os error at ") => said,
        _ => &text,
    };
    said.trim_end_matches('.').into()
}

struct App {
    lab: Lab,
    /// When to end, in simulated seconds.
    seconds: Option<f64>,
    proxy: EventLoopProxy<accesskit_winit::Event>,
    canvas: Option<Canvas>,
    /// Commands for the beginning of the next frame.
    asked: Vec<Command>,
    shift: bool,
    /// Control, Alt or Super: a chord with them is not ours.
    other_modifier: bool,
    /// When the last frame began; `None` where time did not run.
    last_frame: Option<Instant>,
    hidden: bool,
    meter: Meter,
    title: String,
    screenshot: bool,
    started: Instant,
    outcome: Result<(), WindowError>,
}

impl App {
    /// One frame: events → commands → lab → picture → screen.
    fn frame(&mut self, event_loop: &ActiveEventLoop) {
        let now = Instant::now();
        self.simulate(event_loop, now);
        let Some(canvas) = &mut self.canvas else { return };
        let title = self.lab.title();
        if title != self.title {
            canvas.window.set_title(&title);
            self.title = title;
        }
        if self.hidden {
            return;
        }
        if std::mem::take(&mut self.screenshot) {
            let Canvas { window, gpu, .. } = canvas;
            let size = window.inner_size();
            let scale = window.scale_factor() as f32;
            let notice = screenshot::save(gpu, [size.width, size.height], scale, &self.lab);
            self.lab.set_notice(notice);
        }
        match canvas.draw(&self.lab) {
            Ok(Drawn::Shown { commands, repaint_after }) => {
                if self.meter.first_frame() {
                    log::info!("first frame after {} ms", self.started.elapsed().as_millis());
                }
                self.meter.frame(now, self.lab.race().t());
                let again = self.lab.running()
                    || self.lab.is_thinking()
                    || !commands.is_empty()
                    || self.screenshot;
                self.asked.extend(commands);
                self.schedule(event_loop, now, if again { Duration::ZERO } else { repaint_after });
            }
            Ok(Drawn::Skipped) => self.wait(event_loop, now + HIDDEN_FRAME),
            Err(error) => self.end(event_loop, Err(error)),
        }
    }

    /// Applies what was asked for and steps what is due.
    fn simulate(&mut self, event_loop: &ActiveEventLoop, now: Instant) {
        for command in std::mem::take(&mut self.asked) {
            match self.lab.apply(command) {
                Some(Ask::Quit) => self.end(event_loop, Ok(())),
                Some(Ask::Screenshot) => self.screenshot = true,
                Some(Ask::ToggleFullScreen) => self.toggle_full_screen(),
                None => {}
            }
        }
        let frame = self.last_frame.map_or(FIRST_FRAME, |last| now.duration_since(last));
        self.last_frame = self.lab.running().then_some(now);
        self.lab.advance(i64::try_from(frame.as_nanos()).unwrap_or(i64::MAX));
        if let Some(pace) = self.meter.pace() {
            self.lab.set_pace(pace);
        }
        if self.seconds.is_some_and(|seconds| self.lab.race().t() >= seconds) {
            self.end(event_loop, Ok(()));
        }
    }

    /// Asks for the next frame: at the display's pace if `after` is over by then.
    fn schedule(&self, event_loop: &ActiveEventLoop, began: Instant, after: Duration) {
        let Some(canvas) = &self.canvas else { return };
        let refresh = canvas.refresh_mhz.unwrap_or(USUAL_REFRESH_MHZ);
        // A driver that waits for the display has used this time up already; a software one has not.
        let shortest = Duration::from_secs_f64(1000.0 / f64::from(refresh)).mul_f64(0.95);
        match began.checked_add(shortest.max(after)) {
            Some(due) if due <= Instant::now() => canvas.window.request_redraw(),
            Some(due) => self.wait(event_loop, due),
            None => event_loop.set_control_flow(ControlFlow::Wait),
        }
    }

    fn wait(&self, event_loop: &ActiveEventLoop, until: Instant) {
        event_loop.set_control_flow(ControlFlow::WaitUntil(until));
    }

    fn toggle_full_screen(&self) {
        if let Some(Canvas { window, .. }) = &self.canvas {
            let full = window.fullscreen().is_none().then_some(Fullscreen::Borderless(None));
            window.set_fullscreen(full);
        }
    }

    fn end(&mut self, event_loop: &ActiveEventLoop, outcome: Result<(), WindowError>) {
        self.outcome = outcome;
        event_loop.exit();
    }

    fn key(&mut self, event: &KeyEvent, taken_by_widget: bool) {
        if event.state != ElementState::Pressed || self.other_modifier {
            return;
        }
        let Some(key) = keys::key(event, self.shift) else { return };
        // A widget with the focus is worked by these; all other keys stay ours.
        if taken_by_widget && keys::works_widgets(key) {
            return;
        }
        if let Some((command, binding)) = command_for(key)
            && (!event.repeat || binding.repeats)
        {
            self.asked.push(command);
        }
    }

    fn set_hidden(&mut self, event_loop: &ActiveEventLoop, hidden: bool) {
        if hidden != self.hidden {
            self.hidden = hidden;
            if hidden {
                self.wait(event_loop, Instant::now() + HIDDEN_FRAME);
            }
        }
    }
}

impl ApplicationHandler<accesskit_winit::Event> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.canvas.is_some() {
            return;
        }
        self.title = self.lab.title();
        let attributes = Window::default_attributes()
            .with_title(self.title.clone())
            .with_inner_size(winit::dpi::LogicalSize::new(1280.0, 720.0))
            // AccessKit has to be there before the window shows.
            .with_visible(false);
        let window = match event_loop.create_window(attributes) {
            Ok(window) => Arc::new(window),
            Err(error) => {
                return self.end(event_loop, Err(WindowError::Refused(reason(&error))));
            }
        };
        match Canvas::new(event_loop, window, self.proxy.clone()) {
            Ok(canvas) => {
                canvas.window.set_visible(true);
                canvas.window.request_redraw();
                self.canvas = Some(canvas);
            }
            Err(error) => self.end(event_loop, Err(error)),
        }
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, cause: StartCause) {
        if !matches!(cause, StartCause::ResumeTimeReached { .. }) {
            return;
        }
        event_loop.set_control_flow(ControlFlow::Wait);
        if self.hidden {
            self.frame(event_loop);
            self.wait(event_loop, Instant::now() + HIDDEN_FRAME);
        } else if let Some(canvas) = &self.canvas {
            canvas.window.request_redraw();
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, event: accesskit_winit::Event) {
        if let Some(canvas) = &mut self.canvas {
            canvas.accessibility(event);
            canvas.window.request_redraw();
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if matches!(event, WindowEvent::RedrawRequested) {
            return self.frame(event_loop);
        }
        let Some(canvas) = &mut self.canvas else { return };
        let response = canvas.egui.on_window_event(&canvas.window, &event);
        match &event {
            WindowEvent::CloseRequested => return self.end(event_loop, Ok(())),
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. } => {
                self.key(event, response.consumed);
            }
            WindowEvent::ModifiersChanged(modifiers) => {
                let state = modifiers.state();
                self.shift = state.shift_key();
                self.other_modifier = state.control_key() || state.alt_key() || state.super_key();
            }
            // The release of a key pressed here may go to another window.
            WindowEvent::Focused(false) => (self.shift, self.other_modifier) = (false, false),
            WindowEvent::Occluded(hidden) => self.set_hidden(event_loop, *hidden),
            WindowEvent::Resized(size) => {
                canvas.resize();
                // How Windows says that a window is minimised.
                let hidden = size.width == 0 || size.height == 0;
                self.set_hidden(event_loop, hidden);
            }
            WindowEvent::ScaleFactorChanged { .. } | WindowEvent::Moved(_) => canvas.resize(),
            _ => {}
        }
        if (response.repaint || !self.asked.is_empty())
            && let Some(canvas) = &self.canvas
        {
            canvas.window.request_redraw();
        }
    }
}
