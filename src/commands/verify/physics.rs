//! Compares the states of a run with the marks in a manifest.

use std::fmt::Display;

use serde_json::{Map, Value};

use super::super::manifest::{FrameEntry, LaneEnd, LaneMark, Manifest, Mark};
use super::super::state_log::{self, StateLog};
use crate::run::diff::is_same_number;
use crate::scene::clip;
use crate::studio::Studio;

/// The first mark of a run that differs from the manifest.
pub(super) struct PhysicsChange {
    pub(super) tick: u64,
    /// Number of the lane, from 1, and id of its method.
    pub(super) lane: Option<(usize, &'static str)>,
    pub(super) what: String,
}

/// Returns the first mark in which the run differs from the manifest, or else the first lane that ended differently.
/// The studio must be at the end of the run. `moment` is the first frame whose moment differs, with its tick.
pub(super) fn first_change(
    manifest: &Manifest,
    studio: &Studio,
    state_log: StateLog,
    moment: Option<(u64, String)>,
) -> Option<PhysicsChange> {
    let now = state_log.close(studio.race());
    let mut marks = manifest.marks.iter().zip(&now);
    marks
        .find_map(|(then, now)| change(then, now, studio))
        .or_else(|| other_length(&manifest.marks, &now))
        .or_else(|| other_end(&manifest.lanes, studio))
        .or_else(|| moment.map(|(tick, what)| PhysicsChange { tick, lane: None, what }))
}

/// Returns the first difference in how the lanes ended, if there is one.
fn other_end(then: &[LaneEnd], studio: &Studio) -> Option<PhysicsChange> {
    let tick = studio.race().tick();
    let now = state_log::ends(studio);
    if then.len() != now.len() {
        let what = format!("{} lanes at the end in the manifest, {} now", then.len(), now.len());
        return Some(PhysicsChange { tick, lane: None, what });
    }
    let halt =
        |end: &LaneEnd| end.halted.map_or("never".to_owned(), |tick| format!("at tick {tick}"));
    then.iter().zip(&now).zip(studio.race().entrants()).enumerate().find_map(
        |(n, ((then, now), entrant))| {
            let (key, was, is) = [
                ("method", then.method.clone(), now.method.clone()),
                ("substeps", then.substeps.to_string(), now.substeps.to_string()),
                ("hash", then.hash.clone(), now.hash.clone()),
                ("halt", halt(then), halt(now)),
            ]
            .into_iter()
            .map(|(key, was, is)| (key.to_owned(), was, is))
            .chain(body_values(then, now))
            .find(|(_, was, is)| was != is)?;
            let what = format!("its {key} at the end is {was} in the manifest and {is} now");
            let method = entrant.spec.method.id;
            Some(PhysicsChange { tick, lane: Some((n + 1, method)), what })
        },
    )
}

/// Returns the name, the halt and the metrics of each body at the end, with the value of the manifest and that of now.
fn body_values(then: &LaneEnd, now: &LaneEnd) -> Vec<(String, String, String)> {
    let count = then.bodies.len().max(now.bodies.len());
    let none = Map::new();
    let of = |n: usize| {
        let [then, now] = [then, now].map(|end| end.bodies.get(n).unwrap_or(&none));
        let keys = then.keys().chain(now.keys().filter(|key| !then.contains_key(*key)));
        let shown = |body: &Map<String, Value>, key: &str| {
            body.get(key).map_or("missing".to_owned(), |value| clip(&value.to_string()))
        };
        let values = keys.filter(|key| then.get(*key) != now.get(*key));
        let named = |key: &String| {
            (format!("bodies[{n}].{}", clip(key)), shown(then, key), shown(now, key))
        };
        values.map(named).collect::<Vec<_>>()
    };
    (0..count).flat_map(of).collect()
}

/// Describes how the moment of a frame differs from that in the manifest, if it does.
pub(super) fn other_moment(then: &FrameEntry, tick: u64, alpha: (u64, u64)) -> Option<String> {
    let is = [alpha.0, alpha.1];
    let said = |key, was: &dyn Display, is: &dyn Display| {
        Some(format!("its {key} is {was} in the manifest and {is} now"))
    };
    match (then.tick == tick, then.alpha == is) {
        (false, _) => said("tick", &then.tick, &tick),
        (_, false) => said("alpha", &format!("{:?}", then.alpha), &format!("{is:?}")),
        _ => None,
    }
}

/// Returns the first difference between two marks, if there is one.
fn change(then: &Mark, now: &Mark, studio: &Studio) -> Option<PhysicsChange> {
    if then.tick != now.tick || then.lanes.len() != now.lanes.len() {
        let what = format!(
            "{} lanes at tick {} in the manifest, {} at tick {} now",
            then.lanes.len(),
            then.tick,
            now.lanes.len(),
            now.tick
        );
        return Some(PhysicsChange { tick: then.tick.min(now.tick), lane: None, what });
    }
    let lanes = then.lanes.iter().zip(&now.lanes).enumerate();
    lanes
        .filter(|(_, (then, now))| !then.is_same(now))
        .map(|(n, (was, is))| {
            let entrant = &studio.race().entrants()[n];
            let method = entrant.spec.method.id;
            PhysicsChange {
                tick: then.tick,
                lane: Some((n + 1, method)),
                what: first_coordinate(was, is, studio, n),
            }
        })
        .next()
}

/// Describes the first coordinate or velocity of a lane that differs, and the size of the difference.
fn first_coordinate(then: &LaneMark, now: &LaneMark, studio: &Studio, lane: usize) -> String {
    let bodies = studio.race().entrants()[lane].lane.bodies();
    for (n, body) in bodies.iter().enumerate() {
        let values = |mark: &LaneMark| {
            let row = |rows: &[Vec<f64>]| rows.get(n).cloned().unwrap_or_default();
            row(&mark.q).into_iter().chain(row(&mark.v)).collect::<Vec<_>>()
        };
        let coordinates = body.coordinates();
        let names = coordinates.iter();
        let names = names.clone().map(|c| c.name).chain(names.map(|c| c.velocity));
        for ((name, was), is) in names.zip(values(then)).zip(values(now)) {
            if !is_same_number(was, is) {
                let body = &studio.scene().bodies[n].name;
                let off = (is - was).abs();
                return format!("{body}, {name}: {was} in the manifest, {is} now, off by {off:e}");
            }
        }
    }
    let (was, is) = (&then.hash, &now.hash);
    format!("every coordinate is the same, but the hash is {was} in the manifest and {is} now")
}

fn other_length(then: &[Mark], now: &[Mark]) -> Option<PhysicsChange> {
    let shorter = then.len().min(now.len());
    let first = then.get(shorter).or(now.get(shorter))?;
    let what = format!("{} marks in the manifest, {} now", then.len(), now.len());
    Some(PhysicsChange { tick: first.tick, lane: None, what })
}
