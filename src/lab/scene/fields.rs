//! The keys at the top level of a scene file, and the keys that several of its tables share.

use super::TOLERANCES;
use super::cause::Cause;
use super::table::{Field, Table};
use crate::sim::bodies::Range;
use crate::sim::integrators::Method;

pub(super) const TITLE: Field = required("title", "the scene's name for people");
pub(super) const ABOUT: Field = optional("about");
pub(super) const HINT: Field = optional("hint");
pub(super) const TICK_HZ: Field = required("tick_hz", "ticks per second");
pub(super) const SECONDS: Field = optional("seconds");
pub(super) const METHOD_LIST: Field = optional("methods");
pub(super) const OPENING_METHOD: Field = optional("method");
pub(super) const TOP: [Field; 7] =
    [TITLE, ABOUT, HINT, TICK_HZ, SECONDS, METHOD_LIST, OPENING_METHOD];

pub(super) const SUBSTEPS: Field = optional("substeps");
pub(super) const TOLERANCE: Field = optional("tolerance");

pub(super) const fn required(key: &'static str, about: &'static str) -> Field {
    Field { key, needed_as: Some(about) }
}

pub(super) const fn optional(key: &'static str) -> Field {
    Field { key, needed_as: None }
}

/// Reads a tolerance. If the lane's method is known, reports one that takes none.
pub(super) fn read_tolerance(row: &mut Table<'_>, method: Option<&'static Method>) -> Option<f64> {
    let tolerance = row.number(TOLERANCE, Range::Between(TOLERANCES.0, TOLERANCES.1));
    if let (Some(method), true) = (method, row.has(TOLERANCE.key))
        && method.tolerance.is_none()
    {
        let cause = Cause::NoTolerance { key: TOLERANCE.key, method: method.id };
        row.complain(row.span(TOLERANCE.key), cause);
    }
    tolerance
}
