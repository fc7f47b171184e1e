//! `regatta completions`: prints a script with which a shell completes options, scenes and methods after Tab.

use clap::{Args, Command};
use clap_complete::Shell;

use super::error::Error;
use super::help::flowing;
use super::output::print;

const EXAMPLES: &str = "\
Examples:
  regatta completions bash > ~/.local/share/bash-completion/completions/regatta
  regatta completions fish > ~/.config/fish/completions/regatta.fish
  regatta completions zsh  > ~/.zfunc/_regatta";

/// Print a completion script for a shell
#[derive(Debug, Args)]
#[command(after_long_help = flowing(EXAMPLES))]
pub(super) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

/// Prints the completion script for the command line `cli`.
pub(super) fn run(args: &CompletionsArgs, cli: &mut Command) -> Result<(), Error> {
    // The script is generated into memory, because the generator itself would panic on a closed pipe.
    let mut script = Vec::new();
    clap_complete::generate(args.shell, cli, "regatta", &mut script);
    print(String::from_utf8_lossy(&script))
}
