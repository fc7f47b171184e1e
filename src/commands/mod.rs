//! The command line: one file a subcommand, from arguments to a finished run.
//!
//! Data goes to standard output and everything else to standard error, so that a command can stand in
//! a pipe; a pipe that closes early ends a command quietly. Names, columns and exit codes are an
//! interface that scripts rely on.

use std::io::{self, IsTerminal, Write};

use annotate_snippets::{Group, Level, Renderer};
use clap::{Parser, Subcommand, ValueEnum};

mod advise;
mod atomic_file;
mod atomic_output;
mod blessing;
mod capture;
mod chapter;
mod completions;
mod directory_lock;
mod experiment;
mod file_error;
mod fingerprint;
mod frame_folder;
mod frame_names;
mod jobs;
mod list;
mod logbook;
pub mod manifest;
mod movie;
mod picture_format;
mod pipeline;
mod play;
mod recording;
mod scene_file;
mod settings;
mod sheet;
mod stopwatch;
mod sweep;
mod table;
mod trace;
mod verify;
mod voyage;

use advise::{AdviseArgs, AdviseError};
use capture::{CaptureArgs, CaptureError};
use chapter::{ChapterArgs, ChapterError};
use completions::CompletionsArgs;
use list::ListArgs;
use play::PlayArgs;
use scene_file::SceneFileError;
use sweep::{SweepArgs, SweepError};
use trace::TraceArgs;
use verify::{VerifyArgs, VerifyError};

use crate::window::WindowError;

const EXAMPLES: &str = "\
Examples:
  regatta                                          open the harbour under explicit Euler
  regatta --scene stiff --race                     race all methods on a stiff spring
  regatta --scene ship --method explicit-euler --tick-hz 2
  regatta trace --scene ship --method rk4 > ship.csv
  regatta capture --scene spring --race --out clip
  regatta advise --scene stiff
  regatta sweep --scene spring --plot spring.png > spring.csv
  regatta chapter --out figures
  regatta verify clip
  regatta list methods

In the window, H shows the keys. `regatta help COMMAND` explains a command.";

/// Race numerical integrators on a ship and on springs against the exact solution
#[derive(Debug, Parser)]
#[command(name = "regatta", version, args_conflicts_with_subcommands = true)]
#[command(after_help = EXAMPLES, subcommand_help_heading = "Commands", max_term_width = 100)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    play: PlayArgs,
}

#[derive(Debug, Subcommand)]
enum Command {
    Play(PlayArgs),
    Capture(CaptureArgs),
    Verify(VerifyArgs),
    Trace(TraceArgs),
    Advise(AdviseArgs),
    Sweep(SweepArgs),
    Chapter(ChapterArgs),
    List(ListArgs),
    Completions(CompletionsArgs),
}

/// Does what the command line says.
///
/// # Errors
/// What kept it from being done. A closed standard output is not an error.
pub fn run(cli: Cli) -> Result<(), Error> {
    let done = match cli.command.unwrap_or(Command::Play(cli.play)) {
        Command::Play(args) => play::run(&args),
        Command::Capture(args) => capture::run(&args),
        Command::Verify(args) => verify::run(&args),
        Command::Trace(args) => trace::run(&args),
        Command::Advise(args) => advise::run(&args),
        Command::Sweep(args) => sweep::run(&args),
        Command::Chapter(args) => chapter::run(&args),
        Command::List(args) => list::run(&args),
        Command::Completions(args) => completions::run(&args),
    };
    match done {
        Err(error) if error.is_closed_pipe() => Ok(()),
        done => done,
    }
}

/// Why a command did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scene could not be had.
    #[error(transparent)]
    SceneFile(#[from] SceneFileError),
    /// Frames could not be drawn or written.
    #[error(transparent)]
    Capture(#[from] CaptureError),
    /// The chapter's figures could not be drawn or written.
    #[error(transparent)]
    Chapter(#[from] ChapterError),
    /// Not all methods were judged.
    #[error(transparent)]
    Advise(#[from] AdviseError),
    /// Not all methods, rates and scenes could be gone through.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// Frames are not what they were, or cannot be judged.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// The window could not be opened, or failed.
    #[error(transparent)]
    Window(#[from] WindowError),
    /// Standard output took no more.
    #[error("cannot write to standard output: {0}")]
    Output(#[from] io::Error),
}

impl Error {
    /// What the process returns: 1 for a run that failed, 2 for what was asked wrongly, 130 for an
    /// interrupt.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::SceneFile(_) => 2,
            Error::Advise(AdviseError::Interrupted { .. }) => 130,
            Error::Capture(error) => error.exit_code(),
            Error::Chapter(error) => error.exit_code(),
            Error::Sweep(error) => error.exit_code(),
            Error::Verify(error) => error.exit_code(),
            Error::Window(_) | Error::Output(_) => 1,
        }
    }

    /// Whether whoever reads what the command writes has enough.
    fn is_closed_pipe(&self) -> bool {
        match self {
            Error::Output(error) => error.kind() == io::ErrorKind::BrokenPipe,
            Error::Capture(CaptureError::Output(error))
            | Error::Sweep(SweepError::Output(error)) => error.is_closed_pipe(),
            _ => false,
        }
    }

    /// The message, with the lines of the scene file that it speaks of.
    pub fn report(&self, renderer: &Renderer) -> String {
        match self {
            Error::SceneFile(SceneFileError::Invalid(errors)) => {
                scene_file::report(errors, renderer)
            }
            _ => {
                let title = Level::ERROR.primary_title(self.to_string());
                renderer.render(&[Group::with_title(title)])
            }
        }
    }
}

/// How data is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TableFormat {
    /// Aligned columns, for people
    Text,
    /// An array of objects, for programs
    Json,
}

/// How a tidy table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum RowFormat {
    /// Comma-separated values under a header
    Csv,
    /// An array of objects with the same names
    Json,
}

/// Says something on standard error; where that is closed, nobody wants to know.
pub fn tell(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// Renders messages for standard error: in colour on a terminal, unless `NO_COLOR` is set.
pub fn stderr_renderer() -> Renderer {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    if io::stderr().is_terminal() && !is_set("NO_COLOR") && !is_dumb {
        Renderer::styled()
    } else {
        Renderer::plain()
    }
}
