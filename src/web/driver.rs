//! The driver, which is a studio, its canvas, and the page's events since the last frame.

use std::cell::RefCell;
use std::path::Path;

use regatta::look::palette::Theme;
use regatta::run::Replay;
use regatta::scene::Scene;
use regatta::studio::{
    Command, DriverRequest, FrameLoop, Motion, SavedPreferences, StageCommand, Studio, ViewCommand,
    open_file,
};
use regatta::view::{clipboard_text, egui};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::{Closure, JsValue};
use web_sys::{Storage, Window};

use crate::address::Address;
use crate::canvas::Canvas;
use crate::pointer::Fingers;
use crate::work::Workers;

/// Memory limit for rewinding a run, in bytes. Phones have little memory, and a page that is left open must not grow.
const REWIND_BYTES: usize = 16 << 20;

/// Key under which the browser stores a person's preferences.
const STORED: &str = "regatta";

/// Name of a scene that comes from an address.
const LINK: &str = "a link";

pub(crate) struct Driver {
    pub(crate) window: Window,
    pub(crate) canvas: Canvas,
    pub(crate) frames: FrameLoop,
    pub(crate) workers: Workers,
    /// The run of a link, until its replay has shown whether it is the same here.
    pub(crate) arrival: Option<Replay>,
    /// Whether another page embeds the stage.
    pub(crate) is_embedded: bool,
    /// Whether the stage is in sight on a page that embeds it.
    pub(crate) is_in_sight: bool,
    /// Whether to store the display settings. Settings that come from an address are nobody's choice, so they are not
    /// stored.
    remembers: bool,
    /// Input that the panels receive with the next frame.
    pub(crate) input: egui::RawInput,
    pub(crate) held: egui::Modifiers,
    /// Whether a person has entered the stage. The Tab key then belongs to its panels, and Escape and Tab lead out of
    /// it.
    pub(crate) is_entered: bool,
    pub(crate) was_escaped: bool,
    /// The text that a screen reader last received.
    pub(crate) spoken: String,
    /// The stage for which the page has its link to an explanation: the number of opened scenes, the method, and
    /// whether it is the loop lab.
    pub(crate) explained: Option<(u64, usize, bool)>,
    pub(crate) fingers: Fingers,
    /// Number of frames drawn.
    pub(crate) drawn: u32,
    /// Whether to save the next frame as a picture.
    pub(crate) saves_picture: bool,
    pub(crate) frame_is_due: bool,
    pub(crate) work_is_due: bool,
}

thread_local! {
    static DRIVER: RefCell<Option<Driver>> = const { RefCell::new(None) };
}

/// Makes this the page's driver.
pub(crate) fn set(driver: Driver) {
    DRIVER.set(Some(driver));
}

/// Runs `does` on the page's driver. Calls from within another such call, as by the click of a download, are ignored.
pub(crate) fn with(does: impl FnOnce(&mut Driver)) {
    DRIVER.with(|driver| {
        if let Ok(mut driver) = driver.try_borrow_mut()
            && let Some(driver) = driver.as_mut()
        {
            does(driver);
        }
    });
}

/// Returns the browser's storage for the page, if there is any.
fn storage(window: &Window) -> Option<Storage> {
    window.local_storage().ok().flatten()
}

/// Returns the page's time in nanoseconds.
pub(crate) fn now_ns(window: &Window) -> u64 {
    let ms = window.performance().map_or(0.0, |performance| performance.now());
    (ms * 1e6) as u64
}

/// Whether the page handles this command itself. It lets the browser pick a file, and does not compare recordings.
fn is_own(command: &Command) -> bool {
    matches!(command, Command::View(ViewCommand::AskForPath | ViewCommand::AskForRun))
}

/// Returns the system's theme.
pub(crate) fn theme_of(window: &Window) -> Theme {
    if prefers(window, "(prefers-color-scheme: light)") { Theme::Light } else { Theme::Dark }
}

fn prefers(window: &Window, query: &str) -> bool {
    window.match_media(query).ok().flatten().is_some_and(|found| found.matches())
}

impl Driver {
    pub(crate) fn new(
        window: Window,
        canvas: Canvas,
        address: Address,
        mut studio: Studio,
    ) -> Self {
        // The stage is alone at first, as in the window, unless a person has stored another choice.
        let remembered = storage(&window).and_then(|storage| storage.get_item(STORED).ok()?);
        let remembered = remembered.and_then(|text| SavedPreferences::parse(&text).ok());
        remembered.unwrap_or_default().apply(&mut studio);
        studio.deck.set_rewind_bytes(REWIND_BYTES);
        let preferences = &mut studio.viewer.preferences;
        preferences.follow_theme(theme_of(&window));
        if let Some(theme) = address.theme {
            preferences.choose_theme(theme);
        }
        preferences.is_page = true;
        let is_calm = prefers(&window, "(prefers-reduced-motion: reduce)");
        preferences.display.motion = if is_calm { Motion::Reduced } else { Motion::Live };
        let display = &mut preferences.display;
        display.measure = !address.is_embedded && (display.measure || address.opens_at_work());
        let workers = Workers::new(&studio);
        let now_ns = now_ns(&window);
        let mut driver = Self {
            window,
            canvas,
            workers,
            frames: FrameLoop::new(studio, is_own, now_ns),
            arrival: None,
            is_embedded: address.is_embedded,
            is_in_sight: true,
            remembers: !address.is_embedded && address.theme.is_none() && !address.opens_at_work(),
            input: egui::RawInput { focused: true, ..egui::RawInput::default() },
            held: egui::Modifiers::default(),
            is_entered: false,
            was_escaped: false,
            spoken: String::new(),
            explained: None,
            fingers: Fingers::default(),
            drawn: 0,
            saves_picture: false,
            frame_is_due: false,
            work_is_due: false,
        };
        let runs = address.runs_at_first() && !is_calm;
        driver.open_run(address.run);
        if let Some(instrument) = address.instrument {
            driver.frames.studio.viewer.preferences.display.instrument = instrument;
        }
        match address.tick {
            Some(tick) => driver.go_to(tick, runs),
            None if runs => {}
            None => _ = driver.frames.studio.apply(ViewCommand::TogglePause),
        }
        driver
    }

