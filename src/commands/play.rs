//! `regatta play`: the window; where there is no display, its first seconds as pictures.

use std::path::Path;
use std::sync::Arc;

use annotate_snippets::Renderer;
use clap::Args;

use super::capture::{self, CaptureError, FPS};
use super::experiment::{self, Experiment, ExperimentArgs, Lineup};
use super::frame_folder::FrameFolder;
use super::logbook;
use super::recording::{self, Recording};
use super::scene_file;
use super::voyage::Schedule;
use super::{Error, tell};
use crate::view::Panels;
use crate::window::{self, SceneFiles, WindowError};

const EXAMPLES: &str = "\
Examples:
  regatta play --scene spring --method explicit-euler
  regatta play --scene stiff --race --tick-hz 49
  regatta play --scene my.toml

In the window, H shows the keys. Without a display the first seconds are drawn into
./regatta-frames instead.";

/// Open the window (also without `play`)
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct PlayArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// Race all methods of the scene at once
    #[arg(long)]
    race: bool,

    /// Close after this many simulated seconds, to the nearest tick [default: never]
    #[arg(long, value_name = "S", value_parser = experiment::seconds)]
    #[arg(allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// Trails do not fade, and the camera does not glide
    #[arg(long)]
    reduced_motion: bool,
}

/// Where pictures go that nobody named a directory for.
const FRAMES_DIR: &str = "regatta-frames";
/// Enough to see what each method does, and drawn in seconds even by software.
const FRAMES: u32 = 4 * FPS;
/// The size of the window.
const SIZE_PX: [u32; 2] = [1280, 720];

pub(super) fn run(args: &PlayArgs) -> Result<(), Error> {
    let lineup = if args.race { Lineup::Everyone } else { Lineup::Solo };
    let experiment = args.experiment.load(lineup)?;
    let mut lab = experiment.lab();
    lab.set_motion(!args.reduced_motion);
    match window::run(lab, args.seconds, files(&args.experiment, &experiment)) {
        Err(WindowError::NoDisplay(reason)) => {
            let frames = match args.seconds {
                Some(seconds) => capture::frames_in(seconds, FPS)?,
                None => FRAMES,
            };
            let folder = FrameFolder::beside(FRAMES_DIR).map_err(CaptureError::from)?;
            tell(&format!(
                "no display to open a window on ({reason}); drawing {} s of it into {} instead",
                f64::from(frames) / f64::from(FPS),
                folder.path().display(),
            ));
            let schedule = Schedule { frames, fps: FPS };
            let recording = Recording {
                schedule,
                size_px: SIZE_PX,
                scale: 1.0,
                panels: Panels::Shown,
                motion: !args.reduced_motion,
                mark_every: logbook::usual_stride(schedule.ticks(&experiment.lab())),
            };
            Ok(recording::record(&experiment, recording, folder)?)
        }
        done => Ok(done?),
    }
}

/// How the window reads scene files: the one given with the options given, and each with the words of the command line.
fn files(args: &ExperimentArgs, experiment: &Experiment) -> SceneFiles {
    let given = args.clone();
    let read = move |path: &Path| {
        given.read(path).map_err(|error| Error::from(error).report(&Renderer::plain()))
    };
    let is_file = !scene_file::is_built_in(args.scene());
    let opened = is_file.then(|| (args.scene().to_owned(), experiment.text.clone()));
    SceneFiles { read: Arc::new(read), opened }
}
