//! Holds the methods that a scene file names against its bodies.

use std::ops::Range as Span;

use super::described::BodyDraft;
use super::refusal::Refusal;
use super::table::Table;
use crate::scene::LaneSpec;
use crate::sim::bodies::incompatibility;
use crate::sim::integrators::{METHODS, Method};

/// Reports the method of `key` at `span` if it refuses a body.
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
        table.complain(span, format!("`{key}`: {refusal}"), remedy);
    }
}

/// A plain lane for each [method for games](Method::is_for_games) that steps all of these bodies.
pub(super) fn every_lane(bodies: &[BodyDraft]) -> Vec<LaneSpec> {
    let steps = |method: &Method, body: &BodyDraft| {
        let known = body.kind.as_ref().zip(body.values.as_ref());
        known.is_none_or(|(kind, values)| incompatibility(method, kind, values).is_none())
    };
    let own = METHODS.iter().filter(|method| method.is_for_games());
    let fitting = own.filter(|method| bodies.iter().all(|body| steps(method, body)));
    fitting.map(LaneSpec::plain).collect()
}
