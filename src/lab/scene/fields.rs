//! The keys at the top level of a scene file, and the keys that several of its tables share.

use super::nearest::listed;
use super::table::{Field, Table};
use super::{MAX_SUBSTEPS, TOLERANCES};
use crate::lab::lane_spec::LaneSpec;
use crate::sim::bodies::Range;
use crate::sim::integrators::{METHODS, Method};

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
pub(super) const JOINT_HZ: Field = optional("joint_hz");
const JOINT_DAMPING_RATIO: Field = optional("joint_damping_ratio");

pub(super) const fn required(key: &'static str, about: &'static str) -> Field {
    Field { key, needed_as: Some(about) }
}

pub(super) const fn optional(key: &'static str) -> Field {
    Field { key, needed_as: None }
}

/// Reads what a lane of this method has beside it. Complains of what the method does not take.
pub(super) fn read_lane_spec(
    row: &mut Table<'_>,
    method: Option<&'static Method>,
) -> Option<LaneSpec> {
    let substeps = row.whole(SUBSTEPS, 1..=MAX_SUBSTEPS);
    let tolerance = read_tolerance(row, method);
    let joint = read_joint(row, method);
    let method = method?;
    let substeps = substeps.unwrap_or(method.default_substeps);
    Some(LaneSpec { method, substeps, tolerance, joint })
}

/// Reads the frequency and the damping ratio that an engine is told of springs.
fn read_joint(row: &mut Table<'_>, method: Option<&'static Method>) -> Option<[f64; 2]> {
    let [hz, damping_ratio] = LaneSpec::JOINT;
    let hz = row.number(JOINT_HZ, hz);
    let damping_ratio = row.number(JOINT_DAMPING_RATIO, damping_ratio);
    let given = [JOINT_HZ, JOINT_DAMPING_RATIO].into_iter().find(|field| row.has(field.key))?;
    if let Some(method) = method.filter(|method| !method.has_joint()) {
        let (key, id) = (given.key, method.id);
        let what = format!("`{key}` does not apply to the method {id:?}, which is told no spring");
        let remedy = format!("remove it, or choose an engine: {}", methods(Method::has_joint));
        row.complain(row.span(key), what, remedy);
    } else if !row.has(JOINT_HZ.key) {
        let (key, needed) = (JOINT_DAMPING_RATIO.key, JOINT_HZ.key);
        let remedy = format!("remove it, or write `{needed}` too");
        row.complain(row.span(key), format!("`{key}` stands alone"), remedy);
    }
    Some([hz?, damping_ratio.unwrap_or(0.0)])
}

/// Reads a tolerance. If the lane's method is known, reports one that takes none.
pub(super) fn read_tolerance(row: &mut Table<'_>, method: Option<&'static Method>) -> Option<f64> {
    let tolerance = row.number(TOLERANCE, Range::Between(TOLERANCES.0, TOLERANCES.1));
    if let (Some(method), true) = (method, row.has(TOLERANCE.key))
        && method.tolerance.is_none()
    {
        let (key, id) = (TOLERANCE.key, method.id);
        let remedy = format!("remove it, or choose an adaptive method: {}", adaptive_methods());
        row.complain(row.span(key), format!("`{key}` does not apply to the method {id:?}"), remedy);
    }
    tolerance
}

/// The ids of the methods that choose their own steps.
pub(super) fn adaptive_methods() -> String {
    methods(|method| method.tolerance.is_some())
}

fn methods(fits: fn(&Method) -> bool) -> String {
    let fitting = METHODS.iter().filter(|method| fits(method));
    listed(&fitting.map(|method| method.id).collect::<Vec<_>>(), '"', ", ")
}
