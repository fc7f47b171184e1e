//! Draws a run into a folder of numbered pictures with a manifest.

use super::drawing::{adapter, closing_line, interrupted_after};
use super::error::Error;
use super::experiment::Experiment;
use super::frame_folder::FrameFolder;
use super::frame_names::frame_name;
use super::interrupt::watch_for_interrupt;
use super::manifest::{Drawing, FrameEntry, Manifest, SCHEMA, fingerprint};
use super::pipeline::{DrawnFrame, Pipeline};
use super::settings::CaptureSettings;
use super::state_log::{self, StateLog};
use super::terminal::{print_status, report_left_alone};
use crate::studio::Studio;
use crate::view::{OffscreenRenderer, PreparedFrame, png};

/// Draws the run of `studio` into `folder`, and reports the result on standard error. The studio must be at the
/// start of `experiment`, and `drawing` and the renderer must be those of `capture`. Returns the studio at the end
/// of the run.
pub(super) fn record(
    experiment: &Experiment,
    drawing: Drawing,
    studio: Studio,
    capture: CaptureSettings,
    mut renderer: OffscreenRenderer,
    mut folder: FrameFolder,
) -> Result<Studio, Error> {
    let CaptureSettings { schedule, size_px, .. } = capture;
    let adapter = adapter(&renderer);
    // Signals are watched before the folder gets its first entry, because an unhandled Ctrl-C would leave that entry
    // behind.
    let interrupted = watch_for_interrupt();
    folder.clear()?;

    let mut studio = capture.prepare_studio(studio);
    let mut state_log = StateLog::new(capture.mark_every, studio.race());
    let mut entries = Vec::new();
    let run = Pipeline {
        renderer: &mut renderer,
        studio: &mut studio,
        state_log: &mut state_log,
        schedule,
    };
    let encode = |drawn: &DrawnFrame, _: &PreparedFrame| {
        (png::encode(size_px, &drawn.rgba), fingerprint(&drawn.rgba))
    };
    let drawn =
        run.draw_all(&interrupted, encode, |&DrawnFrame { tick, alpha, .. }, (file, pixels)| {
            folder.push(&file)?;
            let file = frame_name(entries.len() as u32);
            entries.push(FrameEntry { file, tick, alpha: [alpha.0, alpha.1], pixels });
            Ok(())
        });
    let (done, frames, whole) = (drawn?, schedule.frames, folder.range());
    if done < frames && !folder.keeps_partial_capture() {
        return Err(interrupted_after(done, frames, "the old frames"));
    }
    let checks = state_log.close(studio.race());
    let mut manifest = Manifest {
        schema: SCHEMA,
        regatta: env!("CARGO_PKG_VERSION").to_owned(),
        recording: state_log::recording_text(&experiment.scene, &checks).map_err(Error::mistake)?,
        drawing,
        settings_hash: String::new(),
        adapter,
        complete: done == frames,
        frames: entries,
        lanes: state_log::ends(&studio),
    };
    manifest.settings_hash = manifest.hash();
    let (path, others) = (folder.path().to_owned(), folder.others().to_vec());
    folder.finish(&manifest.to_text())?;
    if done < frames {
        return Err(interrupted_after(done, frames, &whole));
    }
    print_status(&closing_line(&capture, &whole));
    report_left_alone(&path, &others);
    Ok(studio)
}
