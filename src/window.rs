//! The window: real time, keys, a surface to draw on. The only place that reads a wall clock to
//! drive a [`Lab`].
//!
//! A frame is drawn when something changed: always while time runs, and after an event while it is
//! paused. A window that is hidden draws nothing and keeps simulating.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui_winit::accesskit_winit;
use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::{Fullscreen, Window, WindowId};

use crate::lab::{Ask, Command, Findings, Lab, Scene};

mod canvas;
mod error;
mod interrupt;
mod keys;
mod new_file;
mod opening;
mod pace;
mod recording;
mod screenshot;
mod thinking;
mod watch;

pub use error::WindowError;
pub use opening::{ReadScene, SceneFiles};

use canvas::{Canvas, Drawn};
use error::reason;
use keys::Held;
use pace::Meter;
use thinking::ThinkingThread;
use watch::FileWatch;

/// How long the simulation waits for a frame: well inside the clock's longest, so that a window that is
/// hidden, or that the window system asks no frames of, drops no ticks.
const LONGEST_WAIT: Duration = Duration::from_millis(100);
/// The frame rate where neither the display nor the driver sets one.
const USUAL_REFRESH_MHZ: u32 = 60_000;
/// The first frame after a pause counts as this long: how long it really was says nothing about the
/// simulation.
const FIRST_FRAME: Duration = Duration::ZERO;

/// Opens a window on `lab` and runs it until it is closed, until the tick nearest to `seconds` of simulated time, or,
/// if it `heeds_interrupts`, until Ctrl-C is pressed in the terminal. Returns the lab as it then is, and whether it was
/// interrupted. Scene files that are dropped onto it or typed are read as `files` says.
///
/// # Errors
/// [`WindowError::NoDisplay`] before anything else is tried; the others at any time.
pub fn run(
    mut lab: Lab,
    seconds: Option<f64>,
    files: SceneFiles,
    heeds_interrupts: bool,
) -> Result<(Lab, bool), WindowError> {
    let event_loop = EventLoop::<Event>::with_user_event()
        .build()
        .map_err(|error| WindowError::NoDisplay(reason(&error)))?;
    let proxy = event_loop.create_proxy();
    if heeds_interrupts {
        interrupt::heed(event_loop.create_proxy());
    }
    let SceneFiles { read, opened } = files;
    let watch = FileWatch::new(Arc::clone(&read), proxy.clone());
    if let Some((path, _)) = &opened {
        lab.list_as_file(path);
    }
    watch.watch(opened);
    let mut app = App {
        thinking: ThinkingThread::new(lab.question(), proxy.clone()),
        lab,
        read,
        watch,
        seconds,
        proxy,
        canvas: None,
        asked: Vec::new(),
        held: Held::default(),
        last_frame: None,
        redraw_owed: false,
        occluded: false,
        minimised: false,
        meter: Meter::default(),
        title: String::new(),
        screenshot: false,
        started: Instant::now(),
        interrupted: false,
        outcome: Ok(()),
    };
    event_loop.run_app(&mut app).map_err(|error| WindowError::Refused(reason(&error)))?;
    app.outcome.map(|()| (app.lab, app.interrupted))
}

/// What reaches the window from elsewhere than the window system.
enum Event {
    Accessibility(accesskit_winit::Event),
    Learnt(Findings),
    Interrupted,
    /// A scene file has another text than it had.
    Changed {
        path: PathBuf,
        read: Result<(Scene, String), String>,
    },
}

impl From<accesskit_winit::Event> for Event {
    fn from(event: accesskit_winit::Event) -> Self {
        Event::Accessibility(event)
    }
}

struct App {
    lab: Lab,
    thinking: ThinkingThread,
    read: ReadScene,
    watch: FileWatch,
    /// When to end, in simulated seconds.
    seconds: Option<f64>,
    proxy: EventLoopProxy<Event>,
    canvas: Option<Canvas>,
    /// Commands for the beginning of the next frame.
    asked: Vec<Command>,
    held: Held,
    /// When the last frame began; `None` where time did not run.
    last_frame: Option<Instant>,
    /// Whether a frame was asked for that the window system has not called for yet.
    redraw_owed: bool,
    occluded: bool,
    minimised: bool,
    meter: Meter,
    title: String,
    screenshot: bool,
    started: Instant,
    interrupted: bool,
    outcome: Result<(), WindowError>,
}

