//! A display, the program on it, and a person at keyboard and mouse.

use std::io::{BufRead, BufReader};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use image::{Rgba, RgbaImage};
use tempfile::TempDir;
use x11rb::protocol::xproto::{ClientMessageEvent, ConnectionExt, EventMask, ImageFormat, Window};
use x11rb::rust_connection::RustConnection;

use crate::program::{Program, end};

/// Software draws some ten frames a second where every core is busy; a start takes a few seconds; and a race of a net
/// that may keep 1 MB for going back in time takes most of a second for each tick back.
const PATIENCE: Duration = Duration::from_secs(120);
const POLL: Duration = Duration::from_millis(15);

/// Waits for `found` to find something.
#[track_caller]
pub(crate) fn until<T>(what: &str, mut found: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(value) = found() {
            return value;
        }
        assert!(start.elapsed() < PATIENCE, "waited {PATIENCE:?} for {what}");
        std::thread::sleep(POLL);
    }
}

/// The program in its window. Display and program end with this value.
pub(crate) struct Desk {
    pub(crate) program: Program,
    pub(crate) window: String,
    display: Display,
}

impl Desk {
    /// Starts the program with these words, and the focus on its window.
    #[track_caller]
    pub(crate) fn open(arguments: &str) -> Self {
        Self::open_with(arguments, &[])
    }

    /// The same with environment variables set.
    #[track_caller]
    pub(crate) fn open_with(arguments: &str, variables: &[(&str, &str)]) -> Self {
        let display = Display::open();
        let mut program = display.start(arguments, variables);
        let window = until("a window", || {
            if let Some(status) = program.ended() {
                return Some(Err(status));
            }
            let found = display.xdotool("search --onlyvisible --name ^Regatta").ok()?;
            found.lines().last().map(|window| Ok(window.to_owned()))
        });
        let window = window.unwrap_or_else(|status| panic!("{status}: {}", program.said()));
        let desk = Self { program, window, display };
        desk.focus();
        desk
    }

    /// Gives the window the focus: there is no window manager to do it.
    #[track_caller]
    pub(crate) fn focus(&self) {
        until("the focus", || {
            let _ = self.display.xdotool(&format!("windowfocus {}", self.window));
            let focus = self.display.xdotool("getwindowfocus").ok()?;
            (focus.trim() == self.window).then_some(())
        });
    }

    /// Runs xdotool. `WINDOW` is replaced by the window's number.
    #[track_caller]
    pub(crate) fn xdotool(&self, words: &str) -> String {
        self.display.xdotool(&words.replace("WINDOW", &self.window)).unwrap()
    }

    /// Presses and releases keys, by their names in X.
    #[track_caller]
    pub(crate) fn press(&self, keys: &str) {
        self.xdotool(&format!("key {keys}"));
    }

    /// Clicks at this place of the window, in pixels.
    #[track_caller]
    pub(crate) fn click(&self, x: u32, y: u32) {
        self.xdotool(&format!("mousemove --window WINDOW {x} {y} click 1"));
    }

    #[track_caller]
    pub(crate) fn title(&self) -> String {
        self.xdotool("getwindowname WINDOW").trim_end().to_owned()
    }

    /// Waits for this title, up to the tick that a paused window names and no test can know.
    #[track_caller]
    pub(crate) fn titled(&self, expected: &str) {
        let expected = without_tick(expected);
        let mut title = String::new();
        let start = Instant::now();
        while title != expected {
            assert!(start.elapsed() < PATIENCE, "\"{title}\" did not become \"{expected}\"");
            std::thread::sleep(POLL);
            title = without_tick(&self.title());
        }
    }

    /// Waits for this title of a paused window, as [`Desk::titled`] does, and returns the tick that it names.
    #[track_caller]
    pub(crate) fn tick_of(&self, expected: &str) -> u64 {
        self.titled(expected);
        tick(&self.title()).expect("a paused window names its tick")
    }

    /// Waits for a paused window to show this tick.
    #[track_caller]
    pub(crate) fn at_tick(&self, expected: u64) {
        self.tick_within(expected..=expected);
    }

    /// Waits for a paused window to show one of these ticks, and returns it.
    #[track_caller]
    pub(crate) fn tick_within(&self, expected: RangeInclusive<u64>) -> u64 {
        let what = format!("one of the ticks {expected:?}");
        until(&what, || tick(&self.title()).filter(|tick| expected.contains(tick)))
    }

