//! `regatta advise`: recommends a method for a scene at its tick rate, and gives the reasons.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use clap::Args;

use super::error::Error;
use super::experiment_args::ExperimentArgs;
use super::help::flowing;
use super::id::{CODE_FORM, FAMILY};
use super::interrupt::watch_for_interrupt;
use super::output::table::TableFormat;
use super::{jobs, scene_file};
use crate::measure::Adviser;
use crate::run::race::Mode;
use crate::scene::{LaneSpec, Scene};
use crate::sim::integrators::{Family, METHODS};
use crate::tools::source_code::CodeForm;

mod impact;
mod judged;
mod report;

use judged::{decide, judge_all, search_margins, warn_of_load};

const ABOUT: &str = "\
Each method runs the scene from its start, with its script's inputs, against the exact solution. For
each criterion, advise finds the fewest substeps per tick, 1 to 64:

  bounded      nothing grows that should not, over the scene and in the long run: no mode of a
               linear body doubles within a year; any other body runs for 20 times the scene's
               length, and one that loses its swing for up to 2000 times, until it rests
  looks-right  each swing of the scene is as wide as the truth's, within 5 % of the widest, with
               peaks found between the steps, and the frequency is right within 1 %; with several
               modes, the root of their total energy and the frequency of the strongest; without
               a swing, the motion stays within 5 % of its range
  accurate     over the scene no coordinate or velocity is off by more than 1 % of its amplitude

A ball is judged by its bounces and a body that turns in space by its attitude and its flips, as
`regatta help scenes` says.

The answer is one method: one that looks right, or else is bounded, or else accurate. It has the lowest
cost; if equal, the largest reserve, then a symplectic method before others, then the fewest substeps.
Explicit Euler comes after every other method of its cost.
The cost is evaluations of the acceleration per simulated second, times 2 to 3 for a linearised method,
4 for one that iterates. The reserve is the factor by which the bodies may be stiffer, or the square of
the factor by which the ticks may be slower, if that is less or the factor is 10, where its search ends:
four times the stiffness needs twice the rate. A reserve below 1.5 yields to a larger one at up to twice the cost; the answer then names
the cheaper method, in JSON as instead_of.

With --all, HOLDS DOWN TO is the slowest tick rate at which the criterion still holds with the same
substeps, HOLDS UP TO the factor by which the named parameter may grow, 10 at most, and RESERVE what
both come to; NS/S is measured now, and decides nothing. In JSON, a criterion that is not met has only met, which is false;
an unknown one is null, and take names the criterion of the answer.

For a ball, a line more names the rule for its impacts (`regatta list impacts`) that belongs to the method,
in JSON impact, and what the rule of your scene does.

For a custom spring (--k or --frequency), or with --as, the answer ends with the method as a function, for
a ball without drag with its exact bounces.

Examples:
  regatta advise --scene harbour
  regatta advise --k 900 --c 4 --mass 12 --as csharp
  regatta advise --scene my.toml --tick-hz 50 --format json
  regatta advise --scene engines --family engine";

/// Recommend a method and its substeps for a scene at its tick rate
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct AdviseArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// Also find the slowest tick rates
    ///
    /// For each method with one step a tick, the slowest from 1 to 10000 Hz that meets each criterion.
    #[arg(long)]
    rates: bool,

    /// Judge only the methods of this family
    ///
    /// Explicit, symplectic, adaptive, implicit, linearised, as-printed, follower, engine or interface; advise judges
    /// as-printed, engines and interfaces only by this option.
    #[arg(long, value_name = "FAMILY", value_parser = FAMILY, hide_possible_values = true, conflicts_with = "methods")]
    family: Option<Family>,

    /// Print all tables
    ///
    /// The verdict of every method, and for each criterion its costs and limits.
    #[arg(long)]
    all: bool,

    /// Print the recommended method as code too
    ///
    /// As a function in this language, in text: rust, c, cpp, csharp, gdscript, javascript, lua, or as the lines of a
    /// step. For a spring of --k or --frequency the default is rust.
    #[arg(long = "as", value_name = "LANGUAGE", value_parser = CODE_FORM, hide_possible_values = true)]
    form: Option<CodeForm>,

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

/// Returns one lane for each method of the family that can step the scene. A method that the scene lists keeps the lane
/// that it has there.
fn of_family(scene: &Scene, family: Family) -> Result<Vec<LaneSpec>, Error> {
    let listed = |method| scene.lanes.iter().find(|lane| lane.method == method).copied();
    let fitting = scene.methods_of(family);
    let specs: Vec<_> = fitting.map(|m| listed(m).unwrap_or(scene.plain_lane(m))).collect();
    if specs.is_empty() {
        let method = METHODS.iter().find(|method| method.family == family);
        scene_file::check_method(scene, method.expect("each family has a method"))?;
    }
    Ok(specs)
}

pub(super) fn run(args: &AdviseArgs) -> Result<(), Error> {
    let experiment = args.experiment.load(Mode::Race)?;
    let scene = &experiment.scene;
    let specs: Vec<LaneSpec> = match args.family {
        Some(family) => of_family(scene, family)?,
        None if args.experiment.names_no_method() => scene.advised_lanes(),
        None => args.experiment.lanes_named(scene),
    };
    let wanted = specs.len();
    let interrupted = watch_for_interrupt();
    let advised = scene.clone();
    let adviser = jobs::result(&interrupted, move || Adviser::new(&advised, advised.tick_hz));
    let stopped =
        |judged: usize| Err(Error::interrupted_after(format!("{judged} of {wanted} methods")));
    let Some(adviser) = adviser.map(Arc::new) else { return stopped(0) };
    let pool = jobs::pool(0)?;
    let mut rows = judge_all(&pool, &adviser, specs, args.rates, &interrupted);
    let is_whole = args.all || args.format == TableFormat::Json;
    if is_whole {
        let rows = rows.iter_mut().take_while(|_| !interrupted.load(Ordering::Relaxed));
        rows.for_each(|row| row.time(scene));
    }
    decide(&pool, &adviser, &mut rows, &interrupted);
    if is_whole {
        let margins = adviser.worth_margins(&judged::advised(&rows));
        search_margins(&pool, &adviser, &mut rows, margins, &interrupted);
    }
    let text = match args.format {
        TableFormat::Text => {
            let usual = args.experiment.is_a_spring().then(CodeForm::default);
            let answer = report::answer(scene, &adviser, &rows, wanted, args.form.or(usual));
            answer + &if args.all { report::all_tables(&rows) } else { report::best(&rows) }
        }
        TableFormat::Json => format!("{:#}\n", report::object(scene, &adviser, &rows, wanted)),
    };
    args.format.print(&text)?;
    warn_of_load(&rows);
    if interrupted.load(Ordering::Relaxed) { stopped(rows.len()) } else { Ok(()) }
}
