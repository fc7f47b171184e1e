//! Draws the frames of a capture again and compares them with the files.

use std::fs;
use std::path::{Path, PathBuf};

use super::super::drawing::DrawingError;
use super::super::error::Cause;
use super::super::experiment::Experiment;
use super::super::fingerprint::fingerprint;
use super::super::frame_folder::FrameFolderError;
use super::super::frame_names::{frames_claimed, is_marked};
use super::super::interrupt::watch_for_interrupt;
use super::super::manifest::{FILE_NAME, FrameEntry, Manifest};
use super::super::output::{FileError, write_whole};
use super::super::pipeline::{Drawn, Run, Stop};
use super::super::recording::Recording;
use super::super::schedule::Schedule;
use super::super::state_log::StateLog;
use super::super::terminal::progress;
use super::report::{FrameChange, Report};
use crate::regular_file;
use crate::view::{OffscreenRenderer, png};

/// The limits on another driver: a little more than the differences that were seen.
const OTHER_DRIVER: (u8, f64) = (2, 0.01);

/// The most bytes of a pixel in a picture that is read: four channels of 16 bits.
const BYTES_PER_PIXEL: usize = 8;

/// The most bytes of a picture beside its pixels.
const MAX_NOTES_BYTES: usize = 1 << 20;

/// Why frames were not judged, or not drawn again.
#[derive(Debug, thiserror::Error)]
pub(in crate::commands) enum PixelError {
    /// Pictures of differences would replace the frames.
    #[error("{} holds the frames that are judged; give another --diff", .path.display())]
    DifferencesAmongFrames {
        /// The folder.
        path: PathBuf,
    },
    /// Pictures of differences would replace the frames of another capture.
    #[error("{} holds another capture; give another --diff", .path.display())]
    DifferencesInCapture {
        /// The folder.
        path: PathBuf,
    },
    /// A difference could not be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A folder cannot take what would be written there.
    #[error(transparent)]
    Folder(#[from] FrameFolderError),
    /// The frames could not be drawn.
    #[error("the pixels cannot be judged: {0}")]
    Capture(#[from] DrawingError),
    /// The frames could not be drawn again.
    #[error("not blessed: {0}")]
    Bless(DrawingError),
}

impl Cause for PixelError {
    fn exit_code(&self) -> u8 {
        match self {
            PixelError::File(_) => 1,
            PixelError::Folder(error) => error.exit_code(),
            PixelError::Bless(error) => error.exit_code(),
            PixelError::Capture(DrawingError::Interrupted(_)) => 130,
            PixelError::DifferencesAmongFrames { .. }
            | PixelError::DifferencesInCapture { .. }
            | PixelError::Capture(_) => 2,
        }
    }
}

/// How much a frame may differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    /// The largest difference of a channel.
    pub(super) max_channel: u8,
    /// The most pixels off by more than 1, in percent.
    pub(super) max_pixels_percent: f64,
}

impl Limits {
    /// No difference on the driver that drew the frames, except what the options allow.
    pub(super) fn of(same_driver: bool, max_channel: Option<u8>, max_pixels: Option<f64>) -> Self {
        let (channel, pixels) = if same_driver { (0, 0.0) } else { OTHER_DRIVER };
        Self {
            max_channel: max_channel.unwrap_or(channel),
            max_pixels_percent: max_pixels.unwrap_or(pixels),
        }
    }

    fn allow(self, difference: &Difference) -> bool {
        let percent = 100.0 * difference.off_by_more_than_one as f64 / difference.pixels as f64;
        difference.worst <= self.max_channel && percent <= self.max_pixels_percent
    }
}

/// The folder of the frames, and the folder for pictures of their differences.
#[derive(Clone, Copy)]
pub(super) struct Folder<'a> {
    pub(super) frames: &'a Path,
    pub(super) differences: Option<&'a Path>,
}

/// The difference of two pictures of the same size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Difference {
    pixels: usize,
    off: usize,
    off_by_more_than_one: usize,
    worst: u8,
}

fn difference(a: &[u8], b: &[u8]) -> Difference {
    let mut difference = Difference { pixels: a.len() / 4, ..Difference::default() };
    if a != b {
        for (a, b) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
            let worst = a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
            difference.off += usize::from(worst > 0);
            difference.off_by_more_than_one += usize::from(worst > 1);
            difference.worst = difference.worst.max(worst);
        }
    }
    difference
}

