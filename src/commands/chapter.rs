//! `regatta chapter`: recomputes the tables and figures of the book chapter with which this program began. The results
//! appear next to the printed numbers.
//!
//! The book is Bourg & Bywalec, *Physics for Game Developers*, 2nd edition, chapter 7.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

use clap::Args;
use serde::Serialize;
use serde_json::json;

use super::argument::brief;
use super::error::Error;
use super::help::flowing;
use super::interrupt::watch_for_interrupt;
use super::output::table::TableFormat;
use super::output::{print, print_json};
use super::terminal::{print_status, report_left_alone};
use crate::run::{Lane, Ticker};
use crate::scene::Scene;
use crate::sim::integrators::{Method, method};
use crate::sim::{Solver, TickRate};
use crate::view::{OffscreenRenderer, png};

mod adaptive;
mod figures;
mod folder;
mod speeds;

use figures::Diagram;
use folder::FigureFolder;

const EXAMPLES: &str = "\
A tick marks each number that equals the printed one to the last digit. Figures 7-5 and
7-8 show a spring whose parameters the chapter does not print; those are ours.

Examples:
  regatta chapter
  regatta chapter --out figures";

/// Print the chapter's tables, and draw its Figures 7-2 to 7-8
#[derive(Debug, Args)]
#[command(after_long_help = flowing(EXAMPLES))]
pub(super) struct ChapterArgs {
    /// The directory for the figures and their data
    ///
    /// Files figure-7-2.png, figure-7-2.csv and so on. The directory is created if necessary.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Replace the figures that DIR holds; other files in it stay
    #[arg(long, requires = "out")]
    force: bool,

    /// The format: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    format: TableFormat,
}

pub(super) fn run(args: &ChapterArgs) -> Result<(), Error> {
    if let Some(out) = &args.out {
        let folder = FigureFolder::inspect(out)?;
        if !folder.is_empty() && !args.force {
            return Err(Error::mistake(format!(
                "{} is not empty; give another --out, or --force to replace the figures in it",
                brief(out)
            )));
        }
        draw(folder)?;
    }
    let (table, displacements, listings) =
        (speeds::table_7_1(), speeds::displacements(), adaptive::listings());
    match args.format {
        TableFormat::Text => {
            print([table.text(), displacements.text(), listings.text()].join("\n"))
        }
        TableFormat::Json => {
            let all = json!({
                "table_7_1": table.rows,
                "mean_errors": table.means,
                "distances": displacements.rows,
                "adaptive_euler": listings.rows,
            });
            print_json(format!("{all:#}\n"))
        }
    }
}

/// Size of a figure in pixels, and pixels per point. The text is legible at the width of a page.
const SIZE_PX: [u32; 2] = [1600, 1000];
const SCALE: f32 = 1.6;

fn draw(mut folder: FigureFolder) -> Result<(), Error> {
    let mut renderer = OffscreenRenderer::new(SIZE_PX, SCALE)?;
    let interrupted = watch_for_interrupt();
    folder.clear()?;
    let mut rgba = Vec::new();
    let diagrams = figures::all();
    for (done, Diagram { number, figure }) in diagrams.iter().enumerate() {
        if interrupted.load(Ordering::Relaxed) {
            return Err(Error::interrupted_after(format!("{done} of {} figures", diagrams.len())));
        }
        renderer.draw_figure(figure, &mut rgba)?;
        let name = format!("figure-{number}");
        folder.write(&format!("{name}.csv"), &figures::csv(figure)?)?;
        folder.write(&format!("{name}.png"), &png::encode(SIZE_PX, &rgba))?;
    }
    let path = folder.path().display();
    print_status(&format!(
        "wrote {} figures and their data: {path}/figure-7-2.png …",
        diagrams.len()
    ));
    report_left_alone(folder.path(), folder.others());
    Ok(())
}

/// A number as this program computes it and as the chapter prints it.
#[derive(Clone, Debug, Serialize)]
struct BesidePrinted {
    value: f64,
    /// The number with as many digits as the chapter has.
    shown: String,
    printed: &'static str,
}

impl BesidePrinted {
    /// Returns the number with a check mark if the chapter prints the same number, or else followed by the printed one.
    fn marked(&self) -> String {
        let Self { shown, printed, .. } = self;
        if shown == printed {
            format!("{shown} ✓")
        } else {
            format!("{shown} (printed: {printed})")
        }
    }
}

/// State of a built-in scene's body at time `t` (s), as the tables and figures need it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Moment {
    t: f64,
    q: f64,
    v: f64,
}

fn scene(name: &str) -> Scene {
    Scene::built_in(name).expect("the chapter's scenes are built in")
}

fn method_of(id: &str) -> &'static Method {
    method(id).expect("the chapter's methods are in the table")
}

/// Returns the states of the scene's first body at every tick from 0 to `seconds`, at the scene's tick rate.
fn by_method(scene: &Scene, id: &str, seconds: f64) -> Vec<Moment> {
    moments(scene, Solver::Method(method_of(id)), seconds, scene.tick_hz)
}

/// Returns the exact motion of the scene's first body, with `per_second` states per second.
fn exactly(scene: &Scene, seconds: f64, per_second: impl Into<TickRate>) -> Vec<Moment> {
    moments(scene, Solver::Truth, seconds, per_second.into())
}

fn moments(scene: &Scene, solver: Solver, seconds: f64, rate: TickRate) -> Vec<Moment> {
    let at = |lane: &Lane, tick: u64| {
        let stepper = &lane.bodies()[0].stepper;
        Moment { t: rate.seconds(tick), q: stepper.q()[0], v: stepper.v()[0] }
    };
    let mut follow = Ticker::new(Lane::new(scene, solver, 1), rate);
    let mut moments = vec![at(&follow.body, 0)];
    follow.run((seconds * rate.hz()).round() as u64, |lane, tick| {
        moments.push(at(lane, tick));
        ControlFlow::Continue(())
    });
    moments
}
