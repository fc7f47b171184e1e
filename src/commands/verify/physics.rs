//! Compares the states of a repeated run with those in a manifest.

use std::fmt::Display;

use serde_json::Value;

use crate::commands::manifest::FrameEntry;
use crate::commands::settings::CapturedRun;
use crate::commands::state_log::{self, StateLog};
use crate::scene::{Check, clip};
use crate::studio::Studio;

/// The first state of a run that differs from the manifest.
pub(super) struct PhysicsChange {
    pub(super) tick: u64,
    /// Number of the lane, from 1, and id of its method.
    pub(super) lane: Option<(usize, &'static str)>,
    pub(super) what: String,
}

/// Returns the first state in which the run differs from the manifest, or else the first lane that ended differently
/// from `then`. The studio must be at the end of the run. `moment` is the first frame whose moment differs, with its
/// tick.
pub(super) fn first_change(
    rerun: &CapturedRun,
    then: &[Value],
    studio: &Studio,
    state_log: StateLog,
    moment: Option<(u64, String)>,
) -> Option<PhysicsChange> {
    let lanes = &rerun.experiment.scene.lanes;
    let reached = state_log.close(studio.race());
    let place = |check: &Check| (check.tick, check.lane);
    let state = |&Check { tick, lane, hash }: &Check| {
        let now = reached.binary_search_by_key(&(tick, lane), place);
        let is = now.map_or("none".to_owned(), |at| format!("{:016x}", reached[at].hash));
        let was = format!("{hash:016x}");
        (was != is).then(|| PhysicsChange {
            tick,
            lane: lanes.get(lane.index()).map(|spec| (lane.0, spec.method.id)),
            what: said("state", &was, &is),
        })
    };
    let (tick, now) = (studio.race().tick(), state_log::ends(studio));
    let end = |n: usize| {
        let of = |ends: &[Value]| ends.get(n).cloned().unwrap_or_default();
        let (key, was, is) = difference(&of(then), &of(&now))?;
        let entrant = studio.race().entrants().get(n);
        let lane = entrant.map(|entrant| (entrant.id.0, entrant.spec.method.id));
        let key = format!("{}{key} at the end", if key.is_empty() { "lane" } else { "" });
        Some(PhysicsChange { tick, lane, what: said(&key, &was, &is) })
    };
    let moment = moment.map(|(tick, what)| PhysicsChange { tick, lane: None, what });
    let state = rerun.checks.iter().find_map(state);
    state.or_else(|| (0..then.len().max(now.len())).find_map(end)).or(moment)
}

fn said(key: &str, was: &dyn Display, is: &dyn Display) -> String {
    format!("its {key} is {was} in the manifest and {is} now")
}

/// Returns the path of the first value that differs, and both values. What is missing counts as null.
fn difference(was: &Value, is: &Value) -> Option<(String, String, String)> {
    let within = |head: String, was: Option<&Value>, is: Option<&Value>| {
        let of = |value: Option<&Value>| value.cloned().unwrap_or_default();
        let (path, was, is) = difference(&of(was), &of(is))?;
        let dot = if path.is_empty() || path.starts_with('[') { "" } else { "." };
        Some((format!("{head}{dot}{path}"), was, is))
    };
    match (was, is) {
        (Value::Object(a), Value::Object(b)) => {
            a.keys().chain(b.keys()).find_map(|key| within(clip(key), a.get(key), b.get(key)))
        }
        (Value::Array(a), Value::Array(b)) => {
            (0..a.len().max(b.len())).find_map(|n| within(format!("[{n}]"), a.get(n), b.get(n)))
        }
        _ => {
            let shown =
                |value: &Value| clip(&value.as_str().map_or(value.to_string(), str::to_owned));
            (was != is).then(|| (String::new(), shown(was), shown(is)))
        }
    }
}

/// Describes how the moment of a frame differs from that in the manifest, if it does.
pub(super) fn other_moment(then: &FrameEntry, tick: u64, alpha: (u64, u64)) -> Option<String> {
    let is = [alpha.0, alpha.1];
    match (then.tick == tick, then.alpha == is) {
        (false, _) => Some(said("tick", &then.tick, &tick)),
        (_, false) => Some(said("alpha", &format!("{:?}", then.alpha), &format!("{is:?}"))),
        _ => None,
    }
}
