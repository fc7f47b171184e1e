//! Named pipes as outputs.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::Duration;

use super::{names, run_in, start, stderr, work_after};
use crate::processor;

fn pipe_in(folder: &Path) -> PathBuf {
    let pipe = folder.join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    pipe
}

pub(crate) fn a_named_pipe_is_written_to_and_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let run = "capture --scene spring --frames 3 --size 32x18 --scale 0.5 --format y4m --out";
    run_in(folder.path(), &format!("{run} run.y4m"));
    let pipe = pipe_in(folder.path());
    let writer = start(folder.path(), &format!("{run} pipe"));
    let mut read = Vec::new();
    File::open(&pipe).unwrap().read_to_end(&mut read).unwrap();
    let output = writer.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(read == fs::read(folder.path().join("run.y4m")).unwrap());
    assert_eq!(names(folder.path()), ["pipe", "run.y4m"]);
}

/// Waits until a program waits itself, at so many looks in a row.
fn until_it_waits(child: &mut Child) {
    let mut looks = 0;
    while looks < 50 {
        assert_eq!(child.try_wait().unwrap(), None, "it waits");
        looks = if processor::sleeps(child.id()) { looks + 1 } else { 0 };
        std::thread::sleep(Duration::from_millis(10));
    }
}

pub(crate) fn a_signal_ends_a_command_while_nothing_reads_its_pipe() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = pipe_in(folder.path());
    let sweep = "sweep --scene spring --method rk4 --tick-hz 60";
    let game_loop = "loop --trace steady-144 --out rows.csv --frame-rows";
    // The one waits for a reader; of the other a reader takes nothing, and it has more than a pipe holds.
    for (arguments, has_reader) in [
        (format!("{sweep} --out pipe"), false),
        (format!("{game_loop} pipe"), false),
        (format!("{game_loop} pipe"), true),
    ] {
        let reader =
            has_reader.then(|| File::options().read(true).write(true).open(&pipe).unwrap());
        let mut child = start(folder.path(), &arguments);
        until_it_waits(&mut child);
        let (output, work) = work_after("-TERM", child);
        let said = stderr(&output);
        assert!(work < Duration::from_millis(200), "{arguments}: {work:?}");
        assert_eq!(output.status.code(), Some(130), "{arguments}: {said}");
        assert_eq!(said, "error: interrupted while nothing was reading pipe\n", "{arguments}");
        drop(reader);
        assert_eq!(names(folder.path()), ["pipe"], "{arguments}");
    }
}
