//! The window: drives a [`Studio`] in real time, by keys and mouse, and shows it. No other code of this crate reads a
//! wall clock to drive a studio.
//!
//! It draws a frame when something has changed: always while time runs, and after an event while time is paused. A
//! hidden window draws nothing and continues to simulate.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::error::EventLoopError;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::window::{Fullscreen, WindowId};

use crate::loops::loop_lab::LoopWorker;
use crate::measure::AnalysisWorker;
use crate::measure::cloud::CloudWorker;
use crate::studio::{
    Command, DriverRequest, FrameLoop, SceneList, StageCommand, Studio, ToDo, ViewCommand,
    cloud_request, described_spring, list_as_file, loop_request,
};
use crate::view::{Modifiers, RendererChoice};

mod canvas;
mod caught;
mod clipboard;
mod display;
mod error;
mod event;
mod export;
mod growing_recording;
mod keys;
mod opening;
mod presenter;
mod run_of_session;
mod schedule;
#[cfg_attr(not(feature = "accessibility"), path = "window/no_screen_reader.rs")]
mod screen_reader;
mod settings;
mod tick_timer;
mod watch;
mod work_thread;

pub use error::WindowError;
pub use opening::{KeepRecording, ReadScene, SceneFiles};
pub use run_of_session::Window;
pub use settings::{Closed, OnInterrupt, WindowSettings};

use canvas::{Canvas, FrameOutcome};
use caught::caught;
use clipboard::Clipboard;
use error::reason;
use event::Event;
use growing_recording::GrowingRecording;
use opening::RequestedFile;
use tick_timer::TickTimer;
use watch::FileWatch;
use work_thread::WorkThread;

/// Longest time between two simulation steps without a frame. It is well below the clock's longest frame. A window
/// that is hidden, or gets no requests for frames from the window system, thus drops no ticks.
const MAX_WAIT: Duration = Duration::from_millis(100);

/// A separate thread handles this command, because advice on a spring takes longer than a frame.
const OPEN_SPRING: Command = Command::Stage(StageCommand::OpenSpring);

/// Opens a window on `studio` and runs it until it is closed. `files` reads the scene files that a person opens in
/// it.
///
/// # Errors
/// [`WindowError::NoDisplay`] if there is no display, before any other error. The others may come at any time.
pub fn run(
    mut studio: Studio,
    settings: WindowSettings,
    files: SceneFiles,
) -> Result<Closed, WindowError> {
    let WindowSettings { seconds, tick, size, renderer, on_interrupt } = settings;
    let event_loop = display::connect()?;
    let proxy = event_loop.create_proxy();
    if let Some(on_interrupt) = on_interrupt {
        let window = event_loop.create_proxy();
        // A closed window needs no event.
        on_interrupt(Box::new(move || _ = window.send_event(Event::Interrupted)));
    }
    let SceneFiles { read, opened, methods, keep } = files;
    if let Some((path, _)) = &opened {
        list_as_file(&mut studio.deck, path);
    }
    // Files of lines are watched by their bytes.
    let methods = methods.into_iter().map(|path| (path, String::new()));
    let watch = FileWatch::new(read, opened.into_iter().chain(methods).collect(), proxy.clone());
    studio.viewer.preferences.is_recorded = keep.is_some();
    let analysed = studio.analysis_request();
    let analysis = AnalysisWorker::new(analysed.clone());
    let mut app = App {
        analysis: WorkThread::new(analysis, analysed, proxy.clone()),
        loops: WorkThread::new(LoopWorker::default(), None, proxy.clone()),
        clouds: WorkThread::new(CloudWorker::default(), None, proxy.clone()),
        recording: keep.map(|keep| GrowingRecording::new(keep, proxy.clone())),
        tick_timer: TickTimer::new(proxy.clone()),
        frames: FrameLoop::new(studio, |command| *command == OPEN_SPRING, 0),
        watch,
        seconds,
        size,
        renderer,
        proxy,
        canvas: None,
        clipboard: Clipboard::default(),
        held: Modifiers::default(),
        redraw_owed: false,
        occluded: false,
        minimised: false,
        title: String::new(),
        picture: None,
        started: Instant::now(),
        is_shown: false,
        interrupted: false,
        outcome: Ok(()),
    };
    if let Some(tick) = tick {
        app.frames.go_to(tick, false);
    }
    event_loop.run_app(&mut app).map_err(|error| match error {
        EventLoopError::ExitFailure(_) => WindowError::Lost,
        error => WindowError::Refused(reason(&error)),
    })?;
    let App { outcome, frames, interrupted, size, .. } = app;
    outcome.map(|()| Closed { studio: frames.studio, interrupted, size })
}

