//! The frames of a capture drawn again: to judge them, or to take their place.

use std::path::Path;

use super::pixels::{self, Limits, PixelError};
use super::report::Report;
use super::{VerifyArgs, VerifyError, read};
use crate::commands::clip::record;
use crate::commands::drawing::{DrawingError, adapter};
use crate::commands::experiment::Experiment;
use crate::commands::frame_folder::{Existing, FrameFolder};
use crate::commands::frame_names::is_pending;
use crate::commands::manifest::{Adapter, FILE_NAME, Manifest};
use crate::commands::recording::Recording;
use crate::commands::settings;
use crate::commands::terminal::tell;

/// Draws the clip in `dir` again and replaces the old one once the new one is complete.
pub(super) fn bless(
    dir: &Path,
    unjudged: impl Fn(String) -> VerifyError,
) -> Result<(), VerifyError> {
    let path = dir.join(FILE_NAME);
    // Checked first, so that a missing clip is not reported as a problem with the folder.
    if !path.exists() && !is_pending(dir) {
        read(&path).map_err(&unjudged)?;
    }
    let folder = FrameFolder::inspect(dir, Existing::Bless, "DIR").map_err(PixelError::from)?;
    let manifest = read(&path).map_err(&unjudged)?;
    let (experiment, recording) = settings::read(&manifest.settings).map_err(&unjudged)?;
    match record(&experiment, recording, folder) {
        Err(DrawingError::Write { source, .. } | DrawingError::Folder(source)) => {
            Err(PixelError::from(source).into())
        }
        Err(error) => Err(PixelError::Bless(error).into()),
        Ok(()) => Ok(()),
    }
}

/// Draws the frames again and reports those that differ.
pub(super) fn judge(
    args: &VerifyArgs,
    manifest: &Manifest,
    experiment: &Experiment,
    recording: &Recording,
    report: &mut Report,
) -> Result<(), VerifyError> {
    let mut renderer = recording.renderer().map_err(PixelError::from)?;
    let (was, is) = (&manifest.adapter, adapter(&renderer));
    let limits = Limits::of(*was == is, args.max_channel, args.max_pixels);
    if *was != is {
        let name = |a: &Adapter| format!("{} ({}, {})", a.name, a.backend, a.driver_info);
        tell(&format!(
            "drawn then with {}, now with {}: a channel may differ by {}, and {} % of a frame's \
             pixels by more than 1",
            name(was),
            name(&is),
            limits.max_channel,
            limits.max_pixels_percent,
        ));
    }
    let folder = pixels::Folder { frames: &args.dir, differences: args.diff.as_deref() };
    pixels::judge(manifest, experiment, recording, &mut renderer, limits, folder, report)?;
    Ok(report.say_pixels()?)
}
