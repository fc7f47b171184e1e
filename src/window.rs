//! The window: drives a [`Studio`] in real time, by keys and mouse, and shows it. No other code reads a wall clock to
//! drive a studio.
//!
//! A frame is drawn when something has changed: always while time runs, and after an event while it is paused. A
//! hidden window draws nothing and continues to simulate.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::{Fullscreen, WindowId};

use crate::loops::loop_lab::LoopWorker;
use crate::measure::AnalysisWorker;
use crate::measure::cloud::CloudWorker;
use crate::studio::{
    Command, DriverRequest, PaceMeter, SceneList, StageCommand, Studio, ViewCommand,
};
use crate::view::Modifiers;

mod canvas;
mod clipboard;
mod error;
mod event;
mod export;
mod growing_recording;
mod keys;
mod opening;
mod recording;
mod run_of_session;
mod schedule;
#[cfg(feature = "accessibility")]
mod screen_reader;
mod screenshot;
mod settings;
mod tick_timer;
mod watch;
mod work_thread;

pub use error::WindowError;
pub use opening::{KeepRecording, ReadScene, SceneFiles};
pub use run_of_session::Window;
pub use settings::{Closed, OnInterrupt, WindowSettings};

use canvas::{Canvas, FrameOutcome};
use clipboard::Clipboard;
use error::reason;
use event::Event;
use growing_recording::GrowingRecording;
use opening::Asked;
use tick_timer::TickTimer;
use watch::FileWatch;
use work_thread::WorkThread;

/// The longest time between two simulation steps without a frame. It is well below the clock's longest frame, so that
/// a window that is hidden, or not asked for frames by the window system, drops no ticks.
const MAX_WAIT: Duration = Duration::from_millis(100);
/// The longest time that a frame simulates: the ticks of a race that needs more are dropped, so that the window still
/// answers.
const MAX_SIMULATION: Duration = Duration::from_millis(50);
/// The simulated length of the first frame after a pause, whose real length includes the pause.
const FIRST_FRAME: Duration = Duration::ZERO;

/// Opens a window on `studio` and runs it until it is closed. `files` reads the scene files that are opened in the window.
///
/// # Errors
/// [`WindowError::NoDisplay`] if there is none, before any other error; the others at any time.
pub fn run(
    mut studio: Studio,
    settings: WindowSettings,
    files: SceneFiles,
) -> Result<Closed, WindowError> {
    let WindowSettings { seconds, size, on_interrupt } = settings;
    let event_loop = EventLoop::<Event>::with_user_event()
        .build()
        .map_err(|error| WindowError::NoDisplay(reason(&error)))?;
    let proxy = event_loop.create_proxy();
    if let Some(on_interrupt) = on_interrupt {
        let window = event_loop.create_proxy();
        // A closed window needs no event.
        on_interrupt(Box::new(move || _ = window.send_event(Event::Interrupted)));
    }
    let SceneFiles { read, opened, keep } = files;
    if let Some((path, _)) = &opened {
        studio.list_as_file(path);
    }
    let watch = FileWatch::new(read, opened, proxy.clone());
    studio.viewer_mut().preferences.is_recorded = keep.is_some();
    let analysed = studio.analysis_request();
    let analysis = AnalysisWorker::new(analysed.clone());
    let mut app = App {
        analysis: WorkThread::new(analysis, analysed, proxy.clone()),
        loops: WorkThread::new(LoopWorker::default(), None, proxy.clone()),
        clouds: WorkThread::new(CloudWorker::default(), None, proxy.clone()),
        recording: keep.map(|keep| GrowingRecording::new(keep, proxy.clone())),
        tick_timer: TickTimer::new(proxy.clone()),
        studio,
        watch,
        seconds,
        size,
        proxy,
        canvas: None,
        clipboard: Clipboard::default(),
        asked: Vec::new(),
        opened: false,
        held: Modifiers::default(),
        last_frame: None,
        redraw_owed: false,
        occluded: false,
        minimised: false,
        meter: PaceMeter::default(),
        title: String::new(),
        screenshot: false,
        simulated: Instant::now(),
        started: Instant::now(),
        interrupted: false,
        outcome: Ok(()),
    };
    event_loop.run_app(&mut app).map_err(|error| WindowError::Refused(reason(&error)))?;
    let App { outcome, studio, interrupted, size, .. } = app;
    outcome.map(|()| Closed { studio, interrupted, size })
}

