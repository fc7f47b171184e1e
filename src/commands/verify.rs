//! `regatta verify`: checks that this program still reproduces a capture or a recording.
//!
//! The physics is judged first, bit by bit and without a GPU; then the pixels, which may move when the
//! physics has not.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::error::{Cause, Error};
use super::frame_names::{is_of_a_capture, is_pending};
use super::manifest::{self, FILE_NAME, Manifest, SCHEMA};
use super::output::{DirectoryLock, Older, OutputError, Place, write_text};
use super::terminal::tell;
use super::{scene_file, settings};
use crate::regular_file::{self, Unreadable};

mod checks;
mod errors;
mod physics;
#[cfg(feature = "view")]
mod pixels;
#[cfg(feature = "view")]
mod redrawn;
mod report;

pub(super) use errors::VerifyError;
use report::Report;

const EXAMPLES: &str = "\
FILE.toml is a recording: a scene with checks. Its race is run again, without graphics. Each lane is
reported as the same to the bit, or with the first check that differs.

DIR is a capture. The run that its manifest describes is repeated: first the physics, which must be
the same to the bit, then the frames. On the adapter and driver that drew them, every pixel must be
the same; on others a channel may differ by 2, and one pixel in ten thousand by more than 1.

Exit code 0: the same. 1: different. 2: cannot be judged; the message says why.

Examples:
  regatta verify clip
  regatta verify clip --physics-only
  regatta verify clip --report junit verify.xml --diff differences
  regatta verify clip --bless
  regatta verify recording.toml";

/// Run a capture or a recording again and report whether physics or pixels have changed
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct VerifyArgs {
    /// The directory that `regatta capture` filled, or a scene file with checks
    #[arg(value_name = "DIR|FILE.toml")]
    dir: PathBuf,

    /// Judge only the physics; needs no graphics
    #[arg(long)]
    physics_only: bool,

    /// Also write the result to FILE, as junit or json; repeat the option for both
    #[arg(long, num_args = 2, value_names = ["FORMAT", "FILE"])]
    report: Option<Vec<String>>,

    /// For each frame that differs, write a picture of the difference into DIR
    #[arg(long, value_name = "DIR", conflicts_with = "physics_only")]
    diff: Option<PathBuf>,

    /// The largest allowed difference of a channel, 0 to 255 [default: 0, or 2 on another driver]
    #[arg(long, value_name = "N")]
    max_channel: Option<u8>,

    /// The largest allowed percentage of pixels off by more than 1 [default: 0, or 0.01 on another driver]
    #[arg(long, value_name = "P", value_parser = percent)]
    max_pixels: Option<f64>,

    /// Accept the present results: replace all frames, or all checks of a recording. The old frames stay
    /// until all new ones are drawn
    #[arg(long, conflicts_with_all = ["physics_only", "report", "diff"])]
    bless: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ReportFormat {
    Junit,
    Json,
}

pub(super) fn run(args: &VerifyArgs) -> Result<(), Error> {
    if is_scene_file(&args.dir) {
        return judge_checks(args);
    }
    Ok(judge(args)?)
}

/// Whether something is at the path that is no directory, or nothing and the path ends in `.toml`.
fn is_scene_file(path: &Path) -> bool {
    !path.is_dir() && (path.exists() || path.extension().is_some_and(|ending| ending == "toml"))
}

fn judge_checks(args: &VerifyArgs) -> Result<(), Error> {
    let of_captures = [
        ("--diff", args.diff.is_some()),
        ("--max-channel", args.max_channel.is_some()),
        ("--max-pixels", args.max_pixels.is_some()),
    ];
    if let Some((option, _)) = of_captures.into_iter().find(|(_, is_given)| *is_given) {
        return Err(checks::CheckError::OfCaptures { option }.into());
    }
    if args.bless {
        return checks::bless(&args.dir);
    }
    let reports = reports(args.report.as_deref().unwrap_or_default(), &args.dir)?;
    let is_judged = |path: &Path| match (path.canonicalize(), args.dir.canonicalize()) {
        (Ok(path), Ok(judged)) => path == judged,
        _ => false,
    };
    if let Some((_, path)) = reports.iter().find(|(_, path)| is_judged(path)) {
        return Err(checks::CheckError::ReportOverScene { path: path.to_path_buf() }.into());
    }
    checks::judge(&args.dir, |checked| {
        Ok(write_reports(&reports, || checked.to_junit(), || checked.to_json())?)
    })
}

fn judge(args: &VerifyArgs) -> Result<(), VerifyError> {
    let reports = reports(args.report.as_deref().unwrap_or_default(), &args.dir)?;
    let path = args.dir.join(FILE_NAME);
    let unjudged = |reason| VerifyError::Unjudged { manifest: path.clone(), reason };
    #[cfg(feature = "view")]
    if args.bless {
        return redrawn::bless(&args.dir, unjudged);
    }
    #[cfg(not(feature = "view"))]
    if !args.physics_only {
        return Err(VerifyError::NoGraphics);
    }
    let _lock = lock(&args.dir).map_err(unjudged)?;
    let manifest = read(&path).map_err(unjudged)?;
    let (experiment, recording) = settings::read(&manifest.settings).map_err(unjudged)?;
    if !manifest.complete {
        return Err(unjudged(format!(
            "its capture was stopped after {} of {} frames; draw all frames with --bless",
            manifest.frames.len(),
            manifest.settings.frames
        )));
    }
    let scene = &manifest.settings.scene;
    if scene_file::text_now(Path::new(&scene.name)).is_some_and(|now| now != scene.text) {
        let name = &scene.name;
        tell(&format!("{name} has changed since the capture; the scene as captured is run"));
    }
    let mut report = Report::new(&args.dir);
    physics::judge(&manifest, &experiment, &recording, &mut report);
    report.say_physics()?;
    #[cfg(feature = "view")]
    if !args.physics_only {
        match redrawn::judge(args, &manifest, &experiment, &recording, &mut report) {
            // Different physics is a result, even if the pixels cannot be judged.
            Err(error) if report.physics.is_some() && error.exit_code() == 2 => {
                tell(&error.to_string());
            }
            judged => judged?,
        }
    }
    write_reports(&reports, || report.to_junit(), || report.to_json())?;
    match report.what_differs() {
        None => Ok(()),
        Some(what) => Err(VerifyError::Different { what, manifest: path }),
    }
}

/// Locks `dir` against writers while it is judged. `None` if there is no such directory.
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
        let reason = "a --bless was interrupted while it replaced the frames; --bless completes it";
        return Err(reason.into());
    }
    Ok(Some(lock))
}

