//! `regatta capture`: draws a run frame by frame. The time of each frame is computed and not read from a clock, so that
//! the same command always makes the same bytes.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::error::{Error, PlaceOf};
use super::experiment::{self, Experiment, known_trace};
use super::experiment_args::ExperimentArgs;
use super::frame_folder::{FolderPolicy, FrameFolder};
use super::frame_names::MAX_FRAMES;
use super::help::flowing;
use super::id::{INSTRUMENT, RENDERER, SHAPE, THEME};
use super::output::{Destination, Output};
use super::picture_format::{self, PictureFormat, Writing};
use super::schedule::{FPS, MAX_FPS, Schedule, frames_in};
use super::settings::{CaptureSettings, drawing_for_manifest};
use super::{clip, movie, sheet, state_log};
use crate::atomic_file::IfExists;
use crate::look::palette::Theme;
use crate::loops::TraceCard;
use crate::measure::cloud::CloudShape;
use crate::run::race::Mode;
use crate::studio::{Instrument, loop_lab_refusal};
use crate::view::RendererChoice;

const EXAMPLES: &str = "\
Frame i shows the run at i / fps seconds. The same command makes the same bytes. manifest.json,
written last, describes the frames; `regatta verify` compares with it.

Examples:
  regatta capture --scene spring --race --out clip
  regatta capture --scene ship --frames 1 --size 1920x1080 --out still
  regatta capture --scene stiff --out stiff.png
  regatta capture --race --format y4m --out race.y4m";

/// Draw a run into numbered pictures, without a window
#[derive(Debug, Args)]
#[command(after_long_help = flowing(EXAMPLES))]
pub(super) struct CaptureArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// Race all methods of the scene at once
    #[arg(long)]
    race: bool,

    /// Show the loop lab over a trace [default: edge]
    ///
    /// At an eighth of real time. `regatta list traces` has the names.
    #[arg(long = "loop", value_name = "TRACE", conflicts_with = "race")]
    #[arg(num_args = 0..=1, default_missing_value = "edge", value_parser = known_trace)]
    loop_trace: Option<&'static TraceCard>,

    /// The directory of the frames, or the file
    ///
    /// For the format png a directory of frame-000000.png and so on, created if necessary. For others a file, or - for
    /// standard output.
    #[arg(long, value_name = "DIR|FILE")]
    out: PathBuf,

    /// How many frames to draw
    ///
    /// From 1 to 1000000; in a sheet the number of columns, by default 6.
    #[arg(long, value_name = "N", conflicts_with = "seconds")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_FRAMES)))]
    frames: Option<u32>,

    /// Simulated seconds to draw [default: the scene's]
    #[arg(long, value_name = "s", value_parser = experiment::seconds)]
    #[arg(allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// Frames per simulated second [default: 30]
    ///
    /// From 1 to 1000; in a sheet by default 1.
    #[arg(long, value_name = "F")]
    #[arg(value_parser = fps)]
    fps: Option<u32>,

    /// Width and height in pixels [default: 1280x720]
    ///
    /// From 1x1 to 8192x8192; in a sheet the size of a cell, by default 320x180.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,

    /// The size of text and lines
    ///
    /// Pixels per point, 0.5 to 4.
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = scale)]
    scale: f32,

    /// The theme: dark or light [default: dark]
    #[arg(long, value_name = "THEME", value_parser = THEME, hide_possible_values = true)]
    theme: Option<Theme>,

    /// Panels around the stage: on or off
    ///
    /// By default on, and off in a sheet.
    #[arg(long, value_name = "WHEN", hide_possible_values = true)]
    panels: Option<Shown>,

    /// The instrument [default: motion]
    ///
    /// For the panels, such as energy, phase or cloud.
    #[arg(long, value_name = "NAME", value_parser = INSTRUMENT, conflicts_with = "loop_trace")]
    #[arg(hide_possible_values = true)]
    instrument: Option<Instrument>,

    /// The shape of the starts of the instrument cloud
    ///
    /// Cat, disc or ring; by default cat.
    #[arg(long, value_name = "SHAPE", value_parser = SHAPE, requires = "instrument")]
    #[arg(hide_possible_values = true)]
    shape: Option<CloudShape>,

    /// What draws: auto, gpu or cpu [default: cpu]
    ///
    /// The processor needs no driver, and draws the same frames on every machine, except for single pixels of letters.
    /// Gpu takes a graphics device, which may be a software driver. Auto takes a graphics card, or the processor if
    /// there is none.
    #[arg(long, value_name = "WHAT", value_parser = RENDERER)]
    #[arg(hide_possible_values = true, hide_short_help = true)]
    renderer: Option<RendererChoice>,

    /// Ticks between two states in the manifest
    ///
    /// By default there are about 500 of each lane, and at most 8000 in all.
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    mark_every: Option<u64>,

    /// The format: png, gif, y4m or sheet
    ///
    /// By default from FILE's ending (.png is a sheet), and png for a DIR.
    #[arg(long, value_name = "FORMAT", value_parser = picture_format::by_id(), hide_possible_values = true)]
    format: Option<&'static PictureFormat>,

    /// Replace the frames in DIR, or FILE
    ///
    /// Other files in DIR stay.
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Shown {
    On,
    Off,
}

/// Columns per second of a sheet. One is enough to see a method fail on any scene.
const SHEET_FPS: u32 = 1;

