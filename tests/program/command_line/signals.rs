//! Signals and limits of the system: no temporary file survives the end of a command.
#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use super::mishaps::XorShift;
#[cfg(target_os = "linux")]
use super::work_after;
use super::{ended_by, names, regatta, run_in, start, stderr};

const SIGNALS: [&str; 3] = ["-TERM", "-HUP", "-INT"];

/// A race whose check lies days away.
const LONG: &str = "title = 'x'\ntick_hz = 1000\nseconds = 1\nmethods = ['rk4']\n\
    [[spring]]\nmass_kg = 1\nstiffness_n_per_m = 40\nx0_m = 1\n\
    [[check]]\ntick = 90000000\nlane = 1\nhash = '0000000000000000'\n";

/// Files that never end by themselves, or after seconds.
const ENDLESS: [&str; 7] = [
    "capture --scene spring --frames 100000 --size 32x18 --out run.gif",
    "capture --scene spring --frames 100000 --size 32x18 --out run.y4m",
    "capture --scene harbour --frames 400 --size 32x18 --out run.png",
    "sweep --out rows.csv --plot rows.png",
    "loop --seconds 100000 --out rows.csv --frame-rows frames.csv",
    "cloud --scene liouville --points 1000000 --out cloud.csv",
    "verify long.toml --report json report.json",
];

/// The temporary files in a folder and in those that it holds.
fn parts(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    // A renamed or removed file is no part any more.
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            found.extend(parts(&entry.path()));
        }
        if name.ends_with(".part") || name.starts_with(".regatta-bless") {
            found.push(name);
        }
    }
    found
}

/// Waits for the first temporary file.
#[track_caller]
fn until_begun(folder: &Path, child: &mut Child) {
    while parts(folder).is_empty() {
        assert_eq!(child.try_wait().unwrap(), None, "it goes on");
        std::thread::sleep(Duration::from_micros(100));
    }
}

#[test]
fn a_signal_right_after_a_file_is_created_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let probe = "capture --scene spring --frames 1 --size 32x18 --out probe";
    run_in(folder, probe);
    fs::write(folder.join("long.toml"), LONG).unwrap();
    let before = names(folder);
    for (arguments, signal) in ENDLESS.iter().zip(SIGNALS.iter().cycle()) {
        let mut child = start(folder, arguments);
        until_begun(folder, &mut child);
        let output = ended_by(signal, child);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(130), "{arguments}, {signal}: {said}");
        assert!(said.contains("interrupted"), "{arguments}: {said}");
        assert_eq!(names(folder), before, "{arguments}, {signal}");
    }
}

#[test]
fn a_signal_at_any_moment_leaves_no_temporary_file() {
    let mut random = XorShift::new();
    let commands = [
        "capture --scene spring --frames 12 --size 64x36 --out run.gif",
        "capture --scene harbour --frames 3 --size 64x36 --out run.png",
        "sweep --scene spring --out rows.csv --plot plot.png",
        "chapter --out figures",
    ];
    let whole = commands.map(|arguments| {
        let folder = tempfile::tempdir().unwrap();
        let begun = Instant::now();
        run_in(folder.path(), arguments);
        begun.elapsed()
    });
    for n in 0..20 {
        let folder = tempfile::tempdir().unwrap();
        let (arguments, whole) = (commands[n % 4], whole[n % 4]);
        let signal = SIGNALS[random.below(3) as usize];
        let child = start(folder.path(), arguments);
        std::thread::sleep(Duration::from_micros(random.below(whole.as_micros() as u64)));
        let output = ended_by(signal, child);
        let (code, said) = (output.status.code(), stderr(&output));
        // Before anything is begun the signal itself ends the program.
        assert!(matches!(code, Some(0 | 130) | None), "{arguments}, {signal}: {code:?} {said}");
        assert_eq!(parts(folder.path()), [""; 0], "{arguments}, {signal}: {code:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_cloud_of_any_size_ends_within_a_second_of_work_after_a_signal() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = XorShift::new();
    for signal in SIGNALS {
        let cloud = "cloud --scene liouville --points 1000000 --out cloud.csv";
        let mut child = start(folder.path(), cloud);
        until_begun(folder.path(), &mut child);
        std::thread::sleep(Duration::from_millis(random.below(3000)));
        let (output, work) = work_after(signal, child);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(130), "{signal}: {said}");
        assert!(work < Duration::from_secs(1), "{signal}: {work:?}");
        assert!(said.contains(" of 72 ticks") && said.lines().count() == 1, "{signal}: {said}");
        assert_eq!(names(folder.path()), [""; 0], "{signal}");
    }
}

#[test]
fn a_file_size_limit_ends_in_a_sentence_without_a_file() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [
        "sweep --scene spring --method rk4 --out rows.csv",
        "capture --scene spring --frames 3 --size 64x36 --out run.gif",
        "capture --scene harbour --frames 3 --size 64x36 --out run.png",
        "capture --scene spring --frames 3 --size 640x360 --out clip",
        "loop --trace edge --policy fixed --seconds 2 --out rows.csv --plot plot.png",
        "chapter --out figures",
    ] {
        let limited = "ulimit -f 1; exec \"$0\" \"$@\"";
        let mut command = Command::new("sh");
        command.args(["-c", limited]).arg(regatta().get_program()).args(arguments.split(' '));
        command.current_dir(folder.path()).env("XDG_RUNTIME_DIR", std::env::temp_dir());
        let output = command.output().unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{arguments}: {:?} {said}", output.status);
        assert!(said.contains("cannot write "), "{arguments}: {said}");
        assert!(said.contains("a file's size (ulimit -f)"), "{arguments}: {said}");
        assert_eq!(parts(folder.path()), [""; 0], "{arguments}");
    }
}
