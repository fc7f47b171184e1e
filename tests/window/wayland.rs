//! Wayland without keys: what a compositor shows, and one that asks for no more frames.

use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use image::RgbaImage;
use tempfile::TempDir;

use crate::desk::{self, until};
use crate::program::{self, Program};
use crate::touch::body;

struct Compositor {
    server: Child,
    folder: TempDir,
}

impl Compositor {
    fn open(test: &str) -> Option<Self> {
        let folder = TempDir::new().unwrap();
        let server = Command::new("weston")
            .args(["--backend=headless-backend.so", "--socket=sea", "--width=1280", "--height=800"])
            // With these it draws what it shows, and everybody may ask for a screenshot.
            .args(["--use-pixman", "--debug"])
            .env("XDG_RUNTIME_DIR", folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        match server {
            Ok(server) => {
                until("a compositor", || folder.path().join("sea").exists().then_some(()));
                Some(Self { server, folder })
            }
            Err(error) => desk::skip(test, &format!("weston: {error}")),
        }
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

#[test]
fn a_wayland_window_without_frame_requests_drops_no_ticks() {
    let test = "a_wayland_window_without_frame_requests_drops_no_ticks";
    let Some(compositor) = Compositor::open(test) else { return };
    let variables = [("WAYLAND_DISPLAY", "sea"), ("RUST_LOG", "regatta=info")];
    let folder = compositor.folder.path();
    let mut program = Program::start(folder, "--scene ship --tick-hz 2 --seconds 5", &variables);
    program.says("first frame").unwrap();
    let start = Instant::now();
    program::stop_for(&compositor.server, Duration::from_secs(4));
    let status = until("the end", || program.ended());
    let took = start.elapsed();
    assert_eq!((status.code(), program.said().as_str()), (Some(0), ""));
    // It would be four seconds more if those four had not been simulated.
    assert!((Duration::from_secs(4)..Duration::from_secs(7)).contains(&took), "{took:?}");
}

#[test]
fn a_wayland_compositor_shows_the_stage_whatever_draws_it() {
    let test = "a_wayland_compositor_shows_the_stage_whatever_draws_it";
    let Some(compositor) = Compositor::open(test) else { return };
    let variables = [("WAYLAND_DISPLAY", "sea"), ("RUST_LOG", "regatta=info")];
    for renderer in ["cpu", "gpu"] {
        let arguments = format!("--scene spring --method rk4 --theme dark --renderer {renderer}");
        let mut program = Program::start(compositor.folder.path(), &arguments, &variables);
        if let Err(said) = program.says("first frame") {
            assert_eq!(renderer, "gpu", "{said}");
            let _: Option<()> = desk::skip_for_want_of_an_adapter(test, &said);
            return;
        }
        until("the mass on the screen", || body(&compositor.screenshot()));
    }
}

#[test]
fn a_lost_compositor_is_told_of_once() {
    let Some(mut compositor) = Compositor::open("a_lost_compositor_is_told_of_once") else {
        return;
    };
    let arguments = "--scene spring --method rk4 --theme dark --renderer cpu";
    let variables = [("WAYLAND_DISPLAY", "sea")];
    let mut program = Program::start(compositor.folder.path(), arguments, &variables);
    until("the mass on the screen", || body(&compositor.screenshot()));
    program::end(&mut compositor.server);
    let status = until("the end", || program.ended());
    let lost = "error: the connection to the window system was lost\n";
    assert_eq!((status.code(), program.said().as_str()), (Some(1), lost));
}
