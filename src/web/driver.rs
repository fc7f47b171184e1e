//! The driver: a studio, its canvas, and what has happened on the page since the last frame.

use std::cell::RefCell;
use std::path::Path;

use regatta::look::palette::Theme;
use regatta::run::Replay;
use regatta::scene::Scene;
use regatta::studio::{
    Command, DriverRequest, Motion, PaceMeter, SavedPreferences, StageCommand, Studio, ViewCommand,
};
use regatta::view::{copied, egui};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::{Closure, JsValue};
use web_sys::{Storage, Window};

use crate::address::{Address, scene_of};
use crate::canvas::Canvas;
use crate::pointer::Fingers;
use crate::work::Workers;
use crate::{clipboard, files, listening};

/// The longest time that a frame simulates, in nanoseconds: the ticks of a race that needs more are dropped, so that the
/// page still answers.
const MAX_SIMULATION_NS: u64 = 50_000_000;

/// What a run may take to be rewound: phones have little, and a page that is left open is not to grow.
const REWIND_BYTES: usize = 16 << 20;

/// The name under which the browser keeps the preferences of a person.
const STORED: &str = "regatta";

/// The name of a scene that came in an address.
const LINK: &str = "a link";

pub(crate) struct Driver {
    pub(crate) window: Window,
    pub(crate) canvas: Canvas,
    pub(crate) studio: Studio,
    pub(crate) workers: Workers,
    /// The run of a link, until it is known whether it is here what it was.
    pub(crate) arrival: Option<Replay>,
    /// A tick to go to before time runs, and whether it runs from there.
    goal: Option<(u64, bool)>,
    /// Whether it stands on another's page.
    pub(crate) is_embedded: bool,
    /// Whether a person who scrolls that page has it in sight.
    pub(crate) is_in_sight: bool,
    /// Whether what is shown is remembered: what an address has chosen is nobody's choice.
    remembers: bool,
    /// Commands that the next frame applies before it simulates.
    pub(crate) asked: Vec<Command>,
    /// What panels are told with the next frame.
    pub(crate) input: egui::RawInput,
    pub(crate) held: egui::Modifiers,
    /// Whether the last key was Escape.
    pub(crate) was_escaped: bool,
    pub(crate) fingers: Fingers,
    pub(crate) meter: PaceMeter,
    /// The frames drawn.
    pub(crate) frames: u32,
    /// When the last frame began, in nanoseconds of the page's time; `None` if time did not run.
    pub(crate) last_frame_ns: Option<u64>,
    /// When the studio was last simulated, whether time ran or not.
    simulated_ns: u64,
    /// Whether a command has just opened a scene, of which nothing is drawn yet.
    pub(crate) has_opened: bool,
    /// Whether the next frame is to be saved as a picture.
    pub(crate) saves_picture: bool,
    pub(crate) frame_is_due: bool,
    pub(crate) work_is_due: bool,
}

thread_local! {
    static DRIVER: RefCell<Option<Driver>> = const { RefCell::new(None) };
}

/// Has the driver of the page do something. What happens in the midst of something else, such as a click that a download is,
/// is for the browser alone.
pub(crate) fn with(does: impl FnOnce(&mut Driver)) {
    DRIVER.with(|driver| {
        if let Ok(mut driver) = driver.try_borrow_mut()
            && let Some(driver) = driver.as_mut()
        {
            does(driver);
        }
    });
}

/// Opens what the address asks for, and draws the first frame.
///
/// # Errors
/// Why nothing can be drawn.
pub(crate) async fn start() -> Result<(), String> {
    let window = web_sys::window().ok_or("there is no page")?;
    let element = window.document().and_then(|document| document.get_element_by_id("stage"));
    let element = element.and_then(|element| element.dyn_into().ok()).ok_or("there is no stage")?;
    let address = Address::of(&window.location().hash().unwrap_or_default());
    let canvas = Canvas::new(element).await?;
    let mut driver = Driver::new(window, canvas, address);
    driver.frame();
    DRIVER.set(Some(driver));
    listening::listen();
    Ok(())
}

/// Where the browser keeps what a page remembers, if it does.
fn storage(window: &Window) -> Option<Storage> {
    window.local_storage().ok().flatten()
}

/// The system's theme.
pub(crate) fn theme_of(window: &Window) -> Theme {
    if prefers(window, "(prefers-color-scheme: light)") { Theme::Light } else { Theme::Dark }
}

fn prefers(window: &Window, query: &str) -> bool {
    window.match_media(query).ok().flatten().is_some_and(|found| found.matches())
}

