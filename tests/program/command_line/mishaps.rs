//! Accidents during a capture: no frame is lost, partial or out of order, and an interrupted capture can be repeated
//! in the same place.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

#[cfg(unix)]
use super::ended_by;
use super::{names, regatta, run_in, start, stderr};
#[cfg(target_os = "linux")]
use super::{until_worked, work_after};

const FRAMES: usize = 25;
const CAPTURE: &str = "capture --scene harbour --race --frames 25 --size 96x54 --scale 0.5 --out";

/// Random numbers from a seed that is printed, so that a failure can be had again.
pub(crate) struct XorShift(u64);

impl XorShift {
    pub(crate) fn new() -> Self {
        let since = SystemTime::now().duration_since(UNIX_EPOCH).expect("after 1970");
        let given = std::env::var("SEED").ok().and_then(|seed| seed.parse().ok());
        let seed = given.unwrap_or(since.as_nanos() as u64 | 1);
        println!("{}: SEED={seed}", thread::current().name().unwrap_or_default());
        Self(seed)
    }

    pub(crate) fn below(&mut self, limit: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % limit
    }
}

/// The whole capture, and how long it takes.
fn whole(folder: &Path) -> Duration {
    let begin = SystemTime::now();
    let output = run_in(folder, &format!("{CAPTURE} whole"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    begin.elapsed().unwrap_or_default()
}

/// Whether the frames in `clip` are the first ones of `whole`, to the byte; the names of the rest.
fn first_of_whole(folder: &Path) -> (usize, Vec<String>) {
    let mut rest = if folder.join("clip").exists() { names(&folder.join("clip")) } else { vec![] };
    let frame = |n: usize| format!("frame-{n:06}.png");
    let mut frames = 0;
    while let Some(at) = rest.iter().position(|name| *name == frame(frames)) {
        let name = rest.remove(at);
        let [clip, whole] = ["clip", "whole"].map(|dir| fs::read(folder.join(dir).join(&name)));
        assert!(clip.unwrap() == whole.unwrap(), "{name} is not whole");
        frames += 1;
    }
    (frames, rest)
}

fn draw_again(folder: &Path) {
    let output = run_in(folder, &format!("{CAPTURE} clip --force"));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let (frames, rest) = first_of_whole(folder);
    assert_eq!((frames, rest), (FRAMES, vec!["manifest.json".to_owned()]));
    let [clip, whole] =
        ["clip", "whole"].map(|dir| fs::read(folder.join(dir).join("manifest.json")));
    assert!(clip.unwrap() == whole.unwrap(), "another manifest");
}

#[cfg(target_os = "linux")]
#[test]
fn running_out_of_memory_ends_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    // Of address space. A frame of the largest size takes 256 MiB.
    let limited = format!("ulimit -v {}; exec \"$0\" \"$@\"", 250 << 10);
    for (size, code) in [("64x36", 0), ("8192x8192", 1)] {
        let capture = format!("capture --scene spring --frames 1 --size {size} --out of-{size}");
        let mut command = Command::new("sh");
        command.args(["-c", &limited]).arg(regatta().get_program()).args(capture.split(' '));
        let output = command.current_dir(folder.path()).output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(code), "{size}: {:?} {said}", output.status);
        let is_refused = said.contains("no memory for a frame of 8192x8192; give a smaller size");
        assert_eq!(is_refused, code == 1, "{said}");
    }
}

#[cfg(unix)]
#[test]
fn killing_a_capture_leaves_whole_frames_and_it_can_be_redrawn() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let whole = whole(folder);
    let mut random = XorShift::new();
    for _ in 0..10 {
        let _ = fs::remove_dir_all(folder.join("clip"));
        let mut child = start(folder, &format!("{CAPTURE} clip"));
        thread::sleep(Duration::from_micros(random.below(whole.as_micros() as u64)));
        // That is SIGKILL.
        child.kill().unwrap();
        child.wait().unwrap();
        let (frames, rest) = first_of_whole(folder);
        // The one being written.
        let under_way = match frames {
            FRAMES => "manifest.json.".to_owned(),
            _ => format!("frame-{frames:06}.png."),
        };
        let is_part = |name: &String| name.ends_with(".part") && name.starts_with(&under_way);
        let is_done = frames == FRAMES && rest == ["manifest.json"];
        let is_under_way = rest.len() <= 1 && rest.iter().all(is_part);
        assert!(is_done || is_under_way, "{frames} frames and {rest:?}");
        draw_again(folder);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn an_interrupt_during_verdicts_ends_the_capture_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // Seconds of verdicts, whole or cut short.
    let capture = "capture --scene orbit --race --tick-hz 10000 --frames 1 --size 96x54 --out clip";
    for signal in ["-INT", "-TERM"] {
        let mut child = start(folder, capture);
        until_worked(&mut child, Duration::from_millis(500));
        let (output, work) = work_after(signal, child);
        assert_eq!(output.status.code(), Some(130), "{signal}: {}", stderr(&output));
        assert!(work < Duration::from_secs(1), "{signal}: {work:?}");
        assert!(!folder.join("clip/frame-000000.png").exists(), "{signal}");
        let _ = fs::remove_dir_all(folder.join("clip"));
    }
}

#[cfg(unix)]
#[test]
fn interrupting_a_capture_leaves_a_manifest_of_its_frames() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    whole(folder);
    let mut random = XorShift::new();
    let mut interrupted = 0;
    for _ in 0..7 {
        let _ = fs::remove_dir_all(folder.join("clip"));
        let child = start(folder, &format!("{CAPTURE} clip"));
        let frame = folder.join(format!("clip/frame-{:06}.png", random.below(FRAMES as u64)));
        while !frame.exists() {
            thread::sleep(Duration::from_micros(random.below(1000)));
        }
        let output = ended_by("-INT", child);
        let (frames, rest) = first_of_whole(folder);
        assert_eq!(rest, ["manifest.json"], "{}", stderr(&output));
        let manifest = fs::read_to_string(folder.join("clip/manifest.json")).unwrap();
        let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
        assert_eq!(manifest["frames"].as_array().unwrap().len(), frames);
        assert_eq!(manifest["complete"], frames == FRAMES);
        if frames < FRAMES {
            interrupted += 1;
            assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
            for part in ["", " --physics-only"] {
                let judged = run_in(folder, &format!("verify clip{part}"));
                assert_eq!(judged.status.code(), Some(2), "{}", stderr(&judged));
                let reason = format!("its capture was stopped after {frames} of {FRAMES} frames");
                assert!(stderr(&judged).contains(&reason), "{}", stderr(&judged));
            }
        }
        draw_again(folder);
    }
    assert!(interrupted > 0, "every run was done before it was interrupted");
}

#[test]
fn an_uncreatable_directory_ends_the_capture() {
    let folder = tempfile::tempdir().unwrap();
    // Permissions do not stop the superuser; a file in the way stops everybody.
    fs::write(folder.path().join("file"), "mine").unwrap();
    let output = run_in(folder.path(), &format!("{CAPTURE} file/clip"));
    assert!(matches!(output.status.code(), Some(1 | 2)), "{}", stderr(&output));
    assert!(stderr(&output).contains("file/clip"), "{}", stderr(&output));
    assert_eq!(fs::read(folder.path().join("file")).unwrap(), b"mine");
}