impl App {
    /// One frame: events → commands → lab → picture → screen.
    fn frame(&mut self, event_loop: &ActiveEventLoop) {
        let now = Instant::now();
        self.redraw_owed = false;
        self.simulate(event_loop, now);
        if self.hidden() {
            return self.wait(event_loop);
        }
        let Some(canvas) = &mut self.canvas else { return };
        if std::mem::take(&mut self.screenshot) {
            let Canvas { window, gpu, .. } = canvas;
            let size = window.inner_size();
            let scale = window.scale_factor() as f32;
            let notice = screenshot::save(gpu, [size.width, size.height], scale, &self.lab);
            self.lab.set_notice(notice);
            self.stand_still();
        }
        let waits_for_field = self.waits_for_field();
        let Some(canvas) = &mut self.canvas else { return };
        // What is typed for a field that is not shown yet is put off until it is.
        let early = if waits_for_field { canvas.take_events() } else { Vec::new() };
        let drawn = canvas.draw(&self.lab);
        canvas.put_back(early);
        match drawn {
            Ok(Drawn::Shown { commands, repaint_after }) => {
                if self.meter.first_frame() {
                    log::info!("first frame after {} ms", self.started.elapsed().as_millis());
                    self.stand_still();
                }
                self.meter.frame(now, &self.lab);
                let again = self.lab.running()
                    || !commands.is_empty()
                    || self.screenshot
                    || waits_for_field;
                self.asked.extend(commands);
                self.schedule(event_loop, now, if again { Duration::ZERO } else { repaint_after });
            }
            Ok(Drawn::Skipped) => {
                event_loop.set_control_flow(ControlFlow::WaitUntil(now + LONGEST_WAIT));
            }
            Err(error) => self.end(event_loop, Err(error)),
        }
    }

    /// Leaves out of the simulation the time since the frame began: it went into work of ours.
    fn stand_still(&mut self) {
        self.last_frame = self.last_frame.map(|_| Instant::now());
    }

    /// Applies what was asked for and steps what is due.
    fn simulate(&mut self, event_loop: &ActiveEventLoop, now: Instant) {
        for command in std::mem::take(&mut self.asked) {
            match self.lab.apply(command) {
                Some(Ask::Quit) => self.end(event_loop, Ok(())),
                Some(Ask::Screenshot) => self.screenshot = true,
                Some(Ask::Record) => {
                    let notice = recording::save(&self.lab);
                    self.lab.set_notice(notice);
                    self.stand_still();
                }
                Some(Ask::ToggleFullScreen) => self.toggle_full_screen(),
                Some(Ask::OpenTypedPath) => {
                    let opened = opening::open_typed(&mut self.lab, &self.read);
                    self.watch.watch(opened);
                }
                Some(Ask::CompletePath) => {
                    let path = opening::completed(self.lab.viewer().typed_path());
                    self.lab.apply(Command::TypePath(path));
                }
                None => {}
            }
        }
        self.thinking.ask(self.lab.question());
        let frame = self.last_frame.map_or(FIRST_FRAME, |last| now.duration_since(last));
        self.last_frame = self.lab.running().then_some(now);
        let last = self.seconds.map_or(u64::MAX, |s| self.lab.nearest_tick(s));
        self.lab.advance_to(last, i64::try_from(frame.as_nanos()).unwrap_or(i64::MAX));
        self.lab.set_pace(self.meter.pace());
        if self.lab.race().tick() >= last {
            self.end(event_loop, Ok(()));
        }
        let title = self.lab.title();
        if title != self.title
            && let Some(canvas) = &self.canvas
        {
            canvas.window.set_title(&title);
            self.title = title;
        }
    }

