//! Draws the frames of a capture again, and compares them with the capture's files.

use std::fs;

use super::{Frames, Rerun, VerifyArgs};
use crate::atomic_file::IfExists;
use crate::commands::argument::brief;
use crate::commands::drawing::{adapter, interrupted_after};
use crate::commands::error::{Error, PlaceOf};
use crate::commands::frame_names::{frames_claimed, is_marked, not_ours};
use crate::commands::interrupt::watch_for_interrupt;
use crate::commands::manifest::{Adapter, FILE_NAME, FrameEntry, Manifest, fingerprint};
use crate::commands::output::begin_file;
use crate::commands::pipeline::{DrawnFrame, Pipeline};
use crate::commands::schedule::Schedule;
use crate::commands::state_log::StateLog;
use crate::commands::terminal::print_status;
use crate::regular_file;
use crate::studio::Studio;
use crate::view::png;

/// Limits for frames of a graphics device, or with letters by other instructions. They are a little above the
/// differences seen so far.
const OTHER_ADAPTER: (u8, f64) = (2, 0.01);

/// Maximum number of bytes per pixel in a picture file, which has up to four channels of 16 bits.
const BYTES_PER_PIXEL: usize = 8;

/// Maximum number of bytes in a picture file besides its pixels.
const MAX_NOTES_BYTES: usize = 1 << 20;

/// The difference that a frame may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    /// Maximum difference of a channel of a pixel.
    pub(super) max_channel: u8,
    /// Maximum share of the pixels that may differ by more than 1, in percent.
    pub(super) max_pixels_percent: f64,
}

impl Limits {
    /// Limits of the options, or else of the adapter. The adapter that drew the frames may not differ at all.
    pub(super) fn of(same_adapter: bool, max_channel: Option<u8>, max_pixels: Option<f64>) -> Self {
        let (channel, pixels) = if same_adapter { (0, 0.0) } else { OTHER_ADAPTER };
        Self {
            max_channel: max_channel.unwrap_or(channel),
            max_pixels_percent: max_pixels.unwrap_or(pixels),
        }
    }

    fn allow(self, difference: &PixelDifference) -> bool {
        let percent = 100.0 * difference.off_by_more_than_one as f64 / difference.pixels as f64;
        difference.worst <= self.max_channel && percent <= self.max_pixels_percent
    }
}

/// The difference between two pictures of the same size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct PixelDifference {
    pixels: usize,
    off: usize,
    off_by_more_than_one: usize,
    worst: u8,
}

