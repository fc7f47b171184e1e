//! A scene file against its own checks: its race is run again, without a picture.

use std::path::{Path, PathBuf};

use serde_json::json;

use super::report::{JunitCase, junit, say};
use crate::commands::error::{Cause, Error};
use crate::commands::output::{Older, Place, write_text};
use crate::commands::scene_file;
use crate::commands::terminal::tell;
use crate::lab::{Check, Lab, Scene, Session};

/// Why a scene file does not pass.
#[derive(Debug, thiserror::Error)]
pub(super) enum CheckError {
    /// It was judged, and is not the same.
    #[error(
        "{lanes} lane{} of {} differ{}; if that is meant, --bless", if *lanes == 1 { "" } else { "s" },
        .path.display(), if *lanes == 1 { "s" } else { "" }
    )]
    Different {
        /// How many lanes.
        lanes: usize,
        /// The file.
        path: PathBuf,
    },
    /// An option that says how pictures are judged.
    #[error("{option} is for the frames of a capture, and a recording has none; leave it out")]
    OfCaptures {
        /// The option.
        option: &'static str,
    },
    /// A report would replace what is judged.
    #[error("{} is the recording that is judged; give another --report", .path.display())]
    ReportOverScene {
        /// The file.
        path: PathBuf,
    },
    /// It has nothing to be judged by.
    #[error("{} has no [[check]] to be judged by; --bless writes one for each second", .path.display())]
    NoChecks {
        /// The file.
        path: PathBuf,
    },
}

impl Cause for CheckError {
    fn exit_code(&self) -> u8 {
        match self {
            CheckError::Different { .. } => 1,
            CheckError::OfCaptures { .. }
            | CheckError::ReportOverScene { .. }
            | CheckError::NoChecks { .. } => 2,
        }
    }
}

/// What became of a lane.
#[derive(Clone, Debug, PartialEq)]
struct JudgedLane {
    /// From 1.
    number: usize,
    method: &'static str,
    checks: usize,
    last_tick: u64,
    difference: Option<Difference>,
}

/// The first check that fails.
#[derive(Clone, Debug, PartialEq)]
struct Difference {
    tick: u64,
    /// The simulated time then, in seconds.
    t: f64,
    was: u64,
    /// `None` where the lane has left the race.
    is: Option<u64>,
    /// The last check before it, which held.
    same_at: Option<u64>,
}

impl JudgedLane {
    fn line(&self) -> String {
        let Self { number, method, checks, last_tick, difference } = self;
        let outcome = match difference {
            None => {
                let plural = if *checks == 1 { "" } else { "s" };
                format!("same to the bit: {checks} check{plural} to tick {last_tick}")
            }
            Some(difference) => difference.line(),
        };
        format!("lane {number}, {method}: {outcome}")
    }
}

impl Difference {
    fn line(&self) -> String {
        let Self { tick, t, was, is, same_at } = self;
        let is = is.map_or("the lane has left the race".into(), |is| format!("{is:016x} now"));
        let since = match same_at {
            Some(same) if same + 1 == *tick => String::new(),
            Some(same) => {
                format!("; the first difference lies after tick {same}, the last that is the same")
            }
            None if *tick == 0 => String::new(),
            None => "; no check before it".into(),
        };
        format!("differs first at tick {tick} ({t} s): {was:016x} in the file, {is}{since}")
    }
}

/// Judges the scene file at `path`, and writes reports by `write`.
pub(super) fn judge(
    path: &Path,
    write: impl FnOnce(&Checked) -> Result<(), Error>,
) -> Result<(), Error> {
    let (scene, _) = scene_file::load(path)?;
    if scene.checks.is_empty() {
        return Err(CheckError::NoChecks { path: path.to_owned() }.into());
    }
    let checked = Checked { path: path.to_owned(), lanes: run(&scene) };
    for lane in &checked.lanes {
        say(&lane.line())?;
    }
    write(&checked)?;
    match checked.differing() {
        0 => Ok(()),
        lanes => Err(CheckError::Different { lanes, path: path.to_owned() }.into()),
    }
}

