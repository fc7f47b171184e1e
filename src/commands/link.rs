//! `regatta link`: prints a run as a link.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::error::Error;
use super::help::flowing;
use super::output::table::TableFormat;
use super::output::{print, print_json};
use super::scene_file;
use super::terminal::print_status;
use super::verify::recording::{end_of, refuse_late_checks};
use crate::run::link::MAX_LETTERS;
use crate::run::race::Lane;
use crate::run::{Race, Run, Session, link};
use crate::scene::{Check, Scene};

/// Most coordinates that are computed for the checks of a link, which takes seconds.
const MAX_WORK: u64 = 100_000_000;
/// Work of a tick besides its coordinates, in coordinates.
const WORK_OF_TICK: u64 = 32;

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

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

impl LinkArgs {
    fn print(&self, link: &str) -> Result<(), Error> {
        match self.format {
            TableFormat::Text => print(format!("{link}\n")),
            TableFormat::Json => {
                print_json(format!("{:#}\n", json!({"link": link, "letters": link.len()})))
            }
        }
    }
}

/// Returns checks to the end of a scene, or of the part that takes some seconds.
fn checks_within(path: &Path, scene: &Scene) -> Result<Vec<Check>, Error> {
    let last = end_of(path, scene)?;
    let mut run = Run::new(Session::racing(scene.clone().into()));
    let mut work = 0;
    while run.race().tick() < last && work < MAX_WORK {
        run.tick(&mut ());
        work += WORK_OF_TICK + work_of_last_tick(run.race());
    }
    let reached = run.race().tick();
    if reached < last {
        print_status(&format!(
            "note: the run has {last} ticks; so that the link is made in seconds, its checks end at tick {reached}; \
             a recording with [[check]]s is not cut"
        ));
    }
    Ok(run.recording().checks)
}

/// Returns the coordinates that the lanes and the truth computed in the last tick.
fn work_of_last_tick(race: &Race) -> u64 {
    let lanes = race.entrants().iter().map(|entrant| &entrant.lane).chain([race.truth()]);
    let bodies = lanes.flat_map(Lane::bodies);
    bodies.map(|body| (1 + body.evaluations_of_last_tick()) * body.stepper.q().len() as u64).sum()
}

pub(super) fn run(args: &LinkArgs) -> Result<(), Error> {
    if let Some(name) = args.run.to_str().filter(|_| scene_file::is_built_in(&args.run)) {
        return args.print(&link::to_built_in(name));
    }
    let (mut scene, _) = scene_file::load(&args.run)?;
    refuse_late_checks(&args.run, &scene)?;
    if scene.checks.is_empty() {
        scene.checks = checks_within(&args.run, &scene)?;
    }
    let link = link::link_to_run(&scene).map_err(Error::mistake)?;
    if link.len() > MAX_LETTERS {
        print_status(&format!(
            "warning: the link has {} letters, and a command line takes some {MAX_LETTERS}; share the file",
            link.len()
        ));
    }
    args.print(&link)
}
