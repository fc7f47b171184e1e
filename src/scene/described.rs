//! Reads the bodies of a scene file, and checks whether the methods that the file names fit them.

use std::ops::Range as Span;
use std::sync::Arc;

use super::errors::position;
use super::law::{LAW, read_law};
use super::net::{NET, read_net};
use super::refusal::Refusal;
use super::table::Table;
use super::wanted::{Field, Wanted};
use super::{LaneSpec, MAX_BODIES, MAX_NAME_CHARS, SceneBody};
use crate::sim::bodies::{
    BODIES, ClaimHorizon, Kind, Net, Parameter, Range, by_key, incompatibility, kind,
};
use crate::sim::integrators::{METHODS, Method};

pub(super) const NAME: Field = Field::optional(
    "name",
    "its name, unique in the scene; by default that of its kind",
    Wanted::Text(MAX_NAME_CHARS),
);

/// A body as described in the file, even with faults.
pub(super) struct BodyDraft {
    /// Kind of the body; `None` for a law or a net with faults.
    pub(super) kind: Option<Arc<Kind>>,
    /// Name of the body's table array.
    id: &'static str,
    pub(super) name: Option<String>,
    /// Bytes of the name, or of the table's header if the body has no name.
    name_at: Span<usize>,
    pub(super) values: Option<Vec<f64>>,
}

/// Reads the bodies in the order of the file. Checks the claims of laws against their motion at the ticks of
/// `horizon`.
pub(super) fn read_bodies(top: &mut Table<'_>, horizon: ClaimHorizon) -> Vec<BodyDraft> {
    let mut rows: Vec<(&'static str, Table<'_>)> = Vec::new();
    for id in BODIES.iter().map(|kind| kind.id).chain([LAW, NET]) {
        rows.extend(top.rows(id).into_iter().map(|row| (id, row)));
    }
    rows.sort_by_key(|(_, row)| row.header.start);
    if let Some((_, row)) = rows.get(MAX_BODIES) {
        let what = format!("the scene has {} bodies", rows.len());
        top.report_fault(row.header.clone(), what, format!("keep at most {MAX_BODIES}"));
    }
    let mut bodies = Vec::new();
    for (id, mut row) in rows.into_iter().take(MAX_BODIES) {
        let name = row.text(&NAME);
        let name_at = row.span(NAME.key);
        let (kind, values) = match kind(id) {
            Some(kind) => (Some(kind.clone()), read_values(&kind.parameters, &mut row)),
            None if id == NET => {
                let values = read_values(Net::descriptions(), &mut row);
                (read_net(&mut row), values)
            }
            None => read_law(&mut row, horizon),
        };
        if let (Some(kind), Some(values)) = (&kind, &values)
            && let Err(fault) = (kind.check)(values)
            && kind.law().is_none()
        {
            row.add_fault(row.span(&fault.key), fault.into());
        }
        bodies.push(BodyDraft { kind, id, name, name_at, values });
        top.add_faults_of(row);
    }
    bodies
}

/// Returns the key of a parameter, or of a list of several.
pub(super) fn field_of(group: &'static [Parameter]) -> Field {
    let Parameter { key, about, default, range, list, .. } = &group[0];
    let wanted = if list.is_some() { Wanted::Numbers(group.len()) } else { Wanted::of(*range) };
    Field { key: list.unwrap_or(key), is_required: default.is_none(), about, wanted }
}

fn read_values(parameters: &'static [Parameter], row: &mut Table<'_>) -> Option<Vec<f64>> {
    let read = |group: &'static [Parameter]| {
        let Parameter { default, range, list, .. } = &group[0];
        let field = field_of(group);
        if list.is_some() {
            let defaults = || group.iter().map(|parameter| parameter.default).collect();
            return row.numbers(&field, *range).or_else(defaults);
        }
        let given = match range {
            Range::Curve { .. } => row.curve(&field).map(|points| points.concat()),
            Range::Count(_) => row.whole::<u32>(&field).map(|count| vec![f64::from(count)]),
            _ => row.number(&field).map(|number| vec![number]),
        };
        given.or(default.map(|number| vec![number]))
    };
    // All values are read before a missing one ends the body, so that every fault is found.
    let values: Vec<_> = by_key(parameters).map(read).collect();
    Some(values.into_iter().collect::<Option<Vec<_>>>()?.concat())
}

/// Reports names that several bodies share.
pub(super) fn check_names(text: &str, bodies: &[BodyDraft], top: &mut Table<'_>) {
    for (n, body) in bodies.iter().enumerate() {
        let Some(name) = &body.name else { continue };
        if let Some(first) = bodies[..n].iter().find(|earlier| earlier.name == body.name) {
            let (line, _) = position(text, first.name_at.start);
            let what = format!("the name {name:?} is taken by the body on line {line}");
            top.report_fault(body.name_at.clone(), what, "give it another");
        }
    }
}

/// Names unnamed bodies after their kind, with a number if the kind has several bodies.
pub(super) fn name_the_nameless(bodies: &mut [BodyDraft]) {
    let mut taken: Vec<String> = bodies.iter().filter_map(|body| body.name.clone()).collect();
    let ids: Vec<_> = bodies.iter().map(|body| body.id).collect();
    for (BodyDraft { name, .. }, id) in bodies.iter_mut().zip(&ids) {
        let is_alone = ids.iter().filter(|other| *other == id).count() == 1;
        let name = name.get_or_insert_with(|| {
            let plain = is_alone.then(|| (*id).to_owned());
            let numbered = (1..).map(|number| format!("{id}-{number}"));
            let free = plain.into_iter().chain(numbered).find(|name| !taken.contains(name));
            free.expect("there is always a next number")
        });
        taken.push(name.clone());
    }
}

/// Returns the bodies with all their parameters.
pub(super) fn complete_bodies(bodies: Vec<BodyDraft>) -> Vec<SceneBody> {
    let finish = |BodyDraft { kind, name, values, .. }| {
        Some(SceneBody::new(name.expect("each has one by now"), kind?, values?))
    };
    bodies.into_iter().filter_map(finish).collect()
}

/// Reports the method of `key` at `span` if the method refuses a body.
pub(super) fn check_method(
    key: &'static str,
    method: &'static Method,
    span: Span<usize>,
    bodies: &[BodyDraft],
    table: &mut Table<'_>,
) {
    let refused = bodies.iter().find_map(|BodyDraft { kind, name, values, .. }| {
        let kind = kind.as_ref()?;
        let reason = incompatibility(method, kind, values.as_ref()?)?;
        let body = name.clone().unwrap_or_else(|| kind.id.into());
        Some(Refusal { method: method.id, body, reason })
    });
    if let Some(refusal) = refused {
        let remedy =
            "name another method, or change the body; `regatta list methods` has what each is for";
        table.report_fault(span, format!("`{key}`: {refusal}"), remedy);
    }
}

/// Returns a plain lane for each [method for games](Method::is_for_games) that steps all of these bodies.
pub(super) fn every_lane(bodies: &[BodyDraft], own: &[&'static Method]) -> Vec<LaneSpec> {
    let steps = |method: &Method, body: &BodyDraft| {
        let known = body.kind.as_ref().zip(body.values.as_ref());
        known.is_none_or(|(kind, values)| incompatibility(method, kind, values).is_none())
    };
    let all = METHODS.iter().chain(own.iter().copied()).filter(|method| method.is_for_games());
    let fitting = all.filter(|method| bodies.iter().all(|body| steps(method, body)));
    fitting.map(LaneSpec::plain).collect()
}
