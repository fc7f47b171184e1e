//! Judges a capture. It repeats the run of the manifest once, and compares the states and the frames.

use std::collections::HashSet;
use std::io::ErrorKind;
use std::path::Path;

use serde_json::{Value, json};

use super::physics::{PhysicsChange, first_change};
use super::pixels;
use super::report::{DIRECTORY, Report};
use super::{Frames, Repeated, VerifyArgs};
use crate::commands::captured::{read_run, unjudged};
use crate::commands::clip::record;
use crate::commands::error::Error;
use crate::commands::error::PlaceOf;
use crate::commands::frame_folder::{FolderPolicy, FrameFolder};
use crate::commands::frame_names::{frame_digits, in_the_way, is_pending};
use crate::commands::interrupt::watch_for_interrupt;
use crate::commands::manifest::{FILE_NAME, Manifest, fingerprint};
use crate::commands::output::DirectoryLock;
use crate::commands::scene_file;
use crate::commands::settings::CapturedRun;
use crate::commands::terminal::print_status;
use crate::sim::number::counted;

/// Judges the capture that `args` names.
pub(super) fn judge(args: &VerifyArgs) -> Result<Report, Error> {
    let dir = &args.dir;
    let _lock = lock(dir).map_err(unjudged(dir))?;
    let (rerun, manifest) = read_run(dir)?;
    let Manifest { drawing, complete, frames, .. } = &manifest;
    if !complete {
        let (drawn, asked) = (frames.len(), drawing.frames);
        let how_far = format!("its capture was stopped after {drawn} of {asked} frames");
        return Err(unjudged(dir)(format!("{how_far}; draw all frames with --bless")));
    }
    let name = &drawing.scene;
    let now = scene_file::text_now(Path::new(name));
    if now.is_some_and(|now| fingerprint(now.as_bytes()) != drawing.scene_hash) {
        print_status(&format!(
            "{name} has changed since the capture; verify runs the captured scene"
        ));
    }
    let redrawn = match args.physics_only {
        true => Ok(None),
        false => pixels::judge(args, &rerun, &manifest).map(Some),
    };
    let run = || rerun.run(frames, &watch_for_interrupt()).ok_or_else(Error::nothing_written);
    let (redrawn, repeated, failed) = match redrawn {
        Ok(Some((frames, run))) => (Some(frames), run, None),
        Ok(None) => (None, run()?, None),
        // The physics is judged even if the pixels cannot be.
        Err(error) if error.is_mistake() => (None, run()?, Some(error)),
        Err(error) => return Err(error),
    };
    let mut report = Report::new(DIRECTORY, dir, args.format);
    add_physics(&mut report, &rerun, &manifest.lanes, repeated)?;
    let physics_differs = report.differing() > 0;
    match failed {
        Some(error) if !physics_differs => return Err(error),
        // The result that the physics differs is still reported, so this error is only printed.
        Some(error) => print_status(&error.to_string()),
        None => {}
    }
    add_pixels(&mut report, &manifest, redrawn)?;
    let what = match (physics_differs, report.differing()) {
        (true, 1) => "physics",
        (true, _) => "physics and pixels",
        (false, _) => "pixels",
    };
    let remedy = match in_the_way(dir) {
        None => "if that is meant, --bless".into(),
        Some(path) => format!(
            "if that is meant, move {} away, which regatta did not make, and --bless",
            path.display()
        ),
    };
    report.if_different(format!("{what} differ from {}; {remedy}", dir.join(FILE_NAME).display()));
    Ok(report)
}

fn add_physics(
    report: &mut Report,
    rerun: &CapturedRun,
    ends: &[Value],
    repeated: Repeated,
) -> Result<(), Error> {
    let Repeated { studio, state_log, moment } = repeated;
    let Some(change) = first_change(rerun, ends, &studio, state_log, moment) else {
        let lanes = counted(studio.race().entrants().len(), "lane");
        report
            .say(&format!("physics: same to the bit: {lanes} to tick {}", studio.race().tick()))?;
        report.judged("physics", None);
        report.field("physics", json!({ "same": true, "first_difference": null }));
        return Ok(());
    };
    let PhysicsChange { tick, lane, what } = change;
    let of_lane = lane.map_or(String::new(), |(n, method)| format!("lane {n}, {method}, "));
    let line = format!("differs first at tick {tick}: {of_lane}{what}");
    report.say(&format!("physics: {line}"))?;
    report.judged("physics", Some(line));
    let (lane, method) = lane.unzip();
    let change = json!({ "tick": tick, "lane": lane, "method": method, "what": what });
    report.field("physics", json!({ "same": false, "first_difference": change }));
    Ok(())
}

