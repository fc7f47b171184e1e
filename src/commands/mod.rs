//! The command line. Each subcommand has a file, which leads from the arguments to a finished run.
//!
//! Data goes to standard output and everything else to standard error, so that a command works in a pipe. If the pipe
//! is closed early, the command ends quietly. Scripts rely on the names, columns and exit codes.
//!
//! The modules below come in four groups: subcommands, inputs of a run, drawing, and shared code. Drawing writes a
//! run, frame by frame, into a folder, a stream or a sheet.

#![cfg_attr(
    not(feature = "window"),
    allow(
        dead_code,
        unused_imports,
        reason = "files, formats and settings are shared with commands that draw, which are not compiled here"
    )
)]

use std::ffi::OsString;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Parser, Subcommand};

mod advise;
mod capture;
mod chapter;
mod cloud;
mod completions;
mod diff;
mod fixture;
mod game_loop;
mod help;
mod identify;
mod link;
mod list;
mod mcp;
#[cfg(feature = "window")]
mod play;
mod port;
mod report;
mod rule;
mod show;
mod sweep;
mod trace;
mod verify;

mod captured;
mod experiment;
mod experiment_args;
mod id;
mod scene_file;
mod spring;
mod trace_source;

mod clip;
mod drawing;
mod frame_folder;
mod frame_names;
pub mod manifest;
mod movie;
mod picture_format;
mod pipeline;
mod schedule;
mod settings;
mod sheet;
mod state_log;

mod argument;
mod error;
mod file_names;
mod interrupt;
mod jobs;
mod output;
mod own_file;
mod table_args;
mod terminal;
mod tick_rate;
mod visible;

pub use error::Error;
pub use terminal::{print_error, print_status};
pub use visible::visible;

/// The remedy for missing libraries of a window.
pub const WINDOW_LIBRARIES: &str =
    "on Debian and Ubuntu: apt install libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0";

use crate::manual::{CHAPTERS, chapter};
use crate::scene::{SCENES, clip as shortened, nearest};

const EXAMPLES: &str = "\
Examples:
  regatta                              open the harbour under explicit Euler
  regatta stiff --race                 race all methods on a stiff spring
  regatta --scene ship --method explicit-euler --tick-hz 2
  regatta capture --scene spring --race --out clip
  regatta advise --scene stiff
  regatta sweep --scene spring --plot spring.png > spring.csv
  regatta port --frequency 2.5Hz       the settings of every engine for a spring
  regatta rule 'v *= 0.9; x += v * dt' your own lines at every frame rate
  regatta show rk4 --as csharp         the method's code, for your game
  regatta fixture --as pytest          exact states, to test your engine by
  regatta diff before.csv after.csv    where two runs first differ

In the window, H shows the keys. `regatta help COMMAND` explains a command,";

/// Race numerical integrators against the exact solution
///
/// Every method steps the same ships, springs, chains, pendulums and orbits, at the tick rate that you choose.
#[derive(Debug, Parser)]
#[command(name = "regatta", version, args_conflicts_with_subcommands = true)]
#[command(disable_help_subcommand = true)]
#[command(after_long_help = help::overview(EXAMPLES), subcommand_help_heading = "Commands")]
#[command(max_term_width = help::COLUMNS)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[cfg(feature = "window")]
    #[command(flatten)]
    play: play::PlayArgs,
}

/// Maximum number of bytes of an argument, which is more than a path has. Messages quote arguments.
const MAX_ARGUMENT_BYTES: usize = 4096;

/// Returns the command that is missing before the first word, if that word is no command. It is `list` before the name
/// of a list, and `help` before a chapter.
fn unnamed_command(cli: &clap::Command, arguments: &[OsString]) -> Option<&'static str> {
    let word = arguments.get(1)?.to_str().filter(|word| cli.find_subcommand(word).is_none())?;
    // A chapter that shares its name with a scene is shown only after the word `help`.
    let is_scene = SCENES.iter().any(|scene| scene.name == word);
    match list::names().any(|name| name == word) {
        true => Some("list"),
        false => chapter(word).filter(|_| !is_scene).map(|_| "help"),
    }
}

/// Returns the index of an argument that is a scene but has no option before it, in a command that takes a scene. The
/// argument may be a link. It may also be the name of a built-in scene or of a scene file, unless the command takes
/// positional arguments.
fn lone_scene(cli: &clap::Command, arguments: &[OsString]) -> Option<usize> {
    let end = arguments.iter().position(|one| one == "--").unwrap_or(arguments.len());
    let named = arguments.get(1).and_then(|one| cli.find_subcommand(one));
    let command = named.unwrap_or(cli);
    let takes_names = command.get_positionals().next().is_none();
    let option = |written: &OsString| {
        let name = written.to_str()?.strip_prefix("--")?;
        command.get_arguments().find(|argument| argument.get_long() == Some(name))
    };
    option(&"--scene".into())?;
    let is_lone = |at: &usize| {
        let is_option = arguments[*at].to_str().is_some_and(|one| one.starts_with('-'));
        let before = option(&arguments[at - 1]);
        !is_option && before.is_none_or(|before| !before.get_action().takes_values())
    };
    let is_scene = |at: &usize| {
        let written = arguments[*at].as_ref();
        let is_command = *at == 1 && named.is_some();
        scene_file::is_link(written) || takes_names && !is_command && scene_file::is_name(written)
    };
    (1..end).filter(is_scene).find(is_lone)
}

