//! Wayland without keys: a compositor that asks for no more frames.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;

use crate::desk::{self, until};
use crate::program::{self, Program};

struct Compositor {
    server: Child,
    folder: TempDir,
}

impl Compositor {
    fn open(test: &str) -> Option<Self> {
        let folder = TempDir::new().unwrap();
        let server = Command::new("weston")
            .args(["--backend=headless-backend.so", "--socket=sea", "--width=1280", "--height=800"])
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
    if let Err(said) = program.says("first frame") {
        let _: Option<()> = desk::skip_for_want_of_an_adapter(test, &said);
        return;
    }
    let start = Instant::now();
    program::stop_for(&compositor.server, Duration::from_secs(4));
    let status = until("the end", || program.ended());
    let took = start.elapsed();
    assert_eq!((status.code(), program.said().as_str()), (Some(0), ""));
    // It would be four seconds more if those four had not been simulated.
    assert!((Duration::from_secs(4)..Duration::from_secs(7)).contains(&took), "{took:?}");
}
