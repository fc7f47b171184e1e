//! Wayland without keys: what a compositor shows, and one that asks for no more frames.

use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use image::RgbaImage;
use tempfile::TempDir;

use crate::desk::until;
use crate::program::{self, Program};
use crate::touch::body;

struct Compositor {
    server: Child,
    folder: TempDir,
}

impl Compositor {
    fn open() -> Self {
        let folder = TempDir::new().unwrap();
        let server = Command::new("weston")
            .args(["--backend=headless-backend.so", "--socket=sea", "--width=1280", "--height=800"])
            // With these it draws what it shows, and everybody may ask for a screenshot.
            .args(["--use-pixman", "--debug"])
            .env("XDG_RUNTIME_DIR", folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("weston starts");
        until("a compositor", || folder.path().join("sea").exists().then_some(()));
        Self { server, folder }
    }

    fn screenshot(&self) -> RgbaImage {
        let shot = Command::new("weston-screenshooter")
            .current_dir(self.folder.path())
            .envs([("XDG_RUNTIME_DIR", self.folder.path())])
            .env("WAYLAND_DISPLAY", "sea")
            .status();
        assert!(shot.unwrap().success());
        let files = self.folder.path().read_dir().unwrap();
        let is_shot = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "png");
        let file = files.map(|entry| entry.unwrap().path()).find(is_shot).unwrap();
        let shot = image::open(&file).unwrap().to_rgba8();
        std::fs::remove_file(file).unwrap();
        shot
    }
}

impl Drop for Compositor {
    fn drop(&mut self) {
        program::end(&mut self.server);
    }
}

pub(crate) fn a_wayland_window_without_frame_requests_drops_no_ticks() {
    let compositor = Compositor::open();
    let variables = [("WAYLAND_DISPLAY", "sea"), ("RUST_LOG", "regatta=info")];
    let folder = compositor.folder.path();
    let mut program = Program::start(folder, "--scene ship --tick-hz 2 --seconds 11", &variables);
    program.says("first frame").unwrap();
    let start = Instant::now();
    program::stop_for(&compositor.server, Duration::from_secs(10));
    let status = until("the end", || program.ended());
    let took = start.elapsed();
    assert_eq!((status.code(), program.said().as_str()), (Some(0), ""));
    // Another ten seconds, if those had not been simulated: so many may a busy machine take.
    assert!((Duration::from_secs(10)..Duration::from_secs(21)).contains(&took), "{took:?}");
}

/// Starts the program under a compositor, and waits for the mass on the screen.
fn is_shown(renderer: &str) {
    let compositor = Compositor::open();
    let variables = [("WAYLAND_DISPLAY", "sea"), ("RUST_LOG", "regatta=info")];
    let arguments = format!("--scene spring --method rk4 --theme dark --renderer {renderer}");
    let mut program = Program::start(compositor.folder.path(), &arguments, &variables);
    program.says("first frame").unwrap();
    until("the mass on the screen", || body(&compositor.screenshot()));
}

pub(crate) fn a_wayland_compositor_shows_what_the_processor_draws() {
    is_shown("cpu");
}

pub(crate) fn a_wayland_compositor_shows_what_a_graphics_card_draws() {
    is_shown("gpu");
}

pub(crate) fn a_lost_compositor_is_told_of_once() {
    let mut compositor = Compositor::open();
    let arguments = "--scene spring --method rk4 --theme dark --renderer cpu";
    let variables = [("WAYLAND_DISPLAY", "sea")];
    let mut program = Program::start(compositor.folder.path(), arguments, &variables);
    until("the mass on the screen", || body(&compositor.screenshot()));
    program::end(&mut compositor.server);
    let status = until("the end", || program.ended());
    let lost = "error: the connection to the window system was lost\n";
    assert_eq!((status.code(), program.said().as_str()), (Some(1), lost));
}
