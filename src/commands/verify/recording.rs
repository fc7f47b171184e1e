//! Judges a scene file by its own checks. Its race is run again without graphics, and hashes are compared.

use std::fmt::Display;
use std::path::Path;

use serde_json::{Value, json};

use super::report::{FILE, Report};
use crate::atomic_file::IfExists;
use crate::commands::error::Error;
use crate::commands::interrupt::watch_for_interrupt;
use crate::commands::output::Destination;
use crate::commands::output::table::TableFormat;
use crate::commands::terminal::print_status;
use crate::commands::{jobs, scene_file};
use crate::run::race::{Observer, PerformedAction, Race};
use crate::run::trace::last_tick;
use crate::run::{Reached, Replay, Session};
use crate::scene::{Check, Scene};
use crate::sim::number::counted;
use crate::studio::Studio;

/// Maximum number of ticks of a race that is run for its checks. It is over a day at 1000 Hz, which takes minutes for a
/// body.
const MAX_TICKS: u64 = 100_000_000;

/// Number of ticks of a race above which its length is reported before it runs.
const LONG_TICKS: u64 = 1_000_000;

/// The verdict on a lane.
#[derive(Clone, Debug, PartialEq)]
struct JudgedLane {
    /// Number of the lane, from 1.
    number: usize,
    /// Ids of the methods of the lane, in the order of their use.
    methods: Vec<&'static str>,
    checks: usize,
    last_tick: u64,
    difference: Option<Difference>,
    /// Tick of the first check that names the lane although the lane has left the race.
    left_at: Option<u64>,
}

/// The first check that fails.
#[derive(Clone, Debug, PartialEq)]
struct Difference {
    tick: u64,
    /// Simulated time of the check, in seconds.
    t: f64,
    was: u64,
    /// The hash now, or `None` if the lane has left the race.
    is: Option<u64>,
    /// Tick of the last check before this one, which still holds.
    same_at: Option<u64>,
}

impl JudgedLane {
    /// Returns the number and the methods of the lane, such as `lane 2, rk4 then midpoint`.
    fn name(&self) -> String {
        let methods = match &self.methods[..] {
            [first, between @ .., last] if between.len() > 1 => {
                format!("{first} then {} others then {last}", between.len())
            }
            methods => methods.join(" then "),
        };
        format!("lane {}, {methods}", self.number)
    }

    fn line(&self) -> String {
        let Self { checks, last_tick, difference, .. } = self;
        let outcome = match difference {
            None => {
                format!("same to the bit: {} to tick {last_tick}", counted(*checks, "check"))
            }
            Some(difference) => difference.line(),
        };
        format!("{}: {outcome}", self.name())
    }

    fn object(&self) -> Value {
        let difference = self.difference.as_ref().map(|difference| {
            json!({
                "tick": difference.tick,
                "t": difference.t,
                "was": format!("{:016x}", difference.was),
                "is": difference.is.map(|is| format!("{is:016x}")),
                "same_at": difference.same_at,
            })
        });
        json!({
            "lane": self.number,
            "methods": self.methods,
            "same": difference.is_none(),
            "checks": self.checks,
            "last_tick": self.last_tick,
            "first_difference": difference,
        })
    }
}

impl Difference {
    fn line(&self) -> String {
        let Self { tick, t, was, is, same_at } = self;
        let is = is.map_or("the lane has left the race".into(), |is| format!("{is:016x} now"));
        let since = match same_at {
            Some(same) if same + 1 == *tick => String::new(),
            Some(same) => format!("; the last check that holds is at tick {same}"),
            None if *tick == 0 => String::new(),
            None => "; no check before it".into(),
        };
        format!("differs first at tick {tick} ({t} s): {was:016x} in the file, {is}{since}")
    }
}