impl Driver {
    fn new(window: Window, canvas: Canvas, address: Address) -> Self {
        let opened = address.studio();
        let refused = opened.as_ref().err().cloned();
        let mut studio =
            opened.unwrap_or_else(|_| Address::default().studio().expect("it has one"));
        // At first the stage is alone, as in the window.
        let remembered = storage(&window).and_then(|storage| storage.get_item(STORED).ok()?);
        let remembered = remembered.and_then(|text| SavedPreferences::parse(&text).ok());
        remembered.unwrap_or_default().apply(&mut studio);
        studio.set_rewind_bytes(REWIND_BYTES);
        let preferences = &mut studio.viewer_mut().preferences;
        preferences.follow_theme(theme_of(&window));
        address.theme.into_iter().for_each(|theme| preferences.choose_theme(theme));
        preferences.display.motion = match prefers(&window, "(prefers-reduced-motion: reduce)") {
            true => Motion::Reduced,
            false => Motion::Live,
        };
        let display = &mut preferences.display;
        display.measure = !address.is_embedded && (display.measure || address.opens_at_work());
        let workers = Workers::new(&studio);
        let mut driver = Self {
            window,
            canvas,
            workers,
            studio,
            arrival: None,
            goal: address.tick.map(|tick| (tick, address.plays)),
            is_embedded: address.is_embedded,
            is_in_sight: true,
            remembers: !address.is_embedded && address.theme.is_none() && !address.opens_at_work(),
            asked: Vec::new(),
            input: egui::RawInput { focused: true, ..egui::RawInput::default() },
            held: egui::Modifiers::default(),
            was_escaped: false,
            fingers: Fingers::default(),
            meter: PaceMeter::default(),
            frames: 0,
            last_frame_ns: None,
            simulated_ns: 0,
            has_opened: true,
            saves_picture: false,
            frame_is_due: false,
            work_is_due: false,
        };
        if let Some(refused) = refused {
            driver.studio.viewer_mut().set_notice(refused);
        }
        let runs = address.runs_at_first();
        if let Some(run) = address.run {
            driver.open_run(run);
        }
        if let Some(instrument) = address.instrument {
            driver.studio.viewer_mut().preferences.display.instrument = instrument;
        }
        if !runs && driver.goal.is_none() {
            driver.studio.apply(ViewCommand::TogglePause);
        }
        if let Some((goal, _)) = &mut driver.goal {
            // Beyond its end a run has nothing to show that an address could mean.
            *goal = (*goal).min(regatta::run::trace::last_tick(driver.studio.scene()));
        }
        driver.simulated_ns = driver.now_ns();
        driver
    }

    /// The page's time in nanoseconds.
    pub(crate) fn now_ns(&self) -> u64 {
        let ms = self.window.performance().map_or(0.0, |performance| performance.now());
        (ms * 1e6) as u64
    }

    /// Opens the run of a link, or tells why it leads to none.
    fn open_run(&mut self, run: Result<Scene, String>) {
        match run {
            Ok(scene) => {
                self.arrival = Some(Replay::new(scene.clone().into()));
                self.studio.open_file(Path::new(LINK), scene);
                self.has_opened = true;
            }
            Err(refused) => self.studio.viewer_mut().set_notice(refused),
        }
    }

    /// Opens the run of a link that was pasted.
    pub(crate) fn open_link(&mut self, written: &str) {
        self.open_run(scene_of(written));
        self.request_frame();
    }

    /// Applies the commands, and steps the ticks that are due.
    pub(crate) fn simulate(&mut self, now_ns: u64) {
        let scene = std::ptr::from_ref(self.studio.scene());
        for command in std::mem::take(&mut self.asked) {
            self.apply(command);
        }
        // What it takes to build another scene and to draw it first is not time in its run.
        if self.has_opened || scene != std::ptr::from_ref(self.studio.scene()) {
            (self.has_opened, self.last_frame_ns) = (true, None);
        }
        self.workers.ask(&self.studio);
        let frame_ns = self.last_frame_ns.map_or(0, |last| now_ns.saturating_sub(last));
        self.last_frame_ns = self.studio.running().then_some(now_ns);
        let passed_ns = now_ns.saturating_sub(std::mem::replace(&mut self.simulated_ns, now_ns));
        if !self.studio.time_runs() {
            self.studio.viewer_mut().pass(passed_ns as i64);
        }
        if !self.go_to_goal(now_ns) {
            let window = self.window.clone();
            let spent_ns = move || {
                let ms = window.performance().map_or(0.0, |performance| performance.now());
                ((ms * 1e6) as u64).saturating_sub(now_ns)
            };
            let mut is_time_left = || spent_ns() < MAX_SIMULATION_NS;
            self.studio.advance_in_time(u64::MAX, frame_ns as i64, &mut is_time_left, &mut ());
        }
        self.studio.viewer_mut().pace = Some(self.meter.pace());
    }

