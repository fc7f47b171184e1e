//! Keys of a scene file, each with its reader and its writer. Among them are the keys of a lane.

use super::nearest::listed;
use super::table::Table;
use super::wanted::{Field, Wanted};
use super::{MAX_SUBSTEPS, TOLERANCES};
use crate::sim::bodies::Range;
use crate::sim::integrators::{METHODS, Method};
use crate::sim::{Impact, TickRate};
use crate::{LaneSpec, Swing};

/// A key with a reader into a draft `D` and a writer from a `T`.
pub(super) struct Key<D: 'static, T: 'static> {
    pub(super) field: Field,
    /// Reads the value into the draft. A value with a fault is left out.
    pub(super) read: fn(&mut D, &mut Table<'_>, &Field),
    /// Writes the value as TOML; `None` if the key is left out.
    pub(super) write: fn(&T) -> Option<String>,
}

impl<D, T> Key<D, T> {
    /// Reads the values of these keys into a draft, even if some have faults.
    pub(super) fn read_all(keys: &'static [Self], draft: &mut D, table: &mut Table<'_>) {
        for Key { field, read, .. } in keys {
            read(draft, table, field);
        }
    }

    /// Returns a line for each of these keys, except for those that are left out.
    pub(super) fn lines(keys: &'static [Self], of: &T) -> String {
        let line = |key: &Self| Some(format!("{} = {}\n", key.field.key, (key.write)(of)?));
        keys.iter().filter_map(line).collect()
    }
}

/// Replaces a value if a new one could be read.
pub(super) fn replace_if_read<T>(value: &mut T, read: Option<T>) {
    if let Some(read) = read {
        *value = read;
    }
}

/// Returns the shortest text that reads back as the same number, with the point or exponent that TOML requires.
pub(super) fn number(value: f64) -> String {
    format!("{value:?}")
}

pub(super) fn list(items: impl IntoIterator<Item = String>) -> String {
    format!("[{}]", items.into_iter().collect::<Vec<_>>().join(", "))
}

pub(super) fn numbers(values: &[f64]) -> String {
    list(values.iter().copied().map(number))
}

/// Returns a string in double quotes. Texts of a scene contain no control characters.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

pub(super) const METHOD: Field = Field::required("method", "the method that races", Wanted::Method);
pub(super) const SUBSTEPS: Field =
    Field::optional("substeps", "steps per tick", Wanted::Whole(1..=MAX_SUBSTEPS as u64));
pub(super) const TOLERANCE: Field = Field::optional(
    "tolerance",
    "for an adaptive method, in place of its own",
    Wanted::Number(Range::Between(TOLERANCES.0, TOLERANCES.1)),
);
pub(super) const JOINT_HZ: Field = Field::optional(
    "joint_hz",
    "the frequency to set in an engine for every spring, in place of the spring's own",
    Wanted::Number(Swing::RANGES[0]),
);
const JOINT_DAMPING_RATIO: Field = Field::optional(
    "joint_damping_ratio",
    "the damping ratio to set with that; by default 0",
    Wanted::Number(Swing::RANGES[1]),
);
pub(super) const IMPACT: Field = Field::optional(
    "impact",
    "how impacts of a ball are handled; by default \"locate\", the lane's or else the scene's",
    Wanted::Impact,
);

pub(super) const TICK_HZ: Field =
    Field::required("tick_hz", "ticks per second, unless `step_s` gives them", Wanted::TickRate);
pub(super) const STEP_S: Field = Field::optional(
    "step_s",
    "the length of a tick in seconds, in place of `tick_hz`",
    Wanted::Step,
);

/// Returns a tick rate in Hz as TOML; `None` if [`step_s`] writes the rate.
pub(super) fn tick_hz(rate: TickRate) -> Option<String> {
    let is_step = rate.decimal_step_s().is_some();
    rate.decimal_hz().or_else(|| (!is_step).then(|| quoted(&rate.to_string())))
}

/// Returns a rate as TOML, for a key that must express any rate.
pub(super) fn rate(rate: TickRate) -> String {
    rate.decimal_hz().unwrap_or_else(|| quoted(&rate.to_string()))
}

/// Returns the length of a tick as TOML, if the length is a decimal number and the rate is not.
pub(super) fn step_s(rate: TickRate) -> Option<String> {
    rate.decimal_step_s().filter(|_| rate.decimal_hz().is_none())
}

/// Returns the line at the top of a scene that sets the tick rate.
pub fn tick_rate_line(rate: TickRate) -> String {
    let line = |key: &str, value| Some(format!("{key} = {}\n", value?));
    [line(TICK_HZ.key, tick_hz(rate)), line(STEP_S.key, step_s(rate))]
        .into_iter()
        .flatten()
        .collect()
}

/// A partly read lane.
#[derive(Default)]
pub(super) struct SpecDraft {
    method: Option<&'static Method>,
    substeps: Option<u32>,
    tolerance: Option<f64>,
    joint_hz: Option<f64>,
    joint_damping_ratio: Option<f64>,
    impact: Option<&'static Impact>,
}

/// The keys of a lane, which are also keys of commands.
pub(super) static SPEC: [Key<SpecDraft, LaneSpec>; 6] = [
    Key {
        field: METHOD,
        read: |spec, row, field| spec.method = row.method(field),
        write: |spec| Some(quoted(spec.method.id)),
    },
    Key {
        field: SUBSTEPS,
        read: |spec, row, field| spec.substeps = row.whole(field),
        write: |spec| {
            let is_own = spec.substeps != spec.method.default_substeps;
            is_own.then(|| spec.substeps.to_string())
        },
    },
    Key {
        field: TOLERANCE,
        read: |spec, row, _| spec.tolerance = read_tolerance(row, spec.method),
        write: |spec| spec.tolerance.map(number),
    },
    Key {
        field: JOINT_HZ,
        read: |spec, row, field| spec.joint_hz = row.number(field),
        write: |spec| Some(number(spec.joint?.frequency_hz)),
    },
    Key {
        field: JOINT_DAMPING_RATIO,
        read: |spec, row, field| spec.joint_damping_ratio = row.number(field),
        write: |spec| Some(number(spec.joint?.damping_ratio)),
    },
    Key {
        field: IMPACT,
        read: |spec, row, field| spec.impact = row.impact(field).or(spec.impact),
        write: |spec| Some(quoted(spec.own_impact()?.id)),
    },
];

/// Reads a lane, whose rule for impacts is `impact` by default if its method can have it. Reports settings that the
/// lane's method does not take.
pub(super) fn read_lane_spec(row: &mut Table<'_>, impact: &'static Impact) -> Option<LaneSpec> {
    let mut draft = SpecDraft::default();
    Key::read_all(&SPEC, &mut draft, row);
    check_joint(row, draft.method);
    let SpecDraft { method, substeps, tolerance, joint_hz, joint_damping_ratio, impact: own } =
        draft;
    let method = method?;
    if let Some(refusal) = own.and_then(|own| own.refusal(method)) {
        row.report_fault(row.span(IMPACT.key), refusal, format!("remove `{}`", IMPACT.key));
    }
    let substeps = substeps.unwrap_or(method.default_substeps);
    let damping_ratio = joint_damping_ratio.unwrap_or(0.0);
    let joint = joint_hz.map(|frequency_hz| Swing { frequency_hz, damping_ratio });
    let plain = LaneSpec { substeps, tolerance, joint, ..LaneSpec::plain(method) };
    Some(plain.with_impact(own.unwrap_or(impact)))
}

/// Reports a joint for a method that takes none, and a damping ratio without a frequency.
fn check_joint(row: &mut Table<'_>, method: Option<&'static Method>) {
    let joint = [JOINT_HZ, JOINT_DAMPING_RATIO];
    let Some(Field { key, .. }) = joint.into_iter().find(|field| row.has(field.key)) else {
        return;
    };
    if let Some(method) = method.filter(|method| !method.has_joint()) {
        let id = method.id;
        let what = format!(
            "`{key}` does not apply to the method {id:?}, which takes no settings of a spring"
        );
        let remedy = format!("remove it, or choose an engine: {}", methods(Method::has_joint));
        row.report_fault(row.span(key), what, remedy);
    } else if !row.has(JOINT_HZ.key) {
        let remedy = format!("remove it, or write `{}` too", JOINT_HZ.key);
        row.report_fault(row.span(key), format!("`{key}` stands alone"), remedy);
    }
}

/// Reads a tolerance. If the lane's method is known and takes no tolerance, reports the tolerance.
pub(super) fn read_tolerance(row: &mut Table<'_>, method: Option<&'static Method>) -> Option<f64> {
    let tolerance = row.number(&TOLERANCE);
    if let (Some(method), true) = (method, row.has(TOLERANCE.key))
        && method.tolerance.is_none()
    {
        let (key, id) = (TOLERANCE.key, method.id);
        let remedy = format!("remove it, or choose an adaptive method: {}", adaptive_methods());
        row.report_fault(
            row.span(key),
            format!("`{key}` does not apply to the method {id:?}"),
            remedy,
        );
    }
    tolerance
}

/// Returns the ids of the methods that choose their own steps.
pub(super) fn adaptive_methods() -> String {
    methods(|method| method.tolerance.is_some())
}

fn methods(fits: fn(&Method) -> bool) -> String {
    let fitting = METHODS.iter().filter(|method| fits(method));
    listed(&fitting.map(|method| method.id).collect::<Vec<_>>(), '"', ", ")
}