pub(super) fn judge(path: &Path, format: TableFormat) -> Result<Report, Error> {
    let (scene, _) = scene_file::load(path)?;
    if scene.checks.is_empty() {
        return Err(Error::mistake(format!(
            "{} has no [[check]] to be judged by; --bless writes one for each second and the end, or fewer if the scene is long",
            scene_file::name_in_messages(path)
        )));
    }
    check_ticks(path, &scene)?;
    let judged = jobs::result(&watch_for_interrupt(), move || compare(&scene));
    let lanes = judged.ok_or_else(Error::nothing_written)?;
    let mut report = Report::new(FILE, path, format);
    for lane in &lanes {
        report.say(&lane.line())?;
        report.judged(lane.name(), lane.difference.as_ref().map(Difference::line));
    }
    report.field("lanes", lanes.iter().map(JudgedLane::object).collect());
    let (shown, count) = (scene_file::name_in_messages(path), report.differing());
    let differ = match count {
        1 => format!("1 lane of {shown} differs"),
        _ => format!("{count} lanes of {shown} differ"),
    };
    let remedy = match lanes.iter().find_map(|lane| Some((lane.number, lane.left_at?))) {
        None if scene_file::is_link(path) => {
            "the run differs from the one where it was made".to_owned()
        }
        None => "if that is meant, --bless".to_owned(),
        Some((lane, tick)) => of_no_lane(path, lane, tick),
    };
    report.if_different(format!("{differ}; {remedy}"));
    Ok(report)
}

/// Returns the message about a check that no run can meet and that `--bless` cannot mend.
fn of_no_lane(path: &Path, lane: impl Display, tick: u64) -> String {
    format!(
        "lane {lane} of {} has left the race at tick {tick}, where a [[check]] names it; \
         take that check out, or the `solo` that removes the lane",
        scene_file::name_in_messages(path)
    )
}

/// Fails if a check is later than the last tick to which a race may run.
pub(in crate::commands) fn refuse_late_checks(path: &Path, scene: &Scene) -> Result<(), Error> {
    let last = scene.checks.iter().map(|check| check.tick).max();
    match last.filter(|tick| *tick > MAX_TICKS) {
        None => Ok(()),
        Some(tick) => Err(Error::mistake(format!(
            "{} has a [[check]] at tick {tick}, and verify runs {MAX_TICKS} ticks at most; take it out",
            scene_file::name_in_messages(path)
        ))),
    }
}

/// Returns the tick at which the run of a scene is over, which is that of its end or of its last check. Fails if the
/// run would take too long.
pub(in crate::commands) fn end_of(path: &Path, scene: &Scene) -> Result<u64, Error> {
    refuse_late_checks(path, scene)?;
    let last = last_tick(scene);
    match last <= MAX_TICKS {
        true => Ok(last),
        false => Err(Error::mistake(format!(
            "{} runs for {last} ticks, and verify runs {MAX_TICKS} at most; lower its seconds, or its tick_hz",
            scene_file::name_in_messages(path)
        ))),
    }
}

/// Reports checks that are later than the scene's end. They are judged too, which can take longer than the scene. Fails
/// if that would take too long.
fn check_ticks(path: &Path, scene: &Scene) -> Result<(), Error> {
    refuse_late_checks(path, scene)?;
    let last = scene.checks.iter().map(|check| check.tick).max().unwrap_or(0);
    if last > LONG_TICKS {
        print_status(&format!(
            "the race runs {last} ticks, which can take minutes; Ctrl-C ends it"
        ));
    }
    let end = Studio::new(scene.clone()).race().nearest_tick(scene.seconds);
    let late = scene.checks.iter().map(|check| check.tick).filter(|tick| *tick > end);
    let Some(last) = late.clone().max() else { return Ok(()) };
    let (are, count) = match late.count() {
        1 => ("check lies", 1),
        count => ("checks lie", count),
    };
    print_status(&format!(
        "{count} {are} beyond the end of {} at tick {end} ({} s); the race runs on to tick {last}",
        scene_file::name_in_messages(path),
        scene.seconds
    ));
    Ok(())
}