struct App {
    studio: Studio,
    analysis: WorkThread<AnalysisWorker>,
    loops: WorkThread<LoopWorker>,
    clouds: WorkThread<CloudWorker>,
    recording: Option<GrowingRecording>,
    tick_timer: TickTimer,
    watch: FileWatch,
    /// The end of the run, in simulated seconds.
    seconds: Option<f64>,
    /// The size of the window in points, when it last did not fill the screen.
    size: Option<[u32; 2]>,
    proxy: EventLoopProxy<Event>,
    canvas: Option<Canvas>,
    clipboard: Clipboard,
    /// Commands that the next frame applies before it simulates.
    asked: Vec<Command>,
    /// Whether a command has just opened a scene, of which nothing is drawn yet.
    opened: bool,
    held: Modifiers,
    /// When the last frame began; `None` if time did not run.
    last_frame: Option<Instant>,
    /// When the studio was last simulated, whether time ran or not.
    simulated: Instant,
    /// Whether a redraw was requested and the window system has not asked for it yet.
    redraw_owed: bool,
    occluded: bool,
    minimised: bool,
    meter: PaceMeter,
    title: String,
    screenshot: bool,
    started: Instant,
    interrupted: bool,
    outcome: Result<(), WindowError>,
}

impl App {
    /// One frame: events → commands → studio → picture → screen.
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
            let notice = screenshot::save(gpu, [size.width, size.height], scale, &self.studio);
            self.studio.viewer_mut().set_notice(notice);
            self.stand_still();
        }
        let waits_for_field = self.waits_for_field();
        let Some(canvas) = &mut self.canvas else { return };
        // Text for a field that is not shown yet waits until it is.
        let early = if waits_for_field { canvas.take_events() } else { Vec::new() };
        let drawn = canvas.draw(&self.studio, &mut self.clipboard);
        canvas.put_back(early);
        match drawn {
            Ok(FrameOutcome::Shown { commands, repaint_after }) => {
                if self.meter.first_frame() {
                    log::info!("first frame after {} ms", self.started.elapsed().as_millis());
                    self.stand_still();
                    _ = thread::Builder::new().spawn(SceneList::prepare);
                }
                if std::mem::take(&mut self.opened) {
                    self.stand_still();
                }
                let now_ns = now.duration_since(self.started).as_nanos();
                self.meter.frame(now_ns as u64, &self.studio);
                let again = self.studio.running()
                    || !commands.is_empty()
                    || self.screenshot
                    || waits_for_field;
                self.asked.extend(commands);
                let notice = self.studio.viewer().notice.as_ref();
                let notice_leaves = notice.map(|notice| notice.left_ns().unsigned_abs());
                let notice_leaves = notice_leaves.map_or(Duration::MAX, Duration::from_nanos);
                let recorded = || self.recording.as_ref()?.left(&self.studio, now);
                let after = match again {
                    true => Duration::ZERO,
                    false => {
                        repaint_after.min(notice_leaves).min(recorded().unwrap_or(Duration::MAX))
                    }
                };
                self.schedule(event_loop, now, after);
            }
            Ok(FrameOutcome::Skipped) => {
                event_loop.set_control_flow(ControlFlow::WaitUntil(now + MAX_WAIT));
            }
            Err(error) => self.end(event_loop, Err(error)),
        }
    }

    /// Leaves the time since the frame began out of the simulation, after work that takes long.
    fn stand_still(&mut self) {
        self.last_frame = self.last_frame.map(|_| Instant::now());
    }

    /// Applies the commands and steps the ticks that are due.
    fn simulate(&mut self, event_loop: &ActiveEventLoop, now: Instant) {
        let scene = std::ptr::from_ref(self.studio.scene());
        for command in std::mem::take(&mut self.asked) {
            if command == Command::Stage(StageCommand::OpenSpring) {
                self.advise_on_spring();
                continue;
            }
            match self.studio.apply(command) {
                Some(DriverRequest::Quit) => self.end(event_loop, Ok(())),
                Some(DriverRequest::Screenshot) => self.screenshot = true,
                Some(DriverRequest::Record) => {
                    let notice = recording::save(&mut self.studio);
                    self.studio.viewer_mut().set_notice(notice);
                    self.stand_still();
                }
                Some(DriverRequest::ExportInstrument) => self.export_instrument(),
                Some(DriverRequest::ToggleFullScreen) => self.toggle_full_screen(),
                Some(DriverRequest::OpenTypedPath) => {
                    if let Some(asked) = Asked::typed(&mut self.studio) {
                        self.watch.open(asked);
                    }
                }
                Some(DriverRequest::CompletePath) => {
                    let path = opening::completed(self.studio.viewer().typed_path());
                    self.studio.apply(ViewCommand::TypePath(path));
                }
                Some(
                    request @ (DriverRequest::CopyLink
                    | DriverRequest::CopyInstrument
                    | DriverRequest::CopyMethod(_)
                    | DriverRequest::CopyJoint(_)),
                ) => self.copy(request),
                None => {}
            }
        }
        // What it takes to build another scene and to draw it first is not time in its run.
        if scene != std::ptr::from_ref(self.studio.scene()) {
            (self.opened, self.last_frame) = (true, None);
        }
        self.analysis.ask(self.studio.analysis_request());
        self.loops.ask(self.studio.loop_request());
        self.clouds.ask(self.studio.cloud_request().map(Arc::new));
        self.tick_timer.ask(&self.studio, now);
        let frame = self.last_frame.map_or(FIRST_FRAME, |last| now.duration_since(last));
        self.last_frame = self.studio.running().then_some(now);
        let passed = now.duration_since(std::mem::replace(&mut self.simulated, now));
        if !self.studio.time_runs() {
            self.studio.viewer_mut().pass(i64::try_from(passed.as_nanos()).unwrap_or(i64::MAX));
        }
        let last = self.seconds.map_or(u64::MAX, |s| self.studio.race().nearest_tick(s));
        let frame_ns = i64::try_from(frame.as_nanos()).unwrap_or(i64::MAX);
        self.studio.advance_in_time(
            last,
            frame_ns,
            &mut || now.elapsed() < MAX_SIMULATION,
            &mut (),
        );
        self.studio.viewer_mut().pace = Some(self.meter.pace());
        if self.studio.race().tick() >= last {
            self.end(event_loop, Ok(()));
        }
        if let Some(recording) = &mut self.recording {
            recording.update(&self.studio, now);
        }
        let title = self.studio.title();
        if title != self.title
            && let Some(canvas) = &self.canvas
        {
            canvas.window.set_title(&title);
            self.title = title;
        }
    }

    /// Finds what to recommend for the spring that a person has described, which takes longer than a frame if it is stiff.
    fn advise_on_spring(&self) {
        let (spring, tick_hz) = (self.studio.viewer().my_spring(), self.studio.clock().tick_hz());
        let proxy = self.proxy.clone();
        thread::spawn(move || {
            let scene = spring.advised_scene(tick_hz).into();
            _ = proxy.send_event(Event::SpringAdvised(scene));
        });
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
        self.title = self.studio.title();
        let attributes = settings::attributes(self.size)
            .with_title(self.title.clone())
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
                if let Some(theme) = canvas.window.theme() {
                    self.studio.viewer_mut().preferences.follow_theme(settings::theme_of(theme));
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
        if self.hidden() || self.redraw_owed {
            self.simulate(event_loop, Instant::now());
        } else {
            self.request_redraw();
        }
        self.wait(event_loop);
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
                return self.watch.open(Asked::dropped(&self.studio, path));
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
                // How Windows says that a window is minimised.
                self.minimised = size.width == 0 || size.height == 0;
            }
            WindowEvent::ThemeChanged(theme) => {
                self.studio.viewer_mut().preferences.follow_theme(settings::theme_of(*theme));
                return self.request_redraw();
            }
            WindowEvent::ScaleFactorChanged { .. } | WindowEvent::Moved(_) => canvas.resize(),
            _ => {}
        }
        // While time runs the next frame is due soon, and a moving mouse needs no extra frames.
        if (response.repaint || !self.asked.is_empty()) && !self.studio.running() {
            self.request_redraw();
        }
    }
}