struct App {
    frames: FrameLoop,
    analysis: WorkThread<AnalysisWorker>,
    loops: WorkThread<LoopWorker>,
    clouds: WorkThread<CloudWorker>,
    recording: Option<GrowingRecording>,
    tick_timer: TickTimer,
    watch: FileWatch,
    /// End of the run in simulated seconds.
    seconds: Option<f64>,
    /// Size of the window in points when it last did not fill the screen.
    size: Option<[u32; 2]>,
    renderer: RendererChoice,
    proxy: EventLoopProxy<Event>,
    canvas: Option<Canvas>,
    clipboard: Clipboard,
    held: Modifiers,
    /// Whether a requested redraw is still to come from the window system.
    redraw_owed: bool,
    occluded: bool,
    minimised: bool,
    title: String,
    /// The picture to save with the next frame, a screenshot or a report.
    picture: Option<DriverRequest>,
    /// Zero point of the frames' time.
    started: Instant,
    /// Whether any frame was shown.
    is_shown: bool,
    interrupted: bool,
    outcome: Result<(), WindowError>,
}

impl App {
    /// One frame: events → commands → studio → picture → screen.
    fn frame(&mut self, event_loop: &ActiveEventLoop) {
        let now = Instant::now();
        self.redraw_owed = false;
        self.simulate(event_loop, now);
        if self.is_hidden() {
            return self.wait_for_event(event_loop);
        }
        let Some(canvas) = &mut self.canvas else { return };
        if let Some(request) = self.picture.take() {
            let size = canvas.window.inner_size();
            let scale = canvas.window.scale_factor() as f32;
            let (size_px, studio) = ([size.width, size.height], &self.frames.studio);
            let notice = match request {
                DriverRequest::Report => export::save_report(size_px, scale, studio),
                _ => export::save_screenshot(size_px, scale, studio),
            };
            self.frames.studio.viewer.set_notice(notice);
            self.stand_still();
        }
        let waits_for_field = self.waits_for_field();
        let Some(canvas) = &mut self.canvas else { return };
        // Hold back text for a field until a frame has shown the field.
        let early = if waits_for_field { canvas.take_events() } else { Vec::new() };
        let drawn = canvas.draw(&self.frames.studio, &mut self.clipboard);
        canvas.put_back(early);
        match drawn {
            Ok(FrameOutcome::Shown { commands, repaint_after }) => {
                if !std::mem::replace(&mut self.is_shown, true) {
                    log::info!("first frame after {} ms", self.started.elapsed().as_millis());
                    _ = thread::Builder::new().spawn(SceneList::prepare);
                }
                let due_ns = self.frames.end(self.ns_at(now), self.now_ns(), commands);
                let recorded =
                    || self.recording.as_ref()?.time_to_next_save(&self.frames.studio, now);
                let after = match due_ns {
                    0 => Duration::ZERO,
                    _ if self.picture.is_some() || waits_for_field => Duration::ZERO,
                    due_ns => Duration::from_nanos(due_ns)
                        .min(repaint_after)
                        .min(recorded().unwrap_or(Duration::MAX)),
                };
                self.schedule_frame(event_loop, now, after);
            }
            Ok(FrameOutcome::Skipped) => {
                event_loop.set_control_flow(ControlFlow::WaitUntil(now + MAX_WAIT));
            }
            Err(error) => self.end(event_loop, Err(error)),
        }
    }

    /// Nanoseconds from `started` to `moment`.
    fn ns_at(&self, moment: Instant) -> u64 {
        moment.duration_since(self.started).as_nanos() as u64
    }

    fn now_ns(&self) -> u64 {
        self.ns_at(Instant::now())
    }

    /// Leaves the time since the frame began out of the run. For use after slow work.
    fn stand_still(&mut self) {
        self.frames.stand_still(self.now_ns());
    }

    /// Applies the commands and steps the ticks that are due.
    fn simulate(&mut self, event_loop: &ActiveEventLoop, now: Instant) {
        if let Some(Canvas { window, .. }) = &self.canvas {
            // The system's own keys and buttons change it too.
            let is_full = window.fullscreen().is_some();
            self.frames.studio.viewer.preferences.is_full_screen = is_full;
        }
        while let Some(to_do) = self.frames.begin() {
            match to_do {
                ToDo::Own(_) => self.advise_on_spring(),
                ToDo::Request(request) => self.carry_out(event_loop, request),
            }
        }
        let studio = &self.frames.studio;
        self.analysis.set_request(studio.analysis_request());
        self.loops.set_request(loop_request(studio));
        self.clouds.set_request(cloud_request(studio).map(Arc::new));
        self.tick_timer.request_timing(studio, now);
        let last = self.seconds.map_or(u64::MAX, |s| studio.race().nearest_tick(s));
        let started = self.started;
        let clock = || started.elapsed().as_nanos() as u64;
        self.frames.advance(self.ns_at(now), last, &clock);
        let studio = &self.frames.studio;
        if let Some(recording) = &mut self.recording {
            recording.update(studio, now);
        }
        let (title, is_over) = (studio.title(), studio.race().tick() >= last);
        if title != self.title
            && let Some(canvas) = &self.canvas
        {
            canvas.window.set_title(&title);
            self.title = title;
        }
        if is_over {
            self.end(event_loop, Ok(()));
        }
    }