fn add_pixels(
    report: &mut Report,
    manifest: &Manifest,
    frames: Option<Frames>,
) -> Result<(), Error> {
    let Some(Frames { are_exact, differences }) = frames else {
        report.field("pixels", Value::Null);
        return Ok(());
    };
    let (frames, mut changes) = (differences.len(), Vec::new());
    for (entry, difference) in manifest.frames.iter().zip(differences) {
        if let Some(what) = &difference {
            report.say(&format!("pixels: {}: {what}", entry.file))?;
            changes.push(json!({ "file": entry.file, "what": what }));
        }
        report.judged(&entry.file, difference);
    }
    for file in unlisted(&report.path, manifest) {
        let what = "no frame of the manifest has this name; move it away".to_owned();
        report.say(&format!("pixels: {file}: {what}"))?;
        changes.push(json!({ "file": file, "what": what }));
        report.judged(file, Some(what));
    }
    let all = counted(frames, "frame");
    report.say(&match (changes.len(), are_exact) {
        (0, true) => format!("pixels: same: {all}, every pixel"),
        (0, false) => format!("pixels: same within the limits: {all}"),
        (changed, _) if changed > frames => format!("pixels: {changed} differ, of {all}"),
        (changed, _) => {
            format!("pixels: {changed} of {all} {}", if frames == 1 { "differs" } else { "differ" })
        }
    })?;
    let same = changes.is_empty();
    report.field("pixels", json!({ "same": same, "frames": frames, "differences": changes }));
    Ok(())
}

/// Returns the names in `dir` that are like those of frames, and that the manifest does not list.
fn unlisted(dir: &Path, manifest: &Manifest) -> Vec<String> {
    let listed: HashSet<&str> = manifest.frames.iter().map(|entry| &*entry.file).collect();
    let entries = std::fs::read_dir(dir).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let is_beyond = |name: &String| frame_digits(name).is_some() && !listed.contains(&**name);
    let mut found: Vec<String> = names.filter(is_beyond).collect();
    found.sort();
    found
}

/// Draws the capture in `dir` again, and replaces the old one once the new one is complete.
pub(super) fn bless(dir: &Path) -> Result<(), Error> {
    // This is checked first, so that a missing clip is not reported as a problem with the folder.
    if !dir.join(FILE_NAME).exists() && !is_pending(dir) {
        read_run(dir)?;
    }
    let folder = FrameFolder::inspect(dir, FolderPolicy::Bless, PlaceOf::Blessed)?;
    let (CapturedRun { experiment, capture, .. }, manifest) = read_run(dir)?;
    let studio = experiment.studio();
    let drawn = capture.renderer().and_then(|renderer| {
        record(&experiment, manifest.drawing, studio, capture, renderer, folder)
    });
    drawn.map(drop).map_err(|error| error.within("not blessed"))
}

/// Locks `dir` against writers while the capture in it is judged. Returns `None` if there is no such directory.
fn lock(dir: &Path) -> Result<Option<DirectoryLock>, String> {
    let busy = || "another regatta is writing to it; wait until it has finished".to_owned();
    let lock = match DirectoryLock::shared(dir) {
        Ok(lock) => lock.ok_or_else(busy)?,
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
            return Ok(None);
        }
        Err(error) => return Err(format!("it cannot be locked: {error}")),
    };
    if is_pending(dir) {
        let remedy = in_the_way(dir).map_or("--bless completes it".into(), |path| {
            format!(
                "move {} away, which regatta did not make, and --bless completes it",
                path.display()
            )
        });
        return Err(format!("a --bless was interrupted while it replaced the frames; {remedy}"));
    }
    Ok(Some(lock))
}