fn difference(a: &[u8], b: &[u8]) -> PixelDifference {
    let mut difference = PixelDifference { pixels: a.len() / 4, ..PixelDifference::default() };
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

/// Draws every frame of the capture again, and compares it with its file. Also returns the studio at the end, and the
/// log of its states.
pub(super) fn judge(
    args: &VerifyArgs,
    rerun: &Rerun,
) -> Result<(Frames, (Studio, StateLog)), Error> {
    let Rerun { manifest, capture, .. } = rerun;
    check_differences(args, manifest)?;
    let cannot = |error: Error| error.or_mistake().within("the pixels cannot be judged");
    let mut renderer = capture.renderer().map_err(cannot)?;
    let limits = limits(args, &manifest.adapter, &adapter(&renderer));
    let frames = manifest.frames.len() as u32;
    let interrupted = watch_for_interrupt();
    let (mut studio, mut state_log) = rerun.begin();
    let run = Pipeline {
        renderer: &mut renderer,
        studio: &mut studio,
        state_log: &mut state_log,
        schedule: Schedule { frames, ..capture.schedule },
    };
    let mut differences = Vec::new();
    let compare = |drawn: &DrawnFrame| {
        let entry = &manifest.frames[drawn.frame as usize];
        compare(entry, capture.size_px, &drawn.rgba, limits, args)
    };
    let drawn = run.draw_all(&interrupted, compare, |_, difference| {
        differences.push(difference);
        Ok(())
    });
    let done = drawn.map_err(cannot)?;
    if done < frames {
        return Err(cannot(interrupted_after(done, frames, "nothing is written")));
    }
    let are_exact = limits.max_channel == 0;
    Ok((Frames { are_exact, differences }, (studio, state_log)))
}

/// The limits for these options and adapters. Reports an adapter other than the one that drew the frames.
fn limits(args: &VerifyArgs, was: &Adapter, is: &Adapter) -> Limits {
    let limits = Limits::of(was == is, args.max_channel, args.max_pixels);
    if was != is {
        let name = |a: &Adapter| format!("{} ({}, {})", a.name, a.backend, a.driver_info);
        print_status(&format!(
            "drawn then with {}, now with {}: a channel may differ by {}, and {} % of a frame's \
             pixels by more than 1",
            name(was),
            name(is),
            limits.max_channel,
            limits.max_pixels_percent,
        ));
    }
    limits
}

/// Creates the directory for pictures of differences, if one is requested. Fails if a picture would replace a foreign
/// file.
fn check_differences(args: &VerifyArgs, manifest: &Manifest) -> Result<(), Error> {
    let Some(path) = &args.diff else { return Ok(()) };
    let refused =
        |what| Err(Error::mistake(format!("{} {what}; give another --diff", brief(path))));
    if path.canonicalize().is_ok_and(|it| args.dir.canonicalize().is_ok_and(|dir| dir == it)) {
        return refused("holds the frames that are judged");
    }
    if frames_claimed(&path.join(FILE_NAME)).is_some() {
        return refused("holds another capture");
    }
    let mut pictures = manifest.frames.iter().map(|entry| path.join(&entry.file));
    if let Some(other) = pictures.find(|picture| picture.exists() && !is_marked(picture)) {
        return Err(not_ours(&other, PlaceOf::Option("--diff")));
    }
    fs::create_dir_all(path).map_err(Error::of_file("make the directory", path, "--diff"))
}

/// Describes how a frame differs from its file, if the difference exceeds the limits.
fn compare(
    entry: &FrameEntry,
    size_px: [u32; 2],
    now: &[u8],
    limits: Limits,
    args: &VerifyArgs,
) -> Option<String> {
    let path = args.dir.join(&entry.file);
    let [width, height] = size_px.map(|px| px as usize);
    let max_bytes = BYTES_PER_PIXEL * width * height + MAX_NOTES_BYTES;
    let then = match regular_file::read(&path, max_bytes) {
        Ok(file) => match image::load_from_memory(&file) {
            Ok(picture) => picture.into_rgba8(),
            Err(error) => return Some(format!("cannot be decoded: {error}")),
        },
        Err(error) => return Some(format!("cannot be read: {error}")),
    };
    if then.dimensions() != size_px.into() {
        let (width, height) = then.dimensions();
        return Some(format!("is {width}x{height}, not {}x{}", size_px[0], size_px[1]));
    }
    let difference = difference(&then, now);
    let was_altered = fingerprint(&then) != entry.pixels;
    if limits.allow(&difference) && !was_altered {
        return None;
    }
    let mut what = format!("{} pixels off, the worst by {}", difference.off, difference.worst);
    if was_altered {
        what += "; the file no longer matches its hash in the manifest";
    }
    if let Some(directory) = args.diff.as_ref().filter(|_| difference.off > 0) {
        let path = directory.join(&entry.file);
        let picture = png::encode(size_px, &picture_of(&then, now, difference.worst));
        let written =
            begin_file(&path).and_then(|file| file.write_whole(&picture, IfExists::Replace));
        what += &match written {
            Ok(written) => format!("; see {}", written.display()),
            Err(error) => format!("; {}", Error::of_file("write", &path, "--diff")(error)),
        };
    }
    Some(what)
}

/// Returns a picture of the difference in each channel, scaled so that the largest difference is 255.
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
    fn a_difference_of_one_level_in_one_pixel_is_detected() {
        let black = vec![0; 4 * 200];
        let mut other = black.clone();
        assert_eq!(
            difference(&black, &other),
            PixelDifference { pixels: 200, ..Default::default() }
        );
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
