//! Reads a `[[net]]`: masses joined by springs, as a grid or as lists.

use std::ops::Range as Span;
use std::sync::Arc;

use super::fields::{TOP, optional, required};
use super::nearest::nearest;
use super::table::{Field, Table};
use super::wanted::Wanted;
use crate::sim::bodies::{
    Form, Grid, Kind, Lists, MAX_NODES, NetFault, NetPart, NetPlan, Pin, PlannedSpring, Range,
    net_kind,
};

/// The name of the table array.
pub(super) const NET: &str = "net";

const COLUMNS: Field = required("columns", "how many nodes are in a row");
const ROWS: Field = required("rows", "how many rows there are");
const SPACING: Field = required("spacing_m", "the distance of neighbours");
const SHEAR: Field = optional("shear");
const PIN: Field = optional("pin");
const NODES: Field = optional("nodes");
const FIXED: Field = optional("fixed");
const SPRINGS: Field = required("springs", "which nodes are joined");
const KICKED: Field = optional("kicked_node");

const BETWEEN: Field = required("between", "the numbers of the nodes at its ends, from 0");
const STIFFNESS: Field = optional("stiffness_n_per_m");
const DAMPING: Field = optional("damping_n_s_per_m");
const REST: Field = optional("rest_m");

const GRID_KEYS: [Field; 5] = [COLUMNS, ROWS, SPACING, SHEAR, PIN];
const LIST_KEYS: [Field; 3] = [NODES, FIXED, SPRINGS];

/// The most characters of the name of a pin.
const MAX_PIN_CHARS: usize = 16;

/// Where the parts of a plan stand in the file.
#[derive(Default)]
struct Spans {
    fixed: Vec<Span<usize>>,
    springs: Vec<Span<usize>>,
}

/// The kind of a net; `None` where there is a fault.
pub(super) fn read_net(row: &mut Table<'_>) -> Option<Arc<Kind>> {
    let mut spans = Spans::default();
    let given = |keys: &[Field], row: &Table<'_>| keys.iter().find(|it| row.has(it.key)).copied();
    let lists = given(&LIST_KEYS, row);
    GRID_KEYS.iter().chain(&LIST_KEYS).chain(&[KICKED]).for_each(|field| row.knows(field.key));
    if let (Some(list), Some(of_grid)) = (lists, given(&GRID_KEYS, row)) {
        let what = format!("the net is given twice, by `{}` and by `{}`", list.key, of_grid.key);
        let remedy = "keep the grid, whose fixed nodes `pin` names, or the lists `nodes`, `fixed` and `springs`";
        row.complain(row.span(of_grid.key), what, remedy);
        return None;
    }
    let form = match lists {
        Some(_) => read_lists(row, &mut spans).map(Form::Lists),
        None => read_grid(row).map(Form::Grid),
    };
    let most = MAX_NODES as u32 - 1;
    let kicked = row.whole(KICKED, 0..=most).map(|node| node as usize);
    let is_given = row.has(KICKED.key);
    let plan = NetPlan { form: form?, kicked };
    if (is_given && kicked.is_none()) || !row.is_faultless() {
        return None;
    }
    match net_kind(plan) {
        Ok(kind) => Some(kind),
        Err(faults) => {
            faults.into_iter().for_each(|fault| complain(row, &spans, lists.is_some(), fault));
            None
        }
    }
}

fn read_grid(row: &mut Table<'_>) -> Option<Grid> {
    let most = MAX_NODES as u32;
    let [columns, rows] = [COLUMNS, ROWS].map(|field| row.whole(field, 1..=most));
    let spacing = row.number(SPACING, Range::POSITIVE);
    let shear = row.boolean(SHEAR).unwrap_or(false);
    let pin = read_pin(row);
    Some(Grid { columns: columns? as usize, rows: rows? as usize, spacing: spacing?, shear, pin })
}

fn read_pin(row: &mut Table<'_>) -> Option<Pin> {
    let written = row.text_for(PIN, MAX_PIN_CHARS, Wanted::Pin)?;
    let pin = Pin::ALL.into_iter().find(|pin| pin.id() == written);
    if pin.is_none() {
        let known = Pin::ALL.map(Pin::id);
        let what = format!("unknown `pin` {written:?}");
        let remedy = match nearest(&written, known.into_iter().map(|id| (id, id))) {
            Some(id) => format!("did you mean {id:?}?"),
            None => format!("write {}, or remove it and no node is fixed", Wanted::Pin),
        };
        row.complain(row.span(PIN.key), what, remedy);
    }
    pin
}

fn read_lists(row: &mut Table<'_>, spans: &mut Spans) -> Option<Lists> {
    let nodes = row.points(Field { needed_as: Some("where each node stands"), ..NODES });
    let fixed = row.node_numbers(FIXED, &Wanted::Nodes);
    let springs = row.spring_rows(SPRINGS, &Wanted::Springs);
    let is_whole = fixed.is_some() || !row.has(FIXED.key);
    let mut planned = Vec::new();
    for mut spring in springs? {
        spans.springs.push(spring.header.clone());
        let between = spring.node_numbers(BETWEEN, &Wanted::Ends);
        let ends = match between.as_deref() {
            Some([(_, a), (_, b)]) => Some([*a, *b]),
            Some(_) => {
                let what = "`between` does not name two nodes";
                spring.complain(spring.span(BETWEEN.key), what, Wanted::Ends.remedy());
                None
            }
            None => None,
        };
        let stiffness = spring.number(STIFFNESS, Range::POSITIVE);
        let damping = spring.number(DAMPING, Range::NON_NEGATIVE);
        let rest = spring.number(REST, Range::NON_NEGATIVE);
        planned.push(ends.map(|between| PlannedSpring { between, stiffness, damping, rest }));
        row.adopt(spring, &TOP);
    }
    let (fixed_spans, fixed) = fixed.unwrap_or_default().into_iter().unzip();
    spans.fixed = fixed_spans;
    let springs = planned.into_iter().collect::<Option<Vec<_>>>()?;
    is_whole.then_some(Lists { nodes: nodes?, fixed, springs })
}

/// Reports what is wrong with a part of the plan at its place in the file.
fn complain(row: &mut Table<'_>, spans: &Spans, are_lists: bool, fault: NetFault) {
    let NetFault { part, what, remedy } = fault;
    let at = match part {
        NetPart::Nodes if are_lists => row.span(NODES.key),
        NetPart::Nodes => row.span(COLUMNS.key),
        NetPart::Spacing => row.span(SPACING.key),
        NetPart::Springs if are_lists => row.span(SPRINGS.key),
        NetPart::Springs => row.span(COLUMNS.key),
        NetPart::Fixed(place) => spans.fixed.get(place).cloned().unwrap_or(row.span(PIN.key)),
        NetPart::Spring(place) => {
            spans.springs.get(place).cloned().unwrap_or(row.span(COLUMNS.key))
        }
        NetPart::Kicked => row.span(KICKED.key),
    };
    row.complain(at, what, remedy);
}