/// Maximum number of cells side by side in a sheet, as many as fit on a page.
const SHEET_COLUMNS: u32 = 6;

/// Longest side of a frame in pixels. Nearly every graphics device can draw it.
const MAX_SIDE_PX: u32 = 8192;

pub(super) fn run(args: &CaptureArgs) -> Result<(), Error> {
    if args.shape.is_some() && args.instrument != Some(Instrument::Cloud) {
        return Err(Error::mistake(
            "--shape needs the instrument cloud; give --instrument cloud, or neither",
        ));
    }
    let format = PictureFormat::of(&args.out, args.format)?;
    let everyone = args.race || format.is_sheet() && args.experiment.names_no_method();
    let mode = if everyone { Mode::Race } else { Mode::Solo };
    if args.loop_trace.is_some() && format.is_sheet() {
        return Err(Error::mistake(
            "a sheet shows methods and not loops; give --loop another format",
        ));
    }
    let experiment = args.experiment.load(mode)?;
    let experiment = Experiment { loop_trace: args.loop_trace, ..experiment };
    let studio = experiment.studio();
    if args.loop_trace.is_some()
        && let Some(refusal) = loop_lab_refusal(&studio)
    {
        return Err(Error::mistake(format!("--loop: {refusal}")));
    }
    let fps = args.fps.unwrap_or(format.or_sheet(FPS, SHEET_FPS));
    format.check(fps)?;
    let frames = match (args.frames, args.seconds) {
        (Some(frames), _) => frames,
        (None, Some(seconds)) => frames_in(seconds, fps)?,
        (None, None) if format.is_sheet() => SHEET_COLUMNS,
        (None, None) => frames_in(experiment.scene.seconds, fps)?,
    };
    let schedule = Schedule { frames, fps };
    let capture = CaptureSettings {
        schedule,
        size_px: args.size.unwrap_or(format.or_sheet([1280, 720], [320, 180])),
        scale: args.scale,
        panels: args.panels.unwrap_or(format.or_sheet(Shown::On, Shown::Off)) == Shown::On,
        instrument: args.instrument,
        cloud: args.shape,
        motion: true,
        theme: args.theme.unwrap_or_default(),
        mark_every: args
            .mark_every
            .unwrap_or_else(|| state_log::usual_stride(schedule.ticks(&studio))),
        renderer: args.renderer.unwrap_or(RendererChoice::Cpu),
    };
    match format.writing {
        Writing::Folder => {
            let existing = if args.force { FolderPolicy::Replace } else { FolderPolicy::Refuse };
            let folder = FrameFolder::inspect(&args.out, existing, PlaceOf::Option("--out"))?;
            let renderer = capture.renderer()?;
            let drawing = drawing_for_manifest(&experiment, &capture);
            clip::record(&experiment, drawing, studio, capture, renderer, folder).map(drop)
        }
        Writing::Sheet => sheet::draw(&experiment, &studio, capture, open(args)?),
        Writing::Movie(begin) => movie::record(studio, capture, begin, open(args)?),
    }
}

impl CaptureArgs {
    /// Whether a graphics device may draw.
    pub(super) fn may_take_a_device(&self) -> bool {
        matches!(self.renderer, Some(RendererChoice::Auto | RendererChoice::Gpu))
    }
}

fn open(args: &CaptureArgs) -> Result<Output, Error> {
    let if_exists = if args.force { IfExists::Replace } else { IfExists::Keep };
    let inputs = Vec::from_iter(args.experiment.input());
    Destination { path: &args.out, option: "--out", if_exists, inputs: &inputs }.open()
}

fn size(written: &str) -> Result<[u32; 2], String> {
    let sides = written.split_once(['x', 'X']).and_then(|(width, height)| {
        Some([width.parse::<u32>().ok()?, height.parse::<u32>().ok()?])
    });
    match sides {
        Some(sides) if sides.iter().all(|side| (1..=MAX_SIDE_PX).contains(side)) => Ok(sides),
        Some(_) => Err(format!("each side has 1 to {MAX_SIDE_PX} pixels")),
        None => Err("give width and height in pixels, such as 1280x720".into()),
    }
}

fn fps(written: &str) -> Result<u32, String> {
    match (written.parse(), written.parse::<f64>()) {
        (Ok(fps), _) if (1..=MAX_FPS).contains(&fps) => Ok(fps),
        (Err(_), Ok(fps)) if (1.0..=f64::from(MAX_FPS)).contains(&fps) => Err(format!(
            "frame i stands at i / fps seconds, and fps is a whole number; give {}",
            fps.round()
        )),
        (Ok(fps), _) => Err(format!("{fps} is not in 1..={MAX_FPS}")),
        _ => Err(format!("give a whole number from 1 to {MAX_FPS}")),
    }
}

fn scale(written: &str) -> Result<f32, String> {
    match written.parse::<f32>() {
        Ok(scale) if (0.5..=4.0).contains(&scale) => Ok(scale),
        _ => Err("give a number from 0.5 to 4".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_sides_within_the_limit() {
        assert_eq!(size("1x1"), Ok([1, 1]));
        assert_eq!(size("8192X8192"), Ok([8192, 8192]));
        for wrong in
            ["", "1280", "0x720", "1280x0", "8193x1", "-1x1", "1.5x1", "1x1x1", "99999999999x1"]
        {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }
}
