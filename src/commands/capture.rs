//! `regatta capture`: a run drawn frame by frame into numbered pictures, by a clock that is computed
//! and not read, so that the same command makes the same bytes.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use super::experiment::{self, ExperimentArgs, Lineup};
use super::folder::{Existing, FolderError};
use super::frame_folder::{FrameFolder, MOST_FRAMES};
use super::{Error, tell};
use crate::lab::{Clock, Lab};
use crate::view::{AdapterPreference, Artist, Gpu, GpuError, ReadbackError, png};

const EXAMPLES: &str = "\
Frame i shows the run at i / fps seconds. The same command makes the same bytes.

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

    /// How to write pictures: png
    #[arg(long, value_name = "FORMAT", default_value = "png", hide_possible_values = true)]
    format: PictureFormat,

    /// Replace the frames that DIR holds; other files in it stay
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum PictureFormat {
    Png,
}

/// Smooth enough for every scene, at half the files and half the time of 60.
pub(super) const FPS: u32 = 30;

/// The longest side of a frame in pixels: what nearly every adapter can draw on.
const LONGEST_SIDE_PX: u32 = 8192;

/// The most pixels of a whole capture: hours of drawing and about a hundred gigabytes of files.
/// More is a slip of the fingers.
const MOST_PIXELS: u64 = 1_000_000_000_000;

/// What is drawn: how often, how large.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recording {
    pub(super) frames: u32,
    pub(super) fps: u32,
    pub(super) size_px: [u32; 2],
    /// Pixels to a point.
    pub(super) scale: f32,
}

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
        size_px[0], size_px[1], pixels / GIGA, MOST_PIXELS / GIGA
    )]
    TooManyPixels {
        /// Asked for.
        frames: u32,
        /// Asked for.
        size_px: [u32; 2],
        /// In all.
        pixels: u64,
    },
    /// The folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A frame could not be written.
    #[error("{source}; whole before that: {whole}")]
    Write {
        /// Why.
        source: FolderError,
        /// The frames written before.
        whole: String,
    },
    /// There is nothing to draw with.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A frame was drawn but did not come back.
    #[error(transparent)]
    Readback(#[from] ReadbackError),
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
                FolderError::NotEmpty { .. } | FolderError::NotADirectory { .. },
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
    let seconds = args.seconds.unwrap_or(experiment.scene().seconds);
    let frames = match args.frames {
        Some(frames) => frames,
        None => frames_in(seconds, args.fps)?,
    };
    let PictureFormat::Png = args.format;
    let recording = Recording { frames, fps: args.fps, size_px: args.size, scale: args.scale };
    let existing = if args.force { Existing::Replace } else { Existing::Refuse };
    let folder = FrameFolder::inspect(&args.out, existing).map_err(CaptureError::from)?;
    record(&mut experiment.lab(), recording, folder)?;
    Ok(())
}

/// How many frames cover this many seconds; the start is one of them in any case.
pub(super) fn frames_in(seconds: f64, fps: u32) -> Result<u32, CaptureError> {
    let frames = (seconds * f64::from(fps)).round().max(1.0);
    if frames > f64::from(MOST_FRAMES) {
        return Err(CaptureError::TooManyFrames { frames });
    }
    Ok(frames as u32)
}

/// Draws a run from where `lab` stands into `folder`, and says on standard error what it wrote.
pub(super) fn record(
    lab: &mut Lab,
    recording: Recording,
    mut folder: FrameFolder,
) -> Result<(), CaptureError> {
    let Recording { frames, fps, size_px, scale } = recording;
    let pixels = u64::from(frames) * u64::from(size_px[0]) * u64::from(size_px[1]);
    if pixels > MOST_PIXELS {
        return Err(CaptureError::TooManyPixels { frames, size_px, pixels });
    }
    let gpu = Gpu::headless(AdapterPreference::Any)?;
    log::info!("drawing with {} ({})", gpu.info.name, gpu.info.backend);
    let mut artist = Artist::new(gpu, size_px, scale)?;
    folder.clear()?;

    let interrupted = watch_for_interrupt();
    let progress = ProgressBar::new(u64::from(frames)).with_style(progress_style());
    let mut rgba = Vec::new();
    // In a window verdicts come one a frame; here there is time for all of them before the first.
    while lab.think() {}
    for frame in 0..frames {
        if interrupted.load(Ordering::Relaxed) {
            progress.finish_and_clear();
            let whole = folder.range();
            return Err(CaptureError::Interrupted { done: frame, frames, whole });
        }
        if frame > 0 {
            advance(lab, time_ns(frame, fps) - time_ns(frame - 1, fps));
        }
        artist.draw(lab, &mut rgba)?;
        folder
            .push(&png::encode(size_px, &rgba))
            .map_err(|source| CaptureError::Write { source, whole: folder.range() })?;
        progress.inc(1);
    }
    progress.finish_and_clear();
    let [width, height] = size_px;
    let plural = if frames == 1 { "" } else { "s" };
    tell(&format!(
        "wrote {frames} frame{plural} of {width}x{height}, {fps} a second: {}",
        folder.range()
    ));
    if !folder.others().is_empty() {
        let others: Vec<_> =
            folder.others().iter().map(|name| name.display().to_string()).collect();
        tell(&format!("left alone in {}: {}", folder.path().display(), others.join(", ")));
    }
    Ok(())
}

/// When `frame` is, in nanoseconds: rounded up, so that a tick due at that very moment is done.
fn time_ns(frame: u32, fps: u32) -> u64 {
    (u64::from(frame) * GIGA).div_ceil(u64::from(fps))
}

/// Advances by `ns` nanoseconds in stretches that the clock takes whole.
fn advance(lab: &mut Lab, ns: u64) {
    let longest = u64::from(Clock::LONGEST_FRAME_MS) * 1_000_000;
    let mut left = ns;
    while left > 0 {
        let stretch = left.min(longest);
        let due = lab.advance(stretch as i64);
        assert_eq!(due.dropped, 0, "a stretch is no longer than the clock's longest frame");
        left -= stretch;
    }
}

/// Set once Ctrl-C is pressed.
fn watch_for_interrupt() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&interrupted);
    if let Err(error) = ctrlc::set_handler(move || set.store(true, Ordering::Relaxed)) {
        log::warn!("Ctrl-C will stop the capture at once: {error}");
    }
    interrupted
}

fn progress_style() -> ProgressStyle {
    ProgressStyle::with_template("{bar:40} {pos}/{len} frames, {eta} left")
        .expect("the template is a constant")
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
    use crate::lab::Scene;

    #[test]
    fn each_frame_has_just_the_ticks_that_are_due() {
        for (tick_hz, fps) in
            [(60, 30), (60, 60), (49, 30), (60, 24), (7, 1), (10_000, 3), (1, 1000)]
        {
            let mut scene = Scene::built_in("spring").unwrap();
            scene.tick_hz = tick_hz;
            let mut lab = Lab::new(scene);
            for frame in 1..=2 * fps {
                advance(&mut lab, time_ns(frame, fps) - time_ns(frame - 1, fps));
                let due = u64::from(frame) * u64::from(tick_hz) / u64::from(fps);
                assert_eq!(lab.race().tick(), due, "frame {frame}, {tick_hz} Hz, {fps} fps");
            }
        }
    }

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