    /// Asks for the next frame: at the display's pace if `after` is over by then.
    fn schedule(&mut self, event_loop: &ActiveEventLoop, began: Instant, after: Duration) {
        let Some(canvas) = &self.canvas else { return };
        let refresh = canvas.refresh_mhz.unwrap_or(USUAL_REFRESH_MHZ);
        // A driver that waits for the display has used this time up already; a software one has not.
        let shortest = Duration::from_secs_f64(1000.0 / f64::from(refresh)).mul_f64(0.95);
        match began.checked_add(shortest.max(after)) {
            Some(due) if due <= Instant::now() => {
                self.request_redraw();
                self.wait(event_loop);
            }
            Some(due) => event_loop.set_control_flow(ControlFlow::WaitUntil(due)),
            None => event_loop.set_control_flow(ControlFlow::Wait),
        }
    }

    /// Waits for an event; while time runs, not for long.
    fn wait(&self, event_loop: &ActiveEventLoop) {
        event_loop.set_control_flow(if self.lab.running() {
            ControlFlow::WaitUntil(Instant::now() + LONGEST_WAIT)
        } else {
            ControlFlow::Wait
        });
    }

    fn request_redraw(&mut self) {
        if let Some(canvas) = &self.canvas {
            self.redraw_owed = true;
            canvas.window.request_redraw();
        }
    }

    fn hidden(&self) -> bool {
        self.occluded || self.minimised
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
}

impl ApplicationHandler<Event> for App {
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
                self.canvas = Some(canvas);
                self.request_redraw();
            }
            Err(error) => self.end(event_loop, Err(error)),
        }
    }

    fn new_events(&mut self, event_loop: &ActiveEventLoop, cause: StartCause) {
        if !matches!(cause, StartCause::ResumeTimeReached { .. }) {
            return;
        }
        if self.hidden() || self.redraw_owed {
            self.simulate(event_loop, Instant::now());
        } else {
            self.request_redraw();
        }
        self.wait(event_loop);
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, event: Event) {
        match event {
            Event::Accessibility(event) => {
                if let Some(canvas) = &mut self.canvas {
                    canvas.accessibility(event);
                    self.request_redraw();
                }
            }
            Event::Interrupted => {
                self.interrupted = true;
                self.end(event_loop, Ok(()));
            }
            Event::Learnt(findings) => {
                self.lab.learn(findings);
                if !self.lab.running() {
                    self.request_redraw();
                }
            }
            Event::Changed { path, read } => {
                match read {
                    Ok((scene, _)) => self.lab.reload_file(&path, scene),
                    Err(report) => self.lab.reload_failed(&path, report),
                }
                // What it took is no time of the simulation's.
                self.stand_still();
                self.request_redraw();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if matches!(event, WindowEvent::RedrawRequested) {
            return self.frame(event_loop);
        }
        let Some(canvas) = &mut self.canvas else { return };
        let before = canvas.egui.egui_input().events.len();
        let response = canvas.egui.on_window_event(&canvas.window, &event);
        match &event {
            WindowEvent::CloseRequested | WindowEvent::Destroyed => {
                return self.end(event_loop, Ok(()));
            }
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. } => {
                let panels = canvas.egui.egui_ctx().clone();
                if self.key(event, response.consumed, &panels)
                    && let Some(canvas) = &mut self.canvas
                {
                    // A key that opens a field is no text for it.
                    canvas.egui.egui_input_mut().events.truncate(before);
                }
            }
            WindowEvent::DroppedFile(path) => {
                self.watch.watch(opening::open(&mut self.lab, &self.read, path));
                self.stand_still();
                return self.request_redraw();
            }
            WindowEvent::ModifiersChanged(modifiers) => {
                self.held = modifiers.state().into();
            }
            // The release of a key pressed here may go to another window.
            WindowEvent::Focused(false) => self.held = Held::default(),
            WindowEvent::Occluded(occluded) => self.occluded = *occluded,
            WindowEvent::Resized(size) => {
                canvas.resize();
                // How Windows says that a window is minimised.
                self.minimised = size.width == 0 || size.height == 0;
            }
            WindowEvent::ScaleFactorChanged { .. } | WindowEvent::Moved(_) => canvas.resize(),
            _ => {}
        }
        // While time runs a frame is due soon, and a mouse that moves is no reason for more.
        if (response.repaint || !self.asked.is_empty()) && !self.lab.running() {
            self.request_redraw();
        }
    }
}