    /// Takes a screenshot. Returns its tick and its picture.
    #[track_caller]
    pub(crate) fn screenshot(&self) -> (u64, RgbaImage) {
        self.press("p");
        self.next_screenshot()
    }

    /// The screenshot that was asked for, once it is there.
    #[track_caller]
    pub(crate) fn next_screenshot(&self) -> (u64, RgbaImage) {
        until("a screenshot", || {
            let path = self.display.file("png")?;
            // Until it is written to its end it cannot be read.
            let image = image::open(&path).ok()?.to_rgba8();
            let (_, rest) = path.to_str()?.rsplit_once("-tick-")?;
            let tick = rest.strip_suffix(".png")?.parse().unwrap();
            std::fs::remove_file(path).unwrap();
            Some((tick, image))
        })
    }

    /// Has the program record its run, and returns the recording.
    #[track_caller]
    pub(crate) fn recording(&self) -> String {
        self.press("F5");
        until("a recording", || {
            let path = self.display.file("toml")?;
            // Its last line has no more to come.
            let text = std::fs::read_to_string(&path).unwrap();
            let is_whole = text.ends_with('\n');
            is_whole.then(|| std::fs::remove_file(path).unwrap())?;
            Some(text)
        })
    }

    /// The picture in the window.
    #[track_caller]
    pub(crate) fn sight(&self) -> RgbaImage {
        let (connection, window) = self.connect();
        let size = connection.get_geometry(window).unwrap().reply().unwrap();
        let (width, height) = (size.width, size.height);
        let format = ImageFormat::Z_PIXMAP;
        let image = connection.get_image(format, window, 0, 0, width, height, u32::MAX).unwrap();
        let mut pixels = image.reply().unwrap().data;
        for pixel in pixels.chunks_exact_mut(4) {
            pixel.swap(0, 2);
            pixel[3] = 255;
        }
        RgbaImage::from_raw(width.into(), height.into(), pixels).unwrap()
    }

    /// Waits for the window to show this screenshot of it, paused, `scale` pixels to a point.
    #[track_caller]
    pub(crate) fn shows(&self, picture: &RgbaImage, scale: u32) {
        // The bar above shows the frame rate, and the footer the notice of the screenshot.
        let between = |y: u32| (40 * scale..picture.height() - 32 * scale).contains(&y);
        let differ = |a: &Rgba<u8>, b: &Rgba<u8>| (0..4).any(|i| a[i].abs_diff(b[i]) > 1);
        until("the screenshot in the window", || {
            let sight = self.sight();
            assert_eq!(sight.dimensions(), picture.dimensions());
            let pairs = sight.enumerate_pixels().zip(picture.pixels());
            let off = pairs.filter(|((_, y, a), b)| between(*y) && differ(a, b)).count();
            // Now and then a letter falls on the other side of a quarter of a pixel.
            (off < 100).then_some(())
        });
    }

    /// Waits for a paused window to have drawn all that it had to.
    #[track_caller]
    pub(crate) fn still(&self) {
        let mut still = 0;
        until("stillness", || {
            still = if self.program.sleeps() { still + 1 } else { 0 };
            (still > 15).then_some(())
        });
    }

    /// Waits for a window that may move by itself: to be still, or to have drawn some frames from now on.
    #[track_caller]
    pub(crate) fn settles(&self) {
        let (mut still, mut frames, mut before) = (0, 0, self.sight());
        until("stillness or some frames", || {
            still = if self.program.sleeps() { still + 1 } else { 0 };
            let now = self.sight();
            frames += u32::from(now != before);
            before = now;
            (still > 15 || frames > 4).then_some(())
        });
    }

    /// Presses a key, and waits for something to change in a paused window.
    #[track_caller]
    pub(crate) fn press_and_see(&self, key: &str) {
        self.still();
        let before = self.sight();
        self.press(key);
        until("a change", || (self.sight() != before).then_some(()));
    }

    /// Makes the window this large, in pixels.
    #[track_caller]
    pub(crate) fn resize(&self, width: u32, height: u32) {
        self.xdotool(&format!("windowsize WINDOW {width} {height}"));
        until("the size", || (self.sight().dimensions() == (width, height)).then_some(()));
    }

    /// Asks the window to close, as the cross in its frame would.
    #[track_caller]
    pub(crate) fn close(&self) {
        let (connection, window) = self.connect();
        let atom = |name: &[u8]| connection.intern_atom(false, name).unwrap().reply().unwrap().atom;
        let data = [atom(b"WM_DELETE_WINDOW"), 0, 0, 0, 0];
        let event = ClientMessageEvent::new(32, window, atom(b"WM_PROTOCOLS"), data);
        connection.send_event(false, window, EventMask::NO_EVENT, event).unwrap().check().unwrap();
    }

