//! Draws a run into a folder of numbered pictures, and writes a manifest beside them.

use super::drawing::{DrawingError, adapter, closing_line};
use super::experiment::Experiment;
use super::fingerprint::fingerprint;
use super::frame_folder::FrameFolder;
use super::frame_names::frame_name;
use super::interrupt::watch_for_interrupt;
use super::manifest::{FrameEntry, Manifest, SCHEMA};
use super::pipeline::{Drawn, Run, Stop};
use super::recording::Recording;
use super::settings;
use super::state_log::{self, StateLog};
use super::terminal::{progress, tell};
use crate::view::png;

/// Draws a run into `folder` and reports on standard error what it wrote.
pub(super) fn record(
    experiment: &Experiment,
    recording: Recording,
    mut folder: FrameFolder,
) -> Result<(), DrawingError> {
    let Recording { schedule, size_px, .. } = recording;
    let mut renderer = recording.renderer()?;
    let adapter = adapter(&renderer);
    folder.clear()?;

    let interrupted = watch_for_interrupt();
    let progress = progress(schedule.frames, "frames");
    let mut lab = recording.lab(experiment);
    let mut state_log = StateLog::new(recording.mark_every, lab.race());
    let mut entries = Vec::new();
    let run = Run {
        renderer: &mut renderer,
        lab: &mut lab,
        state_log: &mut state_log,
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
        Err(Stop::Taken(source)) => return Err(DrawingError::Write { source, whole }),
    }
    settled.map_err(|source| DrawingError::Write { source, whole: whole.clone() })?;
    let (done, frames) = (entries.len() as u32, schedule.frames);
    if done < frames && !folder.takes_a_part() {
        return Err(DrawingError::interrupted(done, frames, "the old frames"));
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
        lanes: state_log::ends(&lab),
        marks: state_log.close(lab.race()),
    };
    let (path, others) = (folder.path().to_owned(), folder.others().to_vec());
    let written = folder.finish(&manifest.to_text());
    written.map_err(|source| DrawingError::Write { source, whole: whole.clone() })?;
    if done < frames {
        return Err(DrawingError::interrupted(done, frames, &whole));
    }
    tell(&closing_line(&recording, &whole));
    if !others.is_empty() {
        let others: Vec<_> = others.iter().map(|name| name.display().to_string()).collect();
        tell(&format!("left alone in {}: {}", path.display(), others.join(", ")));
    }
    Ok(())
}