    fn carry_out(&mut self, event_loop: &ActiveEventLoop, request: DriverRequest) {
        match request {
            DriverRequest::Quit => self.end(event_loop, Ok(())),
            DriverRequest::Screenshot | DriverRequest::Report => self.picture = Some(request),
            DriverRequest::Record => {
                let notice = export::save_recording(&mut self.frames.studio);
                self.frames.studio.viewer.set_notice(notice);
                self.stand_still();
            }
            DriverRequest::ExportInstrument => self.export_instrument(),
            DriverRequest::ToggleFullScreen => self.toggle_full_screen(),
            DriverRequest::OpenTypedPath => {
                if let Some(requested) = RequestedFile::typed(&mut self.frames.studio) {
                    self.watch.open(requested);
                }
            }
            DriverRequest::CompletePath => {
                let path = opening::complete_path(self.frames.studio.viewer.typed_path());
                self.frames.studio.apply(ViewCommand::TypePath(path));
            }
            DriverRequest::CopyLink
            | DriverRequest::CopyInstrument
            | DriverRequest::CopyMethod(_)
            | DriverRequest::CopyJoint(_) => self.copy(request),
        }
    }

    /// Searches for advice on the spring that a person has described. If it is stiff, this takes longer than a frame.
    fn advise_on_spring(&self) {
        let (spring, tick_hz) = described_spring(&self.frames.studio);
        let proxy = self.proxy.clone();
        thread::spawn(move || {
            _ = proxy.send_event(match caught(|| spring.advised_scene(tick_hz)) {
                Ok(scene) => Event::SpringAdvised(scene.into()),
                Err(sentence) => Event::WorkFailed(sentence),
            });
        });
    }

    fn toggle_full_screen(&mut self) {
        if let Some(Canvas { window, .. }) = &self.canvas {
            let full = window.fullscreen().is_none().then_some(Fullscreen::Borderless(None));
            self.frames.studio.viewer.preferences.is_full_screen = full.is_some();
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
        self.title = self.frames.studio.title();
        let attributes = settings::attributes(self.size, event_loop)
            .with_title(self.title.clone())
            // AccessKit must be ready before the window is visible.
            .with_visible(false);
        let window = match event_loop.create_window(attributes) {
            Ok(window) => Arc::new(window),
            Err(error) => {
                return self.end(event_loop, Err(WindowError::Refused(reason(&error))));
            }
        };
        match Canvas::new(event_loop, window, self.proxy.clone(), self.renderer) {
            Ok(canvas) => {
                if let Some(theme) = canvas.window.theme() {
                    self.frames.studio.viewer.preferences.follow_theme(settings::theme_of(theme));
                }
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
        if self.is_hidden() || self.redraw_owed {
            self.simulate(event_loop, Instant::now());
        } else {
            self.request_redraw();
        }
        self.wait_for_event(event_loop);
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, event: Event) {
        self.handle(event_loop, event);
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if matches!(event, WindowEvent::RedrawRequested) {
            return self.frame(event_loop);
        }
        self.fetch_pasted(&event);
        let Some(canvas) = &mut self.canvas else { return };
        let before = canvas.egui.egui_input().events.len();
        let response = canvas.egui.on_window_event(&canvas.window, &event);
        match &event {
            WindowEvent::CloseRequested | WindowEvent::Destroyed => {
                return self.end(event_loop, Ok(()));
            }
            WindowEvent::KeyboardInput { event, is_synthetic: false, .. } => {
                let panels = canvas.egui.egui_ctx().clone();
                if self.key(event, &panels)
                    && let Some(canvas) = &mut self.canvas
                {
                    // A key that opens a field is not text for it.
                    canvas.egui.egui_input_mut().events.truncate(before);
                }
            }
            WindowEvent::DroppedFile(path) => {
                return self.watch.open(RequestedFile::dropped(&self.frames.studio, path));
            }
            WindowEvent::ModifiersChanged(modifiers) => {
                self.held = keys::modifiers(modifiers.state());
            }
            // The release of a key pressed here may go to another window.
            WindowEvent::Focused(false) => self.held = Modifiers::default(),
            WindowEvent::Occluded(occluded) => self.occluded = *occluded,
            WindowEvent::Resized(size) => {
                canvas.resize();
                self.size = settings::size_of(&canvas.window, *size).or(self.size);
                // Windows reports a minimised window in this way.
                self.minimised = size.width == 0 || size.height == 0;
            }
            WindowEvent::ThemeChanged(theme) => {
                self.frames.studio.viewer.preferences.follow_theme(settings::theme_of(*theme));
                return self.request_redraw();
            }
            WindowEvent::ScaleFactorChanged { .. } | WindowEvent::Moved(_) => canvas.resize(),
            _ => {}
        }
        // While time runs the next frame is due soon, and a moving mouse needs no extra frames.
        if (response.repaint || !self.frames.queued().is_empty()) && !self.frames.studio.running() {
            self.request_redraw();
        }
    }
}