    #[track_caller]
    pub(crate) fn connect(&self) -> (RustConnection, Window) {
        let (connection, _) = RustConnection::connect(Some(&self.display.name)).unwrap();
        (connection, self.window.parse().unwrap())
    }

    /// Lays another window of the program over this one.
    #[track_caller]
    pub(crate) fn cover(&self) -> Program {
        let cover = self.display.start("--scene stiff", &[]);
        until("the cover", || {
            self.display.xdotool("search --onlyvisible --name ^Regatta\\s-\\sstiff").ok()
        });
        cover
    }

    /// How much of a core the program uses from now on for so long.
    pub(crate) fn load_over(&self, span: Duration) -> f64 {
        let start = self.program.processor_time();
        std::thread::sleep(span);
        (self.program.processor_time() - start).as_secs_f64() / span.as_secs_f64()
    }

    /// Ends the program by the keys. After Escape has taken all layers away, a deed that undoes itself answers the question
    /// with no if it is asked, so that Enter then follows the question.
    #[track_caller]
    pub(crate) fn quit(mut self) {
        until("the end", || {
            let layers = "Escape ".repeat(12);
            let _ = self.display.xdotool(&format!("key {layers} F4 F4 Escape Return"));
            self.program.ended()
        });
        self.ends();
    }

    /// Kills the program, which can do nothing about it, and returns its display.
    pub(crate) fn kill(self) -> Display {
        let Self { program, display, .. } = self;
        drop(program);
        display
    }

    /// The folder that the program works in.
    pub(crate) fn folder(&self) -> &Path {
        self.display.folder()
    }

    /// Waits for the program to end of itself, which it has to do well and in silence.
    #[track_caller]
    pub(crate) fn ends(mut self) {
        let status = until("the end", || self.program.ended());
        assert_eq!((status.code(), self.program.said().as_str()), (Some(0), ""));
    }
}

/// The tick that the title of a paused window names.
fn tick(title: &str) -> Option<u64> {
    let (_, rest) = title.split_once(" (paused, tick ")?;
    rest.strip_suffix(')')?.parse().ok()
}

fn without_tick(title: &str) -> String {
    match title.split_once(" (paused, tick ") {
        Some((before, _)) => format!("{before} (paused)"),
        None => title.to_owned(),
    }
}

/// A display server without a screen, and a folder for its programs to work in.
pub(crate) struct Display {
    server: Child,
    name: String,
    folder: TempDir,
}

impl Display {
    pub(crate) fn open() -> Self {
        Self::of_screen("2600x1500x24")
    }

    /// The same with a screen of this width, height and number of bits a pixel.
    pub(crate) fn of_screen(screen: &str) -> Self {
        let mut server = Command::new("Xvfb")
            .args("-displayfd 1 -noreset -nolisten tcp -screen 0".split(' '))
            .arg(screen)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts");
        let mut number = String::new();
        let stdout = server.stdout.take().expect("it is piped");
        BufReader::new(stdout).read_line(&mut number).expect("Xvfb writes its display's number");
        let folder = TempDir::new().unwrap();
        Self { server, name: format!(":{}", number.trim()), folder }
    }

    /// Starts the program on this display.
    pub(crate) fn start(&self, arguments: &str, variables: &[(&str, &str)]) -> Program {
        let here = [("DISPLAY", self.name.as_str()), ("WINIT_X11_SCALE_FACTOR", "1")];
        Program::start(self.folder.path(), arguments, &[&here, variables].concat())
    }

    /// The folder that its programs work in.
    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    fn xdotool(&self, words: &str) -> Result<String, String> {
        let mut command = Command::new("xdotool");
        let output = command.args(words.split(' ')).env("DISPLAY", &self.name).output().unwrap();
        let [said, complaint] =
            [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
        if output.status.success() { Ok(said) } else { Err(format!("{words}: {complaint}")) }
    }

    /// The first file in the folder with this extension.
    fn file(&self, wanted: &str) -> Option<PathBuf> {
        let mut files = self.folder.path().read_dir().unwrap().map(|file| file.unwrap().path());
        files.find(|path| path.extension().is_some_and(|extension| extension == wanted))
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        end(&mut self.server);
    }
}
