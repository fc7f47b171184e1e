//! `capture`, and `play` without a display: the content of the directory in every case.

use std::fs;
use std::path::Path;

use super::{dimensions, names, regatta, run_in, stderr};
#[cfg(unix)]
use super::{ended_by, start};

#[test]
fn the_same_command_makes_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let capture = "capture --scene harbour --race --frames 3 --fps 10 --size 320x180 --out";
    for out in ["a", "b/c"] {
        let output = run_in(folder.path(), &format!("{capture} {out}"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert!(output.stdout.is_empty());
        let last = stderr(&output).lines().last().unwrap().to_owned();
        let names = format!("{out}/frame-000000.png … frame-000002.png");
        assert_eq!(last, format!("wrote 3 frames, 320x180, 10 fps: {names}"));
    }
    let [a, b] = ["a", "b/c"].map(|out| folder.path().join(out));
    let frames = ["frame-000000.png", "frame-000001.png", "frame-000002.png"];
    assert_eq!(names(&a), [&frames[..], &["manifest.json"]].concat());
    assert_eq!(names(&a), names(&b));
    let bytes = |directory: &Path, name: &String| fs::read(directory.join(name)).unwrap();
    for name in names(&a) {
        assert!(bytes(&a, &name) == bytes(&b, &name), "{name} differs");
    }
    assert!(frames.iter().all(|frame| dimensions(&a.join(frame)) == (320, 180)));
    let [first, last] = ["frame-000000.png", "frame-000002.png"].map(String::from);
    assert!(bytes(&a, &first) != bytes(&a, &last), "nothing moved");
}

#[test]
fn force_replaces_all_frames_but_no_other_file() {
    let folder = tempfile::tempdir().unwrap();
    let clip = folder.path().join("clip");
    let older = "capture --scene spring --frames 3 --size 16x16 --out clip";
    run_in(folder.path(), older);
    fs::write(clip.join("notes.txt"), "old").unwrap();
    let before = names(&clip);
    let capture = "capture --scene ship --frames 1 --size 32x32 --out clip";
    let refused = run_in(folder.path(), capture);
    assert_eq!(refused.status.code(), Some(2));
    assert_eq!(names(&clip), before);

    let forced = run_in(folder.path(), &format!("{capture} --force"));
    assert_eq!(forced.status.code(), Some(0), "{}", stderr(&forced));
    assert!(stderr(&forced).contains("left alone in clip: notes.txt"), "{}", stderr(&forced));
    assert_eq!(names(&clip), ["frame-000000.png", "manifest.json", "notes.txt"]);
    assert_eq!(dimensions(&clip.join("frame-000000.png")), (32, 32));
    assert_eq!(fs::read(clip.join("notes.txt")).unwrap(), b"old");
}

#[test]
fn the_smallest_the_largest_and_odd_sizes_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    for (width, height) in [(1, 1), (3, 997), (1001, 2), (3840, 2160)] {
        let size = format!("{width}x{height}");
        let capture = format!("capture --race --frames 1 --size {size} --scale 2 --out {size}");
        let output = run_in(folder.path(), &capture);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let picture = folder.path().join(size).join("frame-000000.png");
        assert_eq!(dimensions(&picture), (width, height));
    }
}

#[test]
fn an_unwritable_frame_ends_the_capture_with_whole_files_only() {
    let folder = tempfile::tempdir().unwrap();
    let in_the_way = folder.path().join("clip/frame-000002.png");
    fs::create_dir_all(in_the_way.join("something")).unwrap();
    let capture = "capture --frames 5 --size 16x16 --out clip --force";
    let output = run_in(folder.path(), capture);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write clip/frame-000002.png: "), "{said}");
    assert!(said.contains("whole before that: clip/frame-000000.png … frame-000001.png"), "{said}");
    let clip = folder.path().join("clip");
    assert_eq!(names(&clip), ["frame-000000.png", "frame-000001.png", "frame-000002.png"]);
    assert_eq!(dimensions(&clip.join("frame-000001.png")), (16, 16));
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_whole_frames_and_reports_their_number() {
    let folder = tempfile::tempdir().unwrap();
    let probe = "capture --frames 1 --size 16x16 --out probe";
    run_in(folder.path(), probe);
    let child = start(folder.path(), "capture --frames 100000 --size 64x64 --out clip");
    let clip = folder.path().join("clip");
    while !clip.join("frame-000002.png").exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let output = ended_by("-INT", child);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(130), "{said}");
    let mut frames = names(&clip);
    assert_eq!(frames.pop().unwrap(), "manifest.json");
    let last = frames.last().unwrap();
    let expected = format!("interrupted after {} of 100000 frames; whole: ", frames.len());
    assert!(said.contains(&expected), "{said}");
    assert!(said.trim_end().ends_with(last), "{said}");
    assert!(frames.iter().all(|frame| dimensions(&clip.join(frame)) == (64, 64)));
}