    /// Goes to a requested tick. `runs` decides whether time runs on from there.
    fn go_to(&mut self, tick: u64, runs: bool) {
        // An address cannot mean a tick beyond the end of a run.
        let last = regatta::run::trace::last_tick(self.frames.studio.scene());
        self.frames.go_to(tick.min(last), runs);
    }

    pub(crate) fn now_ns(&self) -> u64 {
        now_ns(&self.window)
    }

    /// Opens the run that a link contains, if there is one.
    fn open_run(&mut self, run: Option<Scene>) {
        if let Some(scene) = run {
            self.arrival = Some(Replay::new(scene.clone().into()));
            open_file(&mut self.frames.studio, Path::new(LINK), scene);
        }
    }

    /// Opens a pasted link and puts it into the page's address. If the link leads to no run, shows the reason.
    pub(crate) fn open_link(&mut self, written: &str) {
        match Address::of(written).and_then(|address| address.studio().map(|_| address)) {
            Ok(address) if address.run.is_some() => {
                self.put_fragment(&address.fragment());
                self.open_run(address.run);
                if let Some(tick) = address.tick {
                    self.go_to(tick, address.plays);
                }
            }
            // The page has to be reloaded to open the scene that a link names.
            Ok(address) => {
                self.put_fragment(&address.fragment());
                _ = self.window.location().reload();
            }
            Err(refused) => self.frames.studio.viewer.set_notice(refused),
        }
        self.request_frame();
    }

    /// Puts a link into the page's address.
    fn put_fragment(&self, link: &str) {
        let history = self.window.history();
        _ = history.map(|h| h.replace_state_with_url(&JsValue::NULL, "", Some(link)));
    }

    /// Puts the run into the page's address, unless another page embeds the stage. Returns the whole address of the
    /// run.
    ///
    /// # Errors
    /// The reason why no link can hold the run.
    pub(crate) fn put_into_address(&self) -> Result<String, String> {
        let copied = clipboard_text(&self.frames.studio, DriverRequest::CopyLink);
        let link = copied.unwrap_or_else(|| Err("there is no run".into()))?.text;
        let address = self.window.location().href().unwrap_or_default();
        let page = address.split('#').next().unwrap_or_default();
        // An embedded stage must still be embedded when its page is opened again.
        if !self.is_embedded {
            self.put_fragment(&link);
        }
        Ok(format!("{page}{link}"))
    }

    /// Stores the display settings in the browser.
    pub(crate) fn remember(&self) {
        if let Some(storage) = storage(&self.window).filter(|_| self.remembers) {
            _ = storage.set_item(STORED, &SavedPreferences::of(&self.frames.studio).to_text());
        }
    }

    /// Reloads the page at the present tick of the run, after the graphics driver has taken the canvas away.
    pub(crate) fn reload_page(&self) {
        let plays = if self.frames.studio.running() { "&play" } else { "" };
        let tick = self.frames.studio.race().tick();
        let panels = if self.is_embedded { "&panels=off" } else { "" };
        if let Ok(link) = self.frames.studio.deck.link() {
            self.put_fragment(&format!("{link}&tick={tick}{plays}{panels}"));
        }
        _ = self.window.location().reload();
    }

    /// Resumes time, or pauses it.
    pub(crate) fn toggle_pause(&mut self) {
        self.frames.queue([Command::View(ViewCommand::TogglePause)]);
        self.request_frame();
    }

    /// Restarts the run and lets time run.
    pub(crate) fn restart(&mut self) {
        self.frames.queue([Command::Stage(StageCommand::Restart)]);
        match self.frames.studio.running() {
            true => self.request_frame(),
            false => self.toggle_pause(),
        }
    }

    pub(crate) fn set_in_sight(&mut self, is_in_sight: bool) {
        self.is_in_sight = is_in_sight;
        self.frames.skip_time();
        if is_in_sight {
            self.request_frame();
        }
    }

    /// Requests a frame from the browser, unless a frame is already due.
    pub(crate) fn request_frame(&mut self) {
        if !std::mem::replace(&mut self.frame_is_due, true) {
            let frame = Closure::once_into_js(|| with(Self::frame));
            _ = self.window.request_animation_frame(frame.unchecked_ref());
        }
    }

    /// Schedules work between frames, if there is any to do.
    pub(crate) fn request_work(&mut self) {
        let has_more = self.workers.have_more() || self.arrival.is_some();
        if has_more && !std::mem::replace(&mut self.work_is_due, true) {
            self.run_after_ms(0, Self::work);
        }
    }

    /// Calls `does` on the driver after this number of milliseconds.
    pub(crate) fn run_after_ms(&self, ms: i32, does: fn(&mut Self)) {
        let does = Closure::once_into_js(move || with(does));
        let set = Window::set_timeout_with_callback_and_timeout_and_arguments_0;
        _ = set(&self.window, does.unchecked_ref(), ms);
    }
}
