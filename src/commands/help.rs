//! `regatta help`: prints the help of the program or of a command, or a chapter of the manual.

use clap::{Args, Command};

use super::argument::brief;
use super::error::Error;
use super::output::print;
use crate::manual::{CHAPTERS, Chapter, chapter};
use crate::scene::nearest;

const EXAMPLES: &str = "\
Examples:
  regatta help capture
  regatta help scenes | less";

/// Id of the chapter on keys.
const KEYS: &str = "keys";

/// Maximum number of columns of every help text.
pub(super) const COLUMNS: usize = 80;

/// Indent of the rows of a list, in blanks.
const ROW_INDENT: usize = 2;

/// Print this help, help on a command, or a chapter of the manual
#[derive(Debug, Default, Args)]
#[command(after_long_help = flowing(&manual()))]
pub(super) struct HelpArgs {
    /// A command, or a chapter of the manual
    #[arg(value_name = "COMMAND|CHAPTER")]
    topic: Option<String>,
}

/// Joins the lines of each paragraph, so that the terminal can wrap them. The rows of a list are indented, and begin
/// with a term and two blanks. If all rows of a list fit on a line each, they stay so. Otherwise each explanation moves
/// below its term.
pub(super) fn flowing(text: &str) -> String {
    let blocks = text.split("\n\n").map(|block| {
        let mut rows: Vec<String> = Vec::new();
        for line in block.lines() {
            let inner = line.trim_start();
            let indent = line.len() - inner.len();
            match rows.last_mut() {
                Some(row) if indent > ROW_INDENT || indent == 0 && !row.starts_with(' ') => {
                    *row = format!("{row} {inner}");
                }
                _ => rows.push(line.to_owned()),
            }
        }
        let is_wide = |row: &String| row.starts_with(' ') && row.chars().count() > COLUMNS;
        if rows.iter().any(is_wide) {
            for row in &mut rows {
                if let Some((term, explanation)) = row.trim_start().split_once("  ") {
                    *row = format!("  {term}\n      {}", explanation.trim_start());
                }
            }
        }
        rows.join("\n")
    });
    blocks.collect::<Vec<_>>().join("\n\n")
}

fn manual() -> String {
    let lines = CHAPTERS.iter().map(|chapter| format!("\n  {:10}  {}", chapter.id, chapter.about));
    format!("{EXAMPLES}\n\nChapters:{}", lines.collect::<String>())
}

/// Returns the program's examples, and the chapters of its manual.
pub(super) fn overview(examples: &str) -> String {
    let chapters: Vec<&str> = CHAPTERS.iter().map(|chapter| chapter.id).collect();
    let chapters = chapters.join(", ");
    flowing(&format!(
        "{examples} and `regatta help CHAPTER` prints a chapter of the manual: {chapters}."
    ))
}

/// Returns the text of a chapter for a terminal. The chapter's table of keys is too wide, so `keys` replaces it.
fn chapter_text(chapter: &Chapter, keys: &str) -> String {
    let is_row = |line: &&str| line.starts_with('|');
    match chapter.text.lines().find(is_row).filter(|_| chapter.id == KEYS) {
        None => chapter.text.to_owned(),
        Some(row) => {
            let (before, table) = chapter.text.split_once(row).expect("a line of it");
            let after: Vec<&str> = table.lines().skip(1).skip_while(is_row).collect();
            format!("{before}{keys}{}\n", after.join("\n"))
        }
    }
}

/// Prints the help of `cli` or of one of its commands, or a chapter of the manual. `keys` is the list of keys.
pub(super) fn run(args: &HelpArgs, cli: Command, keys: &str) -> Result<(), Error> {
    let topic = args.topic.as_deref();
    if let Some(chapter) = topic.and_then(chapter) {
        return print(chapter_text(chapter, keys));
    }
    if let Some(topic) = topic
        && cli.find_subcommand(topic).is_none()
    {
        let commands = cli.get_subcommands().map(Command::get_name);
        let known = commands.chain(CHAPTERS.iter().map(|chapter| chapter.id));
        let meant = nearest(topic, known.map(|name| (name, name)));
        let meant = meant.map_or(String::new(), |name| format!("; did you mean `{name}`?"));
        let topic = brief(topic.as_ref());
        return Err(Error::mistake(format!(
            "no command and no chapter is called `{topic}`{meant}\n`regatta help help` lists the chapters"
        )));
    }
    match cli.try_get_matches_from(["regatta"].into_iter().chain(topic).chain(["--help"])) {
        Err(help) => Ok(help.print()?),
        Ok(_) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::flowing;

    #[test]
    fn paragraphs_wrap_and_wide_rows_move_the_explanation_below_the_term() {
        let long = "a word ".repeat(12);
        let text = format!(
            "One\ntwo:\n  a   b\n  cd  e\n\nThree\n\n  f   g\n  h   {long}\n      i\nfour\nfive"
        );
        let wanted = format!(
            "One two:\n  a   b\n  cd  e\n\nThree\n\n  f\n      g\n  h\n      {long} i\nfour five"
        );
        assert_eq!(flowing(&text), wanted);
    }
}