/// Draws every frame of the manifest and reports those that differ.
pub(super) fn judge(
    manifest: &Manifest,
    experiment: &Experiment,
    recording: &Recording,
    renderer: &mut OffscreenRenderer,
    limits: Limits,
    folder: Folder<'_>,
    report: &mut Report,
) -> Result<(), PixelError> {
    let frames = manifest.frames.len() as u32;
    let schedule = Schedule { frames, ..recording.schedule };
    if let Some(path) = folder.differences {
        fs::create_dir_all(path).map_err(FileError::of("make the directory", path, "--diff"))?;
        if fs::canonicalize(path).ok() == fs::canonicalize(folder.frames).ok() {
            return Err(PixelError::DifferencesAmongFrames { path: path.to_owned() });
        }
        if frames_claimed(&path.join(FILE_NAME)).is_some() {
            return Err(PixelError::DifferencesInCapture { path: path.to_owned() });
        }
    }
    let interrupted = watch_for_interrupt();
    let progress = progress(frames, "frames");
    let mut lab = recording.lab(experiment);
    let mut state_log = StateLog::new(u64::MAX, lab.race());
    let run = Run {
        renderer,
        lab: &mut lab,
        state_log: &mut state_log,
        schedule,
        interrupted: &interrupted,
    };
    let mut changes = Vec::new();
    let size_px = recording.size_px;
    let make = |drawn: &Drawn| {
        let entry = &manifest.frames[drawn.frame as usize];
        (entry, compare(entry, size_px, &drawn.rgba, limits, folder))
    };
    let drawn = run.draw_all(make, |_, (entry, change)| {
        changes.extend(change?.map(|what| FrameChange { file: entry.file.clone(), what }));
        progress.inc(1);
        Ok(())
    });
    progress.finish_and_clear();
    let done = match drawn {
        Ok(done) => done,
        Err(Stop::Readback(error)) => return Err(DrawingError::from(error).into()),
        Err(Stop::Taken(error)) => return Err(error),
    };
    if done < frames {
        return Err(DrawingError::interrupted(done, frames, "nothing is written").into());
    }
    report.frames = Some(manifest.frames.iter().map(|entry| entry.file.clone()).collect());
    report.is_exact = limits.max_channel == 0;
    report.pixels = changes;
    Ok(())
}

/// The difference of a frame from its file, if there is one beyond the limits.
fn compare(
    entry: &FrameEntry,
    size_px: [u32; 2],
    now: &[u8],
    limits: Limits,
    folder: Folder<'_>,
) -> Result<Option<String>, PixelError> {
    let path = folder.frames.join(&entry.file);
    let [width, height] = size_px.map(|px| px as usize);
    let max_bytes = BYTES_PER_PIXEL * width * height + MAX_NOTES_BYTES;
    let then = match regular_file::read(&path, max_bytes) {
        Ok(file) => match image::load_from_memory(&file) {
            Ok(picture) => picture.into_rgba8(),
            Err(error) => return Ok(Some(format!("cannot be decoded: {error}"))),
        },
        Err(error) => return Ok(Some(format!("cannot be read: {error}"))),
    };
    if then.dimensions() != size_px.into() {
        let (width, height) = then.dimensions();
        return Ok(Some(format!("is {width}x{height}, not {}x{}", size_px[0], size_px[1])));
    }
    let difference = difference(&then, now);
    let was_altered = fingerprint(&then) != entry.pixels;
    if limits.allow(&difference) && !was_altered {
        return Ok(None);
    }
    let mut what = format!("{} pixels off, the worst by {}", difference.off, difference.worst);
    if was_altered {
        what.push_str("; the file no longer matches its hash in the manifest");
    }
    if let Some(directory) = folder.differences.filter(|_| difference.off > 0) {
        let path = directory.join(&entry.file);
        let picture = picture_of(&then, now, difference.worst);
        if path.exists() && !is_marked(&path) {
            return Err(FrameFolderError::NotOurs { path, option: "--diff" }.into());
        }
        write_whole(&path, &png::encode(size_px, &picture))
            .map_err(FileError::of("write", &path, "--diff"))?;
        what.push_str(&format!("; see {}", path.display()));
    }
    Ok(Some(what))
}

/// A picture of each channel's difference, scaled so that the largest is 255.
fn picture_of(a: &[u8], b: &[u8], worst: u8) -> Vec<u8> {
    let scaled =
        |(a, b): (&u8, &u8)| (u32::from(a.abs_diff(*b)) * 255 / u32::from(worst.max(1))) as u8;
    let mut picture: Vec<u8> = a.iter().zip(b).map(scaled).collect();
    picture.iter_mut().skip(3).step_by(4).for_each(|alpha| *alpha = 255);
    picture
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_pixel_and_one_level_are_seen() {
        let black = vec![0; 4 * 200];
        let mut other = black.clone();
        assert_eq!(difference(&black, &other), Difference { pixels: 200, ..Default::default() });
        other[7] = 1;
        let one = difference(&black, &other);
        assert_eq!((one.off, one.off_by_more_than_one, one.worst), (1, 0, 1));
        assert!(!Limits::of(true, None, None).allow(&one));
        assert!(Limits::of(false, None, None).allow(&one));
        other[40] = 3;
        let two = difference(&black, &other);
        assert_eq!((two.off, two.off_by_more_than_one, two.worst), (2, 1, 3));
        assert!(!Limits::of(false, None, None).allow(&two));
        assert!(!Limits::of(false, Some(3), Some(0.4)).allow(&two));
        assert!(Limits::of(false, Some(3), Some(0.6)).allow(&two));
        let picture = picture_of(&black, &other, two.worst);
        assert_eq!(picture[4..8], [0, 0, 0, 255]);
        assert_eq!(picture[40..44], [255, 0, 0, 255]);
    }
}
