//! Draws the frames of a capture again, and compares them with the capture's files.

use std::fmt::{self, Display, Formatter};
use std::fs;

use super::physics::other_moment;
use super::{Frames, Repeated, VerifyArgs};
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
use crate::commands::settings::CapturedRun;
use crate::commands::terminal::print_status;
use crate::regular_file;
use crate::sim::number::counted;
use crate::view::{PixelDifference, PixelLimits, PreparedFrame, png};

/// Maximum number of bytes per pixel in a picture file, which has up to four channels of 16 bits.
const BYTES_PER_PIXEL: usize = 8;

/// Maximum number of bytes in a picture file besides its pixels.
const MAX_NOTES_BYTES: usize = 1 << 20;

/// The difference that the frames may have.
#[derive(Clone, Copy)]
struct Limits {
    of_pixels: PixelLimits,
    /// Whether only pixels of letters may differ.
    of_letters: bool,
}

impl Limits {
    /// Returns the limits for these adapters, with those that the options replace. The adapter that drew the frames may
    /// not differ at all, and the same one with other letters only in those.
    fn of(args: &VerifyArgs, was: &Adapter, is: &Adapter) -> Self {
        let with_these_letters = Adapter { driver_info: is.driver_info.clone(), ..was.clone() };
        let of_letters = was != is && with_these_letters == *is;
        let usual = match was == is {
            true => PixelLimits::EXACT,
            false if of_letters => PixelLimits::OF_LETTERS,
            false => PixelLimits::OF_EXECUTORS,
        };
        let of_pixels = PixelLimits {
            max_channel: args.max_channel.unwrap_or(usual.max_channel),
            max_pixels_percent: args.max_pixels.unwrap_or(usual.max_pixels_percent),
            ..usual
        };
        Self { of_pixels, of_letters }
    }

    fn allow(self, difference: &PixelDifference, only_letters_differ: impl Fn() -> bool) -> bool {
        self.of_pixels.allow(difference)
            && (difference.worst() == 0 || !self.of_letters || only_letters_differ())
    }
}

impl Display for Limits {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let PixelLimits { max_channel, max_pixels_percent, strays } = self.of_pixels;
        let whose = if self.of_letters { " of a letter" } else { "" };
        write!(f, "a channel{whose} may differ by {max_channel}")?;
        if strays > 0 {
            write!(f, ", in {} of 100 000 by more", counted(strays, "pixel"))?;
        }
        if max_pixels_percent < 100.0 {
            write!(f, ", and in {max_pixels_percent} % of a frame's pixels by more than 1")?;
        }
        Ok(())
    }
}

/// Draws every frame of the capture again, and compares it with its file. Also returns the repeated run.
pub(super) fn judge(
    args: &VerifyArgs,
    rerun: &CapturedRun,
    manifest: &Manifest,
) -> Result<(Frames, Repeated), Error> {
    let capture = &rerun.capture;
    check_differences(args, manifest)?;
    let cannot = |error: Error| error.or_mistake().within("the pixels cannot be judged");
    let mut renderer = capture.renderer().map_err(cannot)?;
    let (was, is) = (&manifest.adapter, adapter(&renderer));
    let limits = Limits::of(args, was, &is);
    if *was != is {
        let name = |a: &Adapter| format!("{} ({}, {})", a.name, a.backend, a.driver_info);
        print_status(&format!("drawn then with {}, now with {}: {limits}", name(was), name(&is)));
    }
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
    let compare = |drawn: &DrawnFrame, prepared: &PreparedFrame| {
        let entry = &manifest.frames[drawn.frame as usize];
        compare(entry, capture.size_px, (&drawn.rgba, prepared), limits, args)
            .or_else(|| other_moment(entry, drawn.tick, drawn.alpha))
    };
    let drawn = run.draw_all(&interrupted, compare, |_, difference| {
        differences.push(difference);
        Ok(())
    });
    let done = drawn.map_err(cannot)?;
    if done < frames {
        return Err(cannot(interrupted_after(done, frames, "nothing is written")));
    }
    let are_exact = limits.of_pixels.are_exact();
    Ok((Frames { are_exact, differences }, Repeated { studio, state_log, moment: None }))
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
    (now, prepared): (&[u8], &PreparedFrame),
    limits: Limits,
    args: &VerifyArgs,
) -> Option<String> {
    let path = args.dir.join(&entry.file);
    let [width, height] = size_px.map(|px| px as usize);
    let max_bytes = BYTES_PER_PIXEL * width * height + MAX_NOTES_BYTES;
    let (then, is_whole) = match regular_file::read(&path, max_bytes) {
        Ok(file) => match image::load_from_memory(&file) {
            Ok(picture) => (picture.into_rgba8(), png::is_whole(&file)),
            Err(error) => return Some(format!("cannot be decoded: {error}")),
        },
        Err(error) if error.is_missing() => return Some("is missing".into()),
        Err(error) => return Some(format!("cannot be read: {error}")),
    };
    if then.dimensions() != size_px.into() {
        let (width, height) = then.dimensions();
        return Some(format!("is {width}x{height}, not {}x{}", size_px[0], size_px[1]));
    }
    let difference = PixelDifference::between(&then, now, |_| true);
    let was_altered = fingerprint(&then) != entry.pixels;
    let only_letters_differ = || {
        prepared.has_letters().is_some_and(|has_letters| {
            PixelDifference::between(&then, now, |pixel| !has_letters[pixel]).worst() == 0
        })
    };
    if limits.allow(&difference, only_letters_differ) && !was_altered {
        let what = "its pixels are the same, but the file is cut, or goes on after its end";
        return (!is_whole).then(|| what.to_owned());
    }
    let (off, worst) = (difference.beyond(0), difference.worst());
    let mut what = format!("{} off, the worst by {worst}", counted(off, "pixel"));
    if was_altered {
        what += "; the file no longer matches its hash in the manifest";
    }
    if let Some(directory) = args.diff.as_ref().filter(|_| off > 0) {
        let path = directory.join(&entry.file);
        let picture = png::encode(size_px, &picture_of(&then, now, worst));
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
    fn a_picture_of_differences_is_scaled_to_the_largest() {
        let (black, other) = ([0, 0, 0, 255, 0, 0, 0, 255], [0, 0, 1, 255, 3, 0, 0, 255]);
        assert_eq!(picture_of(&black, &other, 3), [0, 0, 85, 255, 255, 0, 0, 255]);
    }
}