// Elsewhere the display does not depend on the environment.
#[cfg(target_os = "linux")]
#[test]
fn without_a_display_the_demo_is_drawn_into_a_fresh_directory() {
    let folder = tempfile::tempdir().unwrap();
    for out in ["regatta-frames", "regatta-frames-2"] {
        let output = run_in(folder.path(), "--seconds 0.1");
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert!(said.starts_with("no display to open a window on (neither "), "{said}");
        assert!(said.contains(&format!("0.1 s of it into {out} instead\n")), "{said}");
        let wrote = format!("wrote 3 frames, 1280x720, 30 fps: {out}/frame-000000.png");
        assert!(said.contains(&wrote), "{said}");
        assert_eq!(names(&folder.path().join(out)).len(), 4);
    }
}

#[test]
fn a_capture_with_a_cloud_shows_it_and_can_be_verified() {
    let folder = tempfile::tempdir().unwrap();
    // Pixels of the method's blue in the panel.
    let blue = |out: &str, options: &str| {
        let capture = "capture --scene liouville --method semi-implicit-euler --frames 1";
        let arguments = format!("{capture} --size 1280x720 {options} --out {out}");
        let output = run_in(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let picture = image::open(folder.path().join(out).join("frame-000000.png")).unwrap();
        let is_blue = |x: u32, [r, g, b]: [u8; 3]| x > 800 && r < 150 && g > 130 && b > 170;
        let picture = picture.into_rgb8();
        picture.enumerate_pixels().filter(|(x, _, pixel)| is_blue(*x, pixel.0)).count()
    };
    let without = blue("motion", "");
    let with = blue("cloud", "--instrument cloud");
    assert!(with > without + 1000, "{with} and {without}");
    let manifest = fs::read_to_string(folder.path().join("cloud/manifest.json")).unwrap();
    assert!(manifest.replace(' ', "").contains("\"instrument\":\"cloud\""));
    let verified = run_in(folder.path(), "verify cloud");
    assert_eq!(verified.status.code(), Some(0), "{}", stderr(&verified));
    let wrong = run_in(folder.path(), "capture --instrument fog --out fog");
    assert_eq!(wrong.status.code(), Some(2));
    assert!(stderr(&wrong).contains("There are motion, error"), "{}", stderr(&wrong));
}

#[test]
fn a_capture_shows_the_chosen_cloud_and_no_shape_without_one() {
    let folder = tempfile::tempdir().unwrap();
    for (options, said) in [
        ("--instrument cloud --shape dog", "There are cat, disc, ring"),
        ("--instrument energy --shape disc", "give --instrument cloud, or neither"),
        ("--shape disc", "--instrument"),
    ] {
        let wrong = run_in(folder.path(), &format!("capture {options} --out wrong"));
        assert_eq!(wrong.status.code(), Some(2));
        assert!(stderr(&wrong).contains(said), "{}", stderr(&wrong));
    }
    let frame = |out: &str, shown: &str| {
        let capture = "capture --scene kicked-rotor --method rk4 --frames 1 --size 800x600";
        let arguments = format!("{capture} --instrument cloud {shown} --out {out}");
        let output = run_in(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        fs::read(folder.path().join(out).join("frame-000000.png")).unwrap()
    };
    let ring = frame("ring", "--shape ring");
    assert!(ring != frame("disc", "--shape disc"));
    let verified = run_in(folder.path(), "verify disc");
    assert_eq!(verified.status.code(), Some(0), "{}", stderr(&verified));
}

#[cfg(target_os = "linux")]
#[test]
fn commands_without_a_window_never_mention_wayland() {
    let folder = tempfile::tempdir().unwrap();
    let probe = "capture --scene spring --frames 1 --size 32x18 --out clip";
    run_in(folder.path(), probe);
    for arguments in [
        "capture --scene spring --frames 1 --size 32x18 --out run.gif",
        "capture --scene spring --frames 1 --size 32x18 --renderer auto --out clip",
        "sweep --scene spring --method rk4 --tick-hz 60 --plot plot.png",
        "verify clip",
        "chapter --out figures",
        "play --scene spring --seconds 0.1",
    ] {
        for value in [None, Some(""), Some("relative")] {
            let mut command = regatta();
            command.current_dir(folder.path()).args(arguments.split(' '));
            match value {
                Some(value) => command.env("XDG_RUNTIME_DIR", value),
                None => command.env_remove("XDG_RUNTIME_DIR"),
            };
            let output = command.args(forced(arguments)).output().unwrap();
            let said = stderr(&output);
            assert_eq!(output.status.code(), Some(0), "{arguments}: {said}");
            assert!(!said.contains("XDG_RUNTIME_DIR"), "{arguments}, {value:?}: {said}");
        }
    }
}

/// The option that lets a command overwrite its output.
#[cfg(target_os = "linux")]
fn forced(arguments: &str) -> Option<&'static str> {
    let is_forced = ["capture", "sweep", "chapter"].iter().any(|it| arguments.starts_with(it));
    is_forced.then_some("--force")
}