/// Writes the hashes of now into the checks of the file at `path`; where it has none, a check of each lane for each
/// second and for the end.
pub(super) fn bless(path: &Path) -> Result<(), Error> {
    let (scene, text) = scene_file::load(path)?;
    let mut session = Session::racing(scene.clone().into());
    let text = if scene.checks.is_empty() {
        let end = Lab::new(scene.clone()).nearest_tick(scene.seconds);
        let checks = session.recording(end).checks;
        let rows: String = checks.iter().map(Check::to_toml).collect();
        format!("{}\n{rows}", text.trim_end())
    } else {
        let mut order: Vec<usize> = (0..scene.checks.len()).collect();
        order.sort_by_key(|&row| scene.checks[row].tick);
        let mut hashes: Vec<u64> = scene.checks.iter().map(|check| check.hash).collect();
        for row in order {
            let check = scene.checks[row];
            session.run(check.tick - session.race().tick());
            hashes[row] = hash(&session, check.lane).unwrap_or(check.hash);
        }
        Scene::with_hashes(&text, &hashes)
    };
    write_text(Place { path, option: "FILE", older: Older::Replace }, &text)?;
    tell(&format!("blessed: {}", path.display()));
    Ok(())
}

fn hash(session: &Session, lane: usize) -> Option<u64> {
    let race = session.race();
    let place = race.entrants().iter().position(|entrant| entrant.lane_number == lane)?;
    race.lane_hashes().nth(place)
}

/// Runs the race of a scene past all its checks.
fn run(scene: &Scene) -> Vec<JudgedLane> {
    let mut session = Session::racing(scene.clone().into());
    let lanes = session.race().entrants().iter().map(|entrant| JudgedLane {
        number: entrant.lane_number,
        method: session.race().list()[entrant.entry].method.id,
        checks: 0,
        last_tick: 0,
        difference: None,
    });
    let mut lanes: Vec<JudgedLane> = lanes.collect();
    let mut checks = scene.checks.clone();
    checks.sort_by_key(|check| check.tick);
    for check in checks {
        session.run(check.tick - session.race().tick());
        let lane = &mut lanes[check.lane - 1];
        let is = hash(&session, check.lane);
        if lane.difference.is_none() && is != Some(check.hash) {
            let same_at = (lane.checks > 0).then_some(lane.last_tick);
            let t = session.race().t();
            lane.difference =
                Some(Difference { tick: check.tick, t, was: check.hash, is, same_at });
        }
        lane.checks += 1;
        lane.last_tick = check.tick;
    }
    lanes.retain(|lane| lane.checks > 0);
    lanes
}

/// What was found.
pub(super) struct Checked {
    path: PathBuf,
    lanes: Vec<JudgedLane>,
}

impl Checked {
    fn differing(&self) -> usize {
        self.lanes.iter().filter(|lane| lane.difference.is_some()).count()
    }

    /// As JSON, for programs.
    pub(super) fn to_json(&self) -> String {
        let lanes = self.lanes.iter().map(|lane| {
            let difference = lane.difference.as_ref().map(|difference| {
                json!({
                    "tick": difference.tick,
                    "t": difference.t,
                    "was": format!("{:016x}", difference.was),
                    "is": difference.is.map(|is| format!("{is:016x}")),
                    "same_at": difference.same_at,
                })
            });
            json!({
                "lane": lane.number,
                "method": lane.method,
                "same": difference.is_none(),
                "checks": lane.checks,
                "last_tick": lane.last_tick,
                "first_difference": difference,
            })
        });
        let report = json!({
            "file": self.path.display().to_string(),
            "same": self.differing() == 0,
            "lanes": lanes.collect::<Vec<_>>(),
        });
        format!("{report:#}\n")
    }

    /// As JUnit's XML, a test for each lane.
    pub(super) fn to_junit(&self) -> String {
        let case = |lane: &JudgedLane| JunitCase {
            name: format!("lane {}, {}", lane.number, lane.method),
            failure: lane.difference.as_ref().map(Difference::line),
        };
        let cases: Vec<_> = self.lanes.iter().map(case).collect();
        junit(&format!("regatta verify {}", self.path.display()), &cases)
    }
}
