//! The commands `set`, `place` and `push`, which change one body.

use super::{NAME, SceneContext, inline};
use crate::clip::clip;
use crate::described::BodyDraft;
use crate::edit::edited_values;
use crate::keys::{numbers, quoted};
use crate::nearest::{listed, nearest, offer};
use crate::sim::bodies::{Parameter, Range, TakesEffect};
use crate::table::Table;
use crate::wanted::{Field, Wanted};
use crate::{Action, Scene};

pub(super) const BODY: Field = Field::required("body", "the body's name", NAME);
pub(super) const KEY: Field = Field::required("key", "the parameter's key", NAME);
pub(super) const VALUE: Field = Field::required("value", "its new value", Wanted::ANY);
pub(super) const Q: Field = Field::required("q", "the coordinates", Wanted::Numbers(1));
pub(super) const V: Field = Field::required("v", "the velocities", Wanted::Numbers(1));
pub(super) const BY: Field =
    Field::required("by", "the changes of the velocities, tick after tick", Wanted::Numbers(1));
pub(super) const TICKS: Field = Field::optional(
    "ticks",
    "the number of ticks of a pull, of which each has its changes",
    Wanted::Whole(1..=MAX_PULL_TICKS as u64),
);
/// The largest number of ticks of one `push`; a longer pull has several.
pub(super) const MAX_PULL_TICKS: usize = 10_000;

/// The keys of `set`, `place` and `push`.
pub(crate) static OF_A_BODY: [(&str, &[Field]); 3] =
    [("set", &[BODY, KEY, VALUE]), ("place", &[BODY, Q, V]), ("push", &[BODY, BY, TICKS])];

/// Returns the value of `push` for a pull of this many ticks.
pub(super) fn pull(scene: &Scene, body: usize, by: &[f64], ticks: usize) -> String {
    let mut entries = vec![(BODY, quoted(&scene.bodies[body].name)), (BY, numbers(by))];
    if ticks > 1 {
        entries.push((TICKS, ticks.to_string()));
    }
    inline(&entries)
}

/// Reads the name of a body, and returns the body with its index in the scene.
fn read_body<'d>(
    context: &SceneContext<'d>,
    table: &mut Table<'_>,
) -> Option<(usize, &'d BodyDraft)> {
    let name = table.text(&BODY)?;
    let is_called = |body: &BodyDraft| body.name.as_ref() == Some(&name);
    let Some(index) = context.bodies.iter().position(is_called) else {
        let known = context.bodies.iter().filter_map(|body| body.name.as_deref());
        let remedy = format!("write one of {}", listed(&known.collect::<Vec<_>>(), '"', ", "));
        let what = format!("no body of this scene is called {:?}", clip(&name));
        table.report_fault(table.span(BODY.key), what, remedy);
        return None;
    };
    Some((index, &context.bodies[index]))
}

pub(super) fn read_set(context: &SceneContext<'_>, set: &mut Table<'_>) -> Option<Action> {
    let body = read_body(context, set);
    let key = set.text(&KEY);
    set.allow_key(VALUE.key);
    let (index, BodyDraft { kind, values, .. }) = body?;
    let (key, kind) = (key?, kind.as_ref()?);
    let Some((parameter, Parameter { key: known, range, acts, .. })) = kind.parameter(&key) else {
        let known: Vec<&str> = kind.parameters.iter().map(|parameter| &*parameter.key).collect();
        let nearest = nearest(&key, known.iter().map(|name| (*name, *name)));
        let what = format!("{:?} is no parameter of this body", clip(&key));
        set.report_fault(set.span(KEY.key), what, offer(nearest, &known, '"'));
        return None;
    };
    if *acts == TakesEffect::AtStart {
        let at_once =
            kind.parameters.iter().filter(|parameter| parameter.acts == TakesEffect::AtOnce);
        let settable: Vec<&str> = at_once.map(|parameter| &*parameter.key).collect();
        let remedy = format!(
            "write it in the body's table, move the body by `place`, or set one of {}",
            listed(&settable, '"', ", ")
        );
        let what = format!("`{known}` acts at the start only, and a command comes later");
        set.report_fault(set.span(KEY.key), what, remedy);
        return None;
    }
    let field = Field { wanted: Wanted::of(*range), ..VALUE };
    let value = match *range {
        Range::Count(_) => f64::from(set.whole::<u32>(&field)?),
        _ => set.number(&field)?,
    };
    // The other values are those of the body's table, even if an earlier command has changed them.
    if let Some(values) = values
        && let Err(error) = edited_values(kind, values, parameter, value)
        && let Some(fault) = error.fault()
    {
        set.add_fault(set.span(VALUE.key), fault.into());
    }
    Some(Action::Set { body: index, parameter, value })
}

