//! The program for a test: run, and what it has left.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
#[cfg(target_os = "linux")]
use std::time::Duration;

#[cfg(target_os = "linux")]
use crate::processor;

/// The program, with nothing of this machine's display or settings.
pub(crate) fn regatta() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_regatta"));
    for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "RUST_LOG", "NO_COLOR"] {
        command.env_remove(variable);
    }
    // Where it is unset, libwayland says so on standard error.
    command.env("XDG_RUNTIME_DIR", std::env::temp_dir()).stdin(Stdio::null());
    // Nothing that a window remembers.
    command.env("XDG_CONFIG_HOME", "/nowhere");
    command
}

/// The program's output for these arguments.
pub(crate) fn run(arguments: &str) -> Output {
    regatta().args(arguments.split_whitespace()).output().unwrap()
}

pub(crate) fn run_in(directory: &Path, arguments: &str) -> Output {
    regatta().current_dir(directory).args(arguments.split_whitespace()).output().unwrap()
}

/// The program's data, if it succeeds without messages.
pub(crate) fn stdout_of(arguments: &str) -> String {
    let output = run(arguments);
    // Allowed messages: a busy machine, the progress of a long run, and the files read.
    let is_by_the_way = |line: &str| {
        let how_far = |(done, of): (&str, &str)| {
            done.parse::<u32>().is_ok() && of.starts_with(|c: char| c.is_ascii_digit())
        };
        ["warning: the machine is busy", "read "].iter().any(|start| line.starts_with(start))
            || line.split_once(" of ").is_some_and(how_far)
    };
    let said = stderr(&output);
    let said = said.lines().find(|line| !is_by_the_way(line));
    assert_eq!(said, None, "{arguments}");
    assert_eq!(output.status.code(), Some(0), "{arguments}");
    String::from_utf8(output.stdout).unwrap()
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The program's error message, if it fails with this code and writes no data.
pub(crate) fn refusal(arguments: &str, code: i32) -> String {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(code), "{arguments}: {}", stderr(&output));
    assert!(output.stdout.is_empty(), "{arguments}");
    stderr(&output)
}

/// The program under way, whose messages are kept.
pub(crate) fn start(directory: &Path, arguments: &str) -> Child {
    let mut command = regatta();
    command.current_dir(directory).args(arguments.split(' '));
    command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

#[cfg(unix)]
fn send(signal: &str, child: &Child) {
    // By the shell, for not every system has `kill` as a program.
    let sent = Command::new("sh").args(["-c", &format!("kill {signal} {}", child.id())]).status();
    assert!(sent.unwrap().success());
}

/// Sends a signal to the program, and returns its output.
#[cfg(unix)]
pub(crate) fn ended_by(signal: &str, child: Child) -> Output {
    send(signal, &child);
    child.wait_with_output().unwrap()
}

/// The same with the work of all processors from the signal to the end, which is no more on a busy machine.
#[cfg(target_os = "linux")]
pub(crate) fn work_after(signal: &str, child: Child) -> (Output, Duration) {
    let id = child.id();
    let before = processor::time(id);
    send(signal, &child);
    while !processor::has_ended(id) {
        std::thread::sleep(Duration::from_millis(1));
    }
    let work = processor::time(id) - before;
    (child.wait_with_output().unwrap(), work)
}

/// The names in a directory, in order.
pub(crate) fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

pub(crate) fn dimensions(picture: &Path) -> (u32, u32) {
    image::open(picture).unwrap().into_rgba8().dimensions()
}