    /// Goes on to the tick that the address asks for, for a frame's time. Returns whether it is still on its way.
    fn go_to_goal(&mut self, now_ns: u64) -> bool {
        let Some((goal, plays)) = self.goal else { return false };
        while self.studio.race().tick() < goal {
            if self.now_ns().saturating_sub(now_ns) > MAX_SIMULATION_NS {
                return true;
            }
            self.studio.tick();
        }
        self.goal = None;
        self.last_frame_ns = None;
        if self.studio.running() != plays {
            self.studio.apply(ViewCommand::TogglePause);
        }
        false
    }

    fn apply(&mut self, command: Command) {
        let request = match command {
            Command::View(ViewCommand::AskForPath) => return files::ask(),
            Command::View(ViewCommand::AskForRun) => {
                let told = "a page compares no recordings; `regatta diff` does";
                return self.studio.viewer_mut().set_notice(told);
            }
            command => self.studio.apply(command),
        };
        match request {
            Some(DriverRequest::Screenshot) => self.saves_picture = true,
            Some(DriverRequest::Record) => self.save_recording(),
            Some(DriverRequest::ExportInstrument) => self.save_instrument(),
            Some(request) => self.copy(request),
            None => {}
        }
    }

    /// Puts what is asked for on the clipboard, if it is something to copy.
    fn copy(&mut self, request: DriverRequest) {
        let copied = match copied(&self.studio, request) {
            Some(Ok(copied)) => copied,
            Some(Err(refused)) => return self.studio.viewer_mut().set_notice(refused),
            None => return,
        };
        let mut text = copied.text.clone();
        let is_link = request == DriverRequest::CopyLink;
        if is_link {
            let history = self.window.history();
            _ = history.map(|h| h.replace_state_with_url(&JsValue::NULL, "", Some(&text)));
            text = self.window.location().href().unwrap_or(text);
        }
        clipboard::write(&self.window, &text, move |driver, taken| {
            let notice = match taken {
                Err(_) if is_link => "the address of this page is the run now; copy it".into(),
                taken => copied.notice(taken),
            };
            driver.studio.viewer_mut().set_notice(notice);
            driver.request_frame();
        });
    }

    /// Has the browser remember how the program is shown.
    pub(crate) fn remember(&self) {
        if let Some(storage) = storage(&self.window).filter(|_| self.remembers) {
            _ = storage.set_item(STORED, &SavedPreferences::of(&self.studio).to_text());
        }
    }

    /// Loads the page again at this tick of the run, after the graphics driver has taken the canvas away.
    pub(crate) fn start_again(&self) {
        let plays = if self.studio.running() { "&play" } else { "" };
        let tick = self.studio.race().tick();
        let link = self.studio.link().map(|link| format!("{link}&tick={tick}{plays}"));
        let (history, location) = (self.window.history(), self.window.location());
        if let (Ok(history), Ok(link)) = (history, link) {
            _ = history.replace_state_with_url(&JsValue::NULL, "", Some(&link));
        }
        _ = location.reload();
    }

    /// Puts the run into the address, and copies that.
    pub(crate) fn share(&mut self) {
        self.asked.push(Command::Ask(DriverRequest::CopyLink));
        self.request_frame();
    }

    /// Has time run.
    pub(crate) fn play(&mut self) {
        self.asked.push(Command::View(ViewCommand::TogglePause));
        self.request_frame();
    }

    /// Starts the run again, and has time run.
    pub(crate) fn begin_again(&mut self) {
        self.asked.push(Command::Stage(StageCommand::Restart));
        match self.studio.running() {
            true => self.request_frame(),
            false => self.play(),
        }
    }

    pub(crate) fn set_in_sight(&mut self, is_in_sight: bool) {
        self.is_in_sight = is_in_sight;
        self.last_frame_ns = None;
        if is_in_sight {
            self.request_frame();
        }
    }

    /// Has a frame drawn when the browser next shows one.
    pub(crate) fn request_frame(&mut self) {
        if !std::mem::replace(&mut self.frame_is_due, true) {
            let frame = Closure::once_into_js(|| with(Self::frame));
            _ = self.window.request_animation_frame(frame.unchecked_ref());
        }
    }

    /// Has work done between frames, if there is any.
    pub(crate) fn request_work(&mut self) {
        let has_more = self.workers.have_more() || self.arrival.is_some();
        if has_more && !std::mem::replace(&mut self.work_is_due, true) {
            self.after(0, Self::work);
        }
    }

    /// Has the driver do something after some milliseconds.
    pub(crate) fn after(&self, ms: i32, does: fn(&mut Self)) {
        let does = Closure::once_into_js(move || with(does));
        let set = Window::set_timeout_with_callback_and_timeout_and_arguments_0;
        _ = set(&self.window, does.unchecked_ref(), ms);
    }
}