/// Reads the manifest at `path`.
///
/// # Errors
/// Why it cannot be used: it is missing, incomplete, altered or of another schema.
fn read(path: &Path) -> Result<Manifest, String> {
    let bytes = regular_file::read(path, manifest::MAX_BYTES).map_err(|error| match error {
        Unreadable::System(error) => format!("{error}; `regatta capture` writes it"),
        error => error.to_string(),
    })?;
    let value: serde_json::Value = serde_json::from_slice(&bytes)
        .map_err(|error| format!("it is not JSON: {error}; capture again"))?;
    match value["schema"].as_u64() {
        Some(schema) if schema == u64::from(SCHEMA) => {}
        Some(schema) => {
            return Err(format!(
                "it is of schema {schema}, and this program reads {SCHEMA}; capture again"
            ));
        }
        None => return Err("it does not name its schema; capture again".into()),
    }
    let manifest: Manifest = serde_json::from_slice(&bytes)
        .map_err(|error| format!("it is not as schema {SCHEMA} has it: {error}; capture again"))?;
    settings::check(&manifest)?;
    Ok(manifest)
}

/// Parses the `--report` options: pairs of a format and a path. Refuses a path that would replace a file of a capture.
fn reports<'a>(
    words: &'a [String],
    dir: &Path,
) -> Result<Vec<(ReportFormat, &'a Path)>, VerifyError> {
    let mut reports: Vec<(ReportFormat, &Path)> = Vec::new();
    for words in words.chunks_exact(2) {
        let format = ReportFormat::from_str(&words[0], false)
            .map_err(|_| VerifyError::Format(words[0].clone()))?;
        let path = Path::new(&words[1]);
        if reports.iter().any(|(_, other)| *other == path) {
            return Err(VerifyError::SameReport { path: path.to_owned() });
        }
        if is_of_a_capture(path, dir) {
            return Err(VerifyError::ReportOverCapture { path: path.to_owned() });
        }
        reports.push((format, path));
    }
    Ok(reports)
}

/// Writes each report in its format.
fn write_reports(
    reports: &[(ReportFormat, &Path)],
    junit: impl Fn() -> String,
    json: impl Fn() -> String,
) -> Result<(), OutputError> {
    for &(format, path) in reports {
        let text = match format {
            ReportFormat::Junit => junit(),
            ReportFormat::Json => json(),
        };
        write_text(Place { path, option: "--report", older: Older::Replace }, &text)?;
    }
    Ok(())
}

fn percent(written: &str) -> Result<f64, String> {
    match written.parse::<f64>() {
        Ok(percent) if (0.0..=100.0).contains(&percent) => Ok(percent),
        _ => Err("give a percentage from 0 to 100".into()),
    }
}
