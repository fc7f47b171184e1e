//! `regatta report`: writes a picture of a run that carries the run, which is the form of a bug report.

use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::Ordering;

use clap::Args;

use super::error::Error;
use super::experiment;
use super::experiment_args::ExperimentArgs;
use super::help::flowing;
use super::interrupt::watch_for_interrupt;
use super::output::Destination;
use super::pipeline::complete_analysis;
use super::schedule::{FPS, Schedule, frames_in};
use super::settings::CaptureSettings;
use super::terminal::print_status;
use crate::atomic_file::IfExists;
use crate::look::palette::Theme;
use crate::measure::cloud::CloudWorker;
use crate::run::race::Mode;
use crate::run::recording_text;
use crate::view::{RendererChoice, png};

const ABOUT: &str = "\
The picture is the end of the run. In it are the run's scene, script and hashes, and the version of
the program, so that one file is enough to see a fault and to repeat it. A report is taken wherever a
scene is: `regatta play` opens it, `regatta verify` checks it, and the window opens it when it is
dropped there. Shift P in the window makes one. A recording keeps its own checks.

Examples:
  regatta report --scene stiff --method explicit-euler --out stiff.png
  regatta report recording.toml --out report.png
  regatta verify report.png";

/// Write a run and its picture in one file, to report a bug
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct ReportArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// Race all methods of the scene at once
    #[arg(long)]
    race: bool,

    /// Simulated seconds to run [default: the scene's]
    #[arg(long, value_name = "s", value_parser = experiment::seconds)]
    #[arg(allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// The picture, a PNG file
    #[arg(long, value_name = "FILE.png")]
    out: PathBuf,

    /// Replace FILE.png if it exists
    #[arg(long)]
    force: bool,
}

pub(super) fn run(args: &ReportArgs) -> Result<(), Error> {
    let mode = if args.race { Mode::Race } else { Mode::Solo };
    let experiment = args.experiment.load(mode)?;
    let frames = 1 + frames_in(args.seconds.unwrap_or(experiment.scene.seconds), FPS)?;
    let capture = CaptureSettings {
        schedule: Schedule { frames, fps: FPS },
        size_px: [1280, 720],
        scale: 1.0,
        panels: true,
        instrument: None,
        cloud: None,
        motion: true,
        theme: Theme::Dark,
        mark_every: 1,
        renderer: RendererChoice::Cpu,
    };
    let if_exists = if args.force { IfExists::Replace } else { IfExists::Keep };
    let inputs = Vec::from_iter(args.experiment.input());
    let out = Destination { path: &args.out, option: "--out", if_exists, inputs: &inputs };
    let mut output = out.open()?;
    let mut renderer =
        CaptureSettings { schedule: Schedule { frames: 1, fps: FPS }, ..capture }.renderer()?;
    let mut studio = capture.prepare_studio(experiment.studio());
    let interrupted = watch_for_interrupt();
    for frame in 0..frames {
        if interrupted.load(Ordering::Relaxed) {
            return Err(Error::nothing_written());
        }
        capture.schedule.advance(&mut studio, frame, &mut ());
    }
    if !complete_analysis(&mut studio, &renderer, &mut CloudWorker::default(), &interrupted) {
        return Err(Error::nothing_written());
    }
    // A recording is the report of a run elsewhere, whose hashes it must keep.
    let recording = if experiment.scene.checks.is_empty() {
        studio.deck.recording()
    } else {
        recording_text(&experiment.scene)
    };
    let recording = recording.map_err(Error::failed)?;
    let mut rgba = renderer.buffer()?;
    renderer.draw(&studio, &mut rgba)?;
    output.write_all(&png::encode_report(capture.size_px, &rgba, &recording))?;
    let name = output.close()?;
    print_status(&format!(
        "wrote {name}: the run to tick {}, and its picture; check it with: regatta verify {name}",
        studio.race().tick()
    ));
    Ok(())
}
