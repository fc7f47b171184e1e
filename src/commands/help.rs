//! `regatta help`: of the program, of a command, or a chapter of the manual.

use clap::{Args, Command};

use super::error::Error;
use super::output::print;
use crate::lab::scene::nearest;
use crate::manual::{CHAPTERS, chapter};

const EXAMPLES: &str = "\
Examples:
  regatta help capture
  regatta help scenes | less";

/// Print this help, that of a command, or a chapter of the manual
#[derive(Debug, Default, Args)]
#[command(after_help = after_help())]
pub(super) struct HelpArgs {
    /// A command, or a chapter of the manual
    #[arg(value_name = "COMMAND|CHAPTER")]
    topic: Option<String>,
}

fn after_help() -> String {
    let lines = CHAPTERS.iter().map(|chapter| format!("\n  {:10}  {}", chapter.id, chapter.about));
    format!("{EXAMPLES}\n\nChapters:{}", lines.collect::<String>())
}

/// Prints what `cli` says of itself or of one of its commands, or a chapter.
pub(super) fn run(args: &HelpArgs, cli: Command) -> Result<(), Error> {
    let topic = args.topic.as_deref();
    if let Some(chapter) = topic.and_then(chapter) {
        return print(chapter.text);
    }
    if let Some(topic) = topic
        && cli.find_subcommand(topic).is_none()
    {
        let commands = cli.get_subcommands().map(Command::get_name);
        let known = commands.chain(CHAPTERS.iter().map(|chapter| chapter.id));
        let meant = nearest(topic, known.map(|name| (name, name)));
        let meant = meant.map_or(String::new(), |name| format!("; did you mean `{name}`?"));
        return Err(Error::mistake(format!(
            "no command and no chapter is called `{topic}`{meant}\n`regatta help help` lists the chapters"
        )));
    }
    match cli.try_get_matches_from(["regatta"].into_iter().chain(topic).chain(["--help"])) {
        Err(help) => Ok(help.print()?),
        Ok(_) => Ok(()),
    }
}
