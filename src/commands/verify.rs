//! `regatta verify`: checks that this program still reproduces a capture or a recording.
//!
//! The run is repeated once. Its physics must match bit by bit, even in a build without graphics. Its pixels may differ
//! although the physics is the same.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueEnum};

use super::argument::{brief, number_that};
use super::error::Error;
use super::frame_names::is_of_a_capture;
use super::help::flowing;
use super::manifest::FrameEntry;
use super::output::same_file_path;
use super::output::table::TableFormat;
use super::settings::CapturedRun;
use super::state_log::StateLog;
use crate::studio::Studio;

mod clip;
mod physics;
mod pixels;
pub(super) mod recording;
mod report;

use report::{ReportFile, ReportFormat};

const EXAMPLES: &str = "\
A recording is a scene with checks. Verify runs its race again without graphics: each lane must be the
same to the bit, or verify names the first check that differs. It also repeats the run of a capture:
first the physics, which must be the same to the bit, then the frames. The processor draws them, and
they must be the same in every pixel, or almost if a graphics device drew the capture.

Exit code 0: the same. 1: different. 2: cannot be judged; the message says why.

Examples:
  regatta verify clip
  regatta verify clip --report junit verify.xml --diff differences
  regatta verify recording.toml";

/// Run a capture or a recording again and say what has changed
///
/// Physics or pixels.
#[derive(Debug, Args)]
#[command(after_long_help = flowing(EXAMPLES))]
pub(super) struct VerifyArgs {
    /// The directory that `regatta capture` filled, a scene file with checks, or a report
    #[arg(value_name = "DIR|FILE.toml|FILE.png")]
    dir: PathBuf,

    /// Judge only the physics
    #[arg(long)]
    physics_only: bool,

    /// Also write the result to FILE, as junit or json
    ///
    /// Give the option again for both. Replaces an older report, and no other file.
    #[arg(long, num_args = 2, value_names = ["FORMAT", "FILE"])]
    report: Option<Vec<String>>,

    /// The format of standard output: text or json
    #[arg(long, value_name = "FORMAT", default_value = "text", hide_possible_values = true)]
    #[arg(conflicts_with = "bless")]
    format: TableFormat,

    /// Draw the difference of each changed frame into DIR
    #[arg(long, value_name = "DIR", conflicts_with = "physics_only")]
    diff: Option<PathBuf>,

    /// The largest allowed difference of a channel, 0 to 255
    ///
    /// The default is 0. It is 2 for letters of another processor, and for a frame of a graphics device. In such a
    /// frame 1 pixel of 100 000 may differ by more.
    #[arg(long, value_name = "N")]
    max_channel: Option<u8>,

    /// The largest allowed percentage of pixels off by more than 1
    ///
    /// The default is 0, or 100 where that of --max-channel is 2.
    #[arg(long, value_name = "PERCENT", value_parser = percent)]
    max_pixels: Option<f64>,

    /// Accept the present results
    ///
    /// Replaces all frames, or all checks of a recording. The old frames stay until all new ones are drawn.
    #[arg(long, conflicts_with_all = ["physics_only", "report", "diff"])]
    bless: bool,
}

pub(super) fn run(args: &VerifyArgs) -> Result<(), Error> {
    let is_recording = is_scene_file(&args.dir);
    let of_captures = [
        ("--diff", args.diff.is_some()),
        ("--max-channel", args.max_channel.is_some()),
        ("--max-pixels", args.max_pixels.is_some()),
    ];
    let misplaced = of_captures.into_iter().find(|(_, is_given)| is_recording && *is_given);
    if let Some((option, _)) = misplaced {
        return Err(Error::mistake(format!(
            "{option} is for the frames of a capture, and a recording has none; leave it out"
        )));
    }
    let files = report_files(args)?;
    match (is_recording, args.bless) {
        (true, true) => return recording::bless(&args.dir),
        (false, true) => return clip::bless(&args.dir),
        _ => {}
    }
    let report =
        if is_recording { recording::judge(&args.dir, args.format) } else { clip::judge(args) }?;
    files.into_iter().try_for_each(|file| file.write(&report))?;
    report.outcome()
}

/// Whether `path` counts as a scene file. It does if it is a link, a file, or a missing path that ends in `.toml`.
fn is_scene_file(path: &Path) -> bool {
    super::scene_file::is_link(path)
        || !path.is_dir()
            && (path.exists() || path.extension().is_some_and(|ending| ending == "toml"))
}

/// Opens the files that `--report` names. A report may replace only an older report, and no file of a capture and not
/// the judged recording.
fn report_files(args: &VerifyArgs) -> Result<Vec<ReportFile>, Error> {
    let mut files: Vec<(ReportFormat, &Path)> = Vec::new();
    for words in args.report.as_deref().unwrap_or_default().chunks_exact(2) {
        let (format, path) = (&words[0], Path::new(&words[1]));
        let refused = |why| Err(Error::mistake(format!("{} {why}", brief(path))));
        let Ok(format) = ReportFormat::from_str(format, false) else {
            return Err(Error::mistake(format!(
                "no report format is called {:?}; give junit or json",
                brief(format.as_ref())
            )));
        };
        if files.iter().any(|(_, other)| same_file_path(other) == same_file_path(path)) {
            return Err(Error::mistake(format!(
                "two reports would go to {}; give each a file of its own",
                brief(path)
            )));
        }
        if is_of_a_capture(path, &args.dir) {
            return refused("is a file of a capture; give another --report");
        }
        files.push((format, path));
    }
    let judged = [(&*args.dir, "the recording that is judged")];
    let inputs = &judged[usize::from(!is_scene_file(&args.dir))..];
    files.into_iter().map(|(format, path)| ReportFile::open(format, path, inputs)).collect()
}

fn percent(written: &str) -> Result<f64, String> {
    number_that(written, |it| (0.0..=100.0).contains(&it), "a percentage from 0 to 100")
}

/// A repeated run: the studio at its end, and the log of its states.
struct Repeated {
    studio: Studio,
    state_log: StateLog,
    /// The first frame whose moment differs, with its tick, if no frame was drawn.
    moment: Option<(u64, String)>,
}

/// The frames of a repeated run.
struct Frames {
    /// Whether the frames must be the same to the byte.
    are_exact: bool,
    /// Difference of each frame from its file, or `None` if there is none.
    differences: Vec<Option<String>>,
}

impl CapturedRun {
    /// Returns the studio at the start of the run, and a log of the studio's states.
    fn begin(&self) -> (Studio, StateLog) {
        let studio = self.capture.prepare_studio(self.experiment.studio());
        let state_log = StateLog::new(self.capture.mark_every, studio.race());
        (studio, state_log)
    }

    /// Runs the studio through `frames` without drawing, or to an interrupt, after which it returns `None`.
    fn run(&self, frames: &[FrameEntry], interrupted: &AtomicBool) -> Option<Repeated> {
        let (mut studio, mut state_log) = self.begin();
        let mut moment = None;
        for (frame, entry) in (0..).zip(frames) {
            if interrupted.load(Ordering::Relaxed) {
                return None;
            }
            self.capture.schedule.advance(&mut studio, frame, &mut state_log);
            let (tick, alpha) = (studio.race().tick(), studio.clock().alpha_fraction());
            let other = || physics::other_moment(entry, tick, alpha);
            moment = moment.or_else(|| Some((tick, format!("{}: {}", entry.file, other()?))));
        }
        Some(Repeated { studio, state_log, moment })
    }
}
