//! `regatta capture`: a run drawn frame by frame, by a clock that is computed and not read, so that the
//! same command makes the same bytes.

use std::io;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::Error;
use super::experiment::{self, ExperimentArgs, Lineup};
use super::frame_folder::{Existing, FrameFolder, FrameFolderError, MOST_FRAMES};
use super::logbook;
use super::recording::{Recording, record};
use super::voyage::Schedule;
use crate::view::{GpuError, Panels, ReadbackError};

const EXAMPLES: &str = "\
Frame i shows the run at i / fps seconds. The same command makes the same bytes. manifest.json,
written last, says what was drawn; `regatta verify` judges by it.

Examples:
  regatta capture --scene spring --race --out clip
  regatta capture --scene ship --method rk4 --frames 1 --size 1920x1080 --out still
  ffmpeg -framerate 30 -i clip/frame-%06d.png -pix_fmt yuv420p clip.mp4";

/// Draw a run into numbered pictures, without a window
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct CaptureArgs {
    #[command(flatten)]
    experiment: ExperimentArgs,

    /// Race all methods of the scene at once
    #[arg(long)]
    race: bool,

    /// The directory for frame-000000.png and so on; made where there is none
    #[arg(long, value_name = "DIR")]
    out: PathBuf,

    /// How many frames to draw, 1 to 1000000
    #[arg(long, value_name = "N", conflicts_with = "seconds")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_FRAMES)))]
    frames: Option<u32>,

    /// How many simulated seconds to draw [default: the scene's]
    #[arg(long, value_name = "S", value_parser = experiment::seconds)]
    #[arg(allow_negative_numbers = true)]
    seconds: Option<f64>,

    /// Frames in a simulated second, 1 to 1000
    #[arg(long, value_name = "F", default_value_t = FPS)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1000))]
    fps: u32,

    /// Width and height in pixels, 1x1 to 8192x8192
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    size: [u32; 2],

    /// Pixels to a point, 0.5 to 4: the size of text and lines
    #[arg(long, value_name = "S", default_value = "1", value_parser = scale)]
    scale: f32,

    /// Whether panels are shown around the stage: on or off
    #[arg(long, value_name = "WHEN", default_value = "on", hide_possible_values = true)]
    panels: Shown,

    /// Ticks from one state in the manifest to the next [default: about 500 states in all]
    #[arg(long, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    mark_every: Option<u64>,

    /// How to write pictures: png
    #[arg(long, value_name = "FORMAT", default_value = "png", hide_possible_values = true)]
    format: PictureFormat,

    /// Replace the frames that DIR holds; other files in it stay
    #[arg(long)]
    force: bool,

    /// Keep the frames that the same command left when it was stopped, and draw the rest
    #[arg(long, conflicts_with = "force")]
    resume: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum PictureFormat {
    Png,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Shown {
    On,
    Off,
}

/// Smooth enough for every scene, at half the files and half the time of 60.
pub(super) const FPS: u32 = 30;

/// The longest side of a frame in pixels: what nearly every adapter can draw on.
const LONGEST_SIDE_PX: u32 = 8192;

/// Why there are not all frames.
#[derive(Debug, thiserror::Error)]
pub enum CaptureError {
    /// More frames than six digits number.
    #[error(
        "{frames} frames are asked for, and a capture has at most {MOST_FRAMES}; \
         give a lower --fps or fewer --seconds"
    )]
    TooManyFrames {
        /// Asked for.
        frames: f64,
    },
    /// More pixels than anybody wants.
    #[error(
        "{frames} frames of {}x{} are {} gigapixels, and a capture has at most {}; \
         give fewer --frames or a smaller --size",
        size_px[0], size_px[1], pixels / GIGA, most / GIGA
    )]
    TooManyPixels {
        /// Asked for.
        frames: u32,
        /// Asked for.
        size_px: [u32; 2],
        /// In all.
        pixels: u64,
        /// The most there may be.
        most: u64,
    },
    /// The folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FrameFolderError),
    /// A frame could not be written.
    #[error("{source}; whole before that: {whole}")]
    Write {
        /// Why.
        source: FrameFolderError,
        /// The frames written before.
        whole: String,
    },
    /// There is nothing to draw with.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A frame was drawn but did not come back.
    #[error(transparent)]
    Readback(#[from] ReadbackError),
    /// Standard output took no more.
    #[error("cannot write to standard output: {0}")]
    Output(#[from] io::Error),
    /// Somebody pressed Ctrl-C.
    #[error("interrupted after {done} of {frames} frames; whole: {whole}")]
    Interrupted {
        /// Frames written.
        done: u32,
        /// Frames asked for.
        frames: u32,
        /// Their names.
        whole: String,
    },
}

const GIGA: u64 = 1_000_000_000;

impl CaptureError {
    pub(super) fn exit_code(&self) -> u8 {
        match self {
            CaptureError::TooManyFrames { .. }
            | CaptureError::TooManyPixels { .. }
            | CaptureError::Folder(
                FrameFolderError::NotEmpty { .. }
                | FrameFolderError::NotADirectory { .. }
                | FrameFolderError::Foreign { .. },
            )
            | CaptureError::Gpu(GpuError::TooLarge { .. } | GpuError::Empty { .. }) => 2,
            CaptureError::Interrupted { .. } => 130,
            _ => 1,
        }
    }
}

pub(super) fn run(args: &CaptureArgs) -> Result<(), Error> {
    let lineup = if args.race { Lineup::Everyone } else { Lineup::Solo };
    let experiment = args.experiment.load(lineup)?;
    let seconds = args.seconds.unwrap_or(experiment.scene.seconds);
    let frames = match args.frames {
        Some(frames) => frames,
        None => frames_in(seconds, args.fps)?,
    };
    let schedule = Schedule { frames, fps: args.fps };
    let recording = Recording {
        schedule,
        size_px: args.size,
        scale: args.scale,
        panels: match args.panels {
            Shown::On => Panels::Shown,
            Shown::Off => Panels::Off,
        },
        motion: true,
        mark_every: args
            .mark_every
            .unwrap_or_else(|| logbook::usual_stride(schedule.ticks(experiment.scene.tick_hz))),
    };
    let PictureFormat::Png = args.format;
    let existing = match (args.force, args.resume) {
        (true, _) => Existing::Replace,
        (_, true) => Existing::Continue,
        _ => Existing::Refuse,
    };
    let folder = FrameFolder::inspect(&args.out, existing).map_err(CaptureError::from)?;
    Ok(record(&experiment, recording, folder)?)
}

/// How many frames cover this many seconds; the start is one of them in any case.
pub(super) fn frames_in(seconds: f64, fps: u32) -> Result<u32, CaptureError> {
    let frames = (seconds * f64::from(fps)).round().max(1.0);
    if frames > f64::from(MOST_FRAMES) {
        return Err(CaptureError::TooManyFrames { frames });
    }
    Ok(frames as u32)
}

fn size(written: &str) -> Result<[u32; 2], String> {
    let sides = written.split_once(['x', 'X']).and_then(|(width, height)| {
        Some([width.parse::<u32>().ok()?, height.parse::<u32>().ok()?])
    });
    match sides {
        Some(sides) if sides.iter().all(|side| (1..=LONGEST_SIDE_PX).contains(side)) => Ok(sides),
        Some(_) => Err(format!("each side has 1 to {LONGEST_SIDE_PX} pixels")),
        None => Err("give width and height in pixels, such as 1280x720".into()),
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

    #[test]
    fn seconds_make_whole_frames_and_at_least_the_start() {
        assert_eq!(frames_in(20.0, 30).unwrap(), 600);
        assert_eq!(frames_in(0.0, 30).unwrap(), 1);
        assert_eq!(frames_in(0.05, 30).unwrap(), 2);
        assert!(frames_in(3e7, 1000).is_err());
    }
}
