//! The program as its users meet it: arguments in; bytes, messages and exit codes out.
#![cfg(feature = "desktop")]

use std::path::Path;
use std::process::{Command, Output, Stdio};

mod advise;
mod bless;
mod capture;
mod chapter;
mod cloud;
mod diff;
mod examples;
mod files;
mod fixture;
mod formats;
mod help;
mod identify;
mod link;
mod list;
mod loop_frames;
mod loops;
mod manifest;
mod mcp;
mod mishaps;
mod mistakes;
mod mutations;
mod own_methods;
mod port;
mod recordings;
mod report;
mod rule;
mod schema;
mod show;
mod signals;
mod sweep;
mod sweep_plots;
mod tick_rates;
mod trace;
mod verify;
mod verify_reports;

/// The program, with nothing of this machine's display or settings.
fn regatta() -> Command {
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
fn run(arguments: &str) -> Output {
    regatta().args(arguments.split_whitespace()).output().unwrap()
}

fn run_in(directory: &Path, arguments: &str) -> Output {
    regatta().current_dir(directory).args(arguments.split_whitespace()).output().unwrap()
}

/// The program's data, if it succeeds without messages.
fn stdout_of(arguments: &str) -> String {
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

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The program's error message, if it fails with this code and writes no data.
fn refusal(arguments: &str, code: i32) -> String {
    let output = run(arguments);
    assert_eq!(output.status.code(), Some(code), "{arguments}: {}", stderr(&output));
    assert!(output.stdout.is_empty(), "{arguments}");
    stderr(&output)
}
