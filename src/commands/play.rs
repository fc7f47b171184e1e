//! `regatta play`: the window; where there is no display, its first seconds as pictures.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use annotate_snippets::Renderer;
use clap::Args;

use super::error::{Cause, Error};
use super::experiment::{self, Experiment, ExperimentArgs, Lineup};
use super::frame_folder::FrameFolder;
use super::interrupt::Interrupted;
use super::output::{AtomicOutput, Older, Place};
use super::recording::Recording;
use super::schedule::{FPS, Schedule, frames_in};
use super::terminal::tell;
use super::{clip, logbook, scene_file};
use crate::lab::{Lab, RecordingTooLong};
use crate::view::Panels;
use crate::window::{self, SceneFiles, WindowError};

const EXAMPLES: &str = "\
Examples:
  regatta play --scene spring --method explicit-euler
  regatta play --scene stiff --race --tick-hz 49
  regatta play --scene my.toml
  regatta play --scene spring --record run.toml

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

    /// Write the run into FILE as a scene, when the window is closed or Ctrl-C is pressed
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,

    /// Replace the --record FILE if it is there
    #[arg(long, requires = "record")]
    force: bool,

    /// Trails do not fade, and the camera does not glide
    #[arg(long)]
    reduced_motion: bool,
}

impl Cause for RecordingTooLong {
    fn exit_code(&self) -> u8 {
        1
    }
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
    // Before anything is flown that could then not be kept.
    let record = args.record.as_deref().map(|path| {
        let older = if args.force { Older::Replace } else { Older::Keep };
        Place { path, option: "--record", older }
    });
    let record = record.map(AtomicOutput::open_for_text).transpose()?;
    let files = files(&args.experiment, &experiment);
    let (lab, interrupted) = match window::run(lab, args.seconds, files, record.is_some()) {
        Err(WindowError::NoDisplay(reason)) => {
            (without_display(args, &experiment, &reason)?, false)
        }
        done => done?,
    };
    if let Some(mut record) = record {
        let name = record.name();
        let text = lab.recording()?;
        record.write_all(text.as_bytes()).map_err(|error| record.failed(error))?;
        record.close()?;
        tell(&format!("recorded {} in {name}", ticks(&lab)));
    }
    match interrupted {
        true => Err(Interrupted::After { done: ticks(&lab) }.into()),
        false => Ok(()),
    }
}

/// How far a run came, for people.
fn ticks(lab: &Lab) -> String {
    let ticks = lab.timeline().end();
    format!("{ticks} tick{}", if ticks == 1 { "" } else { "s" })
}

/// Draws the first seconds into a folder, and returns the lab as it then is.
fn without_display(args: &PlayArgs, experiment: &Experiment, reason: &str) -> Result<Lab, Error> {
    let frames = match args.seconds {
        Some(seconds) => frames_in(seconds, FPS)?,
        None => FRAMES,
    };
    let folder = FrameFolder::beside(FRAMES_DIR)?;
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
    clip::record(experiment, recording, folder)?;
    let mut lab = experiment.lab();
    let last = args.seconds.map(|seconds| lab.nearest_tick(seconds));
    (0..frames).for_each(|frame| schedule.advance(&mut lab, frame, &mut ()));
    // The last frame is before the end.
    while last.is_some_and(|last| lab.race().tick() < last) {
        lab.tick();
    }
    Ok(lab)
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