pub(super) fn read_place(context: &SceneContext<'_>, place: &mut Table<'_>) -> Option<Action> {
    let body = read_body(context, place);
    [Q, V].iter().for_each(|field| place.allow_key(field.key));
    let (at, draft) = body?;
    let count = coordinates(draft)?;
    let mut read = |field| place.coordinates(&Field { wanted: Wanted::Numbers(count), ..field });
    let (q, v) = (read(Q), read(V));
    Some(Action::Place { body: at, q: q?.into(), v: v?.into() })
}

pub(super) fn read_push(context: &SceneContext<'_>, push: &mut Table<'_>) -> Option<Action> {
    let body = read_body(context, push);
    [BY, TICKS].iter().for_each(|field| push.allow_key(field.key));
    let ticks = if push.has(TICKS.key) { push.whole(&TICKS)? } else { 1 };
    let (at, draft) = body?;
    let count = coordinates(draft)? * ticks;
    let by = push.coordinates(&Field { wanted: Wanted::Numbers(count), ..BY })?;
    Some(Action::Push { body: at, by: by.into() })
}

/// Returns the number of coordinates of a body, if it could be read.
fn coordinates(BodyDraft { kind, values, .. }: &BodyDraft) -> Option<usize> {
    Some(kind.as_ref()?.coordinates(values.as_ref()?).len())
}

/// Returns the action of each tick that a command takes: a pull has many.
pub(super) fn on_each_tick(context: &SceneContext<'_>, action: Action) -> Vec<Action> {
    match action {
        Action::Push { body, by } => {
            let count = coordinates(&context.bodies[body]).unwrap_or(by.len()).max(1);
            by.chunks(count).map(|by| Action::Push { body, by: by.into() }).collect()
        }
        action => vec![action],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Check, LaneId, Scripted};

    /// The commands of a recording of the orbit with these pushes.
    fn recording(pushes: impl IntoIterator<Item = (u64, [f64; 2])>) -> Scene {
        let mut scene = Scene::built_in("orbit").unwrap();
        let push = |(tick, by): (u64, [f64; 2])| (tick, Action::Push { body: 0, by: by.into() });
        let first = (5, Action::Kick(1.0));
        let rows = [first].into_iter().chain(pushes.into_iter().map(push));
        scene.script = Scripted::of_ticks(scene.tick_hz, rows);
        scene.checks = vec![Check { tick: 90, lane: LaneId(1), hash: 7 }];
        scene
    }

    #[test]
    fn a_pull_of_a_recording_is_one_command_and_is_read_as_it_was() {
        let parts = |tick: u64| [0.1 * tick as f64, -1.0 / tick as f64];
        let pull = (10..50).chain(60..62).map(|tick| (tick, parts(tick)));
        let scene = recording(pull);
        let text = scene.to_toml();
        assert_eq!(text.matches("[[command]]").count(), 3, "{text}");
        assert!(text.contains("ticks = 40 }") && text.contains("ticks = 2 }"), "{text}");
        let read = Scene::parse("run.toml", &text).unwrap();
        assert_eq!(read.script, scene.script);
        assert_eq!(read.to_toml(), text);
        let one = recording([(7, [0.5, 0.25])]).to_toml();
        assert!(one.contains("by = [0.5, 0.25] }") && !one.contains("ticks"), "{one}");
    }

    #[test]
    fn a_pull_without_a_change_for_each_tick_is_refused() {
        let text = recording((10..13).map(|tick| (tick, [0.5, 0.25]))).to_toml();
        for (ticks, what) in [("4", "8 numbers"), ("0", "1 to"), ("99999", "1 to")] {
            let wrong = text.replace("ticks = 3", &format!("ticks = {ticks}"));
            let said = Scene::parse("run.toml", &wrong).unwrap_err().to_string();
            assert!(said.contains(what), "{said}");
        }
    }
}
