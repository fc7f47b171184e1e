//! A run drawn into a folder of numbered pictures, with a manifest beside them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

use super::capture::CaptureError;
use super::experiment::Experiment;
use super::fingerprint::fingerprint;
use super::frame_folder::{FrameFolder, FrameFolderError};
use super::frame_names::frame_name;
use super::logbook::{self, Logbook};
use super::manifest::{Adapter, FrameEntry, Manifest, SCHEMA};
use super::pipeline::{Drawn, Run, Stop};
use super::voyage::Schedule;
use super::{settings, tell};
use crate::lab::Lab;
use crate::view::{AdapterPreference, Artist, Gpu, Panels, png};

/// The most pixels of a whole capture: hours of drawing and about a hundred gigabytes of files.
/// More is a slip of the fingers.
const MOST_PIXELS: u64 = 1_000_000_000_000;

/// What is drawn: how often, how large.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recording {
    pub(super) schedule: Schedule,
    pub(super) size_px: [u32; 2],
    /// Pixels to a point.
    pub(super) scale: f32,
    pub(super) panels: Panels,
    /// Whether trails fade and the camera glides.
    pub(super) motion: bool,
    /// Ticks from one mark in the manifest to the next.
    pub(super) mark_every: u64,
}

impl Recording {
    /// Where the run begins.
    pub(super) fn lab(&self, experiment: &Experiment) -> Lab {
        let mut lab = experiment.lab();
        lab.set_motion(self.motion);
        lab
    }

    /// Who draws it.
    pub(super) fn artist(&self) -> Result<Artist, CaptureError> {
        let (frames, size_px) = (self.schedule.frames, self.size_px);
        let pixels = u64::from(frames) * u64::from(size_px[0]) * u64::from(size_px[1]);
        if pixels > MOST_PIXELS {
            return Err(CaptureError::TooManyPixels { frames, size_px, pixels, most: MOST_PIXELS });
        }
        let gpu = Gpu::headless(AdapterPreference::Any)?;
        log::info!("drawing with {} ({})", gpu.info.name, gpu.info.backend);
        Ok(Artist::new(gpu, size_px, self.scale)?.with_panels(self.panels))
    }
}

/// Draws a run into `folder`, and says on standard error what it wrote.
pub(super) fn record(
    experiment: &Experiment,
    recording: Recording,
    mut folder: FrameFolder,
) -> Result<(), CaptureError> {
    let Recording { schedule, size_px, .. } = recording;
    let mut artist = recording.artist()?;
    let adapter = adapter(&artist);
    folder.clear(schedule.frames)?;

    let interrupted = watch_for_interrupt();
    let progress = progress(schedule.frames, "frames");
    let mut lab = recording.lab(experiment);
    let mut logbook = Logbook::new(recording.mark_every, &lab);
    let mut entries = Vec::new();
    // The frames that stay are drawn again: for proof that they are of this run, and because a glyph's
    // place in egui's atlas, and with it the last bit of a few pixels, depends on the frames before.
    let run = Run {
        artist: &mut artist,
        lab: &mut lab,
        logbook: &mut logbook,
        schedule,
        interrupted: &interrupted,
    };
    let encode = |drawn: &Drawn| (png::encode(size_px, &drawn.rgba), fingerprint(&drawn.rgba));
    let drawn = run.draw_all(encode, |&Drawn { tick, alpha, .. }, (file, pixels)| {
        folder.push(&file)?;
        let file = frame_name(entries.len() as u32);
        entries.push(FrameEntry { file, tick, alpha: [alpha.0, alpha.1], pixels });
        progress.inc(1);
        Ok(())
    });
    progress.finish_and_clear();
    let settled = folder.settle();
    let whole = folder.range();
    match drawn {
        Ok(_) => {}
        Err(Stop::Readback(error)) => return Err(error.into()),
        Err(Stop::Taken(source @ FrameFolderError::Foreign { .. })) => return Err(source.into()),
        Err(Stop::Taken(source)) => return Err(CaptureError::Write { source, whole }),
    }
    settled.map_err(|source| CaptureError::Write { source, whole: whole.clone() })?;
    let (done, frames) = (entries.len() as u32, schedule.frames);
    if done < frames && !folder.takes_a_part() {
        return Err(CaptureError::Interrupted { done, frames, whole: "those of before".into() });
    }
    let settings = settings::written(experiment, &recording);
    let manifest = Manifest {
        schema: SCHEMA,
        regatta: env!("CARGO_PKG_VERSION").to_owned(),
        settings_hash: settings.hash(),
        settings,
        adapter,
        complete: done == frames,
        frames: entries,
        lanes: logbook::ends(&lab),
        marks: logbook.close(&lab),
    };
    let (path, others) = (folder.path().to_owned(), folder.others().to_vec());
    let written = folder.finish(&manifest.to_text());
    written.map_err(|source| CaptureError::Write { source, whole: whole.clone() })?;
    if done < frames {
        return Err(CaptureError::Interrupted { done, frames, whole });
    }
    tell(&closing_line(&recording, &whole));
    if !others.is_empty() {
        let others: Vec<_> = others.iter().map(|name| name.display().to_string()).collect();
        tell(&format!("left alone in {}: {}", path.display(), others.join(", ")));
    }
    Ok(())
}

/// Says what was written, and where.
pub(super) fn closing_line(recording: &Recording, place: &str) -> String {
    let Schedule { frames, fps } = recording.schedule;
    let [width, height] = recording.size_px;
    let plural = if frames == 1 { "" } else { "s" };
    format!("wrote {frames} frame{plural} of {width}x{height}, {fps} a second: {place}")
}

/// What the manifest says of what draws.
pub(super) fn adapter(artist: &Artist) -> Adapter {
    let info = artist.adapter();
    Adapter {
        name: info.name.clone(),
        driver: info.driver.clone(),
        driver_info: info.driver_info.clone(),
        backend: info.backend.to_str().to_owned(),
        kind: format!("{:?}", info.device_type),
    }
}

/// Set once Ctrl-C is pressed.
pub(super) fn watch_for_interrupt() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&interrupted);
    if let Err(error) = ctrlc::set_handler(move || set.store(true, Ordering::Relaxed)) {
        log::warn!("Ctrl-C will stop the run at once: {error}");
    }
    interrupted
}

/// A bar of so many frames or other things, on a terminal.
pub(super) fn progress(number: u32, things: &'static str) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} {msg}, {eta} left")
        .expect("the template is a constant");
    ProgressBar::new(u64::from(number)).with_style(style).with_message(things)
}