/// Replaces the hashes in the checks of the file at `path` by those of a new run. A file that has no checks gets those
/// of a [recording](Session::recording). They cover each lane at every second, or less often in a long run, and at the
/// end.
pub(super) fn bless(path: &Path) -> Result<(), Error> {
    if scene_file::is_link(path) {
        return Err(Error::mistake(
            "a link is not blessed; bless its recording, and print the link again",
        ));
    }
    if scene_file::has_picture_ending(path) {
        return Err(Error::mistake(
            "a report is not blessed: it shows how the run was; make another by `regatta report`",
        ));
    }
    let (scene, text) = scene_file::load(path)?;
    let text = if scene.checks.is_empty() {
        let rows: String = checks_of(path, &scene)?.iter().map(Check::to_toml).collect();
        with_line_ends_of(&text, &format!("{}\n{rows}", text.trim_end()))
    } else {
        let mut hashes: Vec<u64> = scene.checks.iter().map(|check| check.hash).collect();
        check_ticks(path, &scene)?;
        for Reached { row, hash, .. } in replay(&scene, &mut ()) {
            let Check { tick, lane, .. } = scene.checks[row];
            hashes[row] = hash.ok_or_else(|| {
                Error::mistake(format!("not blessed: {}", of_no_lane(path, lane, tick)))
            })?;
        }
        Scene::with_hashes(&text, &hashes)
    };
    Destination { path, option: "FILE", if_exists: IfExists::Replace, inputs: &[] }.write(&text)?;
    print_status(&format!("blessed: {}", path.display()));
    Ok(())
}

/// Returns checks for a scene that has none. They cover every lane once a second and at the end.
fn checks_of(path: &Path, scene: &Scene) -> Result<Vec<Check>, Error> {
    let last = end_of(path, scene)?;
    Ok(Session::racing(scene.clone().into()).recording(last).checks)
}

/// Returns the text with CRLF at the end of every line if the first line of `before` ends so, or else the unchanged
/// text.
fn with_line_ends_of(before: &str, text: &str) -> String {
    match before.lines().next().is_some_and(|first| before[first.len()..].starts_with("\r\n")) {
        true => text.replace("\r\n", "\n").replace('\n', "\r\n"),
        false => text.to_owned(),
    }
}

/// Ids of the methods that each lane has had, by the number of the lane.
struct MethodsSeen(Vec<Vec<&'static str>>);

impl MethodsSeen {
    fn record_methods(&mut self, race: &Race) {
        for entrant in race.entrants() {
            let seen = &mut self.0[entrant.id.index()];
            let method = entrant.lane.solver().method().map(|method| method.id);
            seen.extend(method.filter(|id| seen.last() != Some(id)));
        }
    }
}

impl Observer for MethodsSeen {
    fn after(&mut self, race: &Race, _: &PerformedAction) {
        self.record_methods(race);
    }
}

/// Runs the race of a scene past all its checks, in the order of their ticks.
fn replay(scene: &Scene, observer: &mut dyn Observer) -> Vec<Reached> {
    let mut replay = Replay::new(scene.clone().into());
    std::iter::from_fn(|| replay.run_to_next_check(u64::MAX, observer)).collect()
}

/// Runs the race of a scene, and compares every lane with its checks.
fn compare(scene: &Scene) -> Vec<JudgedLane> {
    let mut methods = MethodsSeen(vec![Vec::new(); scene.lanes.len()]);
    methods.record_methods(&Race::of_scene(scene));
    let all_reached = replay(scene, &mut methods);
    let lanes = methods.0.into_iter().zip(1..).map(|(methods, number)| JudgedLane {
        number,
        methods,
        checks: 0,
        last_tick: 0,
        difference: None,
        left_at: None,
    });
    let mut lanes: Vec<JudgedLane> = lanes.collect();
    for Reached { row, t, hash: is } in all_reached {
        let Check { tick, lane, hash: was } = scene.checks[row];
        let lane = &mut lanes[lane.index()];
        if lane.difference.is_none() && is != Some(was) {
            let same_at = (lane.checks > 0).then_some(lane.last_tick);
            lane.difference = Some(Difference { tick, t, was, is, same_at });
        }
        lane.left_at = lane.left_at.or(is.is_none().then_some(tick));
        lane.checks += 1;
        lane.last_tick = tick;
    }
    lanes.retain(|lane| lane.checks > 0);
    lanes
}
