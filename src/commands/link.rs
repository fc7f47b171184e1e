//! `regatta link`: prints a run as a link.

use std::path::PathBuf;

use clap::Args;

use super::error::Error;
use super::help::flowing;
use super::output::print;
use super::scene_file;
use super::terminal::print_status;
use super::verify::recording::{checks_of, refuse_late_checks};
use crate::run::link;
use crate::run::link::MAX_LETTERS;

const ABOUT: &str = "\
The link holds the scene, its lanes, its script and the hashes at its end, so that `regatta verify LINK`
can compare the run here to the bit. It only names a built-in scene. A link works wherever a scene does,
alone or after an address:

  play, capture, trace, verify, diff … LINK

Examples:
  regatta link recording.toml
  regatta play '#v1.…'
  regatta play '#scene=spring&method=rk4'";

/// Print a run as a link
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct LinkArgs {
    /// A scene, the file of one or of a recording, or a link
    #[arg(value_name = "NAME|FILE")]
    run: PathBuf,
}

pub(super) fn run(args: &LinkArgs) -> Result<(), Error> {
    if let Some(name) = args.run.to_str().filter(|_| scene_file::is_built_in(&args.run)) {
        return print(link::to_built_in(name) + "\n");
    }
    let (mut scene, _) = scene_file::load(&args.run)?;
    refuse_late_checks(&args.run, &scene)?;
    if scene.checks.is_empty() {
        scene.checks = checks_of(&args.run, &scene)?;
    }
    let link = link::link_to_run(&scene).map_err(Error::mistake)?;
    if link.len() > MAX_LETTERS {
        print_status(&format!(
            "warning: the link has {} letters, and a command line takes some {MAX_LETTERS}; share the file",
            link.len()
        ));
    }
    print(link + "\n")
}