/// Returns the error for an unknown word. It suggests the scene, list or chapter with the most similar name.
fn with_similar_name(mut error: clap::Error, word: &str) -> clap::Error {
    let others = list::names().chain(CHAPTERS.iter().map(|chapter| chapter.id));
    let names = SCENES.iter().map(|scene| scene.name).chain(others);
    if let Some(meant) = nearest(word, names.map(|name| (name, name))) {
        let tip = format!("there is `regatta {meant}`");
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    error
}

impl Cli {
    /// Parses a command line, which begins with the name of the program.
    ///
    /// # Errors
    ///
    /// The text to show instead of running the command. It is a mistake, or the help or version for which the user
    /// asked.
    pub fn read(arguments: impl IntoIterator<Item = OsString>) -> Result<Self, clap::Error> {
        let mut arguments: Vec<OsString> = arguments.into_iter().collect();
        let is_link = |one: &OsString| scene_file::is_link(one.as_ref());
        let is_long = |one: &OsString| one.len() > MAX_ARGUMENT_BYTES && !is_link(one);
        let long = (1..).zip(arguments.iter().skip(1)).find(|(_, one)| is_long(one));
        if let Some((place, long)) = long {
            let message = format!(
                "argument {place} has {} bytes, and the limit is {MAX_ARGUMENT_BYTES}; give a file in place of \
                 \"{}\"\n",
                long.len(),
                shortened(&long.to_string_lossy()),
            );
            return Err(Self::command().error(ErrorKind::InvalidValue, message));
        }
        let cli = Self::command();
        if let Some(command) = unnamed_command(&cli, &arguments) {
            arguments.insert(1, command.into());
        } else if let Some(at) = lone_scene(&cli, &arguments) {
            arguments.insert(at, "--scene".into());
        }
        Self::try_parse_from(&arguments).map_err(|error| {
            // The message about a long argument quotes it.
            let texts: Vec<_> = arguments.iter().map(|one| one.to_string_lossy()).collect();
            let shown: Vec<_> = texts.iter().map(|text| visible(text)).collect();
            let error = match shown.iter().zip(&texts).all(|(shown, text)| shown == text) {
                true => error,
                false => {
                    Self::try_parse_from(shown.iter().map(|one| &**one)).err().unwrap_or(error)
                }
            };
            let error = match (error.kind(), texts.get(1)) {
                (ErrorKind::InvalidSubcommand, Some(word)) => with_similar_name(error, word),
                _ => error,
            };
            argument::with_brief_arguments(error)
        })
    }
}

impl Cli {
    /// Whether a graphics device may draw for the command.
    pub fn may_take_a_device(&self) -> bool {
        match &self.command {
            Some(Command::Capture(args)) => args.may_take_a_device(),
            #[cfg(feature = "window")]
            Some(Command::Play(args)) => args.may_take_a_device(),
            #[cfg(feature = "window")]
            None => self.play.may_take_a_device(),
            _ => false,
        }
    }
}

/// Declares the subcommands. Each row has the arguments, and the function that runs the subcommand.
macro_rules! subcommands {
    ($($(#[$when:meta])* $name:ident($args:ty) => $run:expr,)*) => {
        #[derive(Debug, Subcommand)]
        enum Command {
            $($(#[$when])* $name($args),)*
        }

        impl Command {
            fn run(&self) -> Result<(), Error> {
                match self {
                    $($(#[$when])* Self::$name(args) => $run(args),)*
                }
            }
        }
    };
}

subcommands! {
    #[cfg(feature = "window")]
    Play(play::PlayArgs) => play::run,
    Capture(capture::CaptureArgs) => capture::run,
    Report(report::ReportArgs) => report::run,
    Verify(verify::VerifyArgs) => verify::run,
    Trace(trace::TraceArgs) => trace::run,
    Advise(advise::AdviseArgs) => advise::run,
    Sweep(sweep::SweepArgs) => sweep::run,
    Cloud(cloud::CloudArgs) => cloud::run,
    Loop(game_loop::LoopArgs) => game_loop::run,
    Identify(identify::IdentifyArgs) => identify::run,
    Port(port::PortArgs) => port::run,
    Rule(rule::RuleArgs) => rule::run,
    Show(show::ShowArgs) => show::run,
    Fixture(fixture::FixtureArgs) => fixture::run,
    Diff(diff::DiffArgs) => diff::run,
    Link(link::LinkArgs) => link::run,
    Chapter(chapter::ChapterArgs) => chapter::run,
    List(list::ListArgs) => list::run,
    Mcp(mcp::McpArgs) => mcp::run,
    Completions(completions::CompletionsArgs) => |args| completions::run(args, &mut Cli::command()),
    Help(help::HelpArgs) => |args| help::run(args, Cli::command(), &list::keys()),
}

/// Runs the command that the command line names.
///
/// # Errors
/// If the command fails. A closed standard output is not an error.
pub fn run(cli: Cli) -> Result<(), Error> {
    interrupt::survive_large_files();
    #[cfg(feature = "window")]
    let command = cli.command.unwrap_or(Command::Play(cli.play));
    #[cfg(not(feature = "window"))]
    let command = cli.command.unwrap_or(Command::Help(Default::default()));
    match command.run() {
        Err(error) if error.is_closed_pipe() => Ok(()),
        done => done,
    }
}
